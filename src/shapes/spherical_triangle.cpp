// SPDX-License-Identifier: Apache-2.0
// The solid angle is Van Oosterom and Strackee's (1983, "The Solid Angle of a Plane Triangle"). The
// warp is that of Arvo (1995, "Stratified Sampling of Spherical Triangles"): a point C' on the side
// from A to C such that A B C' has the share u.x of the solid angle, then a point on the arc from B
// to C'. Arvo goes by the angles of the triangle, whose sum less π cancels for small ones. Here C'
// comes from the same formula as the solid angle. With C' = cos s A + sin s T, T unit and
// orthogonal to A in the plane of A and C, and half the wanted solid angle h,
//
//   tan h = t det(A, B, T) / ((1 + A·B) + t B·T)  for t = tan(s / 2),
//
// which is linear in t. No difference of nearly equal numbers is left for small triangles, and as
// all vectors are combinations of A, B and C, the result is in barycentric coordinates: the point
// is on the triangle and no ray has to be cut with its plane.
// Cost: three square roots and an arcus tangent; a sample one more root, sine and cosine.
#include "shapes/spherical_triangle.h"

#include "core/sampling.h"

namespace lampyris {

namespace {

/// The angle of the point (cosine, sine) for sine > 0, in [0, π], to float precision.
float upperAngle(float sine, float cosine) {
  const float across = std::abs(cosine);
  const bool steep = sine > across;
  const float r = steep ? across / sine : sine / across, t = r * r, t2 = t * t, t4 = t2 * t2;
  // atan(r) / r on [0, 1], minimax.
  const float low = (1 - 0.333330721f * t) + t2 * (0.199926198f - 0.142036453f * t);
  const float high =
      (0.106409349f - 7.50429556e-2f * t) + t2 * (4.26915251e-2f - 1.60686296e-2f * t);
  const float angle = r * (low + t4 * (high + t4 * 2.84988945e-3f));
  const float folded = steep ? kPi / 2 - angle : angle;
  return cosine < 0 ? kPi - folded : folded;
}

}  // namespace

SphericalTriangle::SphericalTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                     double volume)
    : a_(std::sqrt(glm::dot(a, a))),
      b_(std::sqrt(glm::dot(b, b))),
      c_(std::sqrt(glm::dot(c, c))),
      ab_(glm::dot(a, b)),
      bc_(glm::dot(b, c)),
      ca_(glm::dot(c, a)),
      volume_(volume) {
  if (!(volume > 0)) return;
  // Scaled by the lengths, for the range of floats.
  const double lengths = a_ * b_ * c_, scale = 1 / lengths;
  const auto sine = static_cast<float>(volume * scale);
  const auto cosine = static_cast<float>(1 + (ab_ * c_ + bc_ * a_ + ca_ * b_) * scale);
  if (sine > 0) solidAngle_ = 2 * upperAngle(sine, cosine);
}

Vec3 SphericalTriangle::sample(const Vec2& u) const {
  // From here on a, b and c are unit.
  const double scale = 1 / (a_ * b_ * c_), volume = volume_ * scale;
  const double ab = ab_ * c_ * scale, bc = bc_ * a_ * scale, ca = ca_ * b_ * scale;
  // h = Ω' / 2 in full turns.
  const Vec2 half = circlePoint(u.x * solidAngle_ * (1 / (4 * kPi)));
  const double cosH = half.x, sinH = half.y;
  // C' = x A + y C, by q = t / sin b = numerator / denominator where sin b = |C − (A·C) A|.
  // Rounding may make A and C opposite, or B and C', where the point is next to an edge.
  constexpr double kLeast = 1e-16;
  const double opposite = std::max(1 + ca, kLeast);
  double numerator = sinH * (1 + ab), denominator = volume * cosH - (bc - ca * ab) * sinH;
  if (!(numerator * opposite < denominator)) numerator = 1, denominator = opposite;  // C' = C
  const double d2 = sqr(denominator), t2 = sqr(numerator) * (1 - ca) * opposite;
  const double k = 1 / (d2 + t2);
  const double y = 2 * numerator * denominator * k, x = std::max(0., (d2 - t2) * k - ca * y);
  // P = B + g (C' − (B·C') B) − v B, with 1 − B·P = v = u.y (1 − B·C').
  const double m = std::max(0., 1 - (x * ab + y * bc)), v = static_cast<double>(u.y) * m;
  const double g = std::sqrt(static_cast<double>(u.y) * (2 - v) / std::max(2 - m, kLeast));
  const double z = std::max(0., 1 - v - g * (1 - m));
  const glm::dvec3 w(g * x * b_ * c_, z * c_ * a_, g * y * a_ * b_);
  return Vec3(w * (1 / (w.x + w.y + w.z)));
}

}  // namespace lampyris
