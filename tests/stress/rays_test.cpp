// SPDX-License-Identifier: Apache-2.0
/// Where rays start: outside of the surface that they leave, and no farther from it than floats are
/// apart there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/sampling.h"
#include "stress/stress.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

TEST(Rays, LeaveTrianglesOfAnyShape) {
  for (uint64_t k = 0; k < 400; ++k) {
    const auto random = [k](uint32_t i) { return static_cast<double>(uniform(9, k, i)); };
    const Place place{std::exp2(std::floor(40 * random(0)) - 20),
                      k % 2 ? DVec3(1e5, -7e4, 4e4) : DVec3(0)};
    SCOPED_TRACE(testing::PrintToString(place));
    // Edges from 1e-3 to 1, so that some are needles.
    const auto edge = [&](uint32_t i) {
      return std::pow(1e-3, random(i)) *
             DVec3(sampleUniformSphere({uniform(9, k, i + 1), uniform(9, k, i + 2)}));
    };
    const DVec3 a(random(1) - 0.5, random(2) - 0.5, random(3) - 0.5);
    DScene s;
    s.triangles.push_back({a, a + edge(4), a + edge(7)});
    TinyScene scene(s.placed(place).text({}, place));
    const Scene& built = scene.job().scene;
    const Shape& triangle = *built.shapes.back();
    for (uint64_t i = 0; i < 40; ++i) {
      const auto p = triangle.sampleArea(0, {uniform(k, i, 0), uniform(k, i, 1)});
      if (!p) continue;  // no area is left by rounding
      const Vec3 w = sampleUniformSphere({uniform(k, i, 2), uniform(k, i, 3)});
      if (absDot(w, p->n) < 1e-3f) continue;
      const Vec3 o = offsetRayOrigin(p->p, p->pError, p->n, w);
      const auto again = built.geometry->intersect({o, w});
      EXPECT_FALSE(again && built.geometry->primitive(*again).shape == &triangle);
      // Steps of floats there, and of the triangle's own size.
      const double size = static_cast<double>(triangle.bounds(0).diagonal());
      EXPECT_LE(static_cast<double>(distance(o, p->p)),
                4 * glm::length(place.rounding(DVec3(0))) + 1e-5 * size);
    }
  }
}

}  // namespace
}  // namespace lampyris::test
