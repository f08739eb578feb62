// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/brdf_pivot.h"

namespace lampyris {

namespace {

constexpr double kPiD = 3.14159265358979323846;
/// Below this radius (as a sine, or in relation to the other circle's) a circle is taken as plane.
constexpr float kSmall = 0.02f;

double acosClamped(double x) { return std::acos(std::clamp(x, -1., 1.)); }

/// Share of a disk's area that lies above a line, whose signed distance below the centre is
/// `height` radii.
float diskShare(float height) {
  const auto h = static_cast<double>(height);
  return static_cast<float>((acosClamped(-h) + h * safeSqrt(1 - h * h)) / kPiD);
}

/// Solid angle of the intersection of two caps whose circles cross (Tovchigrechko and Vakser 2001).
/// `crossing` is the cosine between the circles' outward normals where they meet, turned so that 1
/// means: the first just lies within the second.
double intersection(double cos1, double sin1, double cos2, double sin2, double crossing) {
  const double cosDelta = cos1 * cos2 + sin1 * sin2 * crossing;
  const double sinDelta = safeSqrt(1 - std::min(1., cosDelta * cosDelta));
  if (!(sinDelta > 0)) return 2 * kPiD * (1 - std::max(cos1, cos2));
  return 2 * (kPiD - acosClamped(crossing) -
              cos1 * acosClamped((cos2 - cosDelta * cos1) / (sinDelta * sin1)) -
              cos2 * acosClamped((cos1 - cosDelta * cos2) / (sinDelta * sin2)));
}

}  // namespace

// The flux through a region of the sphere is half the integral of r × dr along its edge: here the
// circle's part above the horizon and the horizon's part within the circle.
float meanCosine(const DirectionCap& cap, float height) {
  const float s = cap.sine;
  if (height >= s) return (1 + cap.cosine()) * height * (0.5f * kInvPi);
  if (height <= -s) return 0;
  const auto h = static_cast<double>(height / s);
  if (s < kSmall)
    return static_cast<float>(static_cast<double>(s) / (kPiD * kPiD) *
                              (h * acosClamped(-h) + (2 + h * h) / 3 * safeSqrt(1 - h * h)));
  const auto sine = static_cast<double>(s), up = static_cast<double>(height);
  const double cosine = safeSqrt(1 - sine * sine), across = safeSqrt(1 - up * up);
  const double arc = acosClamped(-cosine * up / (sine * across));
  const double flux = arc * sine * sine * up - cosine * sine * across * std::sin(arc) +
                      acosClamped(cosine / across);
  return static_cast<float>(std::max(0., flux) /
                            (2 * kPiD * kPiD * static_cast<double>(cap.versine)));
}

PivotLobe::PivotLobe(const Vec3& axis, float width, const Vec3& horizon, float integral)
    : axis_(axis),
      horizon_(horizon),
      halfK_(0.5f / width),
      halfWidth_(0.5f * width),
      integral_(integral) {
  // The horizon is a cap as well, with cos θ = 0.
  const float height = dot(axis, horizon);
  horizonCosine_ = boosted(1 - height, 1);
  horizonLength_ = std::sqrt(1 + sqr(horizonCosine_));
  horizonAngle_ = std::atan2(1.f, horizonCosine_);
  const float above = horizonCosine_ < 0
                          ? 0.5f * (horizonLength_ - horizonCosine_) / horizonLength_
                          : 0.5f / (horizonLength_ * (horizonLength_ + horizonCosine_));
  perSteradian_ = integral / (above * 4 * kPi);
}

float PivotLobe::clippedShare(const DirectionCap& cap, float height, float c, float length) const {
  const float crossing = height / cap.sine;
  // A circle much smaller than the horizon's image sees that as a straight line.
  if (cap.sine * horizonLength_ < kSmall * length) return diskShare(crossing);
  const auto l = static_cast<double>(length), horizonL = static_cast<double>(horizonLength_);
  const double cosine = static_cast<double>(c) / l, sine = static_cast<double>(cap.sine) / l;
  const double whole = 2 * kPiD * (cosine > 0 ? sine * sine / (1 + cosine) : 1 - cosine);
  const double part = intersection(cosine, sine, static_cast<double>(horizonCosine_) / horizonL,
                                   1 / horizonL, static_cast<double>(crossing));
  return static_cast<float>(std::clamp(part / whole, 0., 1.));
}

}  // namespace lampyris
