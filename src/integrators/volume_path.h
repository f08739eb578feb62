// SPDX-License-Identifier: Apache-2.0
/// Path tracing through participating media, with or without a guide: what the integrators
/// "volpath" and "guidedpath" share.
#pragma once

#include "integrators/direct_lighting.h"
#include "integrators/guided_roulette.h"
#include "integrators/path_integrator.h"

namespace lampyris {

/// How a path is guided. `guide` null: not at all.
struct Guidance {
  const Guide* guide = nullptr;
  float ownShare = 1;    ///< of the BSDF or phase function in the mixture
  bool use = true;       ///< false: samples are collected only
  float negligible = 0;  ///< radiance: a guide that promises less is not worth its time
  bool collect = false;
  uint64_t stride = 1;  ///< of so many samples, one is learned from
};

class VolumePathEstimator final : public RadianceEstimator {
 public:
  VolumePathEstimator(const Scene& scene, const PathSettings& settings,
                      const LightDistribution* distribution, const Guidance& guidance);

  Rgb radiance(const CameraRay& camera, SampleStream& stream, RenderState& state) const override;
  std::unique_ptr<EstimatorMemory> makeMemory() const override;

 private:
  enum class Event : uint8_t { Ended, Scattered, Surface };
  Rgb emission(const VolumePath& path, const SurfaceInteraction& at) const;
  Rgb outside(const VolumePath& path) const;
  void addDimmedEmission(VolumePath& path, const std::optional<Hit>& hit, float tMax) const;
  static MediumSample sampleDistance(VolumePath& path, const Ray& segment);
  Event throughMedium(VolumePath& path, float tMax) const;
  bool onSurface(VolumePath& path, const Hit& hit) const;
  void addEmission(VolumePath& path, const Rgb& found) const;
  bool shade(VolumePath& path, const SurfaceInteraction& at, const Material* material) const;
  bool enterBelow(VolumePath& path, const SurfaceInteraction& at, const Material& material) const;
  bool scatter(VolumePath& path, const GuidePoint& where) const;
  void proposeLight(VolumePath& path, const class DirectionMixture& mixture,
                    const LocalGuide* guide) const;
  void settle(VolumePath& path) const;
  static void preferRare(VolumePath& path, float& uc);
  const Medium* mediumTowards(const VolumePath& path, const Vec3& w) const;
  void remember(VolumePath& path, const GuidePoint& where, const struct DrawnDirection& d) const;

  const Scene& scene_;
  const DirectLighting lighting_;
  const PathSettings settings_;
  const Guidance& guidance_;
  const GuidedRoulette roulette_;
  const bool scattersBelow_;
};

}  // namespace lampyris
