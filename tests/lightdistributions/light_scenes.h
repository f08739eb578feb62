// SPDX-License-Identifier: Apache-2.0
/// Sets of lights, and points that want light, for tests of light distributions.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/light_distribution.h"
#include "core/image.h"
#include "core/statistics.h"
#include "support/quad_shape.h"
#include "support/resolvers.h"

namespace lampyris::test {

/// Many point lights, or spots without falloff, as one light object.
class CloudLight final : public Light {
 public:
  struct Point {
    Vec3 p{0};
    float intensity = 1;
    Vec3 axis{0, 0, 1};
    float cosCone = -1;  ///< −1: all directions
  };
  explicit CloudLight(std::vector<Point> points) : points_(std::move(points)) {}

  uint32_t elementCount() const override { return static_cast<uint32_t>(points_.size()); }
  bool isDelta() const override { return true; }
  std::optional<LightSample> sample(uint32_t i, const Vec3& from, const Vec2&) const override;
  Rgb power(uint32_t i) const override {
    return Rgb(2 * kPi * (1 - points_[i].cosCone) * points_[i].intensity);
  }
  std::optional<LightBounds> bounds(uint32_t i) const override;

 private:
  std::vector<Point> points_;
};

struct LightScene {
  std::string name;
  float scale = 1;  ///< edge of the cube that the lights are in
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<std::unique_ptr<Light>> lights;
  LightTable table;
  Bounds3 bounds;

  void add(std::unique_ptr<Light> light) {
    light->prepare(bounds);
    table.add(light.get());
    lights.push_back(std::move(light));
  }
};

/// Lights of every kind, few enough that all of them can be summed up at each point.
std::vector<std::unique_ptr<LightScene>> smallLightScenes(float scale = 1);
/// `count` lights at one point.
std::unique_ptr<LightScene> coincidentLights(size_t count);
/// Random lights in the unit cube.
std::unique_ptr<LightScene> manyLights(size_t count);

/// Points within and around the scene, on its lights, facing all ways, opaque and transmissive.
std::vector<LightSampleContext> contextsFor(const LightScene& scene, int count);

/// Luminance that element `light` sends to the point, times the cosine, unoccluded; 0 on sides that
/// don't count. `u` chooses the point of the light.
double contribution(const LightScene& scene, const LightSampleContext& ctx, LightId light,
                    const Vec2& u);

/// A distribution by its registered name, with defaults.
struct DistributionMaker {
  TestBuild build;
  Statistics statistics;
  std::unique_ptr<LightDistribution> make(const std::string& name, const LightScene& scene,
                                          const TestParameters::List& list = {});
};

}  // namespace lampyris::test
