// SPDX-License-Identifier: Apache-2.0
/// The guides by name, and their parameters.
#pragma once

#include <string>

#include "base/scene.h"
#include "guiding/photon_guide.h"
#include "guiding/significance_cache.h"

namespace lampyris {

/// Parameters of all guides; each guide reads its own.
struct GuideSettings {
  std::string name = "significance";
  SignificanceSettings significance;
  PhotonGuideSettings photons;
  void declare(Declaration& d);
};

/// Null for "none". `settings.name` must be one of those declared; `photons` is asked by guides
/// that want some; `paths` is how many the camera sends, as far as is known.
std::unique_ptr<Guide> makeGuide(const GuideSettings& settings, const Scene& scene, int64_t paths,
                                 const PhotonSource& photons);

}  // namespace lampyris
