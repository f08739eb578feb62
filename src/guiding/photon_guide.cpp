// SPDX-License-Identifier: Apache-2.0
// H. W. Jensen 1995, "Importance Driven Path Tracing using the Photon Map": the nearest photons,
// weighed by power and BSDF, make a histogram over the directions above the surface.
//
// The histogram divides the unit square of (sin²θ, φ / 2π), so that a cell is uniform in projected
// solid angle; a photon's power already has the cosine in it. Deviation: photons of direct light
// are left out, for light sampling finds it. Cost a look-up: a search for the nearest photons, and
// the BSDF for each.
#include "guiding/photon_guide.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/frame.h"
#include "core/sampling.h"

namespace lampyris {

namespace {

class PhotonHistogram final : public LocalGuide {
 public:
  PhotonHistogram(const PhotonTree& tree, int nearest)
      : tree_(tree), nearest_(static_cast<size_t>(nearest)) {}

  bool moveTo(const GuidePoint& point, const DirectionWeight& scattering) override;
  Vec3 sample(float u, const Vec2& v, NumberSequence& more) const override;
  float pdf(const Vec3& wi) const override;

 private:
  static constexpr int kRings = 8, kSectors = 16;
  /// Share of all cells alike: a draw that rounding moves into a cell without photons counts too.
  static constexpr float kAnywhere = 0.01f;

  size_t cellOf(const Vec3& local) const {
    const float sine2 = local.x * local.x + local.y * local.y;
    const float turn = std::atan2(local.y, local.x) / (2 * kPi);
    const int ring = std::clamp(static_cast<int>(sine2 * kRings), 0, kRings - 1);
    const int sector =
        std::clamp(static_cast<int>((turn < 0 ? turn + 1 : turn) * kSectors), 0, kSectors - 1);
    return static_cast<size_t>(ring) * kSectors + static_cast<size_t>(sector);
  }

  const PhotonTree& tree_;
  const size_t nearest_;
  Frame frame_;
  std::array<float, kRings * kSectors> share_;  ///< of the cells; sums to 1
};

bool PhotonHistogram::moveTo(const GuidePoint& point, const DirectionWeight& scattering) {
  if (!point.onSurface()) return false;
  frame_ = Frame::fromZ(point.n);
  share_.fill(0);
  std::array<PhotonTree::Near, PhotonGuideSettings::kMostNearest> found;
  const size_t count = tree_.nearest(point.p, {found.data(), nearest_});
  std::array<Vec3, PhotonGuideSettings::kMostNearest> from;
  std::array<float, PhotonGuideSettings::kMostNearest> scattered;
  for (size_t i = 0; i < count; ++i) from[i] = tree_[found[i].photon].wi;
  scattering.weigh({from.data(), count}, {scattered.data(), count});
  float total = 0;
  for (size_t i = 0; i < count; ++i) {
    const GuidePhoton& photon = tree_[found[i].photon];
    const Vec3 local = frame_.toLocal(photon.wi);
    if (!(local.z > 1e-3f)) continue;
    const float weight = photon.power * scattered[i] / local.z;
    if (!(weight > 0) || !std::isfinite(weight)) continue;
    share_[cellOf(local)] += weight;
    total += weight;
  }
  if (!(total > 0) || !std::isfinite(1 / total)) return false;
  for (float& s : share_) s = (1 - kAnywhere) * s / total + kAnywhere / kRings / kSectors;
  return true;
}

Vec3 PhotonHistogram::sample(float u, const Vec2& v, NumberSequence&) const {
  size_t cell = 0;
  for (; cell + 1 < share_.size() && u >= share_[cell]; ++cell) u -= share_[cell];
  const size_t row = cell / kSectors, column = cell % kSectors;
  const auto ring = static_cast<float>(row), sector = static_cast<float>(column);
  const float sine2 = std::min((ring + v.x) / kRings, 1.f);
  return frame_.toWorld(sphericalDirection(std::sqrt(sine2), std::sqrt(1 - sine2),
                                           2 * kPi * (sector + v.y) / kSectors));
}

float PhotonHistogram::pdf(const Vec3& wi) const {
  const Vec3 local = frame_.toLocal(wi);
  if (!(local.z > 0)) return 0;
  return share_[cellOf(local)] * (kRings * kSectors) * local.z / kPi;
}

}  // namespace

void PhotonGuideSettings::declare(Declaration& d) {
  d.add("photons", photons,
        "Photon guide: how many are emitted; as many again are aimed at specular surfaces.")
      .range(1, 1e8);
  d.add("nearest", nearest, "Photon guide: how many are looked up at a point.")
      .range(1, kMostNearest);
}

std::unique_ptr<LocalGuide> PhotonGuide::makeLocal() const {
  return std::make_unique<PhotonHistogram>(tree_, settings_.nearest);
}

void PhotonGuide::report(Statistics& statistics) const {
  statistics.set("guide", "photons", static_cast<double>(tree_.size()));
  statistics.set("guide", "memory (bytes)",
                 static_cast<double>(tree_.size() * (sizeof(GuidePhoton) + 1)));
}

}  // namespace lampyris
