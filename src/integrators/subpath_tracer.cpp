// SPDX-License-Identifier: Apache-2.0
// Importance transport has the BSDF's arguments exchanged, no compression of radiance by
// refraction, and the other cosine of shading normals (Veach 1997, §5.2, 5.3).
#include "integrators/subpath_tracer.h"

#include "integrators/ray_surface.h"

namespace lampyris {

namespace {

/// Factor of the throughput for light that comes from `in` and leaves towards `out`, drawn with
/// `pdf`, but for f: sides by the geometric normal, which densities know, cosines by the shading
/// normal.
float importanceCosine(const PathVertex& v, const Vec3& in, const Vec3& out) {
  return safeDivide(v.bsdf.absCosTheta(in) * absDot(out, v.at.n), absDot(in, v.at.n));
}

}  // namespace

struct SubpathTracer::Walk {
  Ray ray;
  const RayDifferential* differential;  ///< null after the first surface
  Rgb throughput;
  double pdf;  ///< of the direction, or of the place for light from infinity
  const bool fromLight;
  const size_t surfaces;  ///< that the path may have
  SampleStream stream;
  Subpath& path;
  RayCounts& rays;
  EmissionSink* const emission;  ///< null: the last surface is only connected to
  int interfaces = 0;
};

void SubpathTracer::fromCamera(const CameraRay& camera, double pdf, size_t surfaces,
                               SampleStream stream, Subpath& out, RayCounts& rays,
                               EmissionSink* emission) const {
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
  Walk walk{camera.ray, &camera.differential, Rgb(1), pdf, false, surfaces, stream, out, rays,
            emission};
  while (advance(walk)) {
  }
}

void SubpathTracer::fromLight(float time, size_t surfaces, SampleStream stream, Subpath& out,
                              RayCounts& rays) const {
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
  Walk walk{{s->n != Vec3(0) ? offsetRayOrigin(s->p, s->pError, s->n, s->w) : s->p, s->w, kInfinity,
             time},
            nullptr,
            v.throughput * (cosine / onwards),
            static_cast<double>(onwards),
            true,
            surfaces,
            stream,
            out,
            rays,
            nullptr};
  if (!walk.throughput.isFinite()) {
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
    walk.emission->found(v, walk.throughput * radiance);
  }
}

void SubpathTracer::foundAtHit(const Walk& walk, const SurfaceInteraction& at) const {
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
  walk.emission->found(v, walk.throughput * radiance);
}

/// Follows the ray to the next surface and scatters there; false: the walk is over.
bool SubpathTracer::advance(Walk& walk) const {
  const Geometry& geometry = *scene_.geometry;
  ++walk.rays.closest;
  const auto hit = geometry.intersect(walk.ray);
  if (!hit) {
    if (walk.emission) foundOutside(walk);
    return false;
  }
  const Primitive& primitive = geometry.primitive(*hit);
  const Material* const material = primitive.material;
  const SurfaceInteraction at = surfaceAt(geometry, walk.ray, *hit, walk.differential);
  if (primitive.light && walk.emission) foundAtHit(walk, at);
  if (!material) {
    walk.differential = nullptr;
    walk.ray.o = offsetRayOrigin(at.p, at.pError, at.n, walk.ray.d);
    return ++walk.interfaces <= kMaxInterfaces;
  }
  if (walk.path.size() > walk.surfaces) return false;
  const PathVertex& before = walk.path.back();
  PathVertex& v = walk.path.spare();
  v.kind = PathVertex::Kind::Surface;
  v.infinite = false;
  v.connectible = true;
  v.light = kNoLight;
  v.at = at;
  v.throughput = walk.throughput;
  v.forward = densityAt(v, before, walk.pdf);
  v.reverse = 0;
  material->evaluate(v.at, v.bsdf);
  if (v.bsdf.empty()) return false;
  walk.path.grow();
  return scatter(walk);
}

/// Draws the next ray at the path's last vertex.
bool SubpathTracer::scatter(Walk& walk) const {
  const size_t number = walk.path.size() - 1;
  PathVertex& v = walk.path.back();
  PathVertex& before = walk.path[number - 1];
  if (!walk.emission && number >= walk.surfaces) return false;
  walk.stream.setDimension((walk.fromLight ? lightDimension(number) : cameraDimension(number)) +
                           kDirectionOffset);
  const Vec3 wo = v.at.wo;
  const Vec2 u = walk.stream.next2D();
  const auto s = v.bsdf.sample(wo, walk.stream.next1D(), u);
  if (!s || !(s->pdf > 0)) return false;
  if (walk.fromLight) {
    const Rgb f =
        s->isSpecular() ? (s->isTransmission() ? s->f * sqr(s->eta) : s->f) : v.bsdf.f(s->wi, wo);
    walk.throughput *= f * (importanceCosine(v, wo, s->wi) / s->pdf);
  } else {
    walk.throughput *= s->f * (v.bsdf.absCosTheta(s->wi) / s->pdf);
  }
  if (walk.throughput.isBlack() || !walk.throughput.isFinite()) return false;
  // A specular direction: the choice of it has the same probability both ways, and drops out.
  walk.pdf = s->isSpecular() ? 1. : static_cast<double>(s->pdf);
  const double back = s->isSpecular() ? 1. : static_cast<double>(v.bsdf.pdf(s->wi, wo));
  before.reverse = densityAt(before, v, back);
  v.connectible = !s->isSpecular();
  walk.differential = nullptr;
  walk.interfaces = 0;
  walk.ray.o = offsetRayOrigin(v.at.p, v.at.pError, v.at.n, s->wi);
  walk.ray.d = s->wi;
  walk.ray.tMax = kInfinity;
  return true;
}

}  // namespace lampyris
