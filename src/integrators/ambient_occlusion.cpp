// SPDX-License-Identifier: Apache-2.0
// How open the surroundings of the surfaces are that the camera sees: the integral of cos θ over
// the directions of the upper hemisphere in which rays escape, as in pbrt-v3 (π in the open, not
// 1). Lights and materials do not count. Cost a sample: "nsamples" shadow rays.
#include "core/frame.h"
#include "core/sampling.h"
#include "integrators/aov_surface.h"
#include "integrators/common_parameters.h"
#include "integrators/ray_surface.h"
#include "integrators/render_loop.h"

namespace lampyris {

namespace {

struct AmbientOcclusionParameters {
  bool cosineSampled = true;
  int samples = 64;
  std::vector<int> pixelBounds;

  void declare(Declaration& d) {
    d.add("cossample", cosineSampled,
          "Whether directions are drawn by the cosine (less noise) or uniformly.");
    d.add("nsamples", samples, "Rays from each point that is seen.").range(1, 1e6);
    declarePixelBounds(d, pixelBounds);
  }
};

class AmbientOcclusionEstimator final : public RadianceEstimator {
 public:
  AmbientOcclusionEstimator(const Geometry& geometry, const AmbientOcclusionParameters& p)
      : geometry_(geometry), cosineSampled_(p.cosineSampled), samples_(p.samples) {}

  Rgb radiance(const CameraRay& camera, SampleStream& stream, RenderState& state) const override {
    SurfaceInteraction at;
    if (!findSurface(camera.ray, at, state)) return Rgb();
    // On the geometric normal: shading normals would look below the surface.
    const Frame frame = Frame::fromZ(faceForward(at.n, at.wo));
    if (state.aov) {
      at.primitive->material->evaluate(at, state.bsdf);
      stream.setDimension(kFirstPathDimension);
      recordSurface(*state.aov, at, state.bsdf, stream);
    }
    stream.setDimension(kFirstPathDimension + 1);  // pairs begin at even dimensions
    double sum = 0;
    for (int i = 0; i < samples_; ++i) {
      const Vec2 u = stream.next2D();
      const Vec3 w = cosineSampled_ ? sampleCosineHemisphere(u) : sampleUniformCone(u, 1);
      Ray ray;
      ray.d = frame.toWorld(w);
      ray.o = offsetRayOrigin(at.p, at.pError, at.n, ray.d);
      ray.time = camera.ray.time;
      ++state.rays.shadow;
      if (!geometry_.occluded(ray))
        sum += static_cast<double>(cosineSampled_ ? kPi : w.z / uniformConePdf(1));
    }
    return Rgb(static_cast<float>(sum / samples_));
  }

 private:
  /// The first surface with a material that the ray meets.
  bool findSurface(Ray ray, SurfaceInteraction& at, RenderState& state) const {
    for (int i = 0; mayPass(i); ++i) {
      ++state.rays.closest;
      const auto hit = geometry_.intersect(ray);
      if (!hit) return false;
      const Material* material = geometry_.primitive(*hit).material;
      at = geometry_.surface(ray, *hit,
                             state.aov && material ? material->detail() : SurfaceDetail::Basic);
      if (material) return true;
      ray.o = offsetRayOrigin(at.p, at.pError, at.n, ray.d);
    }
    return false;
  }

  const Geometry& geometry_;
  const bool cosineSampled_;
  const int samples_;
};

class AmbientOcclusionIntegrator final : public Integrator {
 public:
  AmbientOcclusionIntegrator(AmbientOcclusionParameters parameters, SourceLocation location)
      : parameters_(std::move(parameters)), location_(location) {}

  uint64_t render(RenderContext& context) const override {
    const PixelBounds pixels = renderedPixels(context.film, parameters_.pixelBounds, location_);
    const AmbientOcclusionEstimator estimator(*context.scene.geometry, parameters_);
    return renderPasses(context, pixels, estimator);
  }

 private:
  const AmbientOcclusionParameters parameters_;
  const SourceLocation location_;
};

std::unique_ptr<Integrator> create(const AmbientOcclusionParameters& p,
                                   const IntegratorContext& context) {
  return std::make_unique<AmbientOcclusionIntegrator>(p, context.location);
}

}  // namespace

IntegratorRegistry::Entry ambientOcclusionPlugin() {
  return makePlugin("ambientocclusion", "How much of the sky surfaces see, whatever the lights.",
                    create);
}

}  // namespace lampyris
