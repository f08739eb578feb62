// SPDX-License-Identifier: Apache-2.0
#include "integrators/path_densities.h"

#include <cmath>

#include "core/rejections.h"

namespace lampyris {

/// Density of `next`, drawn by scattering at `at` what comes from `before` (null: `at` is the
/// path's end).
double PathDensities::scattered(const PathVertex* before, const PathVertex& at,
                                const PathVertex& next, float time) const {
  const Vec3 w = direction(at, next);
  double pdf = 0;
  if (at.kind == PathVertex::Kind::Camera) {
    pdf = cameraPdf(w, time);
  } else if (at.kind == PathVertex::Kind::Light) {
    if (at.light == kNoLight) return 0;
    const LightTable::Entry light = scene_.lightTable[at.light];
    const EmissionPdf emission = light.light->emissionPdf(light.element, at.at.n, w);
    pdf = static_cast<double>(at.infinite ? emission.position : emission.direction);
  } else if (before) {
    pdf = static_cast<double>(at.pdf(direction(at, *before), w));
  }
  return densityAt(next, at, pdf);
}

/// Of vertex `k`, drawn from the camera's side. Subpaths know the densities of their vertices; what
/// depends on the edge between them is looked up.
double PathDensities::cameraDensity(const WholePath& path, size_t k, float time) const {
  const auto& v = path.vertices;
  if (k >= path.fromLight) return v[k]->forward;
  if (k + 2 < path.fromLight) return v[k]->reverse;
  return scattered(k + 2 < v.size() ? v[k + 2] : nullptr, *v[k + 1], *v[k], time);
}

/// Of vertex `k` ≥ 1, drawn from the light's side.
double PathDensities::lightDensity(const WholePath& path, size_t k, float time) const {
  const auto& v = path.vertices;
  if (k < path.fromLight) return v[k]->forward;
  if (k > path.fromLight + 1) return v[k]->reverse;
  return scattered(k >= 2 ? v[k - 2] : nullptr, *v[k - 1], *v[k], time);
}

/// Density of the light's vertex where `fromLight` ≥ 1 vertices are drawn from its side.
double PathDensities::startDensity(const WholePath& path, size_t fromLight) const {
  const PathVertex& start = *path.vertices[0];
  if (start.light == kNoLight) return 0;
  const PathVertex& next = *path.vertices[1];
  const LightTable::Entry light = scene_.lightTable[start.light];
  const Vec3 w = direction(start, next);
  if (fromLight > 1) {
    const EmissionPdf emission = light.light->emissionPdf(light.element, start.at.n, w);
    return static_cast<double>(emitters_.pmf(start.light)) *
           static_cast<double>(start.infinite ? emission.direction : emission.position);
  }
  LightSampleContext at = next.context();
  at.wo = direction(next, *path.vertices[2]);
  const auto pmf = static_cast<double>(distribution_->pmf(at, start.light));
  if (light.light->isDelta()) return pmf;
  const float pdf = start.infinite ? light.light->pdfEscape(-w)
                                   : light.light->pdfHit(light.element, at.p, start.at);
  return densityAt(start, next, pmf * static_cast<double>(pdf));
}

/// Whether so many vertices can have been drawn from the light's side.
bool PathDensities::isPossible(const WholePath& path, size_t fromLight) const {
  const auto& v = path.vertices;
  if (fromLight == 0)
    return v[0]->light == kNoLight || !scene_.lightTable[v[0]->light].light->isDelta();
  // Lights are seen directly by the camera's rays alone.
  if (path.size() == 2 || v[0]->light == kNoLight) return false;
  const size_t s = path.fromLight;
  // The edge by which this path was made joins vertices that let it.
  const auto joins = [&](size_t k) {
    return v[k]->connectible || (s > 0 && (k + 1 == s || k == s));
  };
  return joins(fromLight) && joins(fromLight - 1);
}

double PathDensities::weight(const WholePath& path, float time) const {
  const size_t s = path.fromLight, n = path.size();
  if (n == 2) return 1;
  // Densities in relation to the path's own: `ratio` without that of the light's vertex.
  const double emitted = startDensity(path, 2);
  const double sampled = isPossible(path, 1) ? startDensity(path, 1) : 0;
  const auto start = [&](size_t fromLight) { return fromLight == 1 ? sampled : emitted; };
  const double found = cameraDensity(path, 0, time);
  const double own = s == 0 ? found : start(s);
  if (!(own > 0)) return 0;
  double sum = 0, ratio = 1;
  for (size_t k = s; k-- > 1;) {
    ratio *= cameraDensity(path, k, time) / lightDensity(path, k, time);
    if (isPossible(path, k)) sum += ratio * start(k) / own;
  }
  if (s > 0 && isPossible(path, 0)) sum += ratio * found / own;
  ratio = 1;
  for (size_t k = s; k + 1 < n; ++k) {
    if (k > 0) ratio *= lightDensity(path, k, time) / cameraDensity(path, k, time);
    if (isPossible(path, k + 1)) sum += ratio * start(k + 1) / own;
  }
  const double weight = 1 / (1 + sum);
  if (std::isfinite(weight)) return weight;
  countRejection(Rejection::MisWeight);
  return 0;
}

}  // namespace lampyris
