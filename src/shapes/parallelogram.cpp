// SPDX-License-Identifier: Apache-2.0
#include "shapes/parallelogram.h"

#include <cmath>
#include <limits>

#include "core/rejections.h"
#include "core/sampling.h"
#include "shapes/spherical_triangle.h"

namespace lampyris {

using DVec3 = glm::dvec3;

std::unique_ptr<const Parallelogram> Parallelogram::make(const std::array<Vec3, 4>& corners,
                                                         const Vec3& normal) {
  std::unique_ptr<Parallelogram> q(new Parallelogram);
  Vec3 largest(0);
  for (const Vec3& p : corners) {
    q->bounds_.extend(p);
    largest = glm::max(largest, absComponents(p));
  }
  q->corner_ = corners[0];
  q->e1_ = DVec3(corners[1]) - q->corner_;
  q->e2_ = DVec3(corners[3]) - q->corner_;
  q->areaNormal_ = glm::cross(q->e1_, q->e2_);
  q->gap_ = absComponents(Vec3(q->corner_ + q->e1_ + q->e2_ - DVec3(corners[2])));
  q->normal_ = normal;
  q->area_ = static_cast<float>(glm::length(q->areaNormal_));

  constexpr float kMostOfEdge = 1e-5f;
  const auto edge = static_cast<float>(std::min(glm::length(q->e1_), glm::length(q->e2_)));
  const float rounding = 4 * kMachineEpsilon * maxComponent(largest);
  if (!(maxComponent(q->gap_) <= std::min(rounding, kMostOfEdge * edge))) return nullptr;
  if (!(q->area_ >= std::numeric_limits<float>::min() && std::isfinite(q->area_))) return nullptr;
  return q;
}

/// In relation to a point from which it is sampled.
struct Parallelogram::View {
  View(const Parallelogram& q, const Vec3& from)
      : shape(q), a(q.corner_ - DVec3(from)), volume(std::abs(glm::dot(q.areaNormal_, a))) {}

  bool isWide() const {
    const DVec3 centre = a + 0.5 * (shape.e1_ + shape.e2_);
    return glm::dot(shape.e1_, shape.e1_) + glm::dot(shape.e2_, shape.e2_) >
           kWide * glm::dot(centre, centre);
  }
  /// By solid angle at distance `d`, of points that are uniform by area; as for triangles.
  float uniformPdf(float d) const {
    const double distance = d;
    return static_cast<float>(distance * distance * distance / volume);
  }

  const Parallelogram& shape;
  DVec3 a;
  double volume;
};

/// Two spherical triangles that sweep around the corner, the second on from the diagonal.
struct Parallelogram::Halves {
  [[gnu::always_inline]] explicit Halves(const View& v)
      : corner(v.a),
        next(v.a + v.shape.e1_),
        opposite(v.a + v.shape.e1_ + v.shape.e2_),
        last(v.a + v.shape.e2_),
        first(next, corner, opposite, v.volume),
        second(opposite, corner, last, v.volume),
        whole((first.half() + second.half()).solidAngle()) {}

  /// As (s, t) of corner + s e1 + t e2.
  Vec2 sample(const Vec2& u) const {
    const HalfAngle swept = HalfAngle::ofSolidAngle(u.x * whole);
    const HalfAngle beyond = swept - first.half();
    const bool isFirst = beyond.sin < 0;
    const Vec3 b = (isFirst ? first : second).sample(isFirst ? swept : beyond, u.y);
    return isFirst ? Vec2(b.x + b.z, b.z) : Vec2(b.x, b.x + b.z);
  }

  SeenCorner corner, next, opposite, last;
  SphericalTriangle first, second;
  float whole;  ///< solid angle
};

inline void Parallelogram::set(ShapeSample& out, const Vec2& st, float pdf) const {
  const Vec3 e1(e1_), e2(e2_);
  out.p = Vec3(corner_) + (st.x * e1 + st.y * e2);
  out.pError = roundingBound(2) * absComponents(out.p) + gap_ +
               roundingBound(7) * (st.x * absComponents(e1) + st.y * absComponents(e2));
  out.n = normal_;
  out.pdf = pdf;
}

std::optional<ShapeSample> Parallelogram::sampleArea(uint32_t, const Vec2& u) const {
  std::optional<ShapeSample> out;
  set(out.emplace(), u, 1 / area_);
  return out;
}

std::optional<ShapeSample> Parallelogram::sampleSolidAngle(uint32_t, const Vec3& from,
                                                           const Vec2& u) const {
  std::optional<ShapeSample> out;
  const View view(*this, from);
  if (!(view.volume > 0)) return out;  // seen edge on
  ShapeSample& s = out.emplace();
  if (view.isWide()) {
    const Halves halves(view);
    set(s, halves.sample(u), 1 / halves.whole);
  } else {
    set(s, u, 0);
    s.pdf = view.uniformPdf(distance(s.p, from));
  }
  if (!(s.pdf > 0) || !std::isfinite(s.pdf)) {
    countRejection(Rejection::LightDensity);
    out.reset();
  }
  return out;
}

float Parallelogram::pdfSolidAngle(uint32_t, const Vec3& from, const Vec3& p, const Vec3&) const {
  const View view(*this, from);
  const float pdf = view.isWide() ? 1 / Halves(view).whole : view.uniformPdf(distance(p, from));
  return std::isfinite(pdf) ? pdf : 0;
}

}  // namespace lampyris
