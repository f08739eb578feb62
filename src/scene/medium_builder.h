// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/medium.h"
#include "scene/build_state.h"

namespace lampyris {

/// Builds media, each when a shape or the camera first needs it.
class MediumBuilder {
 public:
  explicit MediumBuilder(BuildState& state)
      : state_(state), built_(state.description.media.size(), nullptr) {}

  /// What the description's medium interface `index` (kNone: none) stands for. Throws SceneError on
  /// names that were not defined before it.
  MediumInterface interfaceOf(uint32_t index);

 private:
  const Medium* medium(std::string_view name, const MediumInterfaceDescription& use);
  const Medium* create(const MediumDefinition& definition);

  BuildState& state_;
  std::vector<const Medium*> built_;  ///< per definition; null: not yet
};

}  // namespace lampyris
