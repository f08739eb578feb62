// SPDX-License-Identifier: Apache-2.0
// Light that specular surfaces focus comes from a small part of all emission. A first quarter of
// the photons finds out which: the place and the direction of emission are four numbers in [0, 1),
// whose cube is cut into cells, and cells from which a photon came by way of a specular surface are
// aimed at by half of the photons that count. (The other half, emitted evenly, keeps every photon
// possible.)
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
/// Share of the photons that only look where to aim.
constexpr int kPilots = 4;

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
  /// Density of an even mixture of all numbers and those aimed at; 1 if there are none.
  float density(const Numbers& u) const {
    if (empty()) return 1;
    const float aimed =
        isIn_[cellOf(u)] ? static_cast<float>(kCells) / static_cast<float>(cells_.size()) : 0.f;
    return 0.5f * (1 + aimed);
  }

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
    // Even indices are aimed. Dimension 0 is the camera's.
    return k < Aim::kDimensions && !aim_.empty() && a.index % 2 == 0
               ? aim_.number(get1D(a, 0), k, u)
               : u;
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

/// Calls take(chunk, index, path) for `count` photons' paths, from index `first` on; chunks run at
/// the same time.
template <class Take>
void trace(const Scene& scene, size_t first, size_t count, int maxDepth,
           const PhotonNumbers& numbers, const Take& take) {
  const EmitterTable emitters(scene.lightTable);
  if (emitters.empty()) return;
  const SubpathTracer tracer(scene, emitters);
  parallelFor((count + kChunk - 1) / kChunk, 1, [&](size_t begin, size_t end) {
    Subpath path;
    RayCounts rays;
    for (size_t c = begin; c < end; ++c)
      for (size_t i = first + c * kChunk; i < first + std::min((c + 1) * kChunk, count); ++i) {
        tracer.fromLight(Ray(), static_cast<size_t>(maxDepth), SampleStream(numbers, {Int2(0), i}),
                         nullptr, path, rays);
        take(c, i, path);
      }
  });
}

Aim aimAtSpecular(const Scene& scene, size_t first, size_t count, int maxDepth) {
  const Aim nowhere;
  const PhotonNumbers numbers(nowhere);
  std::vector<std::vector<Aim::Numbers>> found((count + kChunk - 1) / kChunk);
  trace(scene, first, count, maxDepth, numbers, [&](size_t chunk, size_t i, const Subpath& path) {
    if (path.size() > 2 && path[1].bsdf.isSpecular()) found[chunk].push_back(numbers.emission(i));
  });
  Aim aim;
  for (const auto& part : found)
    for (const Aim::Numbers& u : part) aim.add(u);
  return aim;
}

}  // namespace

std::vector<GuidePhoton> traceGuidePhotons(const Scene& scene, int count, int maxDepth) {
  const auto photons = static_cast<size_t>(count), pilots = photons / kPilots;
  const size_t rest = photons - pilots;
  maxDepth = std::min(maxDepth, kMostBounces);
  // With numbers of their own: cells chosen by the photons that count would dim these.
  const Aim aim = aimAtSpecular(scene, rest, pilots, maxDepth);
  const PhotonNumbers numbers(aim);
  std::vector<std::vector<GuidePhoton>> found((rest + kChunk - 1) / kChunk);
  trace(scene, 0, rest, maxDepth, numbers, [&](size_t chunk, size_t i, const Subpath& path) {
    const float share = 1 / (static_cast<float>(rest) * aim.density(numbers.emission(i)));
    for (size_t v = 2; v < path.size(); ++v) {
      const SurfaceInteraction& at = path[v].at;
      const float power = path[v].throughput.luminance() * share;
      if (!path[v].bsdf.isSpecular() && power > 0 && std::isfinite(power))
        found[chunk].push_back({at.p, at.wo, power, faceForward(at.n, at.wo)});
    }
  });
  std::vector<GuidePhoton> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace lampyris
