// SPDX-License-Identifier: Apache-2.0
/// The BSDF at a point: a sum of lobes, without allocation.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <new>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "base/interaction.h"
#include "core/frame.h"
#include "core/rgb.h"

namespace lampyris {

/// Bits that say what a lobe or a sample of one does.
enum LobeFlags : uint8_t {
  kReflection = 1,
  kTransmission = 2,
  kDiffuse = 4,
  kGlossy = 8,
  kSpecular = 16,   ///< a Dirac delta: f() and pdf() are 0, only sample() sees it
  kAllAround = 32,  ///< one function over the sphere: no side of the surface is excluded
};

/// A direction drawn from a lobe, in local coordinates.
struct LobeSample {
  Vec3 wi{0};
  Rgb f;          ///< for a specular lobe: such that f |cos θi| / pdf is the weight
  float pdf = 0;  ///< by solid angle; for a specular lobe the probability of the choice
  uint8_t flags = 0;
  float eta = 1;  ///< relative index of refraction: ηt/ηi along the path if transmitted
};

/// Where a lobe, or a part of one, sends light from wo, roughly: for those who must judge lights by
/// the BSDF before any direction is drawn. Sizes are luminances.
struct LobeShape {
  enum class Kind : uint8_t {
    Cosine,  ///< constant f over a hemisphere
    Facets,  ///< Trowbridge–Reitz microfacets, mirroring or refracting
  };
  Kind kind = Kind::Cosine;
  bool transmitted = false;  ///< to the other side than wo's
  float albedo = 0;          ///< Facets: factor on what facets that lose no light would scatter
  float alpha = 1;           ///< Facets: roughness, the mean of both directions
  float eta = 1;             ///< transmitted Facets: as LobeSample::eta
};

/// One term of a BSDF, in the local frame of the shading normal (z). Directions are unit and point
/// away from the surface. Radiance transport: refraction scales by 1/η². Trivially destructible, at
/// most Bsdf::kLobeSize bytes.
class Lobe {
 public:
  /// The most shapes that one lobe reports.
  static constexpr size_t kMaxShapes = 2;

  explicit Lobe(uint8_t flags) : flags(flags) {}
  virtual Rgb f(const Vec3& wo, const Vec3& wi) const = 0;
  /// Density by solid angle with which sample() draws wi.
  virtual float pdf(const Vec3& wo, const Vec3& wi) const = 0;
  /// None where nothing is scattered. `uc` chooses among parts of the lobe, `u` the direction.
  virtual std::optional<LobeSample> sample(const Vec3& wo, float uc, const Vec2& u) const = 0;
  /// About how much of the light from wo the lobe scatters (luminance of its albedo, in [0, 1]):
  /// the probability of its choice. > 0 wherever the lobe scatters.
  virtual float albedo(const Vec3& wo) const = 0;
  /// Writes the lobe's shapes and returns their number. A lobe that doesn't say more is taken for
  /// a cosine on each side that it scatters to; a specular one has none.
  virtual size_t shapes(const Vec3& wo, std::span<LobeShape, kMaxShapes> out) const;

  uint8_t flags;
  Rgb scale{1};  ///< factor on f, set by materials that mix; in f(), sample() and albedo() already

 protected:
  ~Lobe() = default;
};

/// A direction drawn from a BSDF, in world space.
struct BsdfSample {
  Vec3 wi{0};
  Rgb f;
  float pdf = 0;
  uint8_t flags = 0;
  float eta = 1;

  bool isSpecular() const { return flags & kSpecular; }
  bool isTransmission() const { return flags & kTransmission; }
};

/// As in pbrt-v3, which side of the surface counts as reflection is decided by the geometric normal
/// (so that shading normals leak no light), while lobes and cosines use the shading frame.
class Bsdf {
 public:
  static constexpr size_t kMaxLobes = 8, kLobeSize = 128;

  Bsdf() = default;
  Bsdf(const Bsdf&) = delete;  // lobes point into the storage
  Bsdf& operator=(const Bsdf&) = delete;

  /// Sets the frame: shading normal, tangent along shading.dpdu. Removes all lobes.
  void reset(const SurfaceInteraction& at);

  /// Adds a lobe; beyond kMaxLobes an assertion fails (debug) or it is dropped.
  template <class L, class... Args>
  void add(Args&&... args) {
    static_assert(sizeof(L) <= kLobeSize && std::is_trivially_destructible_v<L>);
    assert(count_ < kMaxLobes);
    if (count_ >= kMaxLobes) return;
    lobes_[count_] = ::new (&storage_[count_ * kLobeSize]) L(std::forward<Args>(args)...);
    flags_ = static_cast<uint8_t>(flags_ | lobes_[count_]->flags);
    ++count_;
  }
  /// Multiplies the scale of the lobes from number `first` on: for mixtures.
  void scaleLobes(size_t first, const Rgb& by);

  size_t lobeCount() const { return count_; }
  bool empty() const { return count_ == 0; }
  /// All bits that any lobe has.
  uint8_t flags() const { return flags_; }
  bool transmits() const { return flags_ & kTransmission; }
  bool reflects() const { return flags_ & kReflection; }
  /// True if no lobe is other than specular: light sampling is pointless here.
  bool isSpecular() const;
  bool isDiffuse() const { return !(flags_ & (kGlossy | kSpecular)); }

  /// Sum over the non-specular lobes, without the cosine. Directions in world space, unit.
  Rgb f(const Vec3& wo, const Vec3& wi) const;
  /// Density by solid angle with which sample() draws wi; 0 for specular lobes.
  float pdf(const Vec3& wo, const Vec3& wi) const;
  /// None where nothing is scattered. A non-specular sample carries f and pdf of the whole BSDF.
  std::optional<BsdfSample> sample(const Vec3& wo, float uc, const Vec2& u) const;
  float absCosTheta(const Vec3& w) const { return absDot(w, frame_.z); }

  const Frame& frame() const { return frame_; }
  const Vec3& geometricNormal() const { return ng_; }
  const Lobe& lobe(size_t i) const { return *lobes_[i]; }

 private:
  Frame frame_;
  Vec3 ng_{0, 0, 1};
  uint8_t flags_ = 0;
  size_t count_ = 0;
  std::array<Lobe*, kMaxLobes> lobes_{};
  alignas(16) std::array<std::byte, kMaxLobes * kLobeSize> storage_;
};

}  // namespace lampyris
