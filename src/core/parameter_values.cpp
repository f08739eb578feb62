// SPDX-License-Identifier: Apache-2.0
#include "core/parameter_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/spectrum.h"

namespace lampyris {

namespace {

bool isColour(ParameterType t) {
  return t == ParameterType::Rgb || t == ParameterType::Xyz || t == ParameterType::Spectrum ||
         t == ParameterType::Blackbody;
}

[[noreturn]] void fail(const Parameter& p, const std::string& why) {
  throw SceneError(p.location, fmt::format("parameter \"{}\": {}", p.name, why));
}

/// True if a parameter of type `t` may be written into the target.
bool accepts(const ParameterDeclaration& d, ParameterType t) {
  using P = ParameterType;
  if (d.exactType) return t == *d.exactType;
  switch (d.target) {
    case TargetType::Int:
    case TargetType::IntList:
      return t == P::Integer;
    case TargetType::Float:
    case TargetType::FloatList:
      return t == P::Float || t == P::Integer;
    case TargetType::Bool:
      return t == P::Bool;
    case TargetType::String:
    case TargetType::StringList:
      return t == P::String;
    case TargetType::Vec2:
    case TargetType::Vec2List:
      return t == P::Point2 || t == P::Vector2 || t == P::Float;
    case TargetType::Vec3:
    case TargetType::Vec3List:
      return t == P::Point3 || t == P::Vector3 || t == P::Normal;
    case TargetType::Rgb:
      return isColour(t);
    case TargetType::FloatInput:
      return t == P::Float || t == P::Integer || t == P::Texture;
    case TargetType::RgbInput:
      return isColour(t) || t == P::Texture;
  }
  return false;
}

Rgb readRgb(const Parameter& p) {
  const auto v = p.floats;
  switch (p.type) {
    case ParameterType::Rgb:
      if (v.size() != 3) fail(p, fmt::format("expected 3 values, got {}", v.size()));
      return {v[0], v[1], v[2]};
    case ParameterType::Xyz:
      if (v.size() != 3) fail(p, fmt::format("expected 3 values, got {}", v.size()));
      return xyzToRgb(Vec3(v[0], v[1], v[2]));
    case ParameterType::Blackbody:
      if (v.size() != 2)
        fail(p, fmt::format("expected temperature and scale, got {} values", v.size()));
      return blackbodyRgb(v[0]) * v[1];
    default:
      if (v.size() < 2 || v.size() % 2)
        fail(p, fmt::format("expected wavelength, value pairs, got {} values", v.size()));
      return spectrumToRgb(v);
  }
}

float floatAt(const Parameter& p, size_t i) {
  return p.type == ParameterType::Integer ? static_cast<float>(p.integers[i]) : p.floats[i];
}
size_t numberCount(const Parameter& p) {
  return p.type == ParameterType::Integer ? p.integers.size() : p.floats.size();
}

void expectCount(const Parameter& p, size_t got, size_t want) {
  if (got != want)
    fail(p, fmt::format("expected {} value{}, got {}", want, want == 1 ? "" : "s", got));
}

/// The value, in its range: a float at an end is inside however the end is rounded.
template <class T>
T inRange(const ParameterDeclaration& d, const Parameter& p, T v) {
  using Wide = std::conditional_t<std::is_integral_v<T>, double, T>;
  const auto min = static_cast<Wide>(d.min), max = static_cast<Wide>(d.max);
  const auto wide = static_cast<Wide>(v);
  if (wide >= min && wide <= max) return v;
  if (d.clamped) return static_cast<T>(std::clamp(wide, min, max));
  if (std::isinf(d.max)) fail(p, fmt::format("{} is below {}", v, d.min));
  if (std::isinf(d.min)) fail(p, fmt::format("{} is above {}", v, d.max));
  fail(p, fmt::format("{} is outside [{}, {}]", v, d.min, d.max));
}
Rgb inRange(const ParameterDeclaration& d, const Parameter& p, const Rgb& c) {
  return {inRange(d, p, c.r), inRange(d, p, c.g), inRange(d, p, c.b)};
}

/// The member at the declared offset, made present first if it is optional.
template <class T>
T& member(const ParameterDeclaration& d, void* object) {
  void* at = static_cast<char*>(object) + d.offset;
  if (!d.optional) return *static_cast<T*>(at);
  auto& maybe = *static_cast<std::optional<T>*>(at);
  return maybe.emplace();
}

/// Sets what a constant and a texture have in common; true: it is a texture.
template <class Input>
bool readTexture(const Parameter& p, Input& out) {
  out = {};
  out.location = p.location;
  if (p.type != ParameterType::Texture) return false;
  expectCount(p, p.strings.size(), 1);
  out.texture = p.strings[0];
  return true;
}

void readFloatInput(const ParameterDeclaration& d, const Parameter& p, FloatInput& out) {
  if (readTexture(p, out)) return;
  expectCount(p, numberCount(p), 1);
  out.value = inRange(d, p, floatAt(p, 0));
}

void readRgbInput(const ParameterDeclaration& d, const Parameter& p, RgbInput& out) {
  if (!readTexture(p, out)) out.value = inRange(d, p, readRgb(p));
}

void readList(const ParameterDeclaration& d, const Parameter& p, void* object) {
  switch (d.target) {
    case TargetType::IntList: {
      auto& out = member<std::vector<int>>(d, object);
      out.assign(p.integers.begin(), p.integers.end());
      for (int& v : out) v = inRange(d, p, v);
      return;
    }
    case TargetType::FloatList: {
      auto& out = member<std::vector<float>>(d, object);
      out.resize(numberCount(p));
      for (size_t i = 0; i < out.size(); ++i) out[i] = inRange(d, p, floatAt(p, i));
      return;
    }
    case TargetType::StringList:
      member<std::vector<std::string>>(d, object).assign(p.strings.begin(), p.strings.end());
      return;
    case TargetType::Vec2List: {
      if (p.floats.size() % 2)
        fail(p, fmt::format("expected pairs, got {} values", p.floats.size()));
      auto& out = member<std::vector<Vec2>>(d, object);
      out.resize(p.floats.size() / 2);
      for (size_t i = 0; i < out.size(); ++i) out[i] = {p.floats[2 * i], p.floats[2 * i + 1]};
      return;
    }
    default: {
      if (p.floats.size() % 3)
        fail(p, fmt::format("expected triples, got {} values", p.floats.size()));
      auto& out = member<std::vector<Vec3>>(d, object);
      out.resize(p.floats.size() / 3);
      for (size_t i = 0; i < out.size(); ++i)
        out[i] = {p.floats[3 * i], p.floats[3 * i + 1], p.floats[3 * i + 2]};
    }
  }
}

/// What no target can make sense of.
void checkValues(const Parameter& p) {
  for (const float v : p.floats)
    if (!std::isfinite(v)) fail(p, fmt::format("{} is not a finite number", v));
  if (p.type != ParameterType::Bool) return;
  for (const std::string_view v : p.strings)
    if (v != "true" && v != "false") fail(p, fmt::format("expected true or false, got \"{}\"", v));
}

}  // namespace

void readParameter(const ParameterDeclaration& d, const Parameter& p, void* object) {
  if (!accepts(d, p.type))
    fail(p, fmt::format("expected {}, got {}", d.typeText(), typeName(p.type)));
  checkValues(p);
  switch (d.target) {
    case TargetType::Int:
      expectCount(p, p.integers.size(), 1);
      member<int>(d, object) = inRange(d, p, p.integers[0]);
      return;
    case TargetType::Float:
      expectCount(p, numberCount(p), 1);
      member<float>(d, object) = inRange(d, p, floatAt(p, 0));
      return;
    case TargetType::Bool:
      expectCount(p, p.strings.size(), 1);
      member<bool>(d, object) = p.strings[0] == "true";
      return;
    case TargetType::String: {
      expectCount(p, p.strings.size(), 1);
      const std::string v(p.strings[0]);
      if (!d.choices.empty() && std::find(d.choices.begin(), d.choices.end(), v) == d.choices.end())
        fail(p, fmt::format("unknown value \"{}\", expected one of {}{}", v,
                            fmt::join(d.choices, ", "), didYouMean(v, d.choices)));
      member<std::string>(d, object) = v;
      return;
    }
    case TargetType::Vec2:
      expectCount(p, p.floats.size(), 2);
      member<Vec2>(d, object) = {p.floats[0], p.floats[1]};
      return;
    case TargetType::Vec3:
      expectCount(p, p.floats.size(), 3);
      member<Vec3>(d, object) = {p.floats[0], p.floats[1], p.floats[2]};
      return;
    case TargetType::Rgb:
      member<Rgb>(d, object) = inRange(d, p, readRgb(p));
      return;
    case TargetType::FloatInput:
      readFloatInput(d, p, member<FloatInput>(d, object));
      return;
    case TargetType::RgbInput:
      readRgbInput(d, p, member<RgbInput>(d, object));
      return;
    default:
      readList(d, p, object);
  }
}

}  // namespace lampyris
