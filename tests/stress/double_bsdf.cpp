// SPDX-License-Identifier: Apache-2.0
#include "stress/double_bsdf.h"

#include <cmath>
#include <complex>
#include <glm/glm.hpp>

namespace lampyris::test {
namespace {

using DVec3 = glm::dvec3;

double sq(double x) { return x * x; }

/// Smith's Λ.
double lambda(double cosine, double alpha) {
  const double tan2 = std::max(0., 1 - sq(cosine)) / sq(cosine);
  return (std::sqrt(1 + sq(alpha) * tan2) - 1) / 2;
}
double shadowing(double cosO, double cosI, double alpha) {
  return 1 / (1 + lambda(cosO, alpha) + lambda(cosI, alpha));
}

/// ∫ D(m) cos(m) · (o·m) / (cos o cos m) · value(m, o·m) over the facets that face o: evenly in v
/// with tan² = α² (1 − v²) / v², for which D cos dω = 2 v dv dφ / 2π and upright facets, 1 / cos m,
/// do no harm.
template <class Value>
double overFacets(const DVec3& o, double alpha, int facets, const Value& value) {
  double sum = 0;
  for (int i = 0; i < facets; ++i) {
    const double v = (i + 0.5) / facets, tan = alpha * std::sqrt(1 - v * v) / v;
    const double cos = 1 / std::sqrt(1 + tan * tan);
    for (int j = 0; j < facets; ++j) {
      const double phi = 2 * M_PI * (j + 0.5) / facets;
      const DVec3 m(cos * tan * std::cos(phi), cos * tan * std::sin(phi), cos);
      const double facing = glm::dot(o, m);
      if (facing > 0) sum += 2 * v * facing / (o.z * m.z) * value(m, facing);
    }
  }
  return sum / (double{1} * facets * facets);
}

DVec3 view(double cosine) { return {std::sqrt(1 - sq(cosine)), 0, cosine}; }

double reflected(const DVec3& o, const DVec3& m, double facing, double alpha) {
  const double z = 2 * facing * m.z - o.z;
  return z > 0 ? shadowing(o.z, z, alpha) : 0;
}

}  // namespace

double dielectricFresnel(double cosine, double eta) {
  const double under = sq(eta) - 1 + sq(cosine);  // (η cos of the refracted direction)²
  if (under <= 0) return 1;
  const double t = std::sqrt(under);
  const double s = (cosine - t) / (cosine + t);
  const double p = (sq(eta) * cosine - t) / (sq(eta) * cosine + t);
  return (s * s + p * p) / 2;
}

double conductorFresnel(double cosine, double eta, double k) {
  const std::complex<double> n2 = std::complex<double>(eta, k) * std::complex<double>(eta, k);
  const std::complex<double> t = std::sqrt(n2 - (1 - sq(cosine)));
  return (std::norm((cosine - t) / (cosine + t)) +
          std::norm((n2 * cosine - t) / (n2 * cosine + t))) /
         2;
}

double metalAlbedo(double cosine, double alpha, double eta, double k, int facets) {
  const DVec3 o = view(cosine);
  return overFacets(o, alpha, facets, [&](const DVec3& m, double facing) {
    return conductorFresnel(facing, eta, k) * reflected(o, m, facing, alpha);
  });
}

double glassAlbedo(double cosine, double alpha, double eta, int facets) {
  const DVec3 o = view(cosine);
  return overFacets(o, alpha, facets, [&](const DVec3& m, double facing) {
    const double r = dielectricFresnel(facing, eta);
    double sum = r * reflected(o, m, facing, alpha);
    const double under = sq(eta) - 1 + sq(facing);
    if (under > 0) {  // Snell's law, as a vector
      const double z = ((facing - std::sqrt(under)) * m.z - o.z) / eta;
      if (z < 0) sum += (1 - r) * shadowing(o.z, -z, alpha) / sq(eta);
    }
    return sum;
  });
}

}  // namespace lampyris::test
