// SPDX-License-Identifier: Apache-2.0
// Bidirectional path tracing (Lafortune and Willems 1993; Veach 1997, chapter 10), the image of
// pbrt-v3's "bdpt" in expectation. One walk from the camera and one from a light drawn by power;
// all of their vertices are connected. A light's vertex next to the camera's walk is drawn for it
// by the light distribution, as in the path integrator.
//
// Cost a sample, for maxdepth d: 2 d rays, up to (d + 1) (d + 2) / 2 shadow rays.
#include "integrators/bidirectional.h"

#include "integrators/aov_surface.h"
#include "integrators/direct_lighting.h"
#include "integrators/light_connection.h"
#include "integrators/ray_surface.h"

namespace lampyris {

namespace {

constexpr uint64_t kTypicalSamples = 256;

LightSampleContext contextOf(const PathVertex& v) { return {v.at, v.bsdf}; }

/// The place of a vertex as what a shadow ray is led to.
LightSample targetAt(const PathVertex& v, const Vec3& wi) {
  LightSample s;
  s.wi = wi;
  s.distance = 0;  // finite
  s.p = v.at.p;
  s.pError = v.at.pError;
  s.n = v.at.n;
  return s;
}

/// Light that `v`, of a light's walk, scatters towards `w`, but for what distance does.
Rgb scatteredFromLight(const PathVertex& v, const Vec3& w) {
  const Vec3& in = v.at.wo;
  const float cosines = safeDivide(v.bsdf.absCosTheta(in) * absDot(w, v.at.n), absDot(in, v.at.n));
  return v.throughput * v.bsdf.f(w, in) * cosines;
}

}  // namespace

struct BidirectionalEstimator::Paths {
  Subpath camera, light;
  WholePath whole;
  float time = 0;

  /// Puts together the vertex `start` (the light), vertices 1 … s − 1 of the light's walk and t of
  /// the camera's.
  const WholePath& join(const PathVertex& start, size_t s, size_t t) {
    whole.vertices.clear();
    whole.vertices.push_back(&start);
    for (size_t i = 1; i < s; ++i) whole.vertices.push_back(&light[i]);
    while (t-- > 0) whole.vertices.push_back(&camera[t]);
    whole.fromLight = s;
    return whole;
  }
};

/// Adds up the emission that the camera's walk finds.
class BidirectionalEstimator::Found final : public EmissionSink {
 public:
  Found(const BidirectionalEstimator& estimator, Paths& paths)
      : estimator_(estimator), paths_(paths) {}
  void found(const PathVertex& light, const Rgb& radiance) override {
    const WholePath& whole = paths_.join(light, 0, paths_.camera.size());
    sum += radiance * static_cast<float>(estimator_.densities_.weight(whole, paths_.time));
  }
  Rgb sum;

 private:
  const BidirectionalEstimator& estimator_;
  Paths& paths_;
};

BidirectionalEstimator::BidirectionalEstimator(const RenderContext& context, int maxDepth,
                                               const LightDistribution* distribution,
                                               const PixelBounds& pixels, SplatSink& splats)
    : scene_(context.scene),
      camera_(context.camera),
      maxDepth_(maxDepth),
      distribution_(distribution),
      splatFactor_(1 / static_cast<float>(context.film.bounds().area())),
      splats_(splats),
      emitters_(scene_.lightTable),
      tracer_(scene_, emitters_, maxDepth),
      densities_(scene_, camera_, emitters_, distribution, pixels.area()) {}

Rgb BidirectionalEstimator::radiance(const CameraRay& camera, SampleStream& stream,
                                     RenderState& state) const {
  thread_local Paths paths;  // kept, so that a sample allocates nothing
  paths.time = camera.ray.time;
  Found found(*this, paths);
  const double pdf = densities_.cameraPdf(camera.ray.d, paths.time);
  tracer_.fromCamera(camera, pdf, stream, paths.camera, state.rays, found);
  Rgb sum = found.sum;
  if (state.aov && paths.camera.size() > 1) {
    stream.setDimension(cameraDimension(1) + kDirectionOffset);
    recordSurface(*state.aov, paths.camera[1].at, paths.camera[1].bsdf, stream);
  }
  if (emitters_.empty() || !distribution_) return sum;
  tracer_.fromLight(paths.time, stream, paths.light, state.rays);
  const auto edges = static_cast<size_t>(maxDepth_) + 1;
  for (size_t t = 2; t <= paths.camera.size() && t <= edges; ++t) {
    if (paths.camera[t - 1].bsdf.isSpecular()) continue;
    sum += sampleLight(paths, t, stream, state.rays);
    for (size_t s = 2; s <= paths.light.size() && s + t <= edges + 1; ++s)
      sum += connect(paths, s, t, state.rays);
  }
  if (camera_.projects())
    for (size_t s = 2; s <= paths.light.size() && s <= edges; ++s)
      connectCamera(paths, s, stream, state.rays);
  return sum;
}

/// Light sampling at the camera's vertex t − 1.
Rgb BidirectionalEstimator::sampleLight(Paths& paths, size_t t, SampleStream& stream,
                                        RayCounts& rays) const {
  const PathVertex& v = paths.camera[t - 1];
  stream.setDimension(cameraDimension(t - 1));
  const LightSampleContext at = contextOf(v);
  const float choice = stream.next1D();
  const Vec2 u = stream.next2D();
  const auto chosen = distribution_->sample(at, choice);
  if (!chosen || !(chosen->pmf > 0)) return Rgb();
  const LightTable::Entry entry = scene_.lightTable[chosen->light];
  const auto s = entry.light->sample(entry.element, at.p, u);
  if (!s || !(s->pdf > 0) || s->radiance.isBlack()) return Rgb();
  const Rgb light = v.throughput * v.bsdf.f(at.wo, s->wi) * s->radiance *
                    (v.bsdf.absCosTheta(s->wi) / (chosen->pmf * s->pdf));
  if (light.isBlack() || !isVisible(shadowRay(at, paths.time, *s), rays)) return Rgb();
  PathVertex start;
  start.kind = PathVertex::Kind::Light;
  start.infinite = entry.light->isInfinite();
  start.light = chosen->light;
  start.at.p = s->p;
  start.at.n = s->n;
  start.at.wo = s->wi;
  return light * static_cast<float>(densities_.weight(paths.join(start, 1, t), paths.time));
}

/// An edge between the walks' vertices s − 1 and t − 1.
Rgb BidirectionalEstimator::connect(Paths& paths, size_t s, size_t t, RayCounts& rays) const {
  const PathVertex &l = paths.light[s - 1], &c = paths.camera[t - 1];
  const Vec3 d = l.at.p - c.at.p, w = normalize(d);
  if (w == Vec3(0)) return Rgb();
  const Rgb light = c.throughput * c.bsdf.f(c.at.wo, w) * c.bsdf.absCosTheta(w) *
                    scatteredFromLight(l, -w) / lengthSquared(d);
  if (light.isBlack() || !light.isFinite()) return Rgb();
  if (!isVisible(shadowRay(contextOf(c), paths.time, targetAt(l, w)), rays)) return Rgb();
  return light *
         static_cast<float>(densities_.weight(paths.join(paths.light[0], s, t), paths.time));
}

/// An edge from the light's vertex s − 1 to the lens.
void BidirectionalEstimator::connectCamera(Paths& paths, size_t s, SampleStream& stream,
                                           RayCounts& rays) const {
  const PathVertex& l = paths.light[s - 1];
  if (l.bsdf.isSpecular()) return;
  stream.setDimension(lightDimension(s - 1) + 1);
  const auto view = camera_.project(l.at.p, stream.next2D(), paths.time);
  if (!view) return;
  const Vec3 d = view->lens - l.at.p, w = normalize(d);
  const Rgb value =
      scatteredFromLight(l, w) * (view->pixelsPerSteradian * splatFactor_ / lengthSquared(d));
  if (value.isBlack() || !value.isFinite()) return;
  PathVertex lens;
  lens.kind = PathVertex::Kind::Camera;
  lens.at.p = view->lens;
  lens.at.n = Vec3(0);
  if (!isVisible(shadowRay(contextOf(l), paths.time, targetAt(lens, w)), rays)) return;
  paths.join(paths.light[0], s, 0);
  paths.whole.vertices.push_back(&lens);
  splats_.splat(view->film, value * static_cast<float>(densities_.weight(paths.whole, paths.time)));
}

/// As in pbrt-v3's bdpt, and unlike its path, interfaces block no light.
bool BidirectionalEstimator::isVisible(const Ray& segment, RayCounts& rays) const {
  ++rays.shadow;
  const Geometry& geometry = *scene_.geometry;
  if (!geometry.occluded(segment)) return true;
  Ray ray = segment;
  const bool finite = std::isfinite(segment.tMax);
  const Vec3 end = segment.at(finite ? segment.tMax : 0);
  for (int i = 0; i <= kMaxInterfaces; ++i) {
    ++rays.closest;
    const auto hit = geometry.intersect(ray);
    if (!hit) return true;
    if (geometry.primitive(*hit).material) return false;
    const SurfaceInteraction at = geometry.surface(ray, *hit, SurfaceDetail::Basic);
    ray.o = offsetRayOrigin(at.p, at.pError, at.n, ray.d);
    if (!finite) continue;
    ray.tMax = dot(end - ray.o, ray.d) / lengthSquared(ray.d);
    if (!(ray.tMax > 0)) return true;
  }
  return false;
}

namespace {

class SplatSum final : public SplatSink {
 public:
  void splat(const Vec2&, const Rgb& value) override {
    sum += static_cast<double>(value.luminance());
  }
  double sum = 0;
};

}  // namespace

double typicalSample(const RenderContext& context, int maxDepth,
                     const LightDistribution* distribution, const PixelBounds& pixels) {
  SplatSum splats;
  const BidirectionalEstimator estimator(context, maxDepth, distribution, pixels, splats);
  const auto count = static_cast<uint64_t>(pixels.area());
  const uint64_t stride = count / kTypicalSamples + 1;
  RenderState state;
  double sum = 0;
  for (uint64_t i = 0; i < kTypicalSamples; ++i) {
    const uint64_t at = i * stride, pixel = at % count;
    const Int2 offset(static_cast<int>(pixel % static_cast<uint64_t>(pixels.size().x)),
                      static_cast<int>(pixel / static_cast<uint64_t>(pixels.size().x)));
    SampleStream stream(context.sampler, {pixels.min + offset, at / count});
    CameraSample sample;
    sample.film = Vec2(pixels.min + offset) + stream.next2D();
    sample.lens = stream.next2D();
    sample.time = stream.next1D();
    const CameraRay camera = context.camera.generate(sample);
    const auto y = static_cast<double>(estimator.radiance(camera, stream, state).luminance());
    if (std::isfinite(y)) sum += std::abs(y);
  }
  const double typical = (sum + splats.sum) / kTypicalSamples;
  return typical > 0 && std::isfinite(typical) ? typical : 1;
}

}  // namespace lampyris
