// SPDX-License-Identifier: Apache-2.0
#include "accelerators/embree_user_shapes.h"

#include <algorithm>
#include <cmath>

namespace lampyris::embree {

namespace {

/// Whether all of the ray is outside of the ball, rounding of what is computed here included.
bool misses(const RTCRay& ray, const Ball& ball) {
  const Vec3 d(ray.dir_x, ray.dir_y, ray.dir_z);
  const Vec3 toCenter = ball.center - Vec3(ray.org_x, ray.org_y, ray.org_z);
  const float d2 = dot(d, d);
  constexpr float kLeast = 1e-20f;  // products of smaller ones may underflow
  if (!(d2 > kLeast)) return false;
  const float nearest = std::clamp(dot(toCenter, d) / d2, 0.f, ray.tfar);
  const Vec3 off = nearest * d - toCenter;
  const float error = 16 * kMachineEpsilon * (length(toCenter) + nearest * std::sqrt(d2));
  return dot(off, off) > sqr(ball.radius + error);
}

}  // namespace

UserShapes::UserShapes(const std::vector<Primitive>& primitives) : primitives_(primitives) {
  for (uint32_t i = 0; i < primitives.size(); ++i) {
    const Shape& shape = *primitives[i].shape;
    if (shape.triangles().triangleCount > 0) continue;
    for (uint32_t element = 0; element < shape.elementCount(); ++element)
      if (!shape.bounds(element).empty()) add(i, element);
  }
}

void UserShapes::add(uint32_t primitive, uint32_t element) {
  const Ball ball = primitives_[primitive].shape->ball(element);
  if (!balls_.empty() || std::isfinite(ball.radius)) {
    balls_.resize(elements_.size(), Ball{});
    balls_.push_back(ball);
  }
  elements_.push_back({primitive, element});
}

bool UserShapes::passesBy(const RTCRay& ray, uint32_t index) const {
  return !balls_.empty() && misses(ray, balls_[index]);
}

}  // namespace lampyris::embree
