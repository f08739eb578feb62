// SPDX-License-Identifier: Apache-2.0
/// Samples that were thrown away or cut down because numbers or loops came to an end: counted where
/// that happens. In a sound render all counts are 0, but for what the scene file asks for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/statistics.h"

namespace lampyris {

enum class Rejection : uint8_t {
  ScatteringDensity,  ///< a scattered direction: light, but a density of 0 or not finite
  LightDensity,       ///< a point of a light: light, but a density of 0 or not finite
  LightRadiance,      ///< light arrives that is not finite: the point lies on the light
  PathWeight,         ///< a path's throughput, or the light over an edge, is not finite
  MisWeight,          ///< the weight among techniques is not finite
  Interfaces,         ///< a ray passed more surfaces without a material than it may
  ProbeHits,          ///< a probe below a surface met more surfaces than it may
  LearningSample,     ///< a guide is not taught what is not finite
  Splat,              ///< a path from a light brought the camera what is no radiance
  DarkenedSplat,      ///< a value of the light image was beyond its fixed point
  DarkenedSample,     ///< brighter than the film's "maxsampleluminance"
};
inline constexpr size_t kRejectionCount = static_cast<size_t>(Rejection::DarkenedSample) + 1;

/// Of the statistics.
inline constexpr const char* kRejectionSection = "rejected samples";
using RejectionCounts = std::array<uint64_t, kRejectionCount>;

/// Adds one to the process's count. Thread-safe.
void countRejection(Rejection what);
/// Since the process began. Thread-safe.
RejectionCounts rejectionCounts();
/// The name under which the statistics have it.
const char* nameOf(Rejection what);
/// Sets all figures of the section: what was counted since `before`.
void reportRejections(Statistics& statistics, const RejectionCounts& before);

}  // namespace lampyris
