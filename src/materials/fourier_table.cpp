// SPDX-License-Identifier: Apache-2.0
#include "materials/fourier_table.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/source.h"
#include "materials/root.h"

namespace lampyris {

namespace {

static_assert(std::endian::native == std::endian::little, "the format's byte order");

/// A file's numbers one after the other; nothing is allocated that the file does not hold.
class Reader {
 public:
  Reader(const std::string& path, std::string_view bytes) : path_(path), rest_(bytes) {}
  [[noreturn]] void fail(const std::string& what) const {
    throw IoError(fmt::format("\"{}\" is no BSDF file that can be used: {}", path_, what));
  }
  template <class T>
  std::vector<T> list(size_t count) {
    if (count > rest_.size() / sizeof(T))
      fail(fmt::format("it ends too early ({} bytes left of {} numbers)", rest_.size(), count));
    std::vector<T> all(count);
    std::memcpy(all.data(), rest_.data(), count * sizeof(T));
    rest_.remove_prefix(count * sizeof(T));
    return all;
  }
  template <class T>
  T one() {
    return list<T>(1)[0];
  }
  /// A count in [1, most].
  size_t count(const char* what, int32_t most) {
    const auto n = one<int32_t>();
    if (n < 1 || n > most) fail(fmt::format("it has {} {}, expected 1 to {}", n, what, most));
    return static_cast<size_t>(n);
  }
  std::vector<float> finite(const char* what, size_t count) {
    auto all = list<float>(count);
    for (const float v : all)
      if (!std::isfinite(v)) fail(fmt::format("one of its {} is not a number", what));
    return all;
  }

 private:
  const std::string& path_;
  std::string_view rest_;
};

}  // namespace

FourierTable::FourierTable(const std::string& path) : FourierTable(path, MappedFile(path).text()) {}

FourierTable::FourierTable(const std::string& path, std::string_view bytes) {
  constexpr char kMagic[] = "SCATFUN\1";
  constexpr int32_t kMostNodes = 1 << 14, kMostNumbers = std::numeric_limits<int32_t>::max();
  Reader in(path, bytes);
  if (std::memcmp(in.list<char>(8).data(), kMagic, 8) != 0) in.fail("it does not begin as one");
  const auto flags = in.one<int32_t>();
  const size_t n = in.count("elevations", kMostNodes);
  const size_t numbers = in.count("coefficients", kMostNumbers);
  const size_t orders = in.count("orders", kMaxOrders);
  channels_ = in.count("channels", 3);
  const size_t bases = in.count("basis functions", kMostNumbers);
  in.list<int32_t>(3);
  eta_ = in.one<float>();
  in.list<int32_t>(4);
  if (flags != 1 || bases != 1 || channels_ == 2)
    in.fail("only those of one material, with one or three channels, are rendered");
  if (n < 2) in.fail("it has one elevation");
  if (!(eta_ > 1e-3f && eta_ < 1e3f)) in.fail(fmt::format("its index of refraction is {}", eta_));

  mu_ = in.finite("elevations", n);
  for (size_t i = 0; i + 1 < n; ++i)
    if (!(mu_[i] < mu_[i + 1])) in.fail("its elevations do not ascend");
  if (!(mu_.front() >= -1 && mu_.back() <= 1)) in.fail("its elevations are no cosines");
  // The file's own integrals are passed over: those of the spline are exact.
  in.list<float>(n * n);
  const auto places = in.list<int32_t>(2 * n * n);
  coefficients_ = in.finite("coefficients", numbers);

  std::vector<float> mean(n * n);
  for (size_t i = 0; i < n * n; ++i) {
    const auto offset = static_cast<size_t>(places[2 * i]);
    const auto length = static_cast<size_t>(places[2 * i + 1]);
    if (places[2 * i] < 0 || places[2 * i + 1] < 0 || length > orders || offset > numbers ||
        length * channels_ > numbers - offset)
      in.fail(fmt::format("series {} lies outside of its coefficients", i));
    nodes_.push_back({offset, length});
    mean[i] = length > 0 ? coefficients_[offset] : 0;
  }
  mean_ = SplineGrid(mu_, mu_, std::move(mean));
}

std::optional<FourierTable::Series> FourierTable::series(float muI, float muO) const {
  const auto i = splineWeights(mu_, muI), o = splineWeights(mu_, muO);
  if (!i || !o) return std::nullopt;
  Series s;
  for (size_t b = 0; b < 4; ++b)
    for (size_t a = 0; a < 4; ++a) {
      const float weight = o->weight[b] * i->weight[a];
      if (weight == 0) continue;
      const auto row = o->node(b);
      const auto column = i->node(a);
      const Node& node = nodes_[row * mu_.size() + column];
      if (node.orders == 0) continue;
      s.terms_[s.count_++] = {&coefficients_[node.offset], node.orders, weight};
      s.orders_ = std::max(s.orders_, node.orders);
    }
  return s;
}

/// A node's channels follow each other, each of its own length.
float FourierTable::Series::coefficient(size_t channel, size_t k) const {
  float sum = 0;
  for (size_t t = 0; t < count_; ++t) {
    const Term& term = terms_[t];
    if (k < term.orders) sum += term.weight * term.a[channel * term.orders + k];
  }
  return sum;
}

double FourierTable::Series::value(size_t channel, double cosPhi) const {
  // cos (k + 1)φ = 2 cos φ cos kφ − cos (k − 1)φ.
  double sum = 0, current = 1, before = cosPhi;
  for (size_t k = 0; k < orders_; ++k) {
    sum += static_cast<double>(coefficient(channel, k)) * current;
    const double next = 2 * cosPhi * current - before;
    before = current;
    current = next;
  }
  return sum;
}

size_t FourierTable::Series::coefficients(std::array<float, kMaxOrders>& out) const {
  for (size_t k = 0; k < orders_; ++k) out[k] = coefficient(0, k);
  return orders_;
}

std::optional<double> sampleFourier(std::span<const float> a, float u) {
  if (a.empty() || !(a[0] > 0)) return std::nullopt;
  // The series is even: one half of the circle is inverted, the other is its image.
  const bool mirrored = u >= 0.5f;
  const double half = mirrored ? 2 * static_cast<double>(u) - 1 : 2 * static_cast<double>(u);
  const auto integral = [a](double phi) {
    const double c = std::cos(phi), s = std::sin(phi);
    double sum = static_cast<double>(a[0]) * phi, value = static_cast<double>(a[0]);
    // Sine and cosine of kφ by rotation.
    double ck = c, sk = s;
    for (size_t k = 1; k < a.size(); ++k) {
      const auto ak = static_cast<double>(a[k]);
      sum += ak * sk / static_cast<double>(k);
      value += ak * ck;
      const double next = ck * c - sk * s;
      sk = sk * c + ck * s;
      ck = next;
    }
    return std::pair(sum, value);
  };
  const double phi = solveIncreasing(integral, 0., M_PI, half * M_PI * static_cast<double>(a[0]));
  return mirrored ? 2 * M_PI - phi : phi;
}

}  // namespace lampyris
