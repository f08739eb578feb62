// SPDX-License-Identifier: Apache-2.0
/// Means of a picture over triangles of the (u, v) plane: what the triangles of a textured emitter
/// send.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "lights/emission_image.h"

namespace lampyris {

/// A pyramid of grids (sides powers of two, two to four cells a texel but 4096 at most) that hold
/// the luminance's exact averages over their cells, bilinear interpolation and all. A triangle is
/// looked up where its box holds a thousand cells at most, so a look-up takes some microseconds
/// however large triangle and picture are. Triangles of a few texels get points of the picture as
/// well, for which cells are too coarse.
class PictureMeans {
 public:
  /// Of `picture` times `scale`.
  PictureMeans(std::shared_ptr<const EmissionImage> picture, const Rgb& scale);

  /// Mean luminance over the triangle with these surface coordinates, which may lie anywhere and
  /// have no area; its outline is blurred to the width of a cell. 0 only if the picture
  /// is black all over it.
  float over(const std::array<Vec2, 3>& uv) const;

 private:
  struct Level {
    int width = 1, height = 1;
    std::vector<float> cells;  ///< row by row from the image's top

    /// The corners in units of the picture; the outline is uncertain by `slack`.
    double over(std::array<glm::dvec2, 3> corners, glm::dvec2 slack) const;
  };
  Level finest() const;
  static Level halved(const Level& below);
  float luminanceAt(const Rgb& texel) const;
  double overPoints(const std::array<glm::dvec2, 3>& corners, double texels) const;

  std::shared_ptr<const EmissionImage> picture_;
  Rgb scale_;
  std::vector<Level> levels_;
};

}  // namespace lampyris
