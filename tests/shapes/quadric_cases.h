// SPDX-License-Identifier: Apache-2.0
/// All quadrics, whole and cut, under all kinds of maps.
#pragma once

#include <functional>

#include "shapes/shape_helpers.h"

namespace lampyris::test {

struct QuadricCase {
  std::string name, shape;
  Parameters parameters;
  Transform toWorld;
  bool reverse = false;

  std::unique_ptr<Shape> make() const { return makeShape(shape, parameters, toWorld, reverse); }
  /// 0 where a point of object space lies on the surface, else its distance from it, about.
  std::function<double(glm::dvec3)> distance;
  /// Outward there, of any length.
  std::function<glm::dvec3(glm::dvec3)> outward;
};

/// One kind of quadric in object space.
struct QuadricKind {
  std::string name, shape;
  std::function<void(Parameters&)> fill;
  std::function<double(glm::dvec3)> distance;
  std::function<glm::dvec3(glm::dvec3)> outward;
};

/// The surface radius² = c0 + c1 z + c2 z².
inline QuadricKind revolvedKind(const std::string& name, const std::string& shape, double c0,
                                double c1, double c2, std::function<void(Parameters&)> fill) {
  const auto gradient = [=](glm::dvec3 p) { return glm::dvec3(p.x, p.y, -c1 / 2 - c2 * p.z); };
  return {name, shape, std::move(fill),
          [=](glm::dvec3 p) {
            const double value = p.x * p.x + p.y * p.y - c0 - p.z * (c1 + c2 * p.z);
            return std::abs(value) / (2 * glm::length(gradient(p)) + 1e-6);
          },
          gradient};
}

inline std::vector<QuadricKind> revolvedKinds() {
  // A line through (1, 0, 0), the nearest to the axis, and pbrt-v3's own idea of another one.
  const double b = (1.48 - 0.45) / (9 - 2.25);
  return {
      revolvedKind("cone", "cone", 4, -8. / 3, 4. / 9,
                   [](Parameters& p) { p.floats("radius", {2}).floats("height", {3}); }),
      revolvedKind("cut cone", "cone", 0.25, -0.125, 0.015625,
                   [](Parameters& p) {
                     p.floats("radius", {0.5f}).floats("height", {4}).floats("phimax", {200});
                   }),
      revolvedKind("paraboloid", "paraboloid", 0, 2, 0,
                   [](Parameters& p) { p.floats("radius", {2}).floats("zmax", {2}); }),
      revolvedKind("cut paraboloid", "paraboloid", 0, -0.5, 0,
                   [](Parameters& p) {
                     p.floats("zmin", {-2})
                         .floats("zmax", {-0.5f})
                         .floats("radius", {0.5f})
                         .floats("phimax", {300});
                   }),
      revolvedKind("hyperboloid", "hyperboloid", 1, 0, 1,
                   [](Parameters& p) {
                     p.points("p1", {{1, -0.75f, -0.75f}}).points("p2", {{1, 1.25f, 1.25f}});
                   }),
      revolvedKind("cut hyperboloid", "hyperboloid", 0.45 - 2.25 * b, 0, b, [](Parameters& p) {
        p.points("p1", {{0.8f, 0, 0}}).points("p2", {{0.3f, 0.6f, 1.5f}}).floats("phimax", {330});
      })};
}

inline std::vector<QuadricCase> quadricCases() {
  const auto ball = [](double r) {
    return [r](glm::dvec3 p) { return std::abs(glm::length(p) - r); };
  };
  const auto fromCentre = [](glm::dvec3 p) { return p; };
  const auto fromAxis = [](glm::dvec3 p) { return glm::dvec3(p.x, p.y, 0); };
  const auto up = [](glm::dvec3) { return glm::dvec3(0, 0, 1); };
  std::vector<QuadricKind> kinds = {
      {"sphere", "sphere", [](Parameters& p) { p.floats("radius", {1.5f}); }, ball(1.5),
       fromCentre},
      {"cut sphere", "sphere",
       [](Parameters& p) {
         p.floats("radius", {1.5f})
             .floats("zmin", {-0.6f})
             .floats("zmax", {1.1f})
             .floats("phimax", {230});
       },
       ball(1.5), fromCentre},
      {"disk", "disk", [](Parameters& p) { p.floats("height", {0.4f}).floats("radius", {2}); },
       [](glm::dvec3 p) { return std::abs(p.z - static_cast<double>(0.4f)); }, up},
      {"ring", "disk",
       [](Parameters& p) {
         p.floats("radius", {2}).floats("innerradius", {0.7f}).floats("phimax", {120});
       },
       [](glm::dvec3 p) { return std::abs(p.z); }, up},
      {"cylinder", "cylinder", [](Parameters& p) { p.floats("radius", {0.8f}); },
       [](glm::dvec3 p) { return std::abs(std::hypot(p.x, p.y) - static_cast<double>(0.8f)); },
       fromAxis},
      {"cut cylinder", "cylinder",
       [](Parameters& p) {
         p.floats("radius", {0.8f})
             .floats("zmin", {0.2f})
             .floats("zmax", {3})
             .floats("phimax", {290});
       },
       [](glm::dvec3 p) { return std::abs(std::hypot(p.x, p.y) - static_cast<double>(0.8f)); },
       fromAxis}};
  for (QuadricKind& kind : revolvedKinds()) kinds.push_back(std::move(kind));
  const Transform turn = Transform::rotate(37, {1, 2, -0.5f});
  const std::vector<std::pair<std::string, Transform>> maps = {
      {"identity", {}},
      {"moved", Transform::translate({3, -2, 5}) * turn * Transform::scale(Vec3(0.5f))},
      {"mirrored", Transform::translate({1, 2, 3}) * turn * Transform::scale({-1, 1, 1})},
      {"stretched", turn * Transform::scale({1, 2.5f, 0.4f})},
      {"stretched mirror",
       Transform::translate({0, 4, 0}) * Transform::scale({1, -2, 0.5f}) * turn}};
  std::vector<QuadricCase> cases;
  for (const QuadricKind& k : kinds) {
    const bool few = k.shape == "cone" || k.shape == "paraboloid" || k.shape == "hyperboloid";
    for (const auto& [mapName, map] : maps) {
      // They share the maps' code with the other kinds.
      if (few && (mapName == "identity" || mapName == "mirrored")) continue;
      for (const bool reverse : {false, true}) {
        QuadricCase c{k.name + ", " + mapName + (reverse ? ", reversed" : ""),
                      k.shape,
                      {},
                      map,
                      reverse,
                      k.distance,
                      k.outward};
        k.fill(c.parameters);
        cases.push_back(std::move(c));
      }
    }
  }
  return cases;
}

}  // namespace lampyris::test
