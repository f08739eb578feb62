// SPDX-License-Identifier: Apache-2.0
// NURBS patches, as pbrt-v3 renders them: diced into a grid of triangles with vertex normals. Basis
// functions after Piegl and Tiller 1997, "The NURBS Book", §2.5.
#include <fmt/format.h>

#include <cmath>
#include <glm/vec4.hpp>

#include "shapes/grid_mesh.h"
#include "shapes/registry.h"
#include "shapes/triangle_mesh.h"

namespace lampyris {

namespace {

/// Vertices along each side of the grid.
constexpr size_t kDice = 30;
constexpr int kHighestOrder = 64;

/// What describes the surface along u or v.
struct AxisParameters {
  int count = 0, order = 0;
  std::vector<float> knots;
  std::optional<float> begin, end;

  void declare(Declaration& d, const std::string& u) {
    d.add("n" + u, count, "Control points along " + u + ".").atLeast(2).defaultIs("required");
    d.add(u + "order", order, "Order along " + u + ": the degree + 1.")
        .range(2, kHighestOrder)
        .defaultIs("required");
    d.add(u + "knots", knots, "Knots along " + u + ".")
        .rangeIs("n" + u + " + " + u + "order values, ascending");
    d.add(u + "0", begin, "Where the rendered part begins along " + u + ".")
        .defaultIs("where the surface does")
        .rangeIs("within the knots, below " + u + "1");
    d.add(u + "1", end, "Where it ends.")
        .defaultIs("where the surface does")
        .rangeIs("within the knots, above " + u + "0");
  }
};

struct NurbsParameters {
  AxisParameters u, v;
  std::vector<Vec3> points;
  std::vector<float> weighted;

  void declare(Declaration& d) {
    u.declare(d, "u");
    v.declare(d, "v");
    d.add("P", points, "Control points, row after row along u.").rangeIs("nu × nv points");
    d.add("Pw", weighted, "The same as x w, y w, z w, w for rational surfaces, instead of P.")
        .rangeIs("nu × nv times four values, all w of one sign");
  }
};

/// The basis functions that are not 0 at a parameter, from number `first` on.
struct Basis {
  float parameter = 0;
  size_t first = 0;
  std::vector<double> value, slope;
};

/// Along one side of the patch; checks its parameters.
class Axis {
 public:
  Axis(const AxisParameters& p, const char* name, const ShapeContext& context)
      : p_(p), location_(context.location) {
    if (p.count < 2 || p.order < 2)
      fail(fmt::format("\"integer n{0}\" and \"integer {0}order\" are missing", name));
    if (p.count < p.order)
      fail(fmt::format("n{0} is {1}, less than {0}order {2}", name, p.count, p.order));
    const size_t wanted = count() + order();
    if (p.knots.size() != wanted)
      fail(fmt::format("{0} {1}knots; n{1} + {1}order are {2}", p.knots.size(), name, wanted));
    for (size_t i = 0; i < wanted; ++i)
      if (!std::isfinite(p.knots[i]) || (i > 0 && p.knots[i] < p.knots[i - 1]))
        fail(fmt::format("{}knots must be finite and ascend; number {} does not", name, i));
    const float first = p.knots[order() - 1], last = p.knots[count()];
    begin_ = p.begin.value_or(first);
    end_ = p.end.value_or(last);
    if (!(first < last)) fail(fmt::format("{}knots leave no interval", name));
    if (!(first <= begin_ && begin_ < end_ && end_ <= last))
      fail(fmt::format("{0}0 = {1} and {0}1 = {2} must ascend within [{3}, {4}]", name, begin_,
                       end_, first, last));
  }
  size_t count() const { return static_cast<size_t>(p_.count); }

  std::vector<Basis> dice() const {
    std::vector<Basis> all;
    for (size_t i = 0; i < kDice; ++i)
      all.push_back(basisAt(lerp(static_cast<float>(i) / (kDice - 1), begin_, end_)));
    return all;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw SceneError(location_, "nurbs: " + why);
  }
  size_t order() const { return static_cast<size_t>(p_.order); }
  double knot(size_t i) const { return p_.knots[i]; }

  Basis basisAt(float t) const {
    const auto begin = p_.knots.begin();
    const auto above = std::upper_bound(begin, p_.knots.end(), t);
    auto span = std::clamp(static_cast<size_t>(above - begin), order(), count()) - 1;
    while (span > order() - 1 && p_.knots[span] == p_.knots[span + 1]) --span;
    const size_t degree = order() - 1;
    Basis b{t, span - degree, std::vector<double>(order()), std::vector<double>(order())};
    b.value[0] = 1;
    for (size_t d = 1; d <= degree; ++d) {
      double carried = 0, slopeBefore = 0;
      for (size_t r = 0; r < d; ++r) {
        const double left = knot(span + 1 + r - d), right = knot(span + 1 + r);
        const double share = right > left ? b.value[r] / (right - left) : 0;
        b.value[r] = carried + (right - static_cast<double>(t)) * share;
        carried = (static_cast<double>(t) - left) * share;
        b.slope[r] = static_cast<double>(d) * (slopeBefore - share);
        slopeBefore = share;
      }
      b.value[d] = carried;
      b.slope[d] = static_cast<double>(d) * slopeBefore;
    }
    return b;
  }

  const AxisParameters& p_;
  SourceLocation location_;
  float begin_ = 0, end_ = 1;
};

std::vector<glm::dvec4> controlPoints(const NurbsParameters& p, size_t count,
                                      const ShapeContext& context) {
  std::vector<glm::dvec4> points;
  if (p.points.empty()) {
    for (size_t i = 0; i + 3 < p.weighted.size(); i += 4)
      points.emplace_back(p.weighted[i], p.weighted[i + 1], p.weighted[i + 2], p.weighted[i + 3]);
  } else {
    for (const Vec3& v : p.points) points.emplace_back(v, 1);
  }
  if (points.size() != count || (p.points.empty() && p.weighted.size() % 4))
    throw SceneError(
        context.location,
        fmt::format("nurbs: nu × nv = {} control points are wanted, as \"point P\" or with four "
                    "numbers each as \"float Pw\"; there are {}",
                    count, points.size()));
  return points;
}

std::unique_ptr<Shape> create(const NurbsParameters& p, const ShapeContext& context) {
  const Axis u(p.u, "u", context), v(p.v, "v", context);
  const auto points = controlPoints(p, u.count() * v.count(), context);
  const std::vector<Basis> alongU = u.dice(), alongV = v.dice();
  TriangleMeshData data;
  for (const Basis& bv : alongV) {
    for (const Basis& bu : alongU) {
      glm::dvec4 at(0), du(0), dv(0);
      for (size_t j = 0; j < bv.value.size(); ++j) {
        for (size_t i = 0; i < bu.value.size(); ++i) {
          const glm::dvec4& c = points[(bv.first + j) * u.count() + bu.first + i];
          at += bu.value[i] * bv.value[j] * c;
          du += bu.slope[i] * bv.value[j] * c;
          dv += bu.value[i] * bv.slope[j] * c;
        }
      }
      // From homogeneous coordinates; the derivatives but for a factor 1 / w², which is > 0.
      const glm::dvec3 position = glm::dvec3(at) / at.w;
      const glm::dvec3 dpdu = glm::dvec3(du) - du.w * position;
      const glm::dvec3 dpdv = glm::dvec3(dv) - dv.w * position;
      data.positions.emplace_back(position);
      data.normals.push_back(normalize(Vec3(glm::cross(dpdu, dpdv))));
      data.uvs.emplace_back(bu.parameter, bv.parameter);
    }
  }
  data.indices = gridTriangles(kDice, kDice);
  return makeTriangleMesh(std::move(data), context, "nurbs");
}

}  // namespace

ShapeRegistry::Entry nurbsPlugin() { return makePlugin("nurbs", "NURBS patch.", create); }

}  // namespace lampyris
