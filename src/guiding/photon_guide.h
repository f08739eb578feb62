// SPDX-License-Identifier: Apache-2.0
/// Guiding by photons, the rival that the significance cache is measured against.
#pragma once

#include <functional>

#include "core/parameters.h"
#include "guiding/guide.h"
#include "guiding/photon_tree.h"

namespace lampyris {

struct PhotonGuideSettings {
  static constexpr int kMostNearest = 512;
  int photons = 100'000;
  int nearest = 50;
  void declare(Declaration& d);
};

/// Emits so many photons and returns where they come by, but for direct light.
using PhotonSource = std::function<std::vector<GuidePhoton>(int)>;

/// Learns nothing: the photons are all that it knows. Media have none.
class PhotonGuide final : public Guide {
 public:
  PhotonGuide(const PhotonGuideSettings& settings, std::vector<GuidePhoton> photons)
      : settings_(settings), tree_(std::move(photons)) {}

  std::unique_ptr<LocalGuide> makeLocal() const override;
  bool learns() const override { return false; }
  void learn(std::span<const GuideSample>) override {}
  void endPass() override {}
  void report(Statistics& statistics) const override;
  std::string save() const override { return {}; }
  bool restore(std::string_view bytes) override { return bytes.empty(); }

 private:
  PhotonGuideSettings settings_;
  PhotonTree tree_;
};

}  // namespace lampyris
