// SPDX-License-Identifier: Apache-2.0
// Path tracing with next-event estimation (Kajiya 1986; Veach 1997). The image is pbrt-v3's "path"
// in expectation. Where that traces a ray of its own for the BSDF half of multiple importance
// sampling, here the path's next ray serves: one ray less a vertex, and the light that it finds is
// weighed whichever light was drawn. Cost a vertex: one shadow ray, one ray; the shadow ray comes
// second, while memory fetches what the other one has hit.
#include "integrators/path_integrator.h"

#include "integrators/aov_surface.h"
#include "integrators/common_parameters.h"
#include "integrators/direct_lighting.h"
#include "integrators/ray_surface.h"
#include "integrators/subsurface.h"

namespace lampyris {

namespace {

/// Numbers a vertex takes: light (1), point on it (2), direction (2), lobe (1), roulette (1), and
/// one left out so that pairs keep even dimensions.
constexpr uint32_t kDimensionsPerVertex = 8;
constexpr uint32_t kRouletteOffset = 6;
/// Beyond those of any vertex: where the numbers of adaptive direct lighting begin.
constexpr uint32_t kAdaptiveDimension = kFirstPathDimension + (uint32_t{1} << 24);
constexpr int kFirstRouletteBounce = 4;

class PathEstimator final : public RadianceEstimator {
 public:
  PathEstimator(const Scene& scene, const PathSettings& settings,
                const LightDistribution* distribution)
      : geometry_(*scene.geometry),
        lighting_(scene, LightStrategy::One, distribution),
        maxDepth_(settings.maxDepth),
        rrThreshold_(settings.rrThreshold),
        adaptiveVertices_(settings.adaptiveVertices),
        scattersBelow_(scattersBelowSurfaces(scene)) {
    if (settings.adaptive) adaptive_.emplace(scene, settings.adaptiveSettings, *distribution);
  }

  Rgb radiance(const CameraRay& camera, SampleStream& stream, RenderState& state) const override;

 private:
  struct Path;
  void settle(Path& path, RenderState& state) const;
  static void addFound(Path& path, const RenderState& state, const Rgb& light);
  Rgb emission(const Path& path, const SurfaceInteraction& at) const;
  Rgb outside(const Path& path) const;
  void addLightSamples(Path& path, SampleStream& stream, RenderState& state) const;
  bool scatter(Path& path, SurfaceInteraction& at, const Material& material, SampleStream& stream,
               RenderState& state) const;
  bool shade(Path& path, const SurfaceInteraction& at, const Material* material,
             SampleStream& stream, RenderState& state) const;
  bool enterBelow(Path& path, const SurfaceInteraction& at, const Material& material,
                  const Bssrdf& bssrdf, SampleStream& stream, RenderState& state) const;
  bool survives(Path& path, SampleStream& stream) const;

  const Geometry& geometry_;
  const DirectLighting lighting_;
  std::optional<AdaptiveDirect> adaptive_;  ///< samples and weighs in place of lighting_
  const int maxDepth_;
  const float rrThreshold_;
  const int adaptiveVertices_;
  const bool scattersBelow_;
};

struct PathEstimator::Path {
  Ray ray;
  const RayDifferential* differential;  ///< null after the first surface
  Rgb radiance{}, throughput{1};
  /// Undoes the change of radiance by refraction, so that roulette does not end paths for it.
  float etaScale = 1;
  int bounces = 0, interfaces = 0;
  uint32_t vertices = 0;  ///< sets of dimensions taken; more than bounces below surfaces
  uint32_t firstDimension() const { return kFirstPathDimension + vertices * kDimensionsPerVertex; }
  int litVertices = 0;  ///< at which light was sampled
  /// Set where light sampling at the last vertex could have found what the ray finds: `from` and
  /// `bsdfPdf` then say with which densities.
  bool weighed = false;
  /// As in pbrt-v3, light behind an interface does not reach a vertex that is not specular: shadow
  /// rays are blocked by it, so emission found beyond must not count either.
  bool blind = false;
  LightSampleContext from{};
  float bsdfPdf = 0;
  /// Light sampled at the last vertex whose shadow ray is still to be traced.
  LightConnection proposed{};
  bool isProposed = false;
  AdaptiveDirect::Allocation allocation{};
};

Rgb PathEstimator::radiance(const CameraRay& camera, SampleStream& stream,
                            RenderState& state) const {
  Path path{camera.ray, &camera.differential};
  while (true) {
    ++state.rays.closest;
    const auto hit = geometry_.intersect(path.ray);
    if (hit) prefetchSurface(geometry_, *hit);
    settle(path, state);
    if (!hit) {
      if (!path.blind) addFound(path, state, outside(path));
      break;
    }
    const Primitive& primitive = geometry_.primitive(*hit);
    const bool last = path.bounces >= maxDepth_;
    if (last && !primitive.light) break;
    const Material* material = primitive.material;
    SurfaceInteraction at = surfaceAt(geometry_, path.ray, *hit, path.differential);
    if (primitive.light && !path.blind) addFound(path, state, emission(path, at));
    if (last) break;
    if (!material) {
      if (!mayPass(++path.interfaces)) break;
      path.blind = path.weighed;
      path.differential = nullptr;
      path.ray.o = offsetRayOrigin(at.p, at.pError, at.n, path.ray.d);
      continue;
    }
    if (!survives(path, stream)) break;
    if (!scatter(path, at, *material, stream, state)) break;
  }
  settle(path, state);
  return path.radiance;
}

/// Traces the shadow ray of the last vertex, if one is proposed.
void PathEstimator::settle(Path& path, RenderState& state) const {
  if (!path.isProposed) return;
  path.isProposed = false;
  ++state.rays.shadow;
  if (geometry_.occluded(path.proposed.shadow)) return;
  path.radiance += path.proposed.value;
  if (state.aov) state.aov->lightSampled(path.proposed.value);
}

/// Adds light that the path's ray has found.
void PathEstimator::addFound(Path& path, const RenderState& state, const Rgb& light) {
  const Rgb radiance = path.throughput * light;
  path.radiance += radiance;
  if (state.aov && path.weighed) state.aov->bsdfSampled(radiance);
}

/// Emission at the end of the path's ray, weighed where light sampling could have found it.
Rgb PathEstimator::emission(const Path& path, const SurfaceInteraction& at) const {
  if (!path.weighed) return at.primitive->light->emitted(at, at.wo);
  return adaptive_ ? adaptive_->foundAtHit(path.from, path.allocation, path.bsdfPdf, at)
                   : lighting_.foundAtHit(path.from, path.bsdfPdf, at);
}

Rgb PathEstimator::outside(const Path& path) const {
  const Vec3& d = path.ray.d;
  if (!path.weighed) return lighting_.outside(d);
  return adaptive_ ? adaptive_->foundOutside(path.from, path.allocation, path.bsdfPdf, d)
                   : lighting_.foundOutside(path.from, path.bsdfPdf, d);
}

/// Adds what light sampling at path.from finds, or proposes it if that is one light. Takes its
/// numbers from stream.dimension() on, or from those that adaptive direct lighting has for itself.
void PathEstimator::addLightSamples(Path& path, SampleStream& stream, RenderState& state) const {
  if (!adaptive_ && !lighting_.drawsMany()) {
    settle(path, state);
    if (state.aov) lighting_.recordDraws(path.from, stream, *state.aov);
    path.isProposed = lighting_.proposeLight(path.from, path.ray.time, stream, path.proposed);
    if (path.isProposed) path.proposed.value *= path.throughput;
    return;
  }
  Rgb light, scattered;
  if (adaptive_) {
    stream.setDimension(kAdaptiveDimension + path.vertices * AdaptiveDirect::kDimensions);
    const auto effort = path.litVertices++ < adaptiveVertices_ ? AdaptiveDirect::Effort::Allocated
                                                               : AdaptiveDirect::Effort::One;
    const auto parts =
        adaptive_->lightSamples(path.from, path.ray.time, effort, stream, state, path.allocation);
    light = path.throughput * parts.lights, scattered = path.throughput * parts.bsdf;
  } else {
    if (state.aov) lighting_.recordDraws(path.from, stream, *state.aov);
    light = path.throughput * lighting_.lightSamples(path.from, path.ray.time, stream, state.rays);
  }
  path.radiance += light + scattered;
  if (state.aov) state.aov->lightSampled(light), state.aov->bsdfSampled(scattered);
}

/// Russian roulette with the probabilities of pbrt-v3, but after the emission at the new vertex has
/// been added: the same expectation with less noise.
bool PathEstimator::survives(Path& path, SampleStream& stream) const {
  if (path.bounces <= kFirstRouletteBounce) return true;
  const float most = path.throughput.maxComponent() * path.etaScale;
  if (!(most < rrThreshold_)) return true;
  const float end = std::max(0.05f, 1 - most);
  stream.setDimension(path.firstDimension() + kRouletteOffset);
  if (stream.next1D() < end) return false;
  path.throughput /= 1 - end;
  return true;
}

bool PathEstimator::scatter(Path& path, SurfaceInteraction& at, const Material& material,
                            SampleStream& stream, RenderState& state) const {
  material.evaluate(at, state.bsdf);
  return !state.bsdf.empty() && shade(path, at, &material, stream, state);
}

/// Takes three numbers.
std::optional<BsdfSample> sampleDirection(const Bsdf& bsdf, const Vec3& wo, SampleStream& stream) {
  const Vec2 u = stream.next2D();
  return bsdf.sample(wo, stream.next1D(), u);
}

/// Adds the light-sampled radiance of a vertex and sets the next ray; false: the path ends.
/// `material` is null where light has entered below a surface.
bool PathEstimator::shade(Path& path, const SurfaceInteraction& at, const Material* material,
                          SampleStream& stream, RenderState& state) const {
  const Bsdf& bsdf = state.bsdf;
  const uint32_t first = path.firstDimension();
  if (state.aov && path.vertices == 0) {
    stream.setDimension(first + 3);
    recordSurface(*state.aov, at, bsdf, stream);
  }
  const bool below = scattersBelow_ && material && material->scattersBelow();
  // Where rays find no light, the last one need not be traced.
  const bool goesOn = path.bounces + 1 < maxDepth_ || below || lighting_.hasVisibleLights();
  // Drawn before the lights: the processor does both at once, since neither waits for the other.
  stream.setDimension(first + 3);
  const auto s = goesOn ? sampleDirection(bsdf, at.wo, stream) : std::optional<BsdfSample>();
  stream.setDimension(first);
  if (lighting_.hasLights() && !bsdf.isSpecular()) {
    // In place: to copy what was just written, in larger pieces, waits for all of it.
    std::construct_at(&path.from, at, bsdf);
    // The noise of a vertex goes into the image times the throughput: that many lights less pay.
    path.from.worth = std::min(path.throughput.maxComponent(), 1.f);
    addLightSamples(path, stream, state);
  }
  if (!s || !(s->pdf > 0) || s->f.isBlack()) return false;
  path.throughput *= s->f * (bsdf.absCosTheta(s->wi) / s->pdf);
  if (path.throughput.isBlack()) return false;
  if (below && s->isTransmission()) {
    BssrdfStorage storage;
    if (const Bssrdf* bssrdf = material->bssrdf(at, storage))
      return enterBelow(path, at, *material, *bssrdf, stream, state);
  }
  if (s->isTransmission()) path.etaScale *= sqr(s->eta);
  path.weighed = !s->isSpecular();
  path.blind = false;
  path.bsdfPdf = s->pdf;
  path.differential = nullptr;
  path.interfaces = 0;
  path.ray.o = offsetRayOrigin(at.p, at.pError, at.n, s->wi);
  path.ray.d = s->wi;
  path.ray.tMax = kInfinity;
  ++path.bounces;
  ++path.vertices;
  return true;
}

/// Goes on where light that leaves at `at` has entered the body. As in pbrt-v3 that is no bounce.
bool PathEstimator::enterBelow(Path& path, const SurfaceInteraction& at, const Material& material,
                               const Bssrdf& bssrdf, SampleStream& stream,
                               RenderState& state) const {
  ++path.vertices;
  stream.setDimension(path.firstDimension());
  const float uc = stream.next1D();
  const Frame frame = state.bsdf.frame();
  const auto entry = sampleSubsurfaceEntry(geometry_, material, bssrdf, at, frame, path.ray.time,
                                           uc, stream.next2D(), state.rays);
  if (!entry) return false;
  path.throughput *= entry->weight;
  ++path.vertices;
  state.bsdf.reset(entry->at);
  bssrdf.addEntryLobe(state.bsdf);
  return shade(path, entry->at, nullptr, stream, state);
}

class PathIntegrator final : public Integrator {
 public:
  PathIntegrator(const PathSettings& settings, std::unique_ptr<LightDistribution> distribution)
      : settings_(settings), distribution_(std::move(distribution)) {}

  uint64_t render(RenderContext& context) const override {
    const PixelBounds pixels =
        renderedPixels(context.film, settings_.pixelBounds, settings_.location);
    const PathEstimator estimator(context.scene, settings_, distribution_.get());
    return renderPasses(context, pixels, estimator);
  }

 private:
  const PathSettings settings_;
  const std::unique_ptr<LightDistribution> distribution_;
};

}  // namespace

void PathSettings::declare(Declaration& d) {
  d.add("maxdepth", maxDepth, "Longest path, in bounces.").range(0, 1e6);
  d.add("rrthreshold", rrThreshold,
        "From the fifth bounce on, paths whose throughput is below this end at random.")
      .atLeast(0);
  declarePixelBounds(d, pixelBounds);
}

std::unique_ptr<Integrator> makePathIntegrator(const PathSettings& settings,
                                               std::unique_ptr<LightDistribution> distribution) {
  return std::make_unique<PathIntegrator>(settings, std::move(distribution));
}

}  // namespace lampyris
