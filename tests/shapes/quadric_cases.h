// SPDX-License-Identifier: Apache-2.0
/// Spheres, disks and cylinders, whole and cut, under all kinds of maps.
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
};

inline std::vector<QuadricCase> quadricCases() {
  struct Kind {
    std::string name, shape;
    std::function<void(Parameters&)> fill;
    std::function<double(glm::dvec3)> distance;
  };
  const auto ball = [](double r) {
    return [r](glm::dvec3 p) { return std::abs(glm::length(p) - r); };
  };
  const std::vector<Kind> kinds = {
      {"sphere", "sphere", [](Parameters& p) { p.floats("radius", {1.5f}); }, ball(1.5)},
      {"cut sphere", "sphere",
       [](Parameters& p) {
         p.floats("radius", {1.5f})
             .floats("zmin", {-0.6f})
             .floats("zmax", {1.1f})
             .floats("phimax", {230});
       },
       ball(1.5)},
      {"disk", "disk", [](Parameters& p) { p.floats("height", {0.4f}).floats("radius", {2}); },
       [](glm::dvec3 p) { return std::abs(p.z - static_cast<double>(0.4f)); }},
      {"ring", "disk",
       [](Parameters& p) {
         p.floats("radius", {2}).floats("innerradius", {0.7f}).floats("phimax", {120});
       },
       [](glm::dvec3 p) { return std::abs(p.z); }},
      {"cylinder", "cylinder", [](Parameters& p) { p.floats("radius", {0.8f}); },
       [](glm::dvec3 p) { return std::abs(std::hypot(p.x, p.y) - static_cast<double>(0.8f)); }},
      {"cut cylinder", "cylinder",
       [](Parameters& p) {
         p.floats("radius", {0.8f})
             .floats("zmin", {0.2f})
             .floats("zmax", {3})
             .floats("phimax", {290});
       },
       [](glm::dvec3 p) { return std::abs(std::hypot(p.x, p.y) - static_cast<double>(0.8f)); }}};
  const Transform turn = Transform::rotate(37, {1, 2, -0.5f});
  const std::vector<std::pair<std::string, Transform>> maps = {
      {"identity", {}},
      {"moved", Transform::translate({3, -2, 5}) * turn * Transform::scale(Vec3(0.5f))},
      {"mirrored", Transform::translate({1, 2, 3}) * turn * Transform::scale({-1, 1, 1})},
      {"stretched", turn * Transform::scale({1, 2.5f, 0.4f})},
      {"stretched mirror",
       Transform::translate({0, 4, 0}) * Transform::scale({1, -2, 0.5f}) * turn}};
  std::vector<QuadricCase> cases;
  for (const Kind& k : kinds) {
    for (const auto& [mapName, map] : maps) {
      for (const bool reverse : {false, true}) {
        QuadricCase c{k.name + ", " + mapName + (reverse ? ", reversed" : ""),
                      k.shape,
                      {},
                      map,
                      reverse,
                      k.distance};
        k.fill(c.parameters);
        cases.push_back(std::move(c));
      }
    }
  }
  return cases;
}

}  // namespace lampyris::test
