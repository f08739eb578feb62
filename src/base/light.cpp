// SPDX-License-Identifier: Apache-2.0
#include "base/light.h"

#include <numeric>

namespace lampyris {

LightId LightTable::add(const Light* light) {
  const LightId first = size_;
  const auto index = static_cast<uint32_t>(objects_.size());
  const uint32_t elements = light->elementCount();
  if (dense_ && elements != 1) {
    dense_ = false;
    owner_.resize(size_);
    std::iota(owner_.begin(), owner_.end(), 0u);
  }
  objects_.push_back({light, first});
  if (!dense_) owner_.insert(owner_.end(), elements, index);
  size_ += elements;
  return first;
}

}  // namespace lampyris
