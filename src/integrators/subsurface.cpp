// SPDX-License-Identifier: Apache-2.0
// Entry points of separable BSSRDFs: King et al. 2013, "BSSRDF Importance Sampling", as in Pharr et
// al. 2016, §11.4.2. A distance is drawn from one channel's profile on a disk across one of the
// three axes of the frame, and a probe ray through the disk finds surfaces of the same material;
// one of them is drawn. The density is that of all axes and channels together.
//
// Cost: the rays of one probe, as many as it meets surfaces, and one more.
#include "integrators/subsurface.h"

#include <cmath>

#include "core/frame.h"
#include "core/rejections.h"

namespace lampyris {

namespace {

/// Probability of the axes x, y and z: most entries are around the normal.
constexpr float kAxisProbability[] = {0.25f, 0.25f, 0.5f};
/// Distances beyond this share of a profile are not probed.
constexpr float kProbedShare = 0.999f;
/// Surfaces along one probe: two that coincide must not hold it forever.
constexpr int kMaxProbeHits = 1000;

/// A uniform variate that decides several things, one after the other.
class Decider {
 public:
  explicit Decider(float u) : u_(u) {}
  bool operator()(float probability) {
    const bool yes = u_ < probability;
    u_ = yes ? u_ / probability : (u_ - probability) / (1 - probability);
    u_ = std::clamp(u_, 0.f, kOneMinusEpsilon);
    return yes;
  }
  int among(int n) {
    for (int i = 0; i + 1 < n; ++i)
      if ((*this)(1 / static_cast<float>(n - i))) return i;
    return n - 1;
  }

 private:
  float u_;
};

struct Probe {
  Vec3 start{0}, direction{0, 0, 1};
  float length = 0;
};

std::optional<Probe> drawProbe(const Bssrdf& bssrdf, const Vec3& center, const Frame& frame,
                               Decider& decide, const Vec2& u) {
  const Vec3* axis[] = {&frame.x, &frame.y, &frame.z};
  size_t along = 2;
  if (!decide(kAxisProbability[2])) along = decide(0.5f) ? 0 : 1;
  const Vec3 &x = *axis[(along + 1) % 3], &y = *axis[(along + 2) % 3], &z = *axis[along];
  const int channel = decide.among(Bssrdf::kChannels);
  const auto r = bssrdf.sampleRadius(channel, u.x);
  const auto most = bssrdf.sampleRadius(channel, kProbedShare);
  if (!r || !most || !(*r < *most)) return std::nullopt;
  // The chord of a sphere that holds the probed share.
  const float half = std::sqrt(*most * *most - *r * *r), phi = 2 * kPi * u.y;
  Probe p;
  p.start = center + *r * (std::cos(phi) * x + std::sin(phi) * y) - half * z;
  p.direction = z;
  p.length = 2 * half;
  return p;
}

/// One of the surfaces of `material` on the probe, all equally likely, and their number.
struct ProbeHits {
  SurfaceInteraction chosen;
  int count = 0;
};
ProbeHits follow(const Probe& probe, const Geometry& geometry, const Material& material, float time,
                 Decider& decide, RayCounts& rays) {
  ProbeHits hits;
  Ray ray;
  ray.o = probe.start;
  ray.d = probe.direction;
  ray.tMax = probe.length;
  ray.time = time;
  const Vec3 end = probe.start + probe.length * probe.direction;
  for (int i = 0; ray.tMax > 0; ++i) {
    ++rays.closest;
    const auto hit = geometry.intersect(ray);
    if (!hit) break;
    if (i == kMaxProbeHits) {
      countRejection(Rejection::ProbeHits);
      break;
    }
    const SurfaceInteraction at = geometry.surface(ray, *hit, SurfaceDetail::Basic);
    // The n-th takes the place of those before with probability 1/n.
    if (geometry.primitive(*hit).material == &material &&
        decide(1 / static_cast<float>(++hits.count)))
      hits.chosen = at;
    ray.o = offsetRayOrigin(at.p, at.pError, at.n, ray.d);
    ray.tMax = dot(end - ray.o, ray.d);
  }
  return hits;
}

/// Density by area with which a probe passes through `entry`.
float probeDensity(const Bssrdf& bssrdf, const SurfaceInteraction& entry, const Vec3& center,
                   const Frame& frame) {
  const Vec3 d = frame.toLocal(entry.p - center), n = absComponents(frame.toLocal(entry.n));
  const float across[] = {std::hypot(d.y, d.z), std::hypot(d.z, d.x), std::hypot(d.x, d.y)};
  const float cosine[] = {n.x, n.y, n.z};
  float sum = 0;
  for (size_t axis = 0; axis < 3; ++axis)
    for (int channel = 0; channel < Bssrdf::kChannels; ++channel)
      sum += bssrdf.pdfRadius(channel, across[axis]) * cosine[axis] * kAxisProbability[axis];
  return sum / Bssrdf::kChannels;
}

}  // namespace

bool scattersBelowSurfaces(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const auto& m) { return m->scattersBelow(); });
}

std::optional<SubsurfaceEntry> sampleSubsurfaceEntry(const Geometry& geometry,
                                                     const Material& material, const Bssrdf& bssrdf,
                                                     const SurfaceInteraction& exit,
                                                     const Frame& frame, float time, float uc,
                                                     const Vec2& u, RayCounts& rays) {
  Decider decide(uc);
  const auto probe = drawProbe(bssrdf, exit.p, frame, decide, u);
  if (!probe) return std::nullopt;
  const ProbeHits hits = follow(*probe, geometry, material, time, decide, rays);
  if (hits.count == 0) return std::nullopt;
  SubsurfaceEntry entry{hits.chosen, Rgb()};
  const float density =
      probeDensity(bssrdf, entry.at, exit.p, frame) / static_cast<float>(hits.count);
  if (!(density > 0)) return std::nullopt;
  entry.weight = bssrdf.profile(distance(exit.p, entry.at.p)) / density;
  if (entry.weight.isBlack()) return std::nullopt;
  if (!entry.weight.isFinite()) {
    countRejection(Rejection::PathWeight);
    return std::nullopt;
  }
  entry.at.wo = entry.at.shading.n;
  return entry;
}

}  // namespace lampyris
