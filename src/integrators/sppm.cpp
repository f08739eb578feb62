// SPDX-License-Identifier: Apache-2.0
// Stochastic progressive photon mapping (Hachisuka and Jensen 2009) in the form of Knaus and
// Zwicker 2011, "Progressive Photon Mapping: A Probabilistic Approach": every iteration is a photon
// map of its own with a smaller radius, and the image is the mean of the iterations. So an
// iteration is a sample of every pixel like any other integrator's, and nothing is kept from one to
// the next. The radii are those that pbrt-v3's pixels have when all iterations bring them as many
// photons; its image has them all at the last radius, here each counts with its own.
//
// Cost an iteration: "photonsperiteration" paths from lights, and a path from the camera for each
// pixel up to its first diffuse surface.
#include <cmath>

#include "core/parallel.h"
#include "integrators/aov_surface.h"
#include "integrators/common_parameters.h"
#include "integrators/direct_lighting.h"
#include "integrators/photon_map.h"
#include "integrators/pixel_integrator.h"
#include "integrators/ray_surface.h"
#include "integrators/subpath_tracer.h"

namespace lampyris {

namespace {

/// Hachisuka's α: the share of an iteration's photons that a pixel keeps.
constexpr double kKept = 2. / 3;
/// Paths from lights that one thread traces at a time.
constexpr size_t kPhotonChunk = 4096;

/// Photons that a path leaves on average, for an estimate of memory.
constexpr int kUsualBounces = 3;

struct SppmParameters {
  int maxDepth = 5, iterations = 64, photons = -1;
  float radius = 1;
  std::vector<int> pixelBounds;
  std::string lightSampler;

  void declare(Declaration& d) {
    d.add("maxdepth", maxDepth, "Longest path of a photon, and of the camera to its surface.")
        .range(0, 1000);
    d.add("iterations", iterations, "Photon maps, each of which is one sample of every pixel.")
        .alias("numiterations")
        .range(1, 1 << 30);
    d.add("photonsperiteration", photons, "Paths from lights in each; −1: as many as pixels.")
        .range(-1, 2e7);
    d.add("radius", radius, "Distance within which the first iteration gathers photons.")
        .range(1e-15, 1e15);
    declarePixelBounds(d, pixelBounds);
    declareLightSampler(
        d, lightSampler,
        "Which light to sample at a point; see kind lightsampler. Photons start by power.");
    d.ignored("imagewritefrequency", "images are written between passes, as for any integrator");
  }
};

/// The path of a camera ray, on its way to a surface where photons are gathered.
struct CameraPath {
  Ray ray;
  const RayDifferential* differential;  ///< null but for the camera ray
  Rgb throughput = Rgb(1), radiance{};
  bool specular = true;  ///< did the ray leave the camera, or a specular surface?
};

class SppmEstimator final : public RadianceEstimator {
 public:
  SppmEstimator(const RenderContext& context, const SppmParameters& p,
                const LightDistribution* distribution)
      : context_(context),
        geometry_(*context.scene.geometry),
        lighting_(context.scene, LightStrategy::One, distribution),
        emitters_(context.scene.lightTable),
        tracer_(context.scene, emitters_),
        maxDepth_(p.maxDepth),
        firstRadius_(static_cast<double>(p.radius)),
        photons_(static_cast<size_t>(p.photons > 0 ? p.photons : context.film.bounds().area())) {}

  uint64_t beginPass(uint64_t first, uint64_t samples) const override;
  Rgb radiance(const CameraRay& camera, SampleStream& stream, RenderState& state) const override;

 private:
  void tracePhoton(uint64_t iteration, size_t number, Subpath& path, RayCounts& rays,
                   std::vector<Photon>& out) const;
  Rgb gather(const SurfaceInteraction& at, const Bsdf& bsdf) const;
  bool findSurface(CameraPath& path, RenderState& state, SurfaceInteraction& at) const;
  Rgb direct(const SurfaceInteraction& at, uint32_t dimension, SampleStream& stream,
             RenderState& state) const;
  static bool scatter(CameraPath& path, const SurfaceInteraction& at, const Bsdf& bsdf,
                      SampleStream& stream);
  double squaredRadius(uint64_t iteration) const;

  const RenderContext& context_;
  const Geometry& geometry_;
  const DirectLighting lighting_;
  const EmitterTable emitters_;
  const SubpathTracer tracer_;
  const int maxDepth_;
  const double firstRadius_;
  const size_t photons_;
  mutable PhotonMap map_;  ///< of the pass; written between passes
  mutable double gatherArea_ = 1;
};

/// r² times the product of α j / (α (j − 1) + 1) over the iterations j before, by Γ functions.
double SppmEstimator::squaredRadius(uint64_t iteration) const {
  const double n = static_cast<double>(iteration), shift = 1 / kKept;
  const double logarithm = std::lgamma(n + 1) + std::lgamma(shift) - std::lgamma(n + shift);
  return firstRadius_ * firstRadius_ * std::exp(logarithm);
}

/// One iteration a pass: its photon map serves all pixels.
uint64_t SppmEstimator::beginPass(uint64_t first, uint64_t) const {
  const double squared = squaredRadius(first);
  gatherArea_ = static_cast<double>(kPi) * squared;
  if (emitters_.empty()) return 1;
  const size_t chunks = (photons_ + kPhotonChunk - 1) / kPhotonChunk;
  std::vector<std::vector<Photon>> found(chunks);
  parallelFor(chunks, 1, [&](size_t begin, size_t end) {
    Subpath path;
    RayCounts rays;
    for (size_t c = begin; c < end; ++c)
      for (size_t i = c * kPhotonChunk; i < std::min((c + 1) * kPhotonChunk, photons_); ++i)
        tracePhoton(first, i, path, rays, found[c]);
  });
  std::vector<Photon> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  map_ = PhotonMap(std::move(all), static_cast<float>(std::sqrt(squared)));
  return 1;
}

/// What a photon meets first is left to light sampling.
void SppmEstimator::tracePhoton(uint64_t iteration, size_t number, Subpath& path, RayCounts& rays,
                                std::vector<Photon>& out) const {
  const PixelBounds pixels = context_.film.bounds();
  const auto area = static_cast<uint64_t>(pixels.area());
  // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): a film has pixels.
  const uint64_t perIteration = (photons_ + area - 1) / area, pixel = number % area;
  const auto width = static_cast<uint64_t>(pixels.size().x);
  const Int2 at(static_cast<int>(pixel % width), static_cast<int>(pixel / width));
  SampleStream stream(context_.sampler,
                      {pixels.min + at, iteration * perIteration + number / area});
  // The camera tells what time a photon has: that at which its shutter is open.
  CameraSample sample;
  sample.film = Vec2(pixels.min + at) + 0.5f;
  stream.setDimension(4);
  sample.time = stream.next1D();
  tracer_.fromLight(context_.camera.generate(sample).ray, static_cast<size_t>(maxDepth_), stream,
                    nullptr, path, rays);
  for (size_t i = 2; i < path.size(); ++i) {
    const PathVertex& v = path[i];
    if (!v.bsdf.isSpecular())
      out.push_back({v.at.p, v.at.wo, v.at.n, v.throughput / static_cast<float>(photons_)});
  }
}

/// Indirect light that `at` scatters: the density of the photons around.
Rgb SppmEstimator::gather(const SurfaceInteraction& at, const Bsdf& bsdf) const {
  Rgb sum;
  map_.search(at.p, [&](const Photon& photon) {
    const Rgb f = bsdf.f(at.wo, photon.wi);
    if (f.isBlack()) return;
    // Photons come by the geometric normal, the BSDF's cosine is that of the shading normal.
    const float cosines = safeDivide(bsdf.absCosTheta(photon.wi), absDot(photon.wi, photon.n));
    sum += f * photon.power * cosines;
  });
  return sum / static_cast<float>(gatherArea_);
}

/// Goes on to the next surface with a material; false if there is none.
bool SppmEstimator::findSurface(CameraPath& path, RenderState& state,
                                SurfaceInteraction& at) const {
  for (int i = 0; mayPass(i); ++i) {
    ++state.rays.closest;
    const auto hit = geometry_.intersect(path.ray);
    if (!hit) {
      if (path.specular) path.radiance += path.throughput * lighting_.outside(path.ray.d);
      return false;
    }
    const Primitive& primitive = geometry_.primitive(*hit);
    at = surfaceAt(geometry_, path.ray, *hit, path.differential);
    path.differential = nullptr;
    if (primitive.light && path.specular)
      path.radiance += path.throughput * primitive.light->emitted(at, at.wo);
    if (primitive.material) return true;
    startBehind(path.ray, at);
  }
  return false;
}

/// Light from the lights that `at` scatters towards the camera.
Rgb SppmEstimator::direct(const SurfaceInteraction& at, uint32_t dimension, SampleStream& stream,
                          RenderState& state) const {
  if (state.bsdf.isSpecular() || !lighting_.hasLights()) return Rgb();
  const LightSampleContext context(at, state.bsdf);
  stream.setDimension(dimension);
  Rgb light = lighting_.lightSamples(context, at.time, stream, state.rays);
  stream.setDimension(dimension + 4);
  return light += lighting_.bsdfSamples(context, at.time, stream, state.rays);
}

/// Turns the path into a direction that the BSDF draws; false: it ends.
bool SppmEstimator::scatter(CameraPath& path, const SurfaceInteraction& at, const Bsdf& bsdf,
                            SampleStream& stream) {
  const Vec2 u = stream.next2D();
  const auto s = bsdf.sample(at.wo, stream.next1D(), u);
  if (!s || !(s->pdf > 0)) return false;
  path.throughput *= s->f * (bsdf.absCosTheta(s->wi) / s->pdf);
  path.specular = s->isSpecular();
  path.ray.o = offsetRayOrigin(at.p, at.pError, at.n, s->wi);
  path.ray.d = s->wi;
  path.ray.tMax = kInfinity;
  return !path.throughput.isBlack();
}

Rgb SppmEstimator::radiance(const CameraRay& camera, SampleStream& stream,
                            RenderState& state) const {
  CameraPath path{camera.ray, &camera.differential};
  const Bsdf& bsdf = state.bsdf;
  SurfaceInteraction at;
  for (int depth = 0; depth < maxDepth_ && findSurface(path, state, at); ++depth) {
    at.primitive->material->evaluate(at, state.bsdf);
    // Two sets of dimensions; those between are the photons'.
    const auto set = 2 * static_cast<size_t>(depth);
    const uint32_t forDirection = cameraDimension(set + 1) + kDirectionOffset;
    if (state.aov && depth == 0) {
      stream.setDimension(forDirection);
      recordSurface(*state.aov, at, bsdf, stream);
    }
    path.radiance += path.throughput * direct(at, cameraDimension(set), stream, state);
    const bool last = depth + 1 >= maxDepth_;
    if ((bsdf.flags() & kDiffuse) || (last && (bsdf.flags() & kGlossy))) {
      path.radiance += path.throughput * gather(at, bsdf);
      break;
    }
    stream.setDimension(forDirection);
    if (last || !scatter(path, at, bsdf, stream)) break;
  }
  return path.radiance;
}

class SppmIntegrator final : public PixelIntegrator<SppmParameters> {
 public:
  using PixelIntegrator::PixelIntegrator;
  /// Of the photons: in pieces, as a whole and as a map.
  double memory(const Film& film) const override {
    const double paths =
        parameters_.photons > 0 ? parameters_.photons : static_cast<double>(film.bounds().area());
    const double each = std::min(parameters_.maxDepth, kUsualBounces);
    return 3 * sizeof(Photon) * paths * each;
  }

 private:
  uint64_t renderPixels(RenderContext& context, const PixelBounds& pixels) const override {
    RenderContext own = context;
    RenderOptions& o = own.options;
    // As in pbrt-v3 the sampler's number does not count.
    if (o.sampleCount == 0 && !(o.seconds > 0) && !(o.noise > 0))
      o.sampleCount = static_cast<uint64_t>(parameters_.iterations);
    return renderPasses(own, pixels, SppmEstimator(own, parameters_, distribution_.get()));
  }
};

}  // namespace

IntegratorRegistry::Entry sppmPlugin() {
  return makePlugin("sppm", "Stochastic progressive photon mapping.",
                    createPixelIntegrator<SppmIntegrator, SppmParameters>);
}

}  // namespace lampyris
