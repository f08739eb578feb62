// SPDX-License-Identifier: Apache-2.0
/// A picture of a light tree.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "accelerators/light_bvh_report.h"

namespace lampyris {

struct LightTreePicture {
  std::string title;
  std::string caption;                   ///< a line below the title
  std::span<const LightTreeNode> nodes;  ///< the top levels, depth first, left children first
  std::vector<Vec3> lights;              ///< positions to mark; some of many will do
};

/// An SVG image: the boxes of the nodes seen along the scene's two shorter axes, and the levels of
/// the tree as rows of bars, as wide as they have lights and the stronger in colour the brighter
/// their lights are on average. Follows the viewer's light or dark colour scheme.
std::string lightTreeSvg(const LightTreePicture& picture);

}  // namespace lampyris
