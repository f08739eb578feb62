// SPDX-License-Identifier: Apache-2.0
// Written with the vectors of the C++ Parallelism TS v2 (ISO/IEC TS 19570:2018, §9).
#include "accelerators/embree_ball_group.h"

#include <cmath>
#include <experimental/simd>

namespace lampyris::embree {

namespace {

namespace stdx = std::experimental;
using Floats = stdx::simd<float, stdx::simd_abi::deduce_t<float, BallGroup::kSize>>;

Floats load(const std::array<float, BallGroup::kSize>& from) {
  return Floats(from.data(), stdx::vector_aligned);
}

uint32_t bitsOf(const Floats::mask_type& set) {
  if (none_of(set)) return 0;
  Floats bits([](auto i) { return static_cast<float>(1 << i); });
  where(!set, bits) = 0;
  return static_cast<uint32_t>(reduce(bits));
}

}  // namespace

uint32_t BallGroup::all() const { return bitsOf(load(radius_) >= 0); }

uint32_t BallGroup::met(const RTCRay& ray) const {
  const Vec3 d(ray.dir_x, ray.dir_y, ray.dir_z);
  const float d2 = dot(d, d);
  constexpr float kLeast = 1e-20f;  // products of smaller ones may underflow
  if (!(d2 > kLeast)) return all();
  const Floats radius = load(radius_);
  const Floats x = load(x_) - ray.org_x, y = load(y_) - ray.org_y, z = load(z_) - ray.org_z;
  const Floats along = (x * d.x + y * d.y + z * d.z) * (1 / d2);
  const Floats nearest = stdx::min(stdx::max(along, Floats(0)), Floats(ray.tfar));
  const Floats offX = nearest * d.x - x, offY = nearest * d.y - y, offZ = nearest * d.z - z;
  const Floats off2 = offX * offX + offY * offY + offZ * offZ;
  const float dLength = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  const Floats error = 16 * kMachineEpsilon * (abs(x) + abs(y) + abs(z) + nearest * dLength);
  const Floats reach = radius + error;
  // Not "≤": what is not a number is met.
  return bitsOf(radius >= 0 && !(off2 > reach * reach));
}

}  // namespace lampyris::embree
