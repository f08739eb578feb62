// SPDX-License-Identifier: Apache-2.0
/// The significance cache (Bashford-Rogers et al. 2012): records of cosine lobes, found by
/// position.
#pragma once

#include <unordered_map>
#include <vector>

#include "core/bounds.h"
#include "core/hash.h"
#include "core/parameters.h"
#include "guiding/cell_tree.h"
#include "guiding/lobe_side.h"
#include "guiding/photon_tree.h"

namespace lampyris {

struct SignificanceSettings {
  float radius = 0.1f;       ///< width of an undivided cell, in diagonals of the scene
  int nearest = 8;           ///< records used at a point, at most; twice as many of narrow ones
  int maxRecords = 500'000;  ///< bounds the memory
  int photons = 500'000;     ///< emitted before the image to start from, at most
  void declare(Declaration& d);
};

/// Records live in the cells of a spatial hash, apart for surfaces that face different ways and for
/// media; a look-up reads one cell. Cells that many paths visit are divided.
class SignificanceCache final : public Guide {
 public:
  static constexpr size_t kMostNearest = RecordCell::kMostRecords;

  /// A record as look-ups see it.
  struct Lobe {
    TurningAxis axis;
    float flux = 0;
    int level = 0;
    float inverse = 0;  ///< 1 / V above the plane of Lobes::n, if the axis does not turn
  };
  struct Lobes {
    std::span<const Lobe> lobes;
    Vec3 n{0};  ///< as of a surface in the cell; most points of a cell share it
    /// Weighed and clipped for a diffuse surface of that normal, or for an isotropic medium.
    LobeSide even{};
    const LobeBlock* blocks = nullptr;
    float lightWorth = 1;  ///< see LocalGuide
    bool turn = false;     ///< some of the lobes do: `even` does not hold
  };

  SignificanceCache(const SignificanceSettings& settings, const Bounds3& scene);

  std::unique_ptr<LocalGuide> makeLocal() const override;
  /// Starts the records from photons of indirect light; before anything is learned.
  void seed(std::span<const GuidePhoton> photons);
  void learn(std::span<const GuideSample> samples) override;
  void endPass() override;
  void report(Statistics& statistics) const override;
  std::string save() const override;
  bool restore(std::string_view bytes) override;
  /// Of the records that are in use.
  std::vector<LearnedDirection> directions() const override;

  /// The lobes around `p` for surfaces facing `n` (zero: in a medium); empty if nothing is known.
  Lobes find(const Vec3& p, const Vec3& n) const;

  size_t recordCount() const { return lobes_.size(); }
  size_t memory() const;
  const std::vector<CellTree>& trees() const { return trees_; }

 private:
  /// A cell, flat for look-ups.
  struct alignas(32) Cell {
    uint32_t first = 0;       ///< of lobes_
    uint32_t firstBlock = 0;  ///< of blocks_
    Vec3 n{0};
    LobeSide even{};
    uint8_t count = 0;         ///< of lobes_
    uint8_t lightWorth = 255;  ///< in 1/255
    bool turn = false;         ///< see Lobes
  };
  static_assert(sizeof(Cell) == 32);
  /// Of a point in a tree or in a part of it: index in cells_, or kTable and index in tables_.
  using Entry = uint32_t;
  static constexpr Entry kTable = 1u << 31, kNothing = ~Entry{0};
  /// Two levels of a tree: by CellPlace::grandchild().
  using Table = std::array<Entry, 64>;
  struct Slot {
    uint64_t key = 0;
    Entry root = kNothing;
  };
  struct Place {
    uint64_t key = 0;  ///< of the undivided cell: its numbers and which way it faces, exactly
    CellPlace place;   ///< in it
  };
  Place placeOf(const Vec3& p, const Vec3& n) const;
  size_t slotOf(uint64_t key) const { return mixBits(key) & (slots_.size() - 1); }
  void freeze();
  /// Of a node of a tree whose cells start at `first`.
  Entry freeze(const CellTree& tree, size_t node, Entry first);
  void freeze(const RecordCell& cell);
  /// Makes Lobes::even of the cell's lobes, the last ones.
  void freezeEven(Cell& cell);

  SignificanceSettings settings_;
  Vec3 origin_;
  float size_, invSize_;
  std::vector<CellTree> trees_;
  std::vector<uint64_t> keys_;                      ///< of the trees
  std::unordered_map<uint64_t, uint32_t> treeAt_;   ///< by key
  std::vector<std::vector<PlacedSample>> waiting_;  ///< per tree: learned from at the pass's end

  std::vector<Slot> slots_;  ///< a power of two, at most half full
  std::vector<Table> tables_;
  std::vector<Cell> cells_;
  std::vector<Lobe> lobes_;
  std::vector<LobeBlock> blocks_;
  uint64_t learned_ = 0;
};

}  // namespace lampyris
