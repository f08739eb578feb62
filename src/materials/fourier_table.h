// SPDX-License-Identifier: Apache-2.0
/// BSDFs that are tabulated by angles of elevation and hold the azimuth as a Fourier series: Jakob
/// et al. 2014, "A Comprehensive Framework for Rendering Layered Materials", §4. Read from files of
/// the format "SCATFUN" that was published with it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/rgb.h"
#include "materials/catmull_rom.h"

namespace lampyris {

/// μ are cosines with the normal: μo of the outgoing direction, μi of the one *in which* light
/// arrives. Values are f |μi|; channels: luminance, or luminance, red, blue.
class FourierTable {
 public:
  /// The longest series that is read.
  static constexpr size_t kMaxOrders = 1 << 14;

  /// Throws IoError on a file that cannot be read, is damaged, or has more than this reader knows
  /// (textured or other than one or three channels).
  explicit FourierTable(const std::string& path);
  /// The same of the file's contents; `path` is its name for messages.
  FourierTable(const std::string& path, std::string_view bytes);

  float eta() const { return eta_; }
  bool isColored() const { return channels_ == 3; }
  /// Luminance averaged over azimuth: a spline over μi, for μo.
  std::optional<SplineGrid::Row> row(float muO) const { return mean_.row(muO); }

  /// The azimuthal series between the table's nodes. Refers to the table.
  class Series {
   public:
    /// Σ a_k cos kφ of a channel.
    double value(size_t channel, double cosPhi) const;
    /// Writes the luminance's coefficients; returns how many.
    size_t coefficients(std::array<float, kMaxOrders>& out) const;

   private:
    friend class FourierTable;
    struct Term {
      const float* a;
      size_t orders;
      float weight;
    };
    float coefficient(size_t channel, size_t k) const;
    std::array<Term, 16> terms_;
    size_t count_ = 0, orders_ = 0;
  };
  /// None outside the table's elevations.
  std::optional<Series> series(float muI, float muO) const;

 private:
  struct Node {
    size_t offset, orders;
  };
  std::vector<float> mu_, coefficients_;
  std::vector<Node> nodes_;  ///< [o * n + i]
  SplineGrid mean_;
  size_t channels_ = 1;
  float eta_ = 1;
};

/// An azimuth in [0, 2π] drawn with density Σ a_k cos kφ / (2π a_0). None unless a_0 is positive.
std::optional<double> sampleFourier(std::span<const float> a, float u);

}  // namespace lampyris
