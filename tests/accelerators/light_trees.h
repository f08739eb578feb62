// SPDX-License-Identifier: Apache-2.0
/// Lights and receivers for tests of the light BVH, and a fixture that runs them on both its forms.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "accelerators/wide_light_bvh.h"
#include "core/sampling.h"
#include "support/statistics.h"

namespace lampyris::test {

using Lights = std::vector<LightBVHInput>;

/// What both forms of the tree promise.
template <class Tree>
class LightTree : public testing::Test {
 protected:
  static Tree build(const Lights& lights) { return Tree(LightBVHAccel(lights)); }
};
using LightTreeForms = testing::Types<LightBVHAccel, WideLightBVH>;

inline float random(uint64_t i, uint32_t d) { return uniform(11, i, d); }
inline Vec3 randomPoint(uint64_t i, uint32_t d = 0) {
  return {random(i, d), random(i, d + 1), random(i, d + 2)};
}
inline Vec3 randomDirection(uint64_t i, uint32_t d = 10) {
  return sampleUniformSphere({random(i, d), random(i, d + 1)});
}

enum class Kind { Points, Line, Coincident, Cones, TwoSided, FewCones };
/// Random lights in a cube of edge `scale`, with ids in order.
Lights makeLights(Kind kind, size_t count, float scale = 1);
/// Point lights of equal intensity.
Lights pointLights(const std::vector<Vec3>& positions, float intensity = 1);
/// Flat one-sided emitters without extent.
LightBVHInput flatLight(LightId id, const Vec3& p, const Vec3& axis, float cosThetaE = 0);

/// Random points in and around the cube of edge `scale`, on lights, opaque and transmissive.
LightSampleContext makeContext(uint64_t i, const Lights& lights, float scale);
/// A point of an opaque surface, seen from the side of its normal.
LightSampleContext opaqueAt(const Vec3& p, const Vec3& n);
/// A point without a surface.
LightSampleContext volumeAt(const Vec3& p);

/// Whether light can go from `w` on, and be scattered.
bool permitted(const LightSampleContext& c, const Vec3& w);
/// Whether light with these bounds, from `source` in its box, can go towards `p`.
bool emitsTo(const LightBounds& b, const Vec3& source, const Vec3& p);

template <class Tree>
std::vector<double> pmfs(const Tree& tree, const LightSampleContext& c, size_t lights) {
  std::vector<double> all(lights);
  for (size_t l = 0; l < lights; ++l)
    all[l] = static_cast<double>(tree.pmf(LightReceiver(c), static_cast<LightId>(l)));
  return all;
}
inline double sumOf(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.);
}

}  // namespace lampyris::test
