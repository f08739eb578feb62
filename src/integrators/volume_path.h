// SPDX-License-Identifier: Apache-2.0
/// Path tracing through participating media, with or without a guide: what the integrators
/// "volpath" and "guidedpath" share.
#pragma once

#include "integrators/direct_lighting.h"
#include "integrators/guided_memory.h"
#include "integrators/path_integrator.h"

namespace lampyris {

/// How a path is guided. `guide` null: not at all.
struct Guidance {
  const Guide* guide = nullptr;
  float ownShare = 1;  ///< of the BSDF or phase function in the mixture
  bool use = true;     ///< false: samples are collected only
  bool collect = false;
  uint64_t stride = 1;  ///< of every so many samples of a pixel, one is learned from
};

class VolumePathEstimator final : public RadianceEstimator {
 public:
  VolumePathEstimator(const Scene& scene, const PathSettings& settings,
                      const LightDistribution* distribution, const Guidance& guidance);

  Rgb radiance(const CameraRay& camera, SampleStream& stream, RenderState& state) const override;
  std::unique_ptr<EstimatorMemory> makeMemory() const override;

 private:
  struct Path;
  enum class Event : uint8_t { Ended, Scattered, Surface };
  Rgb emission(const Path& path, const SurfaceInteraction& at) const;
  Rgb outside(const Path& path) const;
  void addDimmedEmission(Path& path, const std::optional<Hit>& hit, float tMax) const;
  static MediumSample sampleDistance(Path& path, const Ray& segment);
  Event throughMedium(Path& path, float tMax) const;
  bool onSurface(Path& path, const Hit& hit) const;
  void addEmission(Path& path, const Rgb& found) const;
  bool survives(Path& path) const;
  bool survivesByThroughput(Path& path) const;
  bool survivesByPromise(Path& path, float scattered) const;
  float endByThroughput(const Path& path, float throughput) const;
  void goOn(Path& path, float chance) const;
  bool shade(Path& path, const SurfaceInteraction& at, const Material* material) const;
  bool enterBelow(Path& path, const SurfaceInteraction& at, const Material& material) const;
  bool scatter(Path& path, const GuidePoint& where) const;
  void proposeLight(Path& path, const class DirectionMixture& mixture,
                    const LocalGuide* guide) const;
  void settle(Path& path) const;
  static void preferRare(Path& path, float& uc);
  const Medium* mediumTowards(const Path& path, const Vec3& w) const;
  void remember(Path& path, const GuidePoint& where, const struct DrawnDirection& d) const;

  const Scene& scene_;
  const DirectLighting lighting_;
  const PathSettings settings_;
  const Guidance& guidance_;
  const bool scattersBelow_;
};

}  // namespace lampyris
