// SPDX-License-Identifier: Apache-2.0
#include "cameras/lens_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace lampyris {

namespace {

/// Snell's law; `n` faces against `d`, both unit. False on total reflection.
bool refract(const DVec3& n, double etaRatio, DVec3& d) {
  const double cosine = -glm::dot(n, d);
  const double sine2 = etaRatio * etaRatio * std::max(0., 1 - cosine * cosine);
  if (sine2 >= 1) return false;
  d = etaRatio * d + (etaRatio * cosine - std::sqrt(1 - sine2)) * n;
  return true;
}

/// Where a thick lens bends a ray that came parallel to the axis, and where it focuses it: on the
/// axis of `in`, as z.
struct CardinalPoints {
  double principal, focal;
  CardinalPoints(const LensRay& in, const LensRay& out)
      : principal(out.at((in.o.x - out.o.x) / out.d.x).z), focal(out.at(-out.o.x / out.d.x).z) {}
};

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error(why); }

}  // namespace

LensSystem::LensSystem(std::vector<LensElement> elements) : elements_(std::move(elements)) {
  if (elements_.empty()) fail("the lens has no elements");
  for (size_t i = 0; i < elements_.size(); ++i) {
    const LensElement& e = elements_[i];
    const auto wrong = [&](const char* why) { fail(fmt::format("element {}: {}", i + 1, why)); };
    if (!std::isfinite(e.curvatureRadius) || !std::isfinite(e.thickness))
      wrong("its radius and thickness must be finite");
    if (!(e.thickness >= 0)) wrong("its thickness is negative");
    if (e.eta != 0 && !(e.eta >= 0.1 && e.eta <= 10))
      wrong("its index of refraction must be 0 (air) or between 0.1 and 10");
    if (!(e.apertureRadius > 0) || !std::isfinite(e.apertureRadius))
      wrong("its aperture diameter must be > 0");
  }
  place();
}

void LensSystem::place() {
  z_.resize(elements_.size());
  double z = 0;
  for (size_t i = elements_.size(); i-- > 0;) z_[i] = z += elements_[i].thickness;
}

double LensSystem::behind(size_t i) const {
  const double eta = elements_[i].eta;
  return eta == 0 ? 1 : eta;
}

bool LensSystem::cross(size_t i, double from, double to, LensRay& ray) const {
  const LensElement& e = elements_[i];
  if (e.isStop()) {
    ray.o = ray.at((z_[i] - ray.o.z) / ray.d.z);
    return ray.o.x * ray.o.x + ray.o.y * ray.o.y <= e.apertureRadius * e.apertureRadius;
  }
  const DVec3 centre(0, 0, z_[i] - e.curvatureRadius), o = ray.o - centre;
  const double halfB = glm::dot(o, ray.d);
  const double c = glm::dot(o, o) - e.curvatureRadius * e.curvatureRadius;
  const double discriminant = halfB * halfB - c;
  if (!(discriminant >= 0)) return false;
  // Of the sphere's two halves the one at the interface: the near one where it bulges towards the
  // ray.
  const bool bulgesTowardsRay = (ray.d.z < 0) == (e.curvatureRadius > 0);
  const double root = std::sqrt(discriminant);
  const double t = bulgesTowardsRay ? -halfB - root : -halfB + root;
  if (!(t >= 0)) return false;
  ray.o = ray.at(t);
  if (ray.o.x * ray.o.x + ray.o.y * ray.o.y > e.apertureRadius * e.apertureRadius) return false;
  DVec3 n = (ray.o - centre) / std::abs(e.curvatureRadius);
  if (glm::dot(n, ray.d) > 0) n = -n;
  return refract(n, from / to, ray.d);
}

std::optional<LensRay> LensSystem::traceFromFilm(LensRay ray) const {
  ray.d = glm::normalize(ray.d);
  for (size_t i = elements_.size(); i-- > 0;)
    if (!(ray.d.z > 0) || !cross(i, behind(i), before(i), ray)) return std::nullopt;
  return ray;
}

std::optional<LensRay> LensSystem::traceFromScene(LensRay ray) const {
  ray.d = glm::normalize(ray.d);
  for (size_t i = 0; i < elements_.size(); ++i)
    if (!(ray.d.z < 0) || !cross(i, before(i), behind(i), ray)) return std::nullopt;
  return ray;
}

void LensSystem::focus(double distance, double offset) {
  // Rays parallel to the axis from either side. Lengths cancel from what counts, so that a step
  // off the lens may be any.
  const LensRay sceneIn{{offset, 0, frontZ() + offset}, {0, 0, -1}};
  const LensRay filmIn{{offset, 0, rearZ() - offset}, {0, 0, 1}};
  const auto filmOut = traceFromScene(sceneIn), sceneOut = traceFromFilm(filmIn);
  if (!filmOut || !sceneOut)
    fail("rays near its axis do not pass the lens; is the aperture too small?");
  if (filmOut->d.x == 0 || sceneOut->d.x == 0) fail("the lens does not bend rays");
  const CardinalPoints film(sceneIn, *filmOut), scene(filmIn, *sceneOut);
  // pbrt-v3's axis points to the film: its z are ours, negated.
  const double f = film.principal - film.focal;
  const double sceneSide = -scene.principal, filmSide = -film.principal;
  const double span = sceneSide + distance - filmSide, c = span * (span - 4 * f);
  if (!(c > 0))
    fail(
        fmt::format("the lens cannot focus at a distance of {}; a longer one is wanted", distance));
  elements_.back().thickness += 0.5 * (sceneSide + distance + filmSide - std::sqrt(c));
  if (!(elements_.back().thickness > 0))
    fail(fmt::format("to focus at a distance of {} the film would have to be inside of the lens",
                     distance));
  place();
}

}  // namespace lampyris
