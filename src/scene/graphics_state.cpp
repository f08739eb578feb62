// SPDX-License-Identifier: Apache-2.0
#include "scene/graphics_state.h"

#include <bit>
#include <cmath>

#include "core/hash.h"

namespace lampyris {

namespace {

bool isInvertible(const Transform& t) {
  if (t.isSingular()) return false;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(t.matrix()[c][r]) || !std::isfinite(t.inverseMatrix()[c][r])) return false;
  return true;
}

uint64_t hashOf(const TransformPair& pair) {
  uint64_t hash = 0;
  for (const Transform* t : {&pair.start, &pair.end})
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r)
        // + 0 makes −0 the same as 0.
        hash = hashCombine(hash, std::bit_cast<uint32_t>(t->matrix()[c][r] + 0.f));
  return hash;
}

}  // namespace

void CurrentTransform::concatenate(const Transform& t) {
  if (startActive) ctm.start = ctm.start * t;
  if (endActive) ctm.end = ctm.end * t;
  index = kNone;
}

void CurrentTransform::set(const Transform& t) {
  if (startActive) ctm.start = t;
  if (endActive) ctm.end = t;
  index = kNone;
}

TransformPool::TransformPool(std::vector<TransformPair>& pool) : pool_(pool) {
  for (const TransformPair& pair : pool_)
    byHash_.emplace(hashOf(pair), static_cast<uint32_t>(byHash_.size()));
}

uint32_t TransformPool::indexOf(CurrentTransform& current, SourceLocation where) {
  if (current.index != kNone) return current.index;
  const TransformPair& pair = current.ctm;
  if (!isInvertible(pair.start) || !isInvertible(pair.end))
    throw SceneError(where,
                     "the current transform has no inverse (a scale of 0, or numbers too large)");
  const uint64_t hash = hashOf(pair);
  const auto [first, last] = byHash_.equal_range(hash);
  for (auto i = first; i != last; ++i)
    if (pool_[i->second].start == pair.start && pool_[i->second].end == pair.end)
      return current.index = i->second;
  current.index = static_cast<uint32_t>(pool_.size());
  pool_.push_back(pair);
  byHash_.emplace(hash, current.index);
  return current.index;
}

}  // namespace lampyris
