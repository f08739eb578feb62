// SPDX-License-Identifier: Apache-2.0
// Path tracing with media (pbrt-v3's "volpath" in expectation) and, where there is a guide, with
// directions from the mixture of the BSDF or phase function and the guide. Light sampling and the
// path's next ray are joined by multiple importance sampling with the mixture's own part; the next
// ray serves as the other half, so no ray is traced for it alone. Cost a vertex: one shadow ray,
// one ray, and a look-up of the guide; the shadow ray comes second, while memory fetches what the
// other one has hit.
#include "integrators/volume_path.h"

#include "core/hash.h"
#include "integrators/aov_surface.h"
#include "integrators/direction_mixture.h"
#include "integrators/light_connection.h"
#include "integrators/ray_surface.h"
#include "integrators/sample_numbers.h"
#include "integrators/scattering_point.h"
#include "integrators/subsurface.h"
#include "integrators/transmittance.h"

namespace lampyris {

namespace {

/// Vertices of a path that are learned from, at most.
constexpr size_t kMaxTurns = 64;

/// Chooses one of `stride` samples, scattered over pixels and indices alike.
bool isChosen(const SampleAddress& a, uint64_t stride) {
  if (stride == 1) return true;
  const uint64_t x = static_cast<uint32_t>(a.pixel.x), y = static_cast<uint32_t>(a.pixel.y);
  return hashCombine(x << 32 | y, a.index) % stride == 0;
}

}  // namespace

VolumePathEstimator::VolumePathEstimator(const Scene& scene, const PathSettings& settings,
                                         const LightDistribution* distribution,
                                         const Guidance& guidance)
    : scene_(scene),
      lighting_(scene, LightStrategy::One, distribution, false),
      settings_(settings),
      guidance_(guidance),
      roulette_(settings.rrThreshold),
      scattersBelow_(scattersBelowSurfaces(scene)) {}

std::unique_ptr<EstimatorMemory> VolumePathEstimator::makeMemory() const {
  if (!guidance_.guide) return nullptr;
  return std::make_unique<GuidedMemory>(guidance_.guide->makeLocal());
}

Rgb VolumePathEstimator::radiance(const CameraRay& camera, SampleStream& stream,
                                  RenderState& state) const {
  VolumePath path(camera, scene_.cameraMedium, stream, state);
  path.memory = static_cast<GuidedMemory*>(state.memory.get());
  path.learns = path.memory && guidance_.collect && isChosen(stream.address(), guidance_.stride);
  if (path.memory || scattersBelow_ || !scene_.media.empty())
    path.numbers = numbersBeyond(stream, kFirstPathDimension + VolumePath::kSeedOffset);
  while (true) {
    ++state.rays.closest;
    const auto hit = scene_.geometry->intersect(path.ray);
    if (hit) prefetchSurface(*scene_.geometry, *hit);
    settle(path);
    path.emissionAdded = path.medium != nullptr;
    if (path.medium) {
      const float end = hit ? hit->shape.t : kInfinity;
      addDimmedEmission(path, hit, end);
      const Event event = throughMedium(path, end);
      if (event == Event::Ended) break;
      if (event == Event::Scattered) continue;
    }
    if (hit) {
      if (!onSurface(path, *hit)) break;
      continue;
    }
    if (!path.emissionAdded) addEmission(path, outside(path));
    break;
  }
  settle(path);
  if (path.learns) path.memory->finish(path.radiance.sum);
  if (path.memory && guidance_.use) {
    path.memory->gain.add(stream.address().pixel, path.radiance);
    path.memory->promised += static_cast<double>(path.promise);
    ++path.memory->paths;
  }
  return path.radiance.sum;
}

/// Emission at the end of the path's ray, weighed where light sampling could have found it.
Rgb VolumePathEstimator::emission(const VolumePath& path, const SurfaceInteraction& at) const {
  return path.weighed ? lighting_.foundAtHit(path.from, path.pdf, at)
                      : at.primitive->light->emitted(at, at.wo);
}

Rgb VolumePathEstimator::outside(const VolumePath& path) const {
  return path.weighed ? lighting_.foundOutside(path.from, path.pdf, path.ray.d)
                      : lighting_.outside(path.ray.d);
}

/// Adds what of the light at the end of the path's ray gets through the medium, whether or not the
/// path scatters before: to wait whether it does would make noise wherever a lamp is seen.
void VolumePathEstimator::addDimmedEmission(VolumePath& path, const std::optional<Hit>& hit,
                                            float tMax) const {
  Rgb found;
  if (!hit) {
    found = outside(path);
  } else if (scene_.geometry->primitive(*hit).light) {
    found = emission(path, scene_.geometry->surface(path.ray, *hit, SurfaceDetail::Basic));
  }
  if (found.isBlack()) return;
  Ray segment = path.ray;
  segment.tMax = tMax;
  addEmission(path,
              found * path.medium->transmittance(segment, path.numbers, path.state.rays.tracking));
}

/// The first distance after a bounce has the sampler's numbers.
MediumSample VolumePathEstimator::sampleDistance(VolumePath& path, const Ray& segment) {
  TrackingCounts& counts = path.state.rays.tracking;
  if (path.distanceDrawn) return path.medium->sample(segment, path.numbers, counts);
  path.distanceDrawn = true;
  path.setDimension(VolumePath::kDistanceOffset);
  NumberSequence numbers = path.numbers.fork(path.stream.next2D());
  return path.medium->sample(segment, numbers, counts);
}

/// Goes through the medium up to `tMax`, or scatters in it.
VolumePathEstimator::Event VolumePathEstimator::throughMedium(VolumePath& path, float tMax) const {
  Ray segment = path.ray;
  segment.tMax = tMax;
  const MediumSample s = sampleDistance(path, segment);
  path.throughput *= s.weight;
  if (path.throughput.isBlack()) return Event::Ended;
  if (!s.scatters) return Event::Surface;
  if (path.bounces >= settings_.maxDepth || !roulette_.survives(path)) return Event::Ended;

  const Vec3 p = segment.at(s.t), wo = -path.ray.d;
  path.surface = nullptr;
  std::construct_at(&path.from);
  path.from.p = p;
  path.from.wo = wo;
  path.from.phase = &path.medium->phase();
  path.ray.o = p;
  return scatter(path, GuidePoint{p}) ? Event::Scattered : Event::Ended;
}

/// Adds the emission of a surface and leaves it; false: the path ends.
bool VolumePathEstimator::onSurface(VolumePath& path, const Hit& hit) const {
  const Primitive& primitive = scene_.geometry->primitive(hit);
  const bool last = path.bounces >= settings_.maxDepth;
  if (last && !primitive.light && primitive.material) return false;
  const Material* material = primitive.material;
  SurfaceInteraction at = surfaceAt(*scene_.geometry, path.ray, hit, path.differential);
  if (primitive.light && !path.emissionAdded) addEmission(path, emission(path, at));
  if (!material) {
    if (!mayPass(++path.interfaces)) return false;
    path.differential = nullptr;
    path.medium = mediumBeyond(primitive, path.medium, path.ray.d, at.n);
    startBehind(path.ray, at);
    return true;
  }
  if (last || !roulette_.survives(path)) return false;
  material->evaluate(at, path.state.bsdf);
  if (path.state.bsdf.empty()) return false;
  path.surface = &primitive;
  return shade(path, at, material);
}

/// Turns at a surface whose BSDF is set. `material` is null where light has entered below it.
bool VolumePathEstimator::shade(VolumePath& path, const SurfaceInteraction& at,
                                const Material* material) const {
  const Bsdf& bsdf = path.state.bsdf;
  if (path.state.aov && path.bounces == 0 && material) {
    path.setDimension(VolumePath::kDirectionOffset);
    recordSurface(*path.state.aov, at, bsdf, path.stream);
  }
  path.normal = at.n;
  // In place: to copy what was just written, in larger pieces, waits for all of it.
  std::construct_at(&path.from, at, bsdf);
  const GuidePoint where{at.p, faceForward(at.n, at.wo), bsdf.transmits()};
  path.entersBelow = scattersBelow_ && material && material->scattersBelow();
  path.below = false;
  if (!scatter(path, where)) return false;
  return !(path.below && material) || enterBelow(path, at, *material);
}

/// Goes on where light that leaves at `at` has entered the body. As in pbrt-v3 that is no bounce.
bool VolumePathEstimator::enterBelow(VolumePath& path, const SurfaceInteraction& at,
                                     const Material& material) const {
  BssrdfStorage storage;
  const Bssrdf* bssrdf = material.bssrdf(at, storage);
  if (!bssrdf) return true;
  --path.bounces;
  const Frame frame = path.state.bsdf.frame();
  const float uc = path.numbers.next();
  const auto entry =
      sampleSubsurfaceEntry(*scene_.geometry, material, *bssrdf, at, frame, path.ray.time, uc,
                            path.numbers.next2(), path.state.rays);
  if (!entry) return false;
  path.throughput *= entry->weight;
  path.surface = entry->at.primitive;
  path.state.bsdf.reset(entry->at);
  bssrdf->addEntryLobe(path.state.bsdf);
  path.ownNumbers = true;
  return shade(path, entry->at, nullptr);
}

/// Adds what a ray finds of a light. Guides do not learn it where light sampling finds it as well:
/// they are for light that comes by other ways.
void VolumePathEstimator::addEmission(VolumePath& path, const Rgb& found) const {
  const Rgb added = path.throughput * found;
  path.radiance.add(added, path.odds);
  if (path.learns && path.weighed && !path.memory->turns.empty())
    path.memory->turns.back().before += added;
}

/// Draws a light for a vertex, whose shadow ray waits, and sets the next ray; false: the path ends.
bool VolumePathEstimator::scatter(VolumePath& path, const GuidePoint& where) const {
  const Bsdf* const bsdf = path.from.bsdf;
  const bool specular = bsdf && bsdf->isSpecular();
  // What the last ray finds, light sampling finds as well: guides do not know it.
  const bool lastRay = path.bounces + 1 >= settings_.maxDepth;
  const LocalGuide* guide = nullptr;
  if (path.memory && guidance_.use && !specular && !path.entersBelow && !lastRay) {
    ++path.memory->lookups;
    LocalGuide* const local = path.memory->local.get();
    if (local->moveTo(where, ScatteringPoint(path.from)) &&
        (path.promise > 0 ||
         path.throughput.luminance() * local->scattered() >= guidance_.negligible))
      guide = local;
  }
  const DirectionMixture mixture(path.from, guide, guidance_.ownShare);
  path.remembered = false;
  if (lighting_.hasLights() && !specular) proposeLight(path, mixture, guide);
  if (guide ? !roulette_.survivesByPromise(path, guide->scattered())
            : path.promise > 0 && !roulette_.survivesByThroughput(path))
    return false;
  // Where rays find no light, the last one need not be traced.
  if (lastRay && !path.entersBelow && !lighting_.hasVisibleLights()) return false;

  path.setDimension(VolumePath::kDirectionOffset);
  const Vec2 u = path.ownNumbers ? path.numbers.next2() : path.stream.next2D();
  float uc = path.ownNumbers ? path.numbers.next() : path.stream.next1D();
  const bool hasRare = specular && bsdf->transmits();
  if (path.memory && hasRare && path.bounces == 0) preferRare(path, uc);
  const auto d = mixture.sample(uc, u, path.numbers);
  if (!d) return false;
  path.throughput *= d->scattered / d->pdf;
  if (path.throughput.isBlack()) return false;
  if (d->ownPdf > 0) path.odds *= static_cast<double>(d->pdf / d->ownPdf);
  path.below = path.entersBelow && d->isTransmission;
  if (!path.below) path.etaScale *= d->etaScale;
  path.weighed = !d->isSpecular;
  path.pdf = mixture.ownShare() * d->ownPdf;
  if (path.memory && !specular) {
    ++path.memory->drawn;
    path.memory->guided += guide != nullptr;
    if (path.learns && !lastRay && !d->isSpecular && !path.below) remember(path, where, *d);
  }
  path.differential = nullptr;
  path.interfaces = 0;
  path.distanceDrawn = false;
  path.ownNumbers = false;
  path.medium = mediumTowards(path, d->wi);
  if (path.surface) path.ray.o = offsetRayOrigin(path.from.p, path.from.pError, path.from.n, d->wi);
  path.ray.d = d->wi;
  path.ray.tMax = kInfinity;
  ++path.bounces;
  return true;
}

/// What is seen in glass directly: its reflections are drawn rarely, and a lamp's makes noise that
/// no guide can mend. So `uc`, which chooses between the directions of a specular surface, the
/// reflected one first, is drawn from its lowest part more often.
void VolumePathEstimator::preferRare(VolumePath& path, float& uc) {
  constexpr float kPart = 1 / 16.f, kPreferred = 0.25f;
  constexpr float kDensityLow = 1 - kPreferred + kPreferred / kPart, kDensity = 1 - kPreferred;
  constexpr float kLow = kPart * kDensityLow;
  uc = uc < kLow ? uc / kDensityLow : kPart + (uc - kLow) / kDensity;
  uc = std::min(uc, kOneMinusEpsilon);
  path.throughput /= uc < kPart ? kDensityLow : kDensity;
}

/// The medium of a ray that leaves the last vertex.
const Medium* VolumePathEstimator::mediumTowards(const VolumePath& path, const Vec3& w) const {
  return path.surface ? mediumBeyond(*path.surface, path.medium, w, path.normal) : path.medium;
}

/// Beyond the first vertex, where noise counts less, light is sampled more rarely where the guide
/// has seen little of it arrive.
void VolumePathEstimator::proposeLight(VolumePath& path, const DirectionMixture& mixture,
                                       const LocalGuide* guide) const {
  settle(path);
  const float chance = guide && path.bounces > 0 ? guide->lightWorth() : 1;
  path.lightTried = !(chance < 1) || path.numbers.next() < chance;
  if (!path.lightTried) return;
  path.setDimension(0);
  VolumePath::Proposal& p = path.proposed;
  path.isProposed =
      lighting_.proposeLight(path.from, path.ray.time, path.stream, p.light, mixture.ownShare());
  if (!path.isProposed) return;
  p.light.value *= path.throughput / chance;
  p.medium = mediumTowards(path, p.light.wi);
  p.odds = path.odds;
  p.chance = chance;
}

/// Traces the shadow ray of the last vertex, if one is proposed.
void VolumePathEstimator::settle(VolumePath& path) const {
  if (!path.isProposed) return;
  path.isProposed = false;
  const VolumePath::Proposal& p = path.proposed;
  const Rgb share = transmittance(scene_, p.light.shadow, p.medium, path.numbers, path.state.rays);
  if (share.isBlack()) return;
  const Rgb added = p.light.value * share;
  path.radiance.add(added, p.odds, p.chance);
  if (!path.remembered) return;
  GuidedMemory::Turn& turn = path.memory->turns.back();
  turn.before += added;
  turn.sample.lightFound = true;
}

void VolumePathEstimator::remember(VolumePath& path, const GuidePoint& where,
                                   const DrawnDirection& d) const {
  if (path.memory->turns.size() >= kMaxTurns) return;
  GuidedMemory::Turn& turn = path.memory->turns.emplace_back();
  turn.sample.p = where.p;
  turn.sample.n = where.onSurface() ? faceForward(where.n, d.wi) : Vec3(0);
  turn.sample.wi = d.wi;
  turn.sample.pdf = d.pdf;
  turn.throughput = path.throughput;
  turn.before = path.radiance.sum;
  turn.sample.lightTried = path.lightTried;
  path.remembered = true;
}

}  // namespace lampyris
