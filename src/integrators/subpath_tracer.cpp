// SPDX-License-Identifier: Apache-2.0
// Importance transport has the BSDF's arguments exchanged, no compression of radiance by
// refraction, and the other cosine of shading normals (Veach 1997, §5.2, 5.3).
#include "integrators/subpath_tracer.h"

#include "integrators/ray_surface.h"
#include "integrators/transmittance.h"

namespace lampyris {

struct SubpathTracer::Walk {
  Ray ray;
  const RayDifferential* differential;  ///< null after the first surface
  const Medium* medium;                 ///< of the ray
  Rgb throughput;
  double pdf;  ///< of the direction, or of the place for light from infinity
  const bool fromLight;
  const size_t bounces;  ///< that the path may have
  SampleStream stream;
  NumberSequence* const numbers;  ///< null: media are ignored
  Subpath& path;
  RayCounts& rays;
  EmissionSink* const emission;  ///< null: the last vertex is only connected to
  int interfaces = 0;
  bool distanceDrawn = false;  ///< since the last vertex, with the sampler's numbers

  /// For the numbers of the last vertex.
  void setDimension(uint32_t offset) {
    const size_t vertex = path.size() - 1;
    stream.setDimension((fromLight ? lightDimension(vertex) : cameraDimension(vertex)) + offset);
  }
  Ray segment(float distance) const {
    Ray part = ray;
    part.tMax = distance;
    return part;
  }
  /// Of what the ray finds, whether or not the walk scatters before: to wait whether it does would
  /// make noise wherever a lamp is seen.
  Rgb throughputAfter(float distance) const {
    if (!medium) return throughput;
    return throughput * medium->transmittance(segment(distance), *numbers, rays.tracking);
  }
  MediumSample throughMedium(float distance) {
    if (distanceDrawn) return medium->sample(segment(distance), *numbers, rays.tracking);
    distanceDrawn = true;
    setDimension(kDistanceOffset);
    NumberSequence own = numbers->fork(stream.next2D());
    return medium->sample(segment(distance), own, rays.tracking);
  }
  /// The next vertex, which path.grow() would append.
  PathVertex& next(PathVertex::Kind kind, const SurfaceInteraction& at) {
    const PathVertex& before = path.back();
    PathVertex& v = path.spare();
    v.kind = kind;
    v.infinite = false;
    v.connectible = true;
    v.light = kNoLight;
    v.at = at;
    v.medium = medium;
    v.throughput = throughput;
    v.forward = densityAt(v, before, pdf);
    v.reverse = 0;
    return v;
  }
};

void SubpathTracer::fromCamera(const CameraRay& camera, double pdf, size_t bounces,
                               SampleStream stream, NumberSequence* numbers, Subpath& out,
                               RayCounts& rays, EmissionSink* emission) const {
  out.clear();
  PathVertex& v = out.grow();
  v.kind = PathVertex::Kind::Camera;
  v.infinite = false;
  v.at = SurfaceInteraction();
  v.at.p = camera.ray.o;
  v.at.n = Vec3(0);
  v.throughput = Rgb(1);
  v.forward = 1;
  v.connectible = pdf > 0;
  Walk walk{camera.ray,
            &camera.differential,
            numbers ? scene_.cameraMedium : nullptr,
            Rgb(1),
            pdf,
            false,
            bounces,
            stream,
            numbers,
            out,
            rays,
            emission};
  while (advance(walk)) {
  }
}

void SubpathTracer::fromLight(const Ray& camera, size_t bounces, SampleStream stream,
                              NumberSequence* numbers, Subpath& out, RayCounts& rays) const {
  out.clear();
  if (emitters_.empty()) return;
  stream.setDimension(lightDimension(0));
  const SampledLight chosen = emitters_.sample(stream.next1D());
  const LightTable::Entry entry = scene_.lightTable[chosen.light];
  const Vec2 u = stream.next2D(), w = stream.next2D();
  const auto s = entry.light->sampleEmission(entry.element, u, w);
  if (!s) return;
  const float cosine = s->n != Vec3(0) ? absDot(s->n, s->w) : 1.f;
  PathVertex& v = out.grow();
  v.kind = PathVertex::Kind::Light;
  v.infinite = entry.light->isInfinite();
  v.connectible = true;
  v.light = chosen.light;
  v.at = SurfaceInteraction();
  v.at.p = s->p;
  v.at.pError = s->pError;
  v.at.n = s->n;
  v.at.wo = -s->w;
  const float place = v.infinite ? s->pdfDirection : s->pdfPosition;
  const float onwards = v.infinite ? s->pdfPosition : s->pdfDirection;
  v.forward = static_cast<double>(chosen.pmf) * static_cast<double>(place);
  v.throughput = s->radiance / (chosen.pmf * place);
  const Vec3 o = s->n != Vec3(0) ? offsetRayOrigin(s->p, s->pError, s->n, s->w) : s->p;
  Walk walk{{o, s->w, kInfinity, camera.time},
            nullptr,
            numbers ? mediumAt(scene_, o, camera, rays) : nullptr,
            v.throughput * (cosine / onwards),
            static_cast<double>(onwards),
            true,
            bounces,
            stream,
            numbers,
            out,
            rays,
            nullptr};
  if (v.infinite && walk.medium) {
    const Ray before{o, -s->w, kInfinity, camera.time};
    walk.throughput *= walk.medium->transmittance(before, *numbers, rays.tracking);
  }
  if (!walk.throughput.isFinite()) {
    countRejection(Rejection::PathWeight);
    out.clear();
    return;
  }
  while (advance(walk)) {
  }
}

/// Emission of infinite lights that the ray escapes to.
void SubpathTracer::foundOutside(const Walk& walk) const {
  PathVertex v;
  v.kind = PathVertex::Kind::Light;
  v.infinite = true;
  v.at.wo = walk.ray.d;
  v.forward = walk.pdf;
  for (size_t i = 0; i < scene_.infiniteLights.size(); ++i) {
    const Rgb radiance = scene_.infiniteLights[i]->escaped(walk.ray.d);
    if (radiance.isBlack()) continue;
    v.light = scene_.infiniteLightIds[i];
    walk.emission->found(v, walk.throughputAfter(kInfinity) * radiance);
  }
}

void SubpathTracer::foundAtHit(const Walk& walk, const SurfaceInteraction& at,
                               float distance) const {
  const Primitive& primitive = *at.primitive;
  const Rgb radiance = primitive.light->emitted(at, at.wo);
  if (radiance.isBlack()) return;
  PathVertex v;
  v.kind = PathVertex::Kind::Light;
  v.at = at;
  v.light = primitive.lightId(at.element);
  const PathVertex& before = walk.path.back();
  // An emitter within an object instance is seen but lights nothing, as in the path integrator.
  if (v.light == kNoLight && walk.path.size() > 1 && before.connectible) return;
  v.forward = densityAt(v, before, walk.pdf);
  walk.emission->found(v, walk.throughputAfter(distance) * radiance);
}

/// Follows the ray to where it meets something next and scatters there; false: the walk is over.
bool SubpathTracer::advance(Walk& walk) const {
  const Geometry& geometry = *scene_.geometry;
  ++walk.rays.closest;
  const auto hit = geometry.intersect(walk.ray);
  const float distance = hit ? hit->shape.t : kInfinity;
  SurfaceInteraction at;
  if (hit) at = surfaceAt(geometry, walk.ray, *hit, walk.differential);
  if (walk.emission && !hit) foundOutside(walk);
  if (walk.emission && hit && at.primitive->light) foundAtHit(walk, at, distance);
  if (walk.medium) {
    const MediumSample s = walk.throughMedium(distance);
    walk.throughput *= s.weight;
    if (walk.throughput.isBlack()) return false;
    if (s.scatters) return scatterInMedium(walk, walk.ray.at(s.t));
  }
  if (!hit) return false;
  const Primitive& primitive = *at.primitive;
  if (!primitive.material) {
    walk.differential = nullptr;
    if (walk.numbers) walk.medium = mediumBeyond(primitive, walk.medium, walk.ray.d, at.n);
    startBehind(walk.ray, at);
    return mayPass(++walk.interfaces);
  }
  if (walk.path.size() > walk.bounces) return false;
  PathVertex& v = walk.next(PathVertex::Kind::Surface, at);
  primitive.material->evaluate(v.at, v.bsdf);
  if (v.bsdf.empty()) return false;
  walk.path.grow();
  return scatter(walk);
}

bool SubpathTracer::scatterInMedium(Walk& walk, const Vec3& p) const {
  if (walk.path.size() > walk.bounces) return false;
  SurfaceInteraction at;
  at.p = p;
  at.n = Vec3(0);
  at.wo = -walk.ray.d;
  walk.next(PathVertex::Kind::Medium, at);
  walk.path.grow();
  return scatter(walk);
}

/// Draws the next ray at the path's last vertex.
bool SubpathTracer::scatter(Walk& walk) const {
  const size_t number = walk.path.size() - 1;
  PathVertex& v = walk.path.back();
  PathVertex& before = walk.path[number - 1];
  if (!walk.emission && number >= walk.bounces) return false;
  walk.setDimension(kDirectionOffset);
  const Vec3 wo = v.at.wo;
  const Vec2 u = walk.stream.next2D();
  const auto s = v.sample(walk.stream.next1D(), u);
  if (!s || !(s->pdf > 0)) return false;
  if (walk.fromLight) {
    const Rgb f =
        s->isSpecular() ? (s->isTransmission() ? s->f * sqr(s->eta) : s->f) : v.f(s->wi, wo);
    walk.throughput *= f * (v.importanceCosine(wo, s->wi) / s->pdf);
  } else {
    walk.throughput *= s->f * (v.cosine(s->wi) / s->pdf);
  }
  if (walk.throughput.isBlack()) return false;
  if (!walk.throughput.isFinite()) {
    countRejection(Rejection::PathWeight);
    return false;
  }
  // A specular direction: the choice of it has the same probability both ways, and drops out.
  walk.pdf = s->isSpecular() ? 1. : static_cast<double>(s->pdf);
  const double back = s->isSpecular() ? 1. : static_cast<double>(v.pdf(s->wi, wo));
  before.reverse = densityAt(before, v, back);
  v.connectible = !s->isSpecular();
  walk.differential = nullptr;
  walk.interfaces = 0;
  walk.distanceDrawn = false;
  if (walk.numbers) walk.medium = v.mediumTowards(s->wi);
  walk.ray.o = offsetRayOrigin(v.at.p, v.at.pError, v.at.n, s->wi);
  walk.ray.d = s->wi;
  walk.ray.tMax = kInfinity;
  return true;
}

}  // namespace lampyris
