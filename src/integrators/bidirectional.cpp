// SPDX-License-Identifier: Apache-2.0
// Bidirectional path tracing (Lafortune and Willems 1993; Veach 1997, chapter 10), the image of
// pbrt-v3's "bdpt" in expectation. One walk from the camera and one from a light drawn by power;
// all of their vertices are connected. A light's vertex next to the camera's walk is drawn for it
// by the light distribution, as in the path integrator.
//
// Cost a sample, for maxdepth d: 2 d rays, up to (d + 1) (d + 2) / 2 shadow rays.
#include "integrators/bidirectional.h"

#include "core/rejections.h"
#include "integrators/aov_surface.h"
#include "integrators/direct_lighting.h"
#include "integrators/light_connection.h"
#include "integrators/sample_numbers.h"
#include "integrators/transmittance.h"

namespace lampyris {

namespace {

/// For NumberSequence; the camera's vertex draws nothing.
constexpr uint32_t kSeedDimension = kFirstPathDimension + 1;

/// Whether the light over an edge is finite; if not, that is counted.
bool isUsable(const Rgb& light) {
  if (light.isFinite()) return true;
  countRejection(Rejection::PathWeight);
  return false;
}

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
  return v.throughput * v.f(w, v.at.wo) * v.importanceCosine(v.at.wo, w);
}

}  // namespace

struct BidirectionalPaths::Paths {
  Subpath camera, light;
  WholePath whole;
  Ray ray;                    ///< of the camera
  NumberSequence numbers{0};  ///< for media

  float time() const { return ray.time; }
  /// Null if there are no media.
  NumberSequence* numbersOf(const Scene& scene) { return scene.media.empty() ? nullptr : &numbers; }

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

/// Adds up the emission that the camera's walk finds after `vertices` of its own (0: any number).
class BidirectionalPaths::Found final : public EmissionSink {
 public:
  Found(const BidirectionalPaths& estimator, Paths& paths, size_t vertices)
      : estimator_(estimator), paths_(paths), vertices_(vertices) {}
  void found(const PathVertex& light, const Rgb& radiance) override {
    if (vertices_ > 0 && paths_.camera.size() != vertices_) return;
    const WholePath& whole = paths_.join(light, 0, paths_.camera.size());
    sum += radiance * static_cast<float>(estimator_.densities_.weight(whole, paths_.time()));
  }
  Rgb sum;

 private:
  const BidirectionalPaths& estimator_;
  Paths& paths_;
  const size_t vertices_;
};

BidirectionalPaths::BidirectionalPaths(const RenderContext& context,
                                       const LightDistribution* distribution,
                                       const PixelBounds& pixels)
    : scene_(context.scene),
      camera_(context.camera),
      distribution_(distribution),
      splatFactor_(1 / static_cast<float>(context.film.bounds().area())),
      emitters_(scene_.lightTable),
      tracer_(scene_, emitters_),
      densities_(scene_, camera_, emitters_, distribution, pixels.area()) {}

/// Kept, so that a sample allocates nothing.
BidirectionalPaths::Paths& BidirectionalPaths::threadPaths() {
  thread_local Paths paths;
  return paths;
}

void BidirectionalPaths::traceCamera(Paths& paths, const CameraRay& camera, size_t bounces,
                                     SampleStream& stream, RayCounts& rays,
                                     EmissionSink* emission) const {
  const double pdf = densities_.cameraPdf(camera.ray.d, camera.ray.time);
  tracer_.fromCamera(camera, pdf, bounces, stream, paths.numbersOf(scene_), paths.camera, rays,
                     emission);
}

void BidirectionalPaths::traceLight(Paths& paths, size_t bounces, SampleStream& stream,
                                    RayCounts& rays) const {
  tracer_.fromLight(paths.ray, bounces, stream, paths.numbersOf(scene_), paths.light, rays);
}

Rgb BidirectionalPaths::all(int maxDepth, const CameraRay& camera, SampleStream& stream,
                            RenderState& state, SplatSink& splats) const {
  Paths& paths = threadPaths();
  paths.ray = camera.ray;
  if (!scene_.media.empty()) paths.numbers = numbersBeyond(stream, kSeedDimension);
  Found found(*this, paths, 0);
  const auto bounces = static_cast<size_t>(maxDepth), edges = bounces + 1;
  traceCamera(paths, camera, bounces, stream, state.rays, &found);
  Rgb sum = found.sum;
  if (state.aov && paths.camera.size() > 1 && paths.camera[1].isSurface()) {
    stream.setDimension(cameraDimension(1) + kDirectionOffset);
    recordSurface(*state.aov, paths.camera[1].at, paths.camera[1].bsdf, stream);
  }
  if (emitters_.empty() || !distribution_) return sum;
  traceLight(paths, bounces, stream, state.rays);
  const size_t s = std::max<size_t>(paths.light.size(), 1);
  for (size_t t = 2; t <= paths.camera.size() && t <= edges; ++t)
    for (size_t i = 1; i <= s && i + t <= edges + 1; ++i)
      sum += joined(paths, i, t, stream, state.rays);
  if (camera_.projects())
    for (size_t i = 2; i <= paths.light.size() && i <= edges; ++i)
      if (const auto splat = connectCamera(paths, i, stream, state.rays)) splats.splat(*splat);
  return sum;
}

size_t BidirectionalPaths::strategyCount(int depth) const {
  if (depth == 0) return 1;  // the camera alone sees lights
  const auto bounces = static_cast<size_t>(depth);
  return emitters_.empty() || !distribution_ ? 1 : bounces + 1 + (camera_.projects() ? 1 : 0);
}

PathStrategy BidirectionalPaths::strategy(int depth, size_t number) const {
  return {number, static_cast<size_t>(depth) + 2 - number};
}

Splat BidirectionalPaths::one(const PathStrategy& strategy, const Vec2& film,
                              const CameraRay& camera, SampleStream& stream,
                              const NumberSequence& numbers, RayCounts& rays) const {
  const size_t s = strategy.fromLight, t = strategy.fromCamera;
  Paths& paths = threadPaths();
  paths.ray = camera.ray;
  paths.numbers = numbers;
  Splat result{film, Rgb()};
  if (t > 1) {
    Found found(*this, paths, t - 1);
    traceCamera(paths, camera, s > 0 ? t - 1 : t - 2, stream, rays, s > 0 ? nullptr : &found);
    result.value = found.sum;
    if (s == 0 || paths.camera.size() < t) return result;
  }
  if (s > 1) {
    traceLight(paths, s - 1, stream, rays);
    if (paths.light.size() < s) return result;
  }
  if (t > 1)
    result.value = joined(paths, s, t, stream, rays);
  else if (const auto splat = connectCamera(paths, s, stream, rays))
    result = *splat;
  return result;
}

/// Paths of s ≥ 1 vertices from the light's side and t ≥ 2 from the camera's.
Rgb BidirectionalPaths::joined(Paths& paths, size_t s, size_t t, SampleStream& stream,
                               RayCounts& rays) const {
  if (paths.camera[t - 1].isSpecular()) return Rgb();
  return s > 1 ? connect(paths, s, t, rays) : sampleLight(paths, t, stream, rays);
}

/// Light sampling at the camera's vertex t − 1.
Rgb BidirectionalPaths::sampleLight(Paths& paths, size_t t, SampleStream& stream,
                                    RayCounts& rays) const {
  const PathVertex& v = paths.camera[t - 1];
  stream.setDimension(cameraDimension(t - 1));
  const LightSampleContext at = v.context();
  const float choice = stream.next1D();
  const Vec2 u = stream.next2D();
  const auto chosen = distribution_->sample(at, choice);
  if (!chosen || !(chosen->pmf > 0)) return Rgb();
  const auto s = lightArriving(scene_, chosen->light, at.p, u);
  if (!s) return Rgb();
  Rgb light =
      v.throughput * v.f(at.wo, s->wi) * s->radiance * (v.cosine(s->wi) / (chosen->pmf * s->pdf));
  if (!light.isBlack()) light *= passing(paths, v, *s, rays);
  if (light.isBlack()) return Rgb();
  PathVertex start;
  start.kind = PathVertex::Kind::Light;
  start.infinite = scene_.lightTable[chosen->light].light->isInfinite();
  start.light = chosen->light;
  start.at.p = s->p;
  start.at.n = s->n;
  start.at.wo = s->wi;
  return light * static_cast<float>(densities_.weight(paths.join(start, 1, t), paths.time()));
}

/// An edge between the walks' vertices s − 1 and t − 1.
Rgb BidirectionalPaths::connect(Paths& paths, size_t s, size_t t, RayCounts& rays) const {
  const PathVertex &l = paths.light[s - 1], &c = paths.camera[t - 1];
  const Vec3 d = l.at.p - c.at.p, w = normalize(d);
  if (w == Vec3(0)) return Rgb();
  Rgb light =
      c.throughput * c.f(c.at.wo, w) * c.cosine(w) * scatteredFromLight(l, -w) / lengthSquared(d);
  if (light.isBlack() || !isUsable(light)) return Rgb();
  light *= passing(paths, c, targetAt(l, w), rays);
  if (light.isBlack()) return Rgb();
  return light *
         static_cast<float>(densities_.weight(paths.join(paths.light[0], s, t), paths.time()));
}

/// An edge from the light's vertex s − 1 to the lens.
std::optional<Splat> BidirectionalPaths::connectCamera(Paths& paths, size_t s, SampleStream& stream,
                                                       RayCounts& rays) const {
  const PathVertex& l = paths.light[s - 1];
  if (l.isSpecular()) return std::nullopt;
  stream.setDimension(lightDimension(s - 1) + 1);
  const auto view = camera_.project(l.at.p, stream.next2D(), paths.time());
  if (!view) return std::nullopt;
  const Vec3 d = view->lens - l.at.p, w = normalize(d);
  Rgb value =
      scatteredFromLight(l, w) * (view->pixelsPerSteradian * splatFactor_ / lengthSquared(d));
  if (value.isBlack() || !isUsable(value)) return std::nullopt;
  PathVertex lens;
  lens.kind = PathVertex::Kind::Camera;
  lens.at.p = view->lens;
  lens.at.n = Vec3(0);
  value *= passing(paths, l, targetAt(lens, w), rays);
  if (value.isBlack()) return std::nullopt;
  paths.join(paths.light[0], s, 0);
  paths.whole.vertices.push_back(&lens);
  const auto weight = static_cast<float>(densities_.weight(paths.whole, paths.time()));
  return Splat{view->film, value * weight};
}

/// Share of the light that passes between them. As in pbrt-v3's bdpt, and unlike its path,
/// interfaces block no light.
Rgb BidirectionalPaths::passing(Paths& paths, const PathVertex& from, const LightSample& to,
                                RayCounts& rays) const {
  const Ray ray = shadowRay(from.context(), paths.time(), to);
  return transmittance(scene_, ray, from.mediumTowards(to.wi), paths.numbers, rays);
}

}  // namespace lampyris
