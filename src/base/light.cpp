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
    rows_.clear();
    owner_.resize(size_);
    std::iota(owner_.begin(), owner_.end(), 0u);
  }
  objects_.push_back({light, first});
  if (dense_) addToRow(first, light);
  if (!dense_) owner_.insert(owner_.end(), elements, index);
  size_ += elements;
  return first;
}

void LightTable::addToRow(LightId id, const Light* light) {
  const auto distance = [light](const void* to) {
    return to ? static_cast<const char*>(to) - reinterpret_cast<const char*>(light) : 0;
  };
  const uint32_t place = id % kRow;
  if (place == 0) rows_.push_back({light, 0, distance(light->beyond())});
  Row& row = rows_.back();
  if (place == 1) row.stride = -distance(row.first);
  if (place > 0 && light != row.at(place)) row.stride = 0;
  if (row.beyond != distance(light->beyond())) row.beyond = 0;
}

}  // namespace lampyris
