// SPDX-License-Identifier: Apache-2.0
#include "integrators/guide_photons.h"

#include "core/hash.h"
#include "core/parallel.h"
#include "integrators/subpath_tracer.h"

namespace lampyris {

namespace {

constexpr size_t kChunk = 4096;

/// Numbers of their own: an image must know nothing of those that its guide was made with.
class PhotonNumbers final : public Sampler {
 public:
  float get1D(const SampleAddress& a, uint32_t d) const override {
    return toUnitFloat(hashCombine(hashCombine(kSeed, a.index), d));
  }
  Vec2 get2D(const SampleAddress& a, uint32_t d) const override {
    return {get1D(a, d), get1D(a, d + 1)};
  }
  int samplesPerPixel() const override { return 1; }

 private:
  static constexpr uint64_t kSeed = 0x70686f746f6e73;
};

}  // namespace

std::vector<GuidePhoton> traceGuidePhotons(const Scene& scene, int count, int maxDepth) {
  const EmitterTable emitters(scene.lightTable);
  if (emitters.empty()) return {};
  const SubpathTracer tracer(scene, emitters);
  const PhotonNumbers numbers;
  const auto photons = static_cast<size_t>(count), surfaces = static_cast<size_t>(maxDepth);
  std::vector<std::vector<GuidePhoton>> found((photons + kChunk - 1) / kChunk);
  parallelFor(found.size(), 1, [&](size_t begin, size_t end) {
    Subpath path;
    RayCounts rays;
    for (size_t c = begin; c < end; ++c)
      for (size_t i = c * kChunk; i < std::min((c + 1) * kChunk, photons); ++i) {
        tracer.fromLight(Ray(), surfaces, SampleStream(numbers, {Int2(0), i}), nullptr, path, rays);
        for (size_t v = 2; v < path.size(); ++v) {
          const SurfaceInteraction& at = path[v].at;
          const float power = path[v].throughput.luminance() / static_cast<float>(count);
          if (!path[v].bsdf.isSpecular())
            found[c].push_back({at.p, at.wo, power, faceForward(at.n, at.wo)});
        }
      }
  });
  std::vector<GuidePhoton> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  std::erase_if(all,
                [](const GuidePhoton& p) { return !(p.power > 0) || !std::isfinite(p.power); });
  return all;
}

}  // namespace lampyris
