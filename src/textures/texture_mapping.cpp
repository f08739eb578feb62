// SPDX-License-Identifier: Apache-2.0
#include "textures/texture_mapping.h"

#include <cmath>

#include "core/frame.h"

namespace lampyris {

void MappingParameters::declare(Declaration& d) {
  d.add("mapping", mapping, "How points are mapped to texture coordinates.")
      .oneOf({"uv", "spherical", "cylindrical", "planar"});
  d.add("uscale", uscale, "Factor on u (uv mapping).").any();
  d.add("vscale", vscale, "Factor on v (uv mapping).").any();
  d.add("udelta", udelta, "Added to the first coordinate (uv and planar mapping).").any();
  d.add("vdelta", vdelta, "Added to the second coordinate (uv and planar mapping).").any();
  d.add("v1", v1, "World-space vector of the first coordinate (planar mapping).")
      .type(ParameterType::Vector3)
      .any();
  d.add("v2", v2, "World-space vector of the second coordinate (planar mapping).")
      .type(ParameterType::Vector3)
      .any();
}

TextureMapping2D::TextureMapping2D(const MappingParameters& p, const Transform& textureToWorld)
    : scale_(p.uscale, p.vscale),
      delta_(p.udelta, p.vdelta),
      v1_(p.v1),
      v2_(p.v2),
      worldToTexture_(textureToWorld.inverse()) {
  if (p.mapping == "spherical") kind_ = Kind::Spherical;
  if (p.mapping == "cylindrical") kind_ = Kind::Cylindrical;
  if (p.mapping == "planar") kind_ = Kind::Planar;
}

Vec2 TextureMapping2D::project(const Vec3& p) const {
  const Vec3 w = normalize(worldToTexture_.point(p));
  if (kind_ == Kind::Spherical)
    return {sphericalTheta(w) * kInvPi, sphericalPhi(w) * 0.5f * kInvPi};
  return {0.5f + std::atan2(w.y, w.x) * 0.5f * kInvPi, w.z};
}

TextureCoordinates TextureMapping2D::mapPosition(const SurfaceInteraction& at) const {
  if (kind_ == Kind::Planar) {
    return {delta_ + Vec2(dot(at.p, v1_), dot(at.p, v2_)),
            {dot(at.dpdx, v1_), dot(at.dpdx, v2_)},
            {dot(at.dpdy, v1_), dot(at.dpdy, v2_)}};
  }
  // Forward differences with pbrt-v3's steps, in pixels.
  const float step = kind_ == Kind::Spherical ? 0.1f : 0.01f;
  const int periodic = kind_ == Kind::Spherical ? 1 : 0;
  const Vec2 st = project(at.p);
  const auto difference = [&](const Vec3& dp) {
    if (dp == Vec3(0)) return Vec2(0);
    Vec2 d = project(at.p + step * dp) - st;
    d[periodic] -= std::round(d[periodic]);
    return d / step;
  };
  return {st, difference(at.dpdx), difference(at.dpdy)};
}

}  // namespace lampyris
