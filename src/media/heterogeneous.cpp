// SPDX-License-Identifier: Apache-2.0
// A medium whose density is given on a grid. Distances by delta tracking (Woodcock et al. 1965) and
// transmittances by ratio tracking (Novák et al. 2014) against bounds on a coarser grid. Where the
// channels' extinctions differ (an error in pbrt-v3), collisions are drawn for their mean and the
// weights make up for it (spectral tracking, Kutz et al. 2017).
#include <fmt/format.h>

#include <algorithm>

#include "core/sampling.h"
#include "media/coefficients.h"
#include "media/density_grid.h"
#include "media/henyey_greenstein.h"

namespace lampyris {

namespace {

float meanOf(const Rgb& c) { return (c.r + c.g + c.b) / 3; }

class HeterogeneousMedium final : public Medium {
 public:
  HeterogeneousMedium(const MediumCoefficients& c, const Transform& unitToWorld, DensityGrid grid)
      : scattering_(c.scattering),
        extinction_(c.extinction()),
        most_(extinction_.maxComponent()),
        worldToUnit_(unitToWorld.inverse()),
        grid_(std::move(grid)),
        phase_(c.g) {}

  MediumSample sample(const Ray& ray, NumberSequence& numbers,
                      TrackingCounts& counts) const override {
    MediumSample s;
    forEachCollision(ray, numbers, counts,
                     [&](float t, const Rgb& collides, float density, float bound) {
                       const float mean = meanOf(s.weight);
                       if (!(mean > 0)) return false;
                       const float real = std::min(1.f, meanOf(s.weight * collides) / mean);
                       if (numbers.next() < real) {
                         s.scatters = true;
                         s.t = t;
                         s.weight *= scattering_ * (density / (most_ * bound * real));
                         return false;
                       }
                       s.weight *= (Rgb(1) - collides) / (1 - real);
                       return true;
                     });
    return s;
  }

  Rgb transmittance(const Ray& ray, NumberSequence& numbers,
                    TrackingCounts& counts) const override {
    Rgb share(1);
    forEachCollision(ray, numbers, counts, [&](float, const Rgb& collides, float, float) {
      share *= Rgb(1) - collides;
      // Long ways through what is nearly opaque are not worth following: roulette.
      const float most = share.maxComponent();
      if (!(most < 0.1f)) return true;
      const float end = std::max(0.05f, 1 - most);
      if (numbers.next() < end) {
        share = Rgb();
        return false;
      }
      share /= 1 - end;
      return true;
    });
    return share;
  }

  const PhaseFunction& phase() const override { return phase_; }

 private:
  /// Draws collisions for the bound of the extinction; calls visit(t, per channel the probability
  /// that a collision is real, density, its bound), which returns false to stop.
  template <class F>
  void forEachCollision(const Ray& world, NumberSequence& numbers, TrackingCounts& counts,
                        F&& visit) const {
    uint64_t steps = 0;
    Ray ray = world;
    ray.o = worldToUnit_.point(world.o);
    ray.d = worldToUnit_.vector(world.d);  // so t stays a distance in world space
    grid_.track(ray, [&](float t0, float t1, float bound) {
      const float majorant = most_ * bound;
      float t = t0;
      while (majorant > 0) {
        t += sampleExponential(numbers.next()) / majorant;
        if (!(t < t1)) break;
        ++steps;
        const float density = std::min(grid_.density(ray.at(t)), bound);
        if (!visit(t, extinction_ * (density / majorant), density, bound)) return false;
      }
      return true;
    });
    ++counts.rays;
    counts.steps += steps;
  }

  Rgb scattering_, extinction_;
  float most_;  ///< of the extinction's channels
  Transform worldToUnit_;
  DensityGrid grid_;
  HenyeyGreenstein phase_;
};

struct HeterogeneousParameters {
  CoefficientParameters coefficients;
  std::vector<float> density;
  int nx = 1, ny = 1, nz = 1, boundCells = 0;
  Vec3 p0{0}, p1{1};

  void declare(Declaration& d) {
    coefficients.declare(d);
    d.add("density", density, "Factors on the coefficients, x fastest.")
        .atLeast(0)
        .rangeIs("nx × ny × nz values, at least 0");
    d.add("nx", nx, "Cells along x.").atLeast(1);
    d.add("ny", ny, "Cells along y.").atLeast(1);
    d.add("nz", nz, "Cells along z.").atLeast(1);
    d.add("boundcells", boundCells,
          "Cells along each side of the grid of bounds on the density, which lets rays pass empty "
          "space.")
        .range(0, 256)
        .defaultIs("0: an eighth of the density's longest side, from 16 to 64");
    d.add("p0", p0, "A corner of the grid.").rangeIs("any that differ in x, y and z");
    d.add("p1", p1, "The opposite corner.").rangeIs("any that differ in x, y and z");
  }
};

std::unique_ptr<Medium> create(const HeterogeneousParameters& p, const MediumContext& context) {
  const double wanted = static_cast<double>(p.nx) * p.ny * p.nz;
  if (wanted != static_cast<double>(p.density.size()))
    throw SceneError(context.location,
                     fmt::format("heterogeneous medium: nx × ny × nz = {} × {} × {} = {} values of "
                                 "\"density\" are needed, there are {}",
                                 p.nx, p.ny, p.nz, wanted, p.density.size()));
  const Vec3 extent = p.p1 - p.p0;
  if (extent.x == 0 || extent.y == 0 || extent.z == 0)
    throw SceneError(context.location, "heterogeneous medium: p0 and p1 span no volume");
  const int boundCells =
      p.boundCells > 0 ? p.boundCells : std::clamp(std::max({p.nx, p.ny, p.nz}) / 8, 16, 64);
  const Transform unitToWorld =
      context.mediumToWorld * Transform::translate(p.p0) * Transform::scale(extent);
  return std::make_unique<HeterogeneousMedium>(
      p.coefficients.resolve(context), unitToWorld,
      DensityGrid(p.nx, p.ny, p.nz, p.density, boundCells));
}

}  // namespace

MediumRegistry::Entry heterogeneousMediumPlugin() {
  return makePlugin("heterogeneous", "A medium whose density is given on a grid.", create);
}

}  // namespace lampyris
