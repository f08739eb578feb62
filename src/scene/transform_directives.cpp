// SPDX-License-Identifier: Apache-2.0
// Directives that change the current transform.
#include <fmt/format.h>

#include "scene/world_parser.h"

namespace lampyris {

template <size_t N>
std::array<float, N> WorldParser::numbers() {
  // pbrt-v3 wants brackets around matrices only; either way is read everywhere.
  const bool brackets = in_->peek() == TokenKind::Open;
  if (brackets) in_->skipBracket();
  std::array<float, N> values{};
  for (size_t i = 0; i < N; ++i) {
    if (in_->peek() != TokenKind::Word || !in_->atNumber())
      throw SceneError(in_->location(), fmt::format("{} expects {} numbers, got {} after {}",
                                                    directive_->name, N, in_->describe(), i));
    values[i] = in_->readFloat();
  }
  if (brackets) {
    if (in_->peek() != TokenKind::Close)
      throw SceneError(in_->location(), fmt::format("{} expects ] after {} numbers, got {}",
                                                    directive_->name, N, in_->describe()));
    in_->skipBracket();
  }
  return values;
}

void WorldParser::identity() { state_.transform.set(Transform()); }

void WorldParser::translate() {
  const auto v = numbers<3>();
  state_.transform.concatenate(Transform::translate({v[0], v[1], v[2]}));
}

void WorldParser::scale() {
  const auto v = numbers<3>();
  if (v[0] == 0 || v[1] == 0 || v[2] == 0) fail("Scale by 0 leaves nothing to see");
  state_.transform.concatenate(Transform::scale({v[0], v[1], v[2]}));
}

void WorldParser::rotate() {
  const auto v = numbers<4>();
  const Vec3 axis(v[1], v[2], v[3]);
  if (axis == Vec3(0)) fail("Rotate needs an axis other than 0 0 0");
  state_.transform.concatenate(Transform::rotate(v[0], axis));
}

void WorldParser::lookAt() {
  const auto v = numbers<9>();
  const Transform t = Transform::lookAt({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]});
  if (t.isSingular())
    fail("LookAt needs an eye and a target that differ, and an up vector across the line of sight");
  state_.transform.concatenate(t);
}

Transform WorldParser::matrix() {
  const auto v = numbers<16>();
  // As in pbrt-v3, column after column; GLM's order as well.
  glm::mat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = v[static_cast<size_t>(i)];
  if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] == 0)
    fail(
        fmt::format("{} by a projective matrix: its 4th, 8th and 12th numbers must be 0, its "
                    "16th must not",
                    directive_->name));
  if (m[3][3] != 1) m /= m[3][3];
  const Transform t(m);
  if (t.isSingular()) fail(fmt::format("{} by a matrix that has no inverse", directive_->name));
  return t;
}

void WorldParser::transform() { state_.transform.set(matrix()); }
void WorldParser::concatTransform() { state_.transform.concatenate(matrix()); }

void WorldParser::coordinateSystem() {
  coordinateSystems_[std::string(stringArgument("a coordinate system's name"))] =
      state_.transform.ctm;
}

void WorldParser::coordSysTransform() {
  const std::string_view name = stringArgument("a coordinate system's name");
  const auto known = coordinateSystems_.find(name);
  if (known == coordinateSystems_.end()) {
    std::vector<std::string> names;
    for (const auto& entry : coordinateSystems_) names.push_back(entry.first);
    fail(fmt::format("unknown coordinate system {}{}", inQuotes(name), didYouMean(name, names)));
  }
  state_.transform.ctm = known->second;
  state_.transform.index = kNone;
}

void WorldParser::activeTransform() {
  const bool isWord = in_->peek() == TokenKind::Word;
  const SourceLocation where = in_->location();
  const std::string got = in_->describe();
  const std::string_view word = isWord ? in_->readWord() : "";
  if (word != "StartTime" && word != "EndTime" && word != "All")
    throw SceneError(where,
                     fmt::format("ActiveTransform expects StartTime, EndTime or All, got {}", got));
  state_.transform.startActive = word != "EndTime";
  state_.transform.endActive = word != "StartTime";
}

void WorldParser::transformTimes() {
  const auto v = numbers<2>();
  if (!(v[0] <= v[1])) fail("TransformTimes expects the earlier time first");
  out_.transformTimes[0] = v[0];
  out_.transformTimes[1] = v[1];
}

}  // namespace lampyris
