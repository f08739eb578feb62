// SPDX-License-Identifier: Apache-2.0
#include "light_trees.h"

namespace lampyris::test {

Lights makeLights(Kind kind, size_t count, float scale) {
  Lights lights(count);
  for (size_t i = 0; i < count; ++i) {
    LightBounds& b = lights[i].bounds;
    lights[i].id = static_cast<LightId>(i);
    Vec3 p = randomPoint(i) * scale;
    if (kind == Kind::Line) p = Vec3(random(i, 0), 1, 2) * scale;
    if (kind == Kind::Coincident) p = Vec3(1, 2, 3) * scale;
    b.box = Bounds3(p);
    b.intensity = random(i, 4) + 0.01f;
    if (kind == Kind::Points || kind == Kind::Line || kind == Kind::Coincident) continue;
    b.box.extend(p + randomPoint(i, 5) * 0.02f * scale);
    b.axis = kind == Kind::FewCones ? normalize(Vec3(0, 0, 1) + 0.2f * randomDirection(i))
                                    : randomDirection(i);
    b.cosThetaO = std::cos(0.3f * random(i, 8));
    b.cosThetaE = std::cos(0.1f + random(i, 9));
    b.twoSided = kind == Kind::TwoSided;
  }
  return lights;
}

Lights pointLights(const std::vector<Vec3>& positions, float intensity) {
  Lights lights(positions.size());
  for (size_t i = 0; i < lights.size(); ++i) {
    lights[i].id = static_cast<LightId>(i);
    lights[i].bounds.box = Bounds3(positions[i]);
    lights[i].bounds.intensity = intensity;
  }
  return lights;
}

LightBVHInput flatLight(LightId id, const Vec3& p, const Vec3& axis, float cosThetaE) {
  LightBVHInput l;
  l.id = id;
  l.bounds.box = Bounds3(p);
  l.bounds.axis = axis;
  l.bounds.cosThetaO = 1;
  l.bounds.cosThetaE = cosThetaE;
  l.bounds.intensity = 1;
  return l;
}

LightSampleContext makeContext(uint64_t i, const Lights& lights, float scale) {
  LightSampleContext c;
  c.p = (randomPoint(i, 50) * 1.6f - 0.3f) * scale;
  if (i % 5 == 0) c.p = lights[i % lights.size()].bounds.box.min;
  c.n = randomDirection(i, 60);
  c.ns = normalize(c.n + 0.5f * randomDirection(i, 62));
  c.wo = randomDirection(i, 64);
  c.reflects = i % 3 != 1;
  c.transmits = i % 3 != 0;
  return c;
}

LightSampleContext opaqueAt(const Vec3& p, const Vec3& n) {
  static const Bsdf surface{};  // only whether there is one matters
  LightSampleContext c;
  c.p = p;
  c.n = c.ns = c.wo = n;
  c.transmits = false;
  c.bsdf = &surface;
  return c;
}

LightSampleContext volumeAt(const Vec3& p) {
  LightSampleContext c;
  c.p = p;
  return c;
}

bool permitted(const LightSampleContext& c, const Vec3& w) {
  const bool same = dot(c.n, w) * dot(c.n, c.wo) > 0;
  return same ? c.reflects : c.transmits;
}

bool emitsTo(const LightBounds& b, const Vec3& source, const Vec3& p) {
  const Vec3 w = normalize(p - source);
  float cosine = std::clamp(dot(w, b.axis), -1.f, 1.f);
  if (b.twoSided) cosine = std::abs(cosine);
  return std::acos(cosine) <= std::acos(b.cosThetaO) + std::acos(b.cosThetaE);
}

}  // namespace lampyris::test
