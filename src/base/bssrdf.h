// SPDX-License-Identifier: Apache-2.0
/// Light that enters a surface at one point and leaves it at another.
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/bsdf.h"

namespace lampyris {

/// A separable BSSRDF at the point where light leaves (Jensen et al. 2001; Pharr et al. 2016,
/// "Physically Based Rendering", §11.4): transmission there (the BSDF's), times a radial profile,
/// times a lobe at the point where light enters. Trivially destructible, at most
/// BssrdfStorage::kSize bytes.
class Bssrdf {
 public:
  static constexpr int kChannels = 3;

  /// The profile at distance r: by area.
  virtual Rgb profile(float r) const = 0;
  /// A distance for one channel; grows with `u` in [0, 1). None if the channel does not scatter.
  virtual std::optional<float> sampleRadius(int channel, float u) const = 0;
  /// Density of sampleRadius() with a uniform angle, by area on a plane.
  virtual float pdfRadius(int channel, float r) const = 0;
  /// Adds the lobe of the entering light, in the frame that `bsdf` has.
  virtual void addEntryLobe(Bsdf& bsdf) const = 0;

 protected:
  ~Bssrdf() = default;
};

/// Room for any Bssrdf, without allocation.
class BssrdfStorage {
 public:
  static constexpr size_t kSize = 128;

  BssrdfStorage() = default;
  BssrdfStorage(const BssrdfStorage&) = delete;  // what it holds has been pointed to
  BssrdfStorage& operator=(const BssrdfStorage&) = delete;

  template <class B, class... Args>
  const Bssrdf* make(Args&&... args) {
    static_assert(sizeof(B) <= kSize && std::is_trivially_destructible_v<B>);
    return ::new (storage_.data()) B(std::forward<Args>(args)...);
  }

 private:
  alignas(16) std::array<std::byte, kSize> storage_;
};

}  // namespace lampyris
