// SPDX-License-Identifier: Apache-2.0
#include "integrators/adaptive_direct.h"

#include <algorithm>
#include <chrono>

namespace lampyris {

namespace {

/// Even where BSDF samples do better, most of them miss (eq. 7).
constexpr float kHitBonus = 10;

/// 1 / density; 0 if that is not positive. Densities near a mirror may overflow to infinity.
float inverse(float density) { return density > 0 ? 1 / density : 0.f; }

/// The point as the tree sees it, which `worth` of the whole cut is drawn for.
LightSampleContext seenByTree(const LightSampleContext& at, float worth) {
  LightSampleContext tree = at;
  tree.worth *= worth;
  return tree;
}

enum Technique : size_t { kTree, kBrdfOriented, kBsdf };

/// Tells how long techniques take, at one point in 16: reading the clock has its price too.
class TechniqueClock {
 public:
  explicit TechniqueClock(DirectCounts& counts) : counts_(counts), runs_(counts.points % 16 == 0) {
    if (runs_) last_ = Clock::now();
  }
  /// The time since the last lap was the technique's.
  void lap(Technique technique) {
    if (!runs_) return;
    const auto now = Clock::now();
    counts_.seconds[technique] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  DirectCounts& counts_;
  bool runs_;
  Clock::time_point last_;
};

}  // namespace

/// A point at work.
struct AdaptiveDirect::Point {
  const LightSampleContext& at;
  LightSampleContext tree;
  SampledLights& ofTree;  ///< what the tree drew
  const float time;
  SampleStream& stream;
  RenderState& state;
  const uint32_t firstDimension;
  std::optional<BrdfReceiver> receiver{};  ///< these two at glossy points alone
  std::optional<BrdfVertex> brdf{};
  bool cut = true;
  int samples = 0;  ///< N
  int hits = 1, misses = 1;
  bool drawsLights = false;                                                  ///< some p_i > 0
  std::array<float, AdaptiveSettings::kMostSamples + 1> lightProbabilities;  ///< p_i

  Point(const LightSampleContext& context, float rayTime, SampleStream& numbers, RenderState& s)
      : at(context),
        ofTree(buffer()),
        time(rayTime),
        stream(numbers),
        state(s),
        firstDimension(numbers.dimension()) {}

  /// `least`: points whose glossy lobes have less albedo count as diffuse.
  void look(const BrdfLightDistribution& lights, float least) {
    if (!BrdfReceiver::isWorthwhile(at)) return;
    receiver.emplace(at);
    if (receiver->isGlossy() && receiver->glossyAlbedo() >= least)
      brdf.emplace(lights, at, *receiver);
  }

  static SampledLights& buffer() {
    thread_local SampledLights lights;
    return lights;
  }
  float count() const { return static_cast<float>(samples); }
  /// N m_i, given the densities by solid angle of either technique.
  float mixture(int i, float byLights, float byBsdf) const {
    const float p = lightProbabilities[static_cast<size_t>(i)];
    return count() * (p * byLights + (1 - p) * byBsdf);
  }
  float lightDensity(LightId light, float lightPdf) const {
    return drawsLights ? brdf->pmf(light) * lightPdf : 0.f;
  }
};

AdaptiveDirect::AdaptiveDirect(const Scene& scene, const AdaptiveSettings& settings,
                               const LightDistribution& lights)
    : scene_(scene),
      lights_(dynamic_cast<const BrdfLightDistribution&>(lights)),
      maxSamples_(settings.maxSamples),
      how_(settings.how()) {
  for (const auto& light : scene.lights) visible_ = visible_ || !light->isDelta();
}

AdaptiveDirect::Parts AdaptiveDirect::radiance(const LightSampleContext& at, float time,
                                               SampleStream& stream, RenderState& state) const {
  Allocation allocation;
  return estimate(at, time, Purpose::Ending, stream, state, allocation);
}

AdaptiveDirect::Parts AdaptiveDirect::lightSamples(const LightSampleContext& at, float time,
                                                   Effort effort, SampleStream& stream,
                                                   RenderState& state,
                                                   Allocation& allocation) const {
  const Purpose purpose = effort == Effort::One ? Purpose::ContinuedByOne : Purpose::Continued;
  return estimate(at, time, purpose, stream, state, allocation);
}

int AdaptiveDirect::sampleCount(const Point& point, Purpose purpose, float u) const {
  const bool continued = purpose != Purpose::Ending;
  if (!point.brdf) return continued || visible_;
  if (purpose == Purpose::ContinuedByOne) return 2;
  const float wanted = static_cast<float>(maxSamples_) * point.brdf->importance();
  return std::clamp(static_cast<int>(wanted + u), 1, maxSamples_);
}

/// BRDF-aware samples are drawn by what all lobes make of lights, so each takes its part of the
/// cut's work over; but not that of single lights, which the tree draws without chance.
float AdaptiveDirect::treeWorth(const Point& point) {
  if (!point.brdf || point.samples <= 1) return 1;
  return lerp(point.brdf->shareOfSingleLights(), 1 / point.count(), 1.f);
}

/// p_i, a function of the samples before i alone.
float AdaptiveDirect::lightProbability(const Point& point, int i) const {
  if (!point.brdf) return 0;
  if (!visible_) return 1;
  if (!point.cut) return i == 0 ? 1.f : 0.f;
  switch (how_) {
    case BrdfAllocation::Equal:
      return 0.5f;
    case BrdfAllocation::Lights:
      return 1;
    case BrdfAllocation::Bsdf:
      return 0;
    case BrdfAllocation::Adaptive:
      break;
  }
  if (i == 0) return 0;
  const auto misses = static_cast<float>(point.misses);
  return misses / (misses + kHitBonus * static_cast<float>(point.hits));
}

// A point's numbers: rounding of N, choice in the cut; then four a BRDF-aware sample; then two for
// the samples of the tree.
AdaptiveDirect::Parts AdaptiveDirect::estimate(const LightSampleContext& at, float time,
                                               Purpose purpose, SampleStream& stream,
                                               RenderState& state, Allocation& allocation) const {
  DirectCounts& counts = state.direct;
  TechniqueClock clock(counts);
  Point point(at, time, stream, state);
  point.cut = purpose != Purpose::ContinuedByOne;
  // One sample is all that less could be worth.
  point.look(lights_, 1 / static_cast<float>(maxSamples_));
  point.samples = sampleCount(point, purpose, point.brdf ? stream.next1D() : 0);
  allocation = {point.samples, point.cut, treeWorth(point)};
  point.tree = seenByTree(at, allocation.treeWorth);
  clock.lap(kBrdfOriented);
  drawFromTree(point);
  clock.lap(kTree);

  if (state.aov) state.aov->beginLightVertex();
  ++counts.points;
  if (point.brdf) ++counts.glossyPoints, counts.cutClusters += point.brdf->cutSize();
  Parts sum;
  int ofBsdf = 0;
  for (int i = 0; i < point.samples; ++i) {
    const bool continuation = purpose != Purpose::Ending && i + 1 == point.samples;
    float& p = point.lightProbabilities[static_cast<size_t>(i)];
    p = continuation ? 0 : lightProbability(point, i);
    point.drawsLights = point.drawsLights || p > 0;
    counts.bsdfSamples += continuation && point.brdf;
    ofBsdf += continuation;
    if (continuation) break;
    const uint32_t first = point.firstDimension + 2 + 4 * static_cast<uint32_t>(i);
    stream.setDimension(first);
    const bool ofLights = p > 0 && stream.next1D() < p;
    stream.setDimension(first + 1);
    if (ofLights) {
      sum.lights += brdfLightSample(point, i);
      clock.lap(kBrdfOriented);
    } else {
      sum.bsdf += bsdfSample(point, i);
      ++ofBsdf;
      clock.lap(kBsdf);
    }
  }
  sum.lights += treeSamples(point);
  clock.lap(kTree);
  if (state.aov) state.aov->brdfAware(point.samples, ofBsdf);
  return sum;
}

Rgb AdaptiveDirect::brdfLightSample(Point& point, int i) const {
  ++point.state.direct.lightSamples;
  const Vec2 u = point.stream.next2D();
  const auto chosen = point.brdf->sample(point.stream.next1D());
  if (!chosen || !(chosen->pmf > 0)) return Rgb();
  scene_.lightTable.prefetch(chosen->light);
  if (point.state.aov) point.state.aov->lightDraw(chosen->pmf);
  const LightSampleContext& at = point.at;
  const auto c = connectToLight(scene_, at, point.time, chosen->light, u, point.state.rays);
  if (!c) return Rgb();
  const float byBsdf = c->isDelta ? 0 : at.bsdf->pdf(at.wo, c->wi);
  const float tree = treeDraws(point.tree, point.cut, chosen->light) * c->pdf;
  return c->value * inverse(tree + point.mixture(i, chosen->pmf * c->pdf, byBsdf));
}

Rgb AdaptiveDirect::bsdfSample(Point& point, int i) const {
  const LightSampleContext& at = point.at;
  const Vec2 u = point.stream.next2D();
  const auto s = at.bsdf->sample(at.wo, point.stream.next1D(), u);
  Rgb found;
  if (s && !s->isSpecular() && s->pdf > 0 && !s->f.isBlack()) {
    const auto weight = [&](LightId light, float lightPdf) {
      const float tree = treeDraws(point.tree, point.cut, light) * lightPdf;
      const float p = point.lightProbabilities[static_cast<size_t>(i)];
      const float byLights = p > 0 ? point.lightDensity(light, lightPdf) : 0;
      return inverse(tree + point.mixture(i, byLights, s->pdf));
    };
    Ray ray;
    ray.o = offsetRayOrigin(at.p, at.pError, at.n, s->wi);
    ray.d = s->wi;
    ray.time = point.time;
    ++point.state.rays.closest;
    if (const auto hit = scene_.geometry->intersect(ray)) {
      if (scene_.geometry->primitive(*hit).light)
        found =
            emissionAtHit(at.p, scene_.geometry->surface(ray, *hit, SurfaceDetail::Basic), weight);
    } else {
      found = emissionOutside(scene_, ray.d, weight);
    }
    found *= s->f * at.bsdf->absCosTheta(s->wi);
  }
  const bool hit = !found.isBlack();
  ++(hit ? point.hits : point.misses);
  if (point.brdf) ++point.state.direct.bsdfSamples, point.state.direct.bsdfHits += hit;
  return found;
}

float AdaptiveDirect::treeDraws(const LightSampleContext& at, bool cut, LightId light) const {
  const LightDistribution& tree = lights_.plain();
  return cut ? tree.expectedCount(at, light) : tree.pmf(at, light);
}

/// Before anything else of the point, so that memory has the lights when their turn comes.
void AdaptiveDirect::drawFromTree(Point& point) const {
  point.stream.setDimension(point.firstDimension + 1);
  const float choice = point.stream.next1D();
  const LightDistribution& tree = lights_.plain();
  point.ofTree.clear();
  if (point.cut)
    tree.sampleCut(point.tree, choice, point.ofTree);
  else if (const auto drawn = tree.sample(point.tree, choice))
    point.ofTree.push_back(*drawn);
  prefetchLights(scene_, point.ofTree);
}

Rgb AdaptiveDirect::treeSamples(Point& point) const {
  SampleStream& stream = point.stream;
  stream.setDimension(point.firstDimension + 3 + 4 * AdaptiveSettings::kMostSamples);
  Rgb sum;
  Vec2 u = stream.next2D();
  for (const SampledLight& light : point.ofTree) {
    sum += treeSample(point, light, u);
    u = nextInCut(u);
  }
  return sum;
}

Rgb AdaptiveDirect::treeSample(Point& point, const SampledLight& chosen, const Vec2& u) const {
  ++point.state.direct.treeSamples;
  if (!(chosen.pmf > 0)) return Rgb();
  if (point.state.aov) point.state.aov->lightDraw(chosen.pmf);
  const LightSampleContext& at = point.at;
  const auto c = connectToLight(scene_, at, point.time, chosen.light, u, point.state.rays);
  if (!c) return Rgb();
  const float tree = chosen.pmf * c->pdf;
  if (point.samples == 0) return c->value * inverse(tree);
  const float byBsdf = c->isDelta ? 0 : at.bsdf->pdf(at.wo, c->wi);
  const float byLights = point.lightDensity(chosen.light, c->pdf);
  float sum = 0;
  for (int i = 0; i < point.samples; ++i) sum += inverse(tree + point.mixture(i, byLights, byBsdf));
  return c->value * (sum / point.count());
}

float AdaptiveDirect::continuationWeight(const LightSampleContext& from,
                                         const Allocation& allocation, float bsdfPdf, LightId light,
                                         float lightPdf) const {
  // The path's throughput has been divided by the density already.
  const LightSampleContext seen = seenByTree(from, allocation.treeWorth);
  const float tree = treeDraws(seen, allocation.cut, light) * lightPdf;
  return 1 / (tree / bsdfPdf + static_cast<float>(allocation.samples));
}

Rgb AdaptiveDirect::foundAtHit(const LightSampleContext& from, const Allocation& allocation,
                               float bsdfPdf, const SurfaceInteraction& hit) const {
  return emissionAtHit(from.p, hit, [&](LightId light, float lightPdf) {
    return continuationWeight(from, allocation, bsdfPdf, light, lightPdf);
  });
}

Rgb AdaptiveDirect::foundOutside(const LightSampleContext& from, const Allocation& allocation,
                                 float bsdfPdf, const Vec3& d) const {
  return emissionOutside(scene_, d, [&](LightId light, float lightPdf) {
    return continuationWeight(from, allocation, bsdfPdf, light, lightPdf);
  });
}

}  // namespace lampyris
