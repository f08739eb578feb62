// SPDX-License-Identifier: Apache-2.0
#include "materials/beam_diffusion.h"

#include <cmath>

#include "core/parallel.h"
#include "materials/fresnel.h"

namespace lampyris {

namespace {

/// Points along a beam for extinction 1, drawn by transmittance, stratified.
constexpr int kBeamSamples = 100;
const std::array<double, kBeamSamples>& beamDepths() {
  static const std::array<double, kBeamSamples> depths = [] {
    std::array<double, kBeamSamples> all;
    for (int i = 0; i < kBeamSamples; ++i)
      all[static_cast<size_t>(i)] = -std::log(1 - (i + 0.5) / kBeamSamples);
    return all;
  }();
  return depths;
}

double fresnel(double cosine, double eta) {
  return static_cast<double>(
      fresnelDielectric(static_cast<float>(cosine), static_cast<float>(eta)));
}

double henyeyGreenstein(double cosine, double g) {
  const double d = 1 + g * g + 2 * g * cosine;
  return (1 - g * g) / (4 * M_PI * d * std::sqrt(d));
}

double fresnelMoment(double eta, int k) {
  constexpr int kSteps = 4096;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double c = (i + 0.5) / kSteps;
    sum += fresnel(c, eta) * std::pow(c, k);
  }
  return sum / kSteps;
}

/// What multiple scattering needs of the medium and its boundary.
struct Diffusion {
  double transport;  ///< reduced extinction
  double albedo;     ///< reduced
  double d;          ///< Grosjean's diffusion coefficient
  double decay;      ///< effective transport coefficient σtr
  double mirror;     ///< depth of the mirror plane of the boundary condition, below 0
  double fluence, flux;

  Diffusion(double rho, double g, double firstMoment, double secondMoment) {
    const double sigmaA = 1 - rho, reduced = rho * (1 - g);
    transport = sigmaA + reduced;
    albedo = transport > 0 ? reduced / transport : 0;
    d = (2 * sigmaA + reduced) / (3 * transport * transport);
    decay = safeSqrt(sigmaA / d);
    mirror = -2 * d * (1 + 3 * secondMoment) / (1 - 2 * firstMoment);
    fluence = (1 - 2 * firstMoment) / 4;
    flux = (1 - 3 * secondMoment) / 2;
  }

  /// Exitance of a dipole: a point source on the beam and its negative image beyond the boundary
  /// (eqs. 11–14), with the paper's correction of near sources.
  double exitance(double depth, double r) const {
    const double image = -depth + 2 * mirror;
    const double dr = std::sqrt(r * r + depth * depth), dv = std::sqrt(r * r + image * image);
    const double er = std::exp(-decay * dr), ev = std::exp(-decay * dv);
    const double phi = (er / dr - ev / dv) / (4 * M_PI * d);
    const double e = (depth * (1 + decay * dr) * er / (dr * dr * dr) -
                      image * (1 + decay * dv) * ev / (dv * dv * dv)) /
                     (4 * M_PI);
    const double near = 1 - std::exp(-2 * transport * (dr + depth));
    return near * albedo * albedo * (phi * fluence + e * flux);
  }
  /// Mean over the beam.
  double exitance(double r) const {
    if (!(transport > 0)) return 0;
    double sum = 0;
    for (const double depth : beamDepths()) sum += exitance(depth / transport, r);
    return sum / kBeamSamples;
  }
};

}  // namespace

BeamDiffusion::BeamDiffusion(double g, double eta)
    : g_(g),
      eta_(eta),
      firstMoment_(fresnelMoment(1 / eta, 1)),
      secondMoment_(fresnelMoment(1 / eta, 2)) {}

double BeamDiffusion::multiple(double albedo, double r) const {
  return Diffusion(albedo, g_, firstMoment_, secondMoment_).exitance(r);
}

double BeamDiffusion::single(double albedo, double r) const {
  // Nearer to the surface all light towards r is reflected back inside.
  const double first = r * safeSqrt(eta_ * eta_ - 1);
  double sum = 0;
  for (const double below : beamDepths()) {
    const double depth = first + below;
    const double way = std::sqrt(r * r + depth * depth), cosine = depth / way;
    sum += albedo * std::exp(-(way + first)) / (way * way) * henyeyGreenstein(cosine, g_) *
           (1 - fresnel(-cosine, eta_)) * cosine;
  }
  return sum / kBeamSamples;
}

DiffusionTable::DiffusionTable(float g, float eta) {
  constexpr size_t kAlbedos = 100, kRadii = 64;
  std::vector<float> albedos(kAlbedos), radii(kRadii), values(kAlbedos * kRadii);
  // Denser towards 1, where the reflectance rises.
  for (size_t i = 0; i < kAlbedos; ++i)
    albedos[i] = -std::expm1(-8 * static_cast<float>(i) / (kAlbedos - 1)) / -std::expm1(-8.f);
  radii[1] = 2.5e-3f;
  for (size_t i = 2; i < kRadii; ++i) radii[i] = radii[i - 1] * 1.2f;

  const BeamDiffusion beam(static_cast<double>(g), static_cast<double>(eta));
  parallelFor(kAlbedos, 4, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const auto albedo = static_cast<double>(albedos[i]);
      for (size_t k = 1; k < kRadii; ++k) {
        const auto r = static_cast<double>(radii[k]);
        const double exitance = beam.multiple(albedo, r) + beam.single(albedo, r);
        values[i * kRadii + k] = static_cast<float>(2 * M_PI * r * exitance);
      }
    }
  });
  profiles_ = SplineGrid(std::move(albedos), std::move(radii), std::move(values));
  effective_ = profiles_.totals();
}

SplineGrid::Row DiffusionTable::profile(float albedo) const {
  return *profiles_.row(std::clamp(albedo, 0.f, profiles_.xs().back()));
}

float DiffusionTable::albedoOfReflectance(float reflectance) const {
  return invertSpline(profiles_.xs(), effective_, reflectance);
}

}  // namespace lampyris
