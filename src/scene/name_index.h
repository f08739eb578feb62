// SPDX-License-Identifier: Apache-2.0
/// Names whose meaning depends on the place in the file: textures and materials.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace lampyris {

/// "No index": no material, no object, …
inline constexpr uint32_t kNone = ~uint32_t{0};

/// Definitions by name. A definition holds from its place in the file (`order`) to the end of the
/// AttributeBegin block around it, or to a later one of the same name. A lookup for any place takes
/// time in proportion to the depth of blocks only.
class NameIndex {
 public:
  void add(std::string_view name, uint32_t index, uint32_t order) {
    std::vector<uint32_t>& same = byName_[name];
    const uint32_t shadowed = same.empty() ? kNone : visibleFrom(same.back(), order);
    open_.push_back(static_cast<uint32_t>(definitions_.size()));
    same.push_back(open_.back());
    definitions_.push_back({index, order, kNone, shadowed});
  }
  /// How many definitions hold now; to be given to close() at the end of the block that begins.
  size_t openCount() const { return open_.size(); }
  /// Ends all definitions but the first `count` that hold.
  void close(size_t count, uint32_t order) {
    for (; open_.size() > count; open_.pop_back()) definitions_[open_.back()].end = order;
  }
  /// What the name means at the place `order`; kNone: nothing.
  uint32_t find(std::string_view name, uint32_t order) const {
    const auto same = byName_.find(name);
    if (same == byName_.end()) return kNone;
    const auto after =
        std::lower_bound(same->second.begin(), same->second.end(), order,
                         [this](uint32_t d, uint32_t o) { return definitions_[d].order < o; });
    if (after == same->second.begin()) return kNone;
    const uint32_t d = visibleFrom(*(after - 1), order);
    return d == kNone ? kNone : definitions_[d].index;
  }
  /// Whether the name is defined anywhere in the file.
  bool knows(std::string_view name) const { return byName_.contains(name); }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& [name, definitions] : byName_) all.emplace_back(name);
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  struct Definition {
    uint32_t index, order, end;
    uint32_t shadowed;  ///< the definition that held before, so that ended blocks are skipped
  };
  uint32_t visibleFrom(uint32_t d, uint32_t order) const {
    while (d != kNone && definitions_[d].end <= order) d = definitions_[d].shadowed;
    return d;
  }

  std::unordered_map<std::string_view, std::vector<uint32_t>> byName_;
  std::vector<Definition> definitions_;
  std::vector<uint32_t> open_;
};

}  // namespace lampyris
