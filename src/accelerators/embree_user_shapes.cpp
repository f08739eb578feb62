// SPDX-License-Identifier: Apache-2.0
#include "accelerators/embree_user_shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/bitfield.hpp>

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

size_t countBalls(const std::vector<Primitive>& primitives) {
  size_t count = 0;
  for (const Primitive& p : primitives)
    if (p.shape->triangles().triangleCount == 0 && p.shape->elementCount() > 0 &&
        std::isfinite(p.shape->ball(0).radius))
      count += p.shape->elementCount();
  return count;
}

UserShapes::UserShapes(const std::vector<Primitive>& primitives) : primitives_(primitives) {
  std::vector<Vec3> centres;
  for (uint32_t i = 0; i < primitives.size(); ++i) {
    const Shape& shape = *primitives[i].shape;
    if (shape.triangles().triangleCount > 0) continue;
    for (uint32_t element = 0; element < shape.elementCount(); ++element) {
      const Bounds3 b = shape.bounds(element);
      if (b.empty()) continue;
      centres.push_back(b.centroid());
      elements_.push_back({i, element});
    }
  }
  sortInSpace(centres);
  findBalls();
}

void UserShapes::sortInSpace(const std::vector<Vec3>& centres) {
  Bounds3 all;
  for (const Vec3& p : centres) all.extend(p);
  constexpr float kCells = 1 << 20;  // an axis; three times that many bits fit into a code
  const float size = maxComponent(all.extent());
  const float scale = size > 0 ? kCells / size : 0;

  std::vector<std::pair<uint64_t, Element>> order(centres.size());
  for (size_t i = 0; i < centres.size(); ++i) {
    // Scaled first: a difference may be infinite.
    const Vec3 at = centres[i] * scale - all.min * scale;
    const glm::uvec3 cell(glm::clamp(at, 0.f, kCells));
    order[i] = {glm::bitfieldInterleave(cell.x, cell.y, cell.z), elements_[i]};
  }
  std::sort(order.begin(), order.end());
  for (size_t i = 0; i < order.size(); ++i) elements_[i] = order[i].second;
}

void UserShapes::findBalls() {
  balls_.reserve(elements_.size());
  bool any = false;
  for (const Element& e : elements_) {
    balls_.push_back(primitive(e).shape->ball(e.element));
    any = any || std::isfinite(balls_.back().radius);
  }
  if (!any) balls_ = {};
}

bool UserShapes::passesBy(const RTCRay& ray, uint32_t index) const {
  return !balls_.empty() && misses(ray, balls_[index]);
}

}  // namespace lampyris::embree
