// SPDX-License-Identifier: Apache-2.0
/// Where rays of lights at infinity start: a disk that covers the scene.
#pragma once

#include "base/light.h"
#include "core/frame.h"
#include "core/sampling.h"

namespace lampyris {

class DistantDisk {
 public:
  /// Of the sphere about the scene's box.
  void cover(const Bounds3& scene) {
    const float radius = 0.5f * scene.diagonal();
    if (!(radius > 0) || !std::isfinite(radius)) return;
    radius_ = radius;
    center_ = scene.centroid();
  }
  float radius() const { return radius_; }
  float pdfPosition() const { return 1 / (kPi * sqr(radius_)); }
  /// A ray along `w` from a point of the disk across it, before the scene.
  EmissionSample start(const Vec2& u, const Vec3& w) const {
    EmissionSample s;
    const Frame frame = Frame::fromZ(w);
    const Vec2 d = radius_ * sampleConcentricDisk(u);
    s.p = center_ - radius_ * w + d.x * frame.x + d.y * frame.y;
    s.w = w;
    s.pdfPosition = pdfPosition();
    return s;
  }

 private:
  float radius_ = 1;
  Vec3 center_{0};
};

}  // namespace lampyris
