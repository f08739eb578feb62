// SPDX-License-Identifier: Apache-2.0
// T. Bashford-Rogers, K. Debattista and A. Chalmers 2012, "A Significance Cache for Accelerating
// Global Illumination", §3.
//
// Deviations. Updates happen between passes, in a fixed order, where the paper's threads race.
// Samples count with their weights and in shares (see SignificanceRecord), which replaces eq. 7 to
// 12. The records of a cell of the hash are used together, in place of the N_cache nearest ones: to
// search those took five times as long as everything else at a vertex, and single lobes near to
// each other cover a hemisphere with gaps. Cells are divided where there are many samples. Cost a
// look-up: a probe of the hash, up to three steps down a tree, and where the BSDF varies, it for
// each lobe.
#include "guiding/significance_cache.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/parallel.h"
#include "guiding/lobe_mixture.h"

namespace lampyris {

namespace {

/// With an inverse that is a float, too.
float usableSize(float size) { return size > 1e-30f && size < 1e30f ? size : 1.f; }

/// Which of the six faces of a cube a normal points to; 6 for none.
uint64_t facing(const Vec3& n) {
  if (n == Vec3(0)) return 6;
  const Vec3 a = absComponents(n);
  const int axis = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
  return 2 * static_cast<uint64_t>(axis) + (n[axis] < 0);
}

/// 1 / V of a record for surfaces with normal `n`; of the whole lobe where n is zero.
float inverseAbove(const SignificanceRecord& r, const Vec3& n) {
  const float tilt = dot(r.axis().direction, n);
  return n == Vec3(0) || !(tilt > 0) ? inverseWholeLobe(r.level())
                                     : inverseClippedLobe(r.level(), tilt);
}

}  // namespace

void SignificanceSettings::declare(Declaration& d) {
  d.add("radius", radius,
        "Significance cache: records serve points within this many diagonals of the scene; less "
        "where many paths come by.")
      .range(1e-6, 1);
  d.add(
       "ncache", nearest,
       "Significance cache: records used at a point, at most; twice as many where they are narrow.")
      .range(1, SignificanceCache::kMostNearest);
  d.add("maxrecords", maxRecords, "Significance cache: records in all, at most.").range(0, 1e8);
  d.add("seedphotons", photons,
        "Significance cache: photons emitted before the image to start from, at most, and no more "
        "than one for 16 paths of the camera; as many again are aimed at specular surfaces.")
      .range(0, 1e8);
}

SignificanceCache::SignificanceCache(const SignificanceSettings& settings, const Bounds3& scene)
    : settings_(settings),
      origin_(scene.empty() ? Vec3(0) : scene.min),
      size_(usableSize(settings.radius * scene.diagonal())),
      invSize_(1 / size_) {}

std::unique_ptr<LocalGuide> SignificanceCache::makeLocal() const {
  return std::make_unique<LobeMixture>(*this);
}

SignificanceCache::Place SignificanceCache::placeOf(const Vec3& p, const Vec3& n) const {
  // Far beyond, in endless media, all is one cell. Shifted by a third of a cell, so that walls on
  // the scene's bounds do not lie on the cells' faces.
  constexpr int kBits = 20, kFarthest = (1 << (kBits - 1)) - 1;
  constexpr int kAcross = CellPlace::kCellsAcross;
  const Vec3 x = (p - origin_) * invSize_ + 1 / 3.f;
  std::array<uint32_t, 3> part;
  uint64_t key = facing(n);
  for (int axis = 0; axis < 3; ++axis) {
    const float inRange =
        std::clamp(x[axis], -static_cast<float>(kFarthest), static_cast<float>(kFarthest));
    const auto smallest = static_cast<uint32_t>(static_cast<int>(std::floor(inRange * kAcross)) +
                                                kFarthest * kAcross);
    part[static_cast<size_t>(axis)] = smallest % kAcross;
    key = key << kBits | smallest / kAcross;
  }
  return {key, CellPlace(part[0], part[1], part[2])};
}

SignificanceCache::Lobes SignificanceCache::find(const Vec3& p, const Vec3& n) const {
  if (slots_.empty()) return {};
  const Place at = placeOf(p, n);
  const size_t mask = slots_.size() - 1;
  size_t slot = slotOf(at.key);
  while (slots_[slot].root != kNothing && slots_[slot].key != at.key) slot = (slot + 1) & mask;
  Entry entry = slots_[slot].root;
  if (entry == kNothing) return {};
  for (int depth = 0; entry & kTable; depth += 2)
    entry = tables_[entry & ~kTable][at.place.grandchild(depth)];
  const Cell& cell = cells_[entry];
  return {{lobes_.data() + cell.first, cell.count},
          cell.n,
          cell.even,
          blocks_.data() + cell.firstBlock,
          static_cast<float>(cell.lightWorth) * (1 / 255.f),
          cell.turn};
}

void SignificanceCache::learn(std::span<const GuideSample> samples) {
  learned_ += samples.size();
  for (const GuideSample& s : samples) {
    const Place place = placeOf(s.p, s.n);
    const auto [at, isNew] = treeAt_.try_emplace(place.key, static_cast<uint32_t>(trees_.size()));
    if (isNew) {
      if (!(s.radiance > 0) || recordCount() >= static_cast<size_t>(settings_.maxRecords)) {
        treeAt_.erase(at);
        continue;
      }
      trees_.emplace_back(settings_.nearest);
      keys_.push_back(place.key);
      waiting_.emplace_back();
    }
    waiting_[at->second].push_back({s, place.place});
  }
}

namespace {

std::vector<GuideSample> samplesOf(std::span<const GuidePhoton> photons) {
  std::vector<GuideSample> samples;
  samples.reserve(photons.size());
  for (const GuidePhoton& p : photons) {
    GuideSample s{p.p, p.n, p.wi, 0, 1};
    constexpr float kGrazing = 0.1f;
    s.radiance = p.power / std::max(kGrazing, absDot(p.n, p.wi));
    if (std::isfinite(s.radiance)) samples.push_back(s);
  }
  return samples;
}

}  // namespace

void SignificanceCache::seed(std::span<const GuidePhoton> photons) {
  learn(samplesOf(photons));
  learned_ = 0;
  const size_t quota =
      trees_.empty() ? 0 : static_cast<size_t>(settings_.maxRecords) / 2 / trees_.size();
  parallelFor(trees_.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      trees_[i].seed(waiting_[i], size_, quota);
      waiting_[i] = {};
    }
  });
  freeze();
}

void SignificanceCache::endPass() {
  // Each tree may add an equal part of what is left, so that the outcome knows no order.
  const size_t left = static_cast<size_t>(settings_.maxRecords) -
                      std::min(static_cast<size_t>(settings_.maxRecords), recordCount());
  const size_t quota = trees_.empty() ? 0 : left / trees_.size();
  const size_t first = trees_.empty() ? 0 : left % trees_.size();
  parallelFor(trees_.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      for (const PlacedSample& s : waiting_[i]) trees_[i].learn(s, quota + (i < first));
      trees_[i].endPass();
      waiting_[i] = {};
    }
  });
  freeze();
}

void SignificanceCache::freeze() {
  tables_.clear();
  cells_.clear();
  lobes_.clear();
  blocks_.clear();
  slots_.assign(std::bit_ceil(2 * trees_.size() + 1), {});
  const size_t mask = slots_.size() - 1;
  for (size_t t = 0; t < trees_.size(); ++t) {
    size_t slot = slotOf(keys_[t]);
    while (slots_[slot].root != kNothing) slot = (slot + 1) & mask;
    const auto first = static_cast<Entry>(cells_.size());
    for (const CellTree::Node& n : trees_[t].nodes()) freeze(n.cell);
    slots_[slot] = {keys_[t], freeze(trees_[t], 0, first)};
  }
}

SignificanceCache::Entry SignificanceCache::freeze(const CellTree& tree, size_t node, Entry first) {
  const auto childOf = [&tree](size_t parent, size_t child) {
    return tree.nodes()[parent].children[child];
  };
  const auto isChild = [](int32_t child) { return child != CellTree::kNoChild; };
  const Entry own = first + static_cast<Entry>(node);
  if (std::ranges::none_of(tree.nodes()[node].children, isChild)) return own;
  const size_t table = tables_.size();
  tables_.emplace_back();
  for (size_t i = 0; i < std::tuple_size_v<Table>; ++i) {
    Entry entry = own;
    if (const int32_t child = childOf(node, i / 8); isChild(child)) {
      const int32_t grandchild = childOf(static_cast<size_t>(child), i % 8);
      entry = isChild(grandchild) ? freeze(tree, static_cast<size_t>(grandchild), first)
                                  : first + static_cast<Entry>(child);
    }
    tables_[table][i] = entry;
  }
  return kTable | static_cast<Entry>(table);
}

void SignificanceCache::freeze(const RecordCell& cell) {
  Cell& flat = cells_.emplace_back();
  flat.first = static_cast<uint32_t>(lobes_.size());
  flat.firstBlock = static_cast<uint32_t>(blocks_.size());
  flat.n = cell.normal();
  for (const SignificanceRecord& r : cell.records()) {
    lobes_.push_back({r.axis(), r.flux(), r.level(), inverseAbove(r, flat.n)});
    flat.turn = flat.turn || r.axis().turn != 0;
  }
  flat.count = static_cast<uint8_t>(cell.records().size());
  freezeEven(flat);
  flat.lightWorth = static_cast<uint8_t>(std::lround(cell.lightWorth() * 255));
}

void SignificanceCache::freezeEven(Cell& cell) {
  blocks_.resize(blocks_.size() + LobeSide::blocksOf(cell.count));
  for (size_t i = cell.first; i < lobes_.size(); ++i) {
    const Lobe& r = lobes_[i];
    const Vec3& axis = r.axis.direction;
    const float w = (cell.n == Vec3(0) ? 1.f : dot(axis, cell.n)) * r.flux;
    if (w > 0 && std::isfinite(w))
      cell.even.add(&blocks_[cell.firstBlock], axis, r.level, w, r.inverse);
  }
}

std::string SignificanceCache::save() const {
  ByteWriter out;
  out.put(learned_);
  out.put(keys_);
  for (const CellTree& t : trees_) t.save(out);
  return out.bytes();
}

bool SignificanceCache::restore(std::string_view bytes) {
  ByteReader in(bytes);
  in.get(learned_);
  in.get(keys_);
  trees_.clear();
  treeAt_.clear();
  for (const uint64_t key : keys_) {
    treeAt_.emplace(key, static_cast<uint32_t>(trees_.size()));
    trees_.emplace_back(settings_.nearest).restore(in);
  }
  waiting_.assign(trees_.size(), {});
  if (!in.ok() || !in.atEnd()) return false;
  freeze();
  return true;
}

std::vector<LearnedDirection> SignificanceCache::directions() const {
  std::vector<LearnedDirection> found;
  for (const CellTree& t : trees_)
    for (const CellTree::Node& n : t.nodes()) {
      if (n.divided) continue;
      for (const SignificanceRecord& r : n.cell.records())
        found.push_back({r.axis().place, r.axis().direction, r.exponent(), r.radiance()});
    }
  return found;
}

size_t SignificanceCache::memory() const {
  size_t bytes = slots_.capacity() * sizeof(Slot) + tables_.capacity() * sizeof(Table) +
                 cells_.capacity() * sizeof(Cell) + lobes_.capacity() * sizeof(Lobe) +
                 blocks_.capacity() * sizeof(LobeBlock) + treeAt_.size() * 32;
  for (const CellTree& t : trees_) bytes += t.memory();
  return bytes;
}

void SignificanceCache::report(Statistics& statistics) const {
  const auto set = [&statistics](const char* name, size_t value) {
    statistics.set("guide", name, static_cast<double>(value));
  };
  set("records", recordCount());
  set("cells", cells_.size());
  set("samples learned from", learned_);
  set("memory (bytes)", memory());
}

}  // namespace lampyris
