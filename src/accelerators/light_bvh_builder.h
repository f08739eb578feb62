// SPDX-License-Identifier: Apache-2.0
/// Builds the light BVH top down, in place, with the surface area orientation heuristic: Ma 2018,
/// §3.2 and 3.3, eq. 3.1–3.5.
///
/// Deviations. Buckets of equal width (the thesis: of equal count), and the penalty on thin splits
/// of Conty and Kulla 2018. The area gets the squared diagonal added, so that lights on a line or a
/// plane are split as others are. The cone measure of a candidate takes the cone from the length of
/// the mean axis (eq. 3.6) instead of from bounds: sums are enough, no cones are merged per bucket.
/// The cones that nodes get are bounds, merged from the leaves up. Beyond 64 levels, and where all
/// lights coincide, ranges are halved, so the tree is never deeper than 96.
#pragma once

#include <span>
#include <vector>

#include "accelerators/light_bvh_node.h"
#include "core/huge_pages.h"

namespace lampyris {

struct LightBVHInput;

/// Fills `nodes` depth first and sets leafOf[id] of each light that is in the tree. Returns the
/// number of levels.
uint32_t buildLightBVH(std::span<const LightBVHInput> lights, HugeVector<LinearLightBVHNode>& nodes,
                       std::vector<uint32_t>& leafOf);

}  // namespace lampyris
