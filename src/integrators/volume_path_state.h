// SPDX-License-Identifier: Apache-2.0
/// What VolumePathEstimator knows of a path while it grows.
#pragma once

#include "integrators/guided_memory.h"
#include "integrators/light_connection.h"
#include "integrators/sample_numbers.h"

namespace lampyris {

struct VolumePath {
  /// Numbers a vertex takes: light (1), point on it (2), direction (2), lobe (1), roulette (1),
  /// distance in the medium before it (2), and one left out so that pairs keep even dimensions.
  static constexpr uint32_t kDimensionsPerVertex = 10;
  static constexpr uint32_t kDirectionOffset = 3, kRouletteOffset = 6, kDistanceOffset = 7,
                            kSeedOffset = 9;

  VolumePath(const CameraRay& camera, const Medium* around, SampleStream& s, RenderState& st)
      : ray(camera.ray), differential(&camera.differential), medium(around), stream(s), state(st) {}

  Ray ray;
  const RayDifferential* differential;  ///< null after the first vertex
  const Medium* medium;
  SampleStream& stream;
  RenderState& state;
  GuidedMemory* memory = nullptr;  ///< null: nothing guides, nothing learns
  bool learns = false;

  PairedRadiance radiance;
  Rgb throughput{1};
  double odds = 1;     ///< of the way so far, as PairedRadiance::add() wants them
  float promise = 0;   ///< radiance to come at the first vertex of which a guide told it; 0: none
  float etaScale = 1;  ///< undoes the change of radiance by refraction, for roulette
  int bounces = 0, interfaces = 0;
  bool emissionAdded = false;  ///< of what the ray ends at
  bool distanceDrawn = false;  ///< since the last bounce, with the sampler's numbers
  /// Light sampling at the last vertex could have found what the ray finds; `from` and `pdf` say
  /// with which densities.
  bool weighed = false;
  LightSampleContext from{};
  float pdf = 0;
  bool entersBelow = false;  ///< a transmitted direction leads below the surface; no guide knows
  bool below = false;        ///< it has
  bool ownNumbers = false;   ///< the sampler's numbers of this bounce are used up
  /// Light sampled at the last vertex whose shadow ray is still to be traced.
  struct Proposal {
    LightConnection light;
    const Medium* medium = nullptr;  ///< in which its shadow ray starts
    double odds = 1;
    float chance = 1;
  } proposed{};
  bool isProposed = false;
  bool lightTried = false;             ///< at the last vertex
  bool remembered = false;             ///< the last turn is that of the last vertex
  const Primitive* surface = nullptr;  ///< of the last vertex; null in a medium
  Vec3 normal{0, 0, 1};                ///< there
  NumberSequence numbers{0};           ///< whatever the sampler's dimensions do not cover

  /// Largest component of what the throughput would be, had the same way been drawn without a
  /// guide.
  float unguidedThroughput() const { return throughput.maxComponent() * static_cast<float>(odds); }
  void setDimension(uint32_t offset) {
    stream.setDimension(kFirstPathDimension +
                        static_cast<uint32_t>(bounces) * kDimensionsPerVertex + offset);
  }
};

}  // namespace lampyris
