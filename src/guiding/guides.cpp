// SPDX-License-Identifier: Apache-2.0
#include "guiding/guides.h"

#include <algorithm>

namespace lampyris {

namespace {

struct Entry {
  const char* name;
  std::unique_ptr<Guide> (*make)(const GuideSettings&, const Scene&, int64_t paths,
                                 const PhotonSource&);
};

std::unique_ptr<Guide> makeNone(const GuideSettings&, const Scene&, int64_t, const PhotonSource&) {
  return nullptr;
}

std::unique_ptr<Guide> makeSignificance(const GuideSettings& s, const Scene& scene, int64_t paths,
                                        const PhotonSource& photons) {
  auto cache = std::make_unique<SignificanceCache>(s.significance, scene.bounds);
  // A short render is not worth many.
  constexpr int64_t kPathsPerPhoton = 16;
  const auto count = std::min<int64_t>(s.significance.photons, paths / kPathsPerPhoton);
  if (count > 0) cache->seed(photons(static_cast<int>(count)));
  return cache;
}

std::unique_ptr<Guide> makePhotons(const GuideSettings& s, const Scene&, int64_t,
                                   const PhotonSource& photons) {
  return std::make_unique<PhotonGuide>(s.photons, photons(s.photons.photons));
}

// One line a guide.
constexpr Entry kGuides[] = {
    {"significance", makeSignificance},
    {"photons", makePhotons},
    {"none", makeNone},
};

}  // namespace

void GuideSettings::declare(Declaration& d) {
  std::vector<std::string> names;
  for (const Entry& e : kGuides) names.emplace_back(e.name);
  d.add("guide", name, "What guides the paths.").oneOf(names);
  significance.declare(d);
  photons.declare(d);
}

std::unique_ptr<Guide> makeGuide(const GuideSettings& settings, const Scene& scene, int64_t paths,
                                 const PhotonSource& photons) {
  const auto* e = std::find_if(std::begin(kGuides), std::end(kGuides),
                               [&](const Entry& entry) { return settings.name == entry.name; });
  return e->make(settings, scene, paths, photons);
}

}  // namespace lampyris
