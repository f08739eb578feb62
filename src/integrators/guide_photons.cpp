// SPDX-License-Identifier: Apache-2.0
// Light that specular surfaces focus comes from a small part of all emission. Photons emitted
// evenly find out which: the place and the direction of emission are four numbers in [0, 1), whose
// cube is cut into cells, and at the cells from which a photon came to a specular surface first, as
// many photons are aimed. These alone tell of all light that meets such a surface first, the even
// ones of all other light. (Cells that no even photon has found are missed: a guide may be wrong.)
#include "integrators/guide_photons.h"

#include <array>
#include <bitset>

#include "core/hash.h"
#include "core/parallel.h"
#include "integrators/subpath_tracer.h"

namespace lampyris {

namespace {

constexpr size_t kChunk = 4096;
/// Bounces of a photon, at most: what is to be known first is where light gets to by few.
constexpr int kMostBounces = 6;

/// Parts of the numbers that choose place and direction of emission.
class Aim {
 public:
  static constexpr uint32_t kDimensions = 4;

  using Numbers = std::array<float, kDimensions>;
  void add(const Numbers& u) {
    const size_t cell = cellOf(u);
    if (!isIn_[cell]) cells_.push_back(static_cast<uint16_t>(cell));
    isIn_[cell] = true;
  }
  bool empty() const { return cells_.empty(); }
  /// Of a number in the cell that `choice` in [0, 1) chooses, at `u` within it.
  float number(float choice, uint32_t dimension, float u) const {
    const auto i = static_cast<size_t>(choice * static_cast<float>(cells_.size()));
    const uint32_t digit = cells_[std::min(i, cells_.size() - 1)] >> (kBits * dimension);
    return std::min((static_cast<float>(digit % kBins) + u) / kBins, kOneMinusEpsilon);
  }
  /// Of all numbers.
  float share() const { return static_cast<float>(cells_.size()) / kCells; }

 private:
  static constexpr uint32_t kBits = 3, kBins = 1 << kBits;
  static constexpr size_t kCells = size_t{1} << (kBits * kDimensions);
  static size_t cellOf(const Numbers& u) {
    size_t cell = 0;
    for (uint32_t k = 0; k < kDimensions; ++k)
      cell |= static_cast<size_t>(u[k] * kBins) << (kBits * k);
    return cell;
  }
  std::bitset<kCells> isIn_;
  std::vector<uint16_t> cells_;
};

/// Numbers of their own: an image must know nothing of those that its guide was made with.
class PhotonNumbers final : public Sampler {
 public:
  explicit PhotonNumbers(const Aim& aim) : aim_(aim) {}
  float get1D(const SampleAddress& a, uint32_t d) const override {
    const uint32_t k = d - kFirstAimed;
    const float u = toUnitFloat(hashCombine(hashCombine(kSeed, a.index), d));
    // Dimension 0, otherwise the camera's, chooses the cell.
    return k < Aim::kDimensions && !aim_.empty() ? aim_.number(get1D(a, 0), k, u) : u;
  }
  Vec2 get2D(const SampleAddress& a, uint32_t d) const override {
    return {get1D(a, d), get1D(a, d + 1)};
  }
  int samplesPerPixel() const override { return 1; }
  Aim::Numbers emission(uint64_t index) const {
    Aim::Numbers u;
    for (uint32_t k = 0; k < Aim::kDimensions; ++k) u[k] = get1D({Int2(0), index}, kFirstAimed + k);
    return u;
  }

 private:
  static constexpr uint64_t kSeed = 0x70686f746f6e73;
  static inline const uint32_t kFirstAimed = lightDimension(0) + 1;
  const Aim& aim_;
};

bool startsSpecular(const Subpath& path) { return path.size() > 1 && path[1].bsdf.isSpecular(); }

/// What photons have left, by chunks, which are traced at the same time.
class PhotonPaths {
 public:
  PhotonPaths(const Scene& scene, size_t count, size_t maxDepth)
      : scene_(scene), count_(count), maxDepth_(maxDepth) {}

  /// Calls take(chunk, index, path) for the photons from index `first` on.
  template <class Take>
  void trace(size_t first, const PhotonNumbers& numbers, const Take& take) const {
    const EmitterTable emitters(scene_.lightTable);
    if (emitters.empty()) return;
    const SubpathTracer tracer(scene_, emitters);
    parallelFor(chunks(), 1, [&](size_t begin, size_t end) {
      Subpath path;
      RayCounts rays;
      for (size_t c = begin; c < end; ++c)
        for (size_t i = c * kChunk; i < std::min((c + 1) * kChunk, count_); ++i) {
          tracer.fromLight(Ray(), maxDepth_, SampleStream(numbers, {Int2(0), first + i}), nullptr,
                           path, rays);
          take(c, first + i, path);
        }
    });
  }
  size_t chunks() const { return (count_ + kChunk - 1) / kChunk; }

 private:
  const Scene& scene_;
  size_t count_, maxDepth_;
};

/// Appends the photons of a path where they reach what scatters them diffusely; `share`: of the
/// light's power, in the path's terms.
void keep(const Subpath& path, float share, std::vector<GuidePhoton>& found) {
  for (size_t v = 2; v < path.size(); ++v) {
    const SurfaceInteraction& at = path[v].at;
    const float power = path[v].throughput.luminance() * share;
    if (!path[v].bsdf.isSpecular() && power > 0 && std::isfinite(power))
      found.push_back({at.p, at.wo, power, faceForward(at.n, at.wo)});
  }
}

}  // namespace

std::vector<GuidePhoton> traceGuidePhotons(const Scene& scene, int count, int maxDepth) {
  const auto photons = static_cast<size_t>(count);
  const PhotonPaths paths(scene, photons, static_cast<size_t>(std::min(maxDepth, kMostBounces)));
  struct Found {
    std::vector<GuidePhoton> photons;
    std::vector<Aim::Numbers> specular;
  };
  std::vector<Found> even(paths.chunks()), aimed(paths.chunks());
  const float share = 1 / static_cast<float>(photons);

  const Aim nowhere;
  const PhotonNumbers evenNumbers(nowhere);
  paths.trace(0, evenNumbers, [&](size_t chunk, size_t i, const Subpath& path) {
    if (!startsSpecular(path))
      keep(path, share, even[chunk].photons);
    else if (path.size() > 2)
      even[chunk].specular.push_back(evenNumbers.emission(i));
  });
  Aim aim;
  for (const Found& part : even)
    for (const Aim::Numbers& u : part.specular) aim.add(u);
  if (!aim.empty())
    paths.trace(photons, PhotonNumbers(aim), [&](size_t chunk, size_t, const Subpath& path) {
      if (startsSpecular(path)) keep(path, share * aim.share(), aimed[chunk].photons);
    });

  std::vector<GuidePhoton> all;
  for (auto* stream : {&even, &aimed})
    for (Found& part : *stream) {
      all.insert(all.end(), part.photons.begin(), part.photons.end());
      part = {};
    }
  return all;
}

}  // namespace lampyris
