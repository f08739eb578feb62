// SPDX-License-Identifier: Apache-2.0
/// Shapes for tests, made through the registry as a scene file makes them.
#pragma once

#include <deque>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "base/shape.h"
#include "core/frame.h"
#include "shapes/registry.h"
#include "support/statistics.h"

namespace lampyris::test {

/// A parameter list with its storage, which copies share.
class Parameters {
 public:
  Parameters& floats(const std::string& name, std::vector<float> v,
                     ParameterType type = ParameterType::Float) {
    Parameter& p = push(name, type);
    p.floats = storage_->floats.emplace_back(std::move(v));
    return *this;
  }
  Parameters& points(const std::string& name, const std::vector<Vec3>& v,
                     ParameterType type = ParameterType::Point3) {
    std::vector<float> f;
    for (const Vec3& p : v) f.insert(f.end(), {p.x, p.y, p.z});
    return floats(name, std::move(f), type);
  }
  Parameters& integers(const std::string& name, std::vector<int32_t> v) {
    Parameter& p = push(name, ParameterType::Integer);
    p.integers = storage_->integers.emplace_back(std::move(v));
    return *this;
  }
  Parameters& text(const std::string& name, const std::string& v) {
    Parameter& p = push(name, ParameterType::String);
    p.strings = storage_->views.emplace_back(1, storage_->names.emplace_back(v));
    return *this;
  }
  ParameterSet set() const { return {list_, {}}; }

 private:
  struct Storage {
    std::deque<std::string> names;
    std::deque<std::vector<float>> floats;
    std::deque<std::vector<int32_t>> integers;
    std::deque<std::vector<std::string_view>> views;
  };
  Parameter& push(const std::string& name, ParameterType type) {
    Parameter& p = list_.emplace_back();
    p.name = storage_->names.emplace_back(name);
    p.type = type;
    return p;
  }
  std::vector<Parameter> list_;
  std::shared_ptr<Storage> storage_ = std::make_shared<Storage>();
};

class NoTextures final : public TextureResolver {
 public:
  TexturedFloat resolve(const FloatInput& input) const override { return {input.value, nullptr}; }
  TexturedRgb resolve(const RgbInput& input) const override { return {input.value, nullptr}; }
};

struct Build {
  SourceFiles files;
  std::vector<std::string> warnings;
  Diagnostics diagnostics{files, [this](const std::string& w) { warnings.push_back(w); }};
  NoTextures textures;

  ShapeContext context(const Transform& toWorld = {}, bool reverse = false) {
    return {{diagnostics, [](const std::string& f) { return f; }, SourceLocation{}},
            textures,
            toWorld,
            reverse};
  }
  std::unique_ptr<Shape> make(const std::string& name, const Parameters& parameters,
                              const Transform& toWorld = {}, bool reverse = false) {
    return shapeRegistry().get(name, {}).create(parameters.set(), context(toWorld, reverse));
  }
};

inline std::unique_ptr<Shape> makeShape(const std::string& name, const Parameters& parameters,
                                        const Transform& toWorld = {}, bool reverse = false) {
  Build build;
  return build.make(name, parameters, toWorld, reverse);
}

/// The nearest hit over all elements, by brute force.
struct AnyHit {
  uint32_t element = 0;
  ShapeHit hit;
};
inline std::optional<AnyHit> bruteForce(const Shape& shape, Ray ray) {
  std::optional<AnyHit> nearest;
  for (uint32_t e = 0; e < shape.elementCount(); ++e) {
    if (const auto hit = shape.intersect(e, ray)) {
      nearest = AnyHit{e, *hit};
      ray.tMax = hit->t;
    }
  }
  return nearest;
}

inline Vec3 randomPoint(const Bounds3& box, uint64_t seed, uint64_t i, uint32_t dimension) {
  const Vec3 u(uniform(seed, i, dimension), uniform(seed, i, dimension + 1),
               uniform(seed, i, dimension + 2));
  return box.min + u * (box.max - box.min);
}
inline Vec3 randomDirection(uint64_t seed, uint64_t i, uint32_t dimension) {
  const float z = 1 - 2 * uniform(seed, i, dimension);
  return sphericalDirection(std::sqrt(std::max(0.f, 1 - z * z)), z,
                            2 * kPi * uniform(seed, i, dimension + 1));
}
inline Bounds3 totalBounds(const Shape& shape) {
  Bounds3 b;
  for (uint32_t e = 0; e < shape.elementCount(); ++e) b.extend(shape.bounds(e));
  return b;
}

}  // namespace lampyris::test
