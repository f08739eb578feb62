// SPDX-License-Identifier: Apache-2.0
#include "guiding/record_cell.h"

#include <algorithm>
#include <array>

#include "core/math.h"

namespace lampyris {

namespace {

constexpr double kFirstFit = 32;
constexpr double kFading = 0.5;
/// Share of the flux around that may come from anywhere: keeps a lobe from taking all of a sample
/// that it hardly predicts.
constexpr float kBackground = 0.05f;
/// Within this part of its height a lobe is taken to know about a direction (the paper's s > 0.5).
constexpr float kKnown = 0.5f;
/// A lobe with less than this share of the cell's flux is not worth its place.
constexpr float kIdleShare = 2e-3f;
/// Two lobes as high as this at each other's axis are one.
constexpr float kAlike = 0.8f;
/// Bounds sample weights, so that no sum overflows: far beyond radiances that images hold.
constexpr double kLargestWeight = 1e60;

/// Lobes are narrow if all together cover less than this part of the hemisphere.
constexpr float kNarrow = 0.3f;
/// A lobe of fewer samples may look narrow by chance.
constexpr double kKnownSamples = 8;

}  // namespace

RecordCell::RecordCell(int room) : room_(room), fading_(kFading), nextFit_(kFirstFit) {}

RecordCell::RecordCell(const RecordCell& parent, double share, double brightness)
    : RecordCell(parent) {
  fade(share);
  i_ *= brightness;
  i2_ *= sqr(brightness);
  for (SignificanceRecord& r : records_) r.brighten(brightness);
  sinceFit_ = 0;
  nextFit_ = kFirstFit;
}

void RecordCell::fade(double factor) {
  for (double* sum : {&s_, &i_, &i2_, &lightTried_, &lightFound_}) *sum *= factor;
  for (SignificanceRecord& r : records_) r.fade(factor);
}

void RecordCell::save(ByteWriter& out) const {
  out.put(room_);
  out.put(fading_);
  out.put(normal_);
  for (const double sum : {s_, i_, i2_, lightTried_, lightFound_, sinceFit_, nextFit_})
    out.put(sum);
  out.put(records_);
}

void RecordCell::restore(ByteReader& in) {
  in.get(room_);
  in.get(fading_);
  in.get(normal_);
  for (double* sum : {&s_, &i_, &i2_, &lightTried_, &lightFound_, &sinceFit_, &nextFit_})
    in.get(*sum);
  in.get(records_);
}

double RecordCell::lightWorth() const {
  constexpr double kLeastTries = 20, kLeast = 0.1, kTriesForOne = 4;
  if (lightTried_ < kLeastTries) return 1;
  return std::clamp(kTriesForOne * (lightFound_ + 0.5) / lightTried_, kLeast, 1.);
}

bool RecordCell::learn(const GuideSample& sample, bool mayInsert) {
  lightTried_ += sample.lightTried;
  lightFound_ += sample.lightFound;
  const double weight = std::min(
      static_cast<double>(sample.radiance) / static_cast<double>(sample.pdf), kLargestWeight);
  normal_ = sample.n;
  const bool significant = weight >= meanFlux();
  const double count = static_cast<double>(sample.count), part = weight * count;
  s_ += count;
  i_ += part;
  i2_ += part * part;
  sinceFit_ += 1;
  bool inserted = false;
  if (weight > 0) {
    std::array<float, kMostRecords> predicted;
    float total = 0;
    bool known = false;
    for (size_t i = 0; i < records_.size(); ++i) {
      const SignificanceRecord& r = records_[i];
      const float power = lobePower(r.level(), r.axis().at(sample.p), sample.wi);
      predicted[i] = r.radiance() * power;
      total += predicted[i];
      known = known || power > kKnown;
    }
    const float sphere = sample.n == Vec3(0) ? 4 * kPi : 2 * kPi;
    const float mean = static_cast<float>(std::min(meanFlux(), 1e30)) / sphere;
    const float sum = total + kBackground * mean;
    if (sum > 0)
      for (size_t i = 0; i < records_.size(); ++i)
        records_[i].add(sample.p, sample.wi, part * static_cast<double>(predicted[i] / sum));
    if (mayInsert && significant && !known && sample.radiance > total && hasRoom()) {
      records_.emplace_back(sample.p, sample.wi, part).fit(s_);
      inserted = true;
    }
  }
  if (sinceFit_ >= nextFit_) fit();
  return inserted;
}

bool RecordCell::hasRoom() const {
  const auto room = static_cast<size_t>(room_);
  if (records_.size() < room) return true;
  if (records_.size() >= std::min(2 * room, kMostRecords)) return false;
  float covered = 0;
  for (const SignificanceRecord& r : records_)
    covered += r.effectiveSamples() > kKnownSamples ? 1 / (r.exponent() + 1) : kNarrow;
  return covered < kNarrow;
}

void RecordCell::fit() {
  for (SignificanceRecord& r : records_) r.fit(s_);
  fade(fading_);
  sinceFit_ = 0;
  nextFit_ = std::max(kFirstFit, 2 * s_);
  mergeAlike();
}

namespace {

/// How far two lobes are one: the least of their heights, with `a` = 1 at its axis, at the other's
/// axis, where `a` is.
float likeness(const SignificanceRecord& a, const SignificanceRecord& b) {
  const Vec3 at = a.axis().place;
  const Vec3 other = b.axis().at(at);
  return std::min(lobePower(a.level(), a.axis().direction, other),
                  lobePower(b.level(), a.axis().direction, other));
}

}  // namespace

/// Lobes that have come to the same place make room for one that is needed elsewhere.
void RecordCell::mergeAlike() {
  for (size_t i = 0; i < records_.size(); ++i)
    for (size_t j = records_.size() - 1; j > i; --j) {
      const SignificanceRecord &a = records_[i], &b = records_[j];
      if (std::min(likeness(a, b), likeness(b, a)) < kAlike || std::abs(a.level() - b.level()) > 2)
        continue;
      records_[i].merge(b);
      records_.erase(records_.begin() + static_cast<std::ptrdiff_t>(j));
    }
}

void RecordCell::endPass() {
  if (sinceFit_ >= kFirstFit) fit();
  const auto least = static_cast<float>(meanFlux()) * kIdleShare;
  if (s_ >= kFirstFit)
    std::erase_if(records_, [&](const SignificanceRecord& r) { return !(r.flux() > least); });
}

}  // namespace lampyris
