// SPDX-License-Identifier: Apache-2.0
/// From surface points to texture coordinates, as pbrt-v3 maps them.
#pragma once

#include <string>

#include "base/texture.h"

namespace lampyris {

/// The parameters of all textures over two coordinates.
struct MappingParameters {
  std::string mapping = "uv";
  float uscale = 1, vscale = 1, udelta = 0, vdelta = 0;
  Vec3 v1{1, 0, 0}, v2{0, 1, 0};

  void declare(Declaration& d);
};

/// A point of a texture and its change over one pixel.
struct TextureCoordinates {
  Vec2 st{0}, dstdx{0}, dstdy{0};

  bool hasFootprint() const { return dstdx.x != 0 || dstdx.y != 0 || dstdy.x != 0 || dstdy.y != 0; }
};

/// Deviation from pbrt-v3: at the seams of "spherical" and "cylindrical" the differentials are
/// those of the shorter way around. (pbrt-v3 corrects the jump after it divided by the step, which
/// leaves a footprint of several turns, and for cylinders corrects the coordinate that has no
/// jump.)
class TextureMapping2D {
 public:
  TextureMapping2D(const MappingParameters& parameters, const Transform& textureToWorld);

  TextureCoordinates map(const SurfaceInteraction& at) const {
    if (kind_ != Kind::Uv) return mapPosition(at);
    return {scale_ * at.uv + delta_, scale_ * at.duvdx, scale_ * at.duvdy};
  }

 private:
  enum class Kind : uint8_t { Uv, Spherical, Cylindrical, Planar };

  TextureCoordinates mapPosition(const SurfaceInteraction& at) const;
  Vec2 project(const Vec3& p) const;

  Kind kind_ = Kind::Uv;
  Vec2 scale_, delta_;
  Vec3 v1_, v2_;
  Transform worldToTexture_;
};

/// A point of space and its change over one pixel.
struct TexturePoint {
  Vec3 p{0}, dpdx{0}, dpdy{0};

  TexturePoint operator*(float scale) const { return {p * scale, dpdx * scale, dpdy * scale}; }
};

/// The point at which a texture over space is looked up. As in pbrt-v3 the world position goes
/// through the texture's transform itself, not its inverse: scenes are made for that.
class TextureMapping3D {
 public:
  explicit TextureMapping3D(const Transform& textureToWorld) : transform_(textureToWorld) {}
  TexturePoint map(const SurfaceInteraction& at) const {
    return {transform_.point(at.p), transform_.vector(at.dpdx), transform_.vector(at.dpdy)};
  }

 private:
  Transform transform_;
};

}  // namespace lampyris
