// SPDX-License-Identifier: Apache-2.0
// pbrt-v3 traces a million rays for each box. Here a coarse grid of rays finds the pupil, a finer
// one its outline, and bisection its edges: about 1e-3 of the pupil's size off, as there.
#include "cameras/exit_pupil.h"

#include <cmath>

namespace lampyris {

namespace {

using DVec2 = glm::dvec2;

/// Rays from a point of the film's x axis.
class PupilProbe {
 public:
  PupilProbe(const LensSystem& lens, double filmX) : lens_(lens), filmX_(filmX) {}

  bool passes(const DVec2& rear) const {
    const DVec3 film(filmX_, 0, 0);
    return lens_.traceFromFilm({film, DVec3(rear, lens_.rearZ()) - film}).has_value();
  }

  /// Extends `found` by the points of a grid over `area` that light comes through, `steps` + 1 a
  /// side; with `edges` by the pupil's edges along the grid's lines, too.
  void search(const PupilBox& area, int steps, bool edges, PupilBox& found) const {
    const DVec2 step = (area.max - area.min) / static_cast<double>(steps);
    const auto at = [&](int x, int y) { return area.min + DVec2(x, y) * step; };
    for (int y = 0; y <= steps; ++y) {
      for (int x = 0; x <= steps; ++x) {
        if (!passes(at(x, y))) continue;
        found.extend(at(x, y));
        if (!edges) continue;
        for (const DVec2& way :
             {DVec2(step.x, 0), DVec2(-step.x, 0), DVec2(0, step.y), DVec2(0, -step.y)})
          if (!contains(found, at(x, y) + way)) found.extend(edge(at(x, y), way));
      }
    }
  }

 private:
  static bool contains(const PupilBox& b, const DVec2& p) {
    return p.x >= b.min.x && p.x <= b.max.x && p.y >= b.min.y && p.y <= b.max.y;
  }
  /// The last point from `inside` along `way` that light comes through.
  DVec2 edge(const DVec2& inside, const DVec2& way) const {
    double lo = 0, hi = 1;
    for (int i = 0; i < 8; ++i) {
      const double middle = 0.5 * (lo + hi);
      (passes(inside + middle * way) ? lo : hi) = middle;
    }
    return inside + lo * way;
  }

  const LensSystem& lens_;
  double filmX_;
};

constexpr int kCoarse = 32, kFine = 128, kOutline = 32;

/// The pupil's box from one point; `hint` is where a point nearby saw it.
PupilBox pupilFrom(const LensSystem& lens, double filmX, const PupilBox& hint,
                   const PupilBox& everywhere) {
  const PupilProbe probe(lens, filmX);
  PupilBox rough;
  if (!hint.empty()) probe.search(hint, kCoarse, false, rough);
  probe.search(everywhere, kCoarse, false, rough);
  if (rough.empty() && hint.empty()) probe.search(everywhere, kFine, false, rough);
  if (rough.empty()) return rough;
  // By a cell of either grid: what lies between its points is part of the pupil, too.
  const DVec2 cell = (everywhere.max - everywhere.min) / static_cast<double>(kCoarse);
  PupilBox area = rough;
  area.min -= cell;
  area.max += cell;
  PupilBox found = rough;
  probe.search(area, kOutline, true, found);
  return found;
}

}  // namespace

ExitPupil::ExitPupil(const LensSystem& lens, double filmRadius) : filmRadius_(filmRadius) {
  PupilBox everywhere;
  everywhere.extend(DVec2(0));
  everywhere.grow(1.5 * lens.rearRadius());
  const double step = filmRadius / kIntervals;
  const double margin = 2 * glm::length(everywhere.max - everywhere.min) / 1024;
  PupilBox last = pupilFrom(lens, 0, {}, everywhere);
  for (size_t i = 0; i < kIntervals; ++i) {
    PupilBox hint = last;
    if (!hint.empty()) hint.grow(glm::length(last.max - last.min) + 2 * step);
    const PupilBox next = pupilFrom(lens, static_cast<double>(i + 1) * step, hint, everywhere);
    PupilBox& box = boxes_[i] = last;
    if (!next.empty()) box.extend(next.min), box.extend(next.max);
    if (box.empty())
      box = everywhere;
    else
      box.grow(margin);
    last = next;
  }
}

}  // namespace lampyris
