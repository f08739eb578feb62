// SPDX-License-Identifier: Apache-2.0
#include "base/light.h"

namespace lampyris {

LightId LightTable::add(const Light* light) {
  const LightId first = size();
  const auto index = static_cast<uint32_t>(objects_.size());
  objects_.push_back({light, first});
  owner_.insert(owner_.end(), light->elementCount(), index);
  return first;
}

}  // namespace lampyris
