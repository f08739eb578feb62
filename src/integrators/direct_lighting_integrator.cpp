// SPDX-License-Identifier: Apache-2.0
// Direct lighting with specular reflection and refraction followed, the image of pbrt-v3's
// "directlighting" in expectation. Branches of specular surfaces wait on a small stack instead of
// recursing; where there would be too many, one is drawn at random, which keeps the expectation and
// bounds the time for any depth.
#include "integrators/direct_lighting_integrator.h"

#include <array>

#include "integrators/adaptive_direct.h"
#include "integrators/aov_surface.h"
#include "integrators/common_parameters.h"
#include "integrators/ray_surface.h"

namespace lampyris {

namespace {

/// Up to this depth all branches of a specular surface are followed.
constexpr int kBranchingDepth = 6;
constexpr size_t kMaxBranches = 2 * Bsdf::kMaxLobes;
/// Below this depth a pending branch has at most kMaxBranches − 1 siblings.
constexpr size_t kStackSize = kBranchingDepth * kMaxBranches;

struct DirectLightingParameters {
  std::string strategy = "all";
  DirectLightingSettings settings;
  std::string lightSampler;
  AdaptiveSettings adaptive;

  void declare(Declaration& d) {
    d.add("strategy", strategy,
          "Whether all lights are sampled at a point, or one, or as many as the lights and the "
          "BSDF there are worth.")
        .oneOf({"all", "one", "adaptive"});
    settings.declare(d);
    declareLightSampler(
        d, lightSampler,
        "Strategy \"one\": which light to sample at a point; see kind lightsampler. Strategy "
        "\"adaptive\" takes \"brdf\" alone.");
    adaptive.declare(d);
  }
};

/// A ray still to be followed.
struct Branch {
  Vec3 o, d;
  Rgb throughput;
  int depth;
};
using Branches = std::array<Branch, kMaxBranches>;

class DirectLightingEstimator final : public RadianceEstimator {
 public:
  DirectLightingEstimator(const Scene& scene, int maxDepth, LightStrategy strategy,
                          const LightDistribution* distribution, const AdaptiveDirect* adaptive)
      : geometry_(*scene.geometry),
        lighting_(scene, strategy, distribution),
        adaptive_(adaptive),
        maxDepth_(maxDepth),
        dimensionsPerVertex_(
            2 + (adaptive ? AdaptiveDirect::kDimensions
                          : lighting_.lightDimensions() + lighting_.bsdfDimensions())) {}

  Rgb radiance(const CameraRay& camera, SampleStream& stream, RenderState& state) const override;

 private:
  struct Node {
    Ray ray;
    const RayDifferential* differential;  ///< null but for the camera ray
    uint32_t firstDimension;
  };
  bool findSurface(Node& node, RenderState& state, Rgb& radiance, SurfaceInteraction& at) const;
  Rgb shade(const Node& node, const SurfaceInteraction& at, SampleStream& stream,
            RenderState& state) const;
  static size_t branch(const SurfaceInteraction& at, const Bsdf& bsdf, const Vec2& u,
                       Branches& out);

  const Geometry& geometry_;
  const DirectLighting lighting_;
  const AdaptiveDirect* const adaptive_;  ///< samples in place of lighting_ if there is one
  const int maxDepth_;
  const uint32_t dimensionsPerVertex_;
};

/// Follows the ray to the first surface with a material; false if there is none.
bool DirectLightingEstimator::findSurface(Node& node, RenderState& state, Rgb& radiance,
                                          SurfaceInteraction& at) const {
  for (int i = 0; mayPass(i); ++i) {
    ++state.rays.closest;
    const auto hit = geometry_.intersect(node.ray);
    if (!hit) {
      radiance = lighting_.outside(node.ray.d);
      return false;
    }
    const Primitive& primitive = geometry_.primitive(*hit);
    at = surfaceAt(geometry_, node.ray, *hit, node.differential);
    if (primitive.material) {
      if (primitive.light) radiance = primitive.light->emitted(at, at.wo);
      return true;
    }
    // As in pbrt-v3, what an interface emits is not seen by these rays.
    node.differential = nullptr;
    node.ray.o = offsetRayOrigin(at.p, at.pError, at.n, node.ray.d);
  }
  return false;
}

/// Light scattered by the lobes that are not specular.
Rgb DirectLightingEstimator::shade(const Node& node, const SurfaceInteraction& at,
                                   SampleStream& stream, RenderState& state) const {
  stream.setDimension(node.firstDimension);
  if (state.aov && node.firstDimension == kFirstPathDimension)
    recordSurface(*state.aov, at, state.bsdf, stream);
  if (!lighting_.hasLights() || state.bsdf.isSpecular()) return Rgb();
  const LightSampleContext context(at, state.bsdf);
  if (adaptive_) {
    const auto parts = adaptive_->radiance(context, node.ray.time, stream, state);
    if (state.aov) state.aov->lightSampled(parts.lights), state.aov->bsdfSampled(parts.bsdf);
    return parts.lights + parts.bsdf;
  }
  if (state.aov) lighting_.recordDraws(context, stream, *state.aov);
  const Rgb light = lighting_.lightSamples(context, node.ray.time, stream, state.rays);
  stream.setDimension(node.firstDimension + lighting_.lightDimensions());
  const Rgb scattered = lighting_.bsdfSamples(context, node.ray.time, stream, state.rays);
  if (state.aov) state.aov->lightSampled(light), state.aov->bsdfSampled(scattered);
  return light + scattered;
}

/// The specular directions at a surface, with what each contributes.
size_t DirectLightingEstimator::branch(const SurfaceInteraction& at, const Bsdf& bsdf,
                                       const Vec2& u, Branches& out) {
  size_t count = 0;
  const Vec3 wo = bsdf.frame().toLocal(at.wo);
  const auto follow = [&](const LobeSample& s, float probability) {
    if (!(probability > 0)) return;
    const Rgb weight = s.f * (absCosTheta(s.wi) / probability);
    if (weight.isBlack()) return;
    const Vec3 wi = bsdf.frame().toWorld(s.wi);
    out[count++] = {offsetRayOrigin(at.p, at.pError, at.n, wi), wi, weight, 0};
  };
  for (size_t i = 0; i < bsdf.lobeCount(); ++i) {
    const Lobe& lobe = bsdf.lobe(i);
    if (!(lobe.flags & kSpecular)) continue;
    const auto low = lobe.sample(wo, 0, u);
    const bool both = (lobe.flags & kReflection) && (lobe.flags & kTransmission);
    const auto high = both ? lobe.sample(wo, kOneMinusEpsilon, u) : std::nullopt;
    if (low && high && low->flags != high->flags) {
      // Both are taken, so the probability with which the lobe chooses among them drops out.
      follow(*low, 1);
      follow(*high, 1);
    } else if (low) {
      follow(*low, low->pdf);
    }
  }
  return count;
}

Rgb DirectLightingEstimator::radiance(const CameraRay& camera, SampleStream& stream,
                                      RenderState& state) const {
  Rgb sum;
  Branches next;
  std::array<Branch, kStackSize> stack;
  size_t pending = 1;
  stack[0] = {camera.ray.o, camera.ray.d, Rgb(1), 0};
  const RayDifferential* differential = &camera.differential;
  for (uint32_t number = 0; pending > 0; ++number) {
    const Branch current = stack[--pending];
    Node node{{current.o, current.d, kInfinity, camera.ray.time},
              differential,
              kFirstPathDimension + number * dimensionsPerVertex_};
    differential = nullptr;
    Rgb radiance;
    SurfaceInteraction at;
    const bool found = findSurface(node, state, radiance, at);
    if (found) {
      at.primitive->material->evaluate(at, state.bsdf);
      radiance += shade(node, at, stream, state);
    }
    sum += current.throughput * radiance;
    if (!found || current.depth + 1 >= maxDepth_ || !(state.bsdf.flags() & kSpecular)) continue;

    stream.setDimension(node.firstDimension + dimensionsPerVertex_ - 2);
    const Vec2 u = stream.next2D();
    size_t count = branch(at, state.bsdf, u, next);
    if (count > 1 && current.depth >= kBranchingDepth) {
      const auto chosen = static_cast<size_t>(u.x * static_cast<float>(count));
      next[0] = next[std::min(chosen, count - 1)];
      next[0].throughput *= static_cast<float>(count);
      count = 1;
    }
    while (count-- > 0) {
      next[count].throughput *= current.throughput;
      next[count].depth = current.depth + 1;
      if (!next[count].throughput.isBlack()) stack[pending++] = next[count];
    }
  }
  return sum;
}

class DirectLightingIntegrator final : public Integrator {
 public:
  DirectLightingIntegrator(const DirectLightingSettings& settings, LightStrategy strategy,
                           std::unique_ptr<LightDistribution> distribution,
                           std::optional<AdaptiveSettings> adaptive = {})
      : settings_(settings),
        strategy_(strategy),
        distribution_(std::move(distribution)),
        adaptive_(std::move(adaptive)) {}

  uint64_t render(RenderContext& context) const override {
    const PixelBounds pixels =
        renderedPixels(context.film, settings_.pixelBounds, settings_.location);
    std::optional<AdaptiveDirect> adaptive;
    if (adaptive_) adaptive.emplace(context.scene, *adaptive_, *distribution_);
    const DirectLightingEstimator estimator(context.scene, settings_.maxDepth, strategy_,
                                            distribution_.get(), adaptive ? &*adaptive : nullptr);
    return renderPasses(context, pixels, estimator);
  }

 private:
  const DirectLightingSettings settings_;
  const LightStrategy strategy_;
  const std::unique_ptr<LightDistribution> distribution_;
  const std::optional<AdaptiveSettings> adaptive_;
};

std::unique_ptr<Integrator> create(const DirectLightingParameters& p,
                                   const IntegratorContext& context) {
  DirectLightingSettings settings = p.settings;
  settings.location = context.location;
  // Sampling all lights needs no tree.
  if (p.strategy == "all") return makeDirectLightingIntegrator(settings, LightStrategy::All, {});
  if (p.strategy == "adaptive")
    return std::make_unique<DirectLightingIntegrator>(
        settings, LightStrategy::One, makeAdaptiveLights(context, p.lightSampler), p.adaptive);
  return makeDirectLightingIntegrator(settings, LightStrategy::One,
                                      context.lightDistribution(p.lightSampler));
}

}  // namespace

void DirectLightingSettings::declare(Declaration& d) {
  d.add("maxdepth", maxDepth, "How many specular surfaces a path may meet.").range(0, 1e6);
  declarePixelBounds(d, pixelBounds);
}

std::unique_ptr<Integrator> makeDirectLightingIntegrator(
    const DirectLightingSettings& settings, LightStrategy strategy,
    std::unique_ptr<LightDistribution> distribution) {
  return std::make_unique<DirectLightingIntegrator>(settings, strategy, std::move(distribution));
}

IntegratorRegistry::Entry directLightingPlugin() {
  return makePlugin("directlighting",
                    "Light that comes from lights directly, or by specular surfaces only.", create);
}

}  // namespace lampyris
