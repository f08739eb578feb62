// SPDX-License-Identifier: Apache-2.0
#include "core/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

#include "core/parameter_values.h"

namespace lampyris {

namespace {

constexpr std::array<std::string_view, 14> kTypeNames = {
    "integer", "float",  "bool", "string", "point2",   "vector2",   "point",
    "vector",  "normal", "rgb",  "xyz",    "spectrum", "blackbody", "texture"};

std::string text(int v) { return fmt::format("{}", v); }
std::string text(float v) { return fmt::format("{}", v); }
std::string text(bool v) { return v ? "true" : "false"; }
std::string text(const std::string& v) { return fmt::format("\"{}\"", v); }
std::string text(const Vec2& v) { return fmt::format("[{} {}]", v.x, v.y); }
std::string text(const Vec3& v) { return fmt::format("[{} {} {}]", v.x, v.y, v.z); }
std::string text(const Rgb& v) { return fmt::format("[{} {} {}]", v.r, v.g, v.b); }

}  // namespace

std::string_view typeName(ParameterType type) { return kTypeNames[static_cast<size_t>(type)]; }

std::optional<ParameterType> typeFromName(std::string_view name) {
  if (name == "color") return ParameterType::Rgb;
  if (name == "point3") return ParameterType::Point3;
  if (name == "vector3") return ParameterType::Vector3;
  if (name == "normal3") return ParameterType::Normal;
  for (size_t i = 0; i < kTypeNames.size(); ++i)
    if (kTypeNames[i] == name) return static_cast<ParameterType>(i);
  return std::nullopt;
}

const Parameter* ParameterSet::find(std::string_view name) const {
  for (size_t i = parameters.size(); i-- > 0;)
    if (parameters[i].name == name) return &parameters[i];
  return nullptr;
}

std::string ParameterDeclaration::typeText() const {
  if (exactType) return std::string(typeName(*exactType));
  switch (target) {
    case TargetType::Int:
    case TargetType::IntList:
      return "integer";
    case TargetType::Float:
    case TargetType::FloatList:
      return "float";
    case TargetType::Bool:
      return "bool";
    case TargetType::String:
    case TargetType::StringList:
      return "string";
    case TargetType::Vec2:
    case TargetType::Vec2List:
      return "point2";
    case TargetType::Vec3:
    case TargetType::Vec3List:
      return "point";
    case TargetType::Rgb:
      return "rgb (or xyz, spectrum, blackbody)";
    case TargetType::FloatInput:
      return "float or texture";
    case TargetType::RgbInput:
      return "rgb (or xyz, spectrum, blackbody) or texture";
  }
  return "";
}

std::string ParameterDeclaration::rangeText() const {
  if (!rangeWords.empty()) return rangeWords;
  if (!choices.empty()) return fmt::format("one of {}", fmt::join(choices, ", "));
  if (target == TargetType::Bool) return "true or false";
  const bool low = std::isfinite(min), high = std::isfinite(max);
  if (low && high) return fmt::format("{} to {}{}", min, max, clamped ? " (clamped)" : "");
  if (low && clamped) return fmt::format("at least {0} (less counts as {0})", min);
  if (low) return fmt::format("at least {}", min);
  return high ? fmt::format("at most {}", max) : "";
}

bool ParameterDeclaration::matches(std::string_view n) const {
  if (name == n) return true;
  return std::any_of(aliases.begin(), aliases.end(), [n](const std::string& a) { return a == n; });
}

// Not inline: GCC 12 at -O3 sees overflows in them that are not there.
DeclarationHandle& DeclarationHandle::alias(std::string name) {
  d_.aliases.push_back(std::move(name));
  return *this;
}

DeclarationHandle& DeclarationHandle::rangeIs(std::string text) {
  d_.rangeWords = std::move(text);
  return *this;
}

DeclarationHandle Declaration::push(std::string name, TargetType target, bool optional,
                                    const void* member, std::string defaultText, std::string doc) {
  const std::ptrdiff_t offset = static_cast<const char*>(member) - object_;
  assert(offset >= 0 && static_cast<size_t>(offset) < size_ && "not a member of the struct");
  ParameterDeclaration d;
  d.name = std::move(name);
  d.target = target;
  d.optional = optional;
  d.offset = static_cast<size_t>(offset);
  d.doc = std::move(doc);
  d.defaultText = std::move(defaultText);
  return DeclarationHandle(declarations_.emplace_back(std::move(d)));
}

DeclarationHandle Declaration::add(std::string name, int& m, std::string doc) {
  return push(std::move(name), TargetType::Int, false, &m, text(m), std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, float& m, std::string doc) {
  return push(std::move(name), TargetType::Float, false, &m, text(m), std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, bool& m, std::string doc) {
  return push(std::move(name), TargetType::Bool, false, &m, text(m), std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::string& m, std::string doc) {
  return push(std::move(name), TargetType::String, false, &m, text(m), std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, Vec2& m, std::string doc) {
  return push(std::move(name), TargetType::Vec2, false, &m, text(m), std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, Vec3& m, std::string doc) {
  return push(std::move(name), TargetType::Vec3, false, &m, text(m), std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, Rgb& m, std::string doc) {
  return push(std::move(name), TargetType::Rgb, false, &m, text(m), std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, FloatInput& m, std::string doc) {
  return push(std::move(name), TargetType::FloatInput, false, &m, text(m.value), std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, RgbInput& m, std::string doc) {
  return push(std::move(name), TargetType::RgbInput, false, &m, text(m.value), std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::vector<int>& m, std::string doc) {
  return push(std::move(name), TargetType::IntList, false, &m, "[]", std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::vector<float>& m, std::string doc) {
  return push(std::move(name), TargetType::FloatList, false, &m, "[]", std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::vector<std::string>& m, std::string doc) {
  return push(std::move(name), TargetType::StringList, false, &m, "[]", std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::vector<Vec2>& m, std::string doc) {
  return push(std::move(name), TargetType::Vec2List, false, &m, "[]", std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::vector<Vec3>& m, std::string doc) {
  return push(std::move(name), TargetType::Vec3List, false, &m, "[]", std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::optional<int>& m, std::string doc) {
  return push(std::move(name), TargetType::Int, true, &m, "not set", std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::optional<float>& m, std::string doc) {
  return push(std::move(name), TargetType::Float, true, &m, "not set", std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::optional<bool>& m, std::string doc) {
  return push(std::move(name), TargetType::Bool, true, &m, "not set", std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::optional<std::string>& m,
                                   std::string doc) {
  return push(std::move(name), TargetType::String, true, &m, "not set", std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::optional<Rgb>& m, std::string doc) {
  return push(std::move(name), TargetType::Rgb, true, &m, "not set", std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::optional<FloatInput>& m,
                                   std::string doc) {
  return push(std::move(name), TargetType::FloatInput, true, &m, "not set", std::move(doc));
}
DeclarationHandle Declaration::add(std::string name, std::optional<RgbInput>& m, std::string doc) {
  return push(std::move(name), TargetType::RgbInput, true, &m, "not set", std::move(doc));
}

void Declaration::ignored(std::string name, std::string reason) {
  ParameterDeclaration d;
  d.name = std::move(name);
  d.target = TargetType::String;
  d.ignoredBecause = std::move(reason);
  declarations_.push_back(std::move(d));
}

const ParameterDeclaration* Schema::find(std::string_view name) const {
  for (const auto& d : declarations_)
    if (d.matches(name)) return &d;
  return nullptr;
}

std::vector<std::string> Schema::names() const {
  std::vector<std::string> all;
  for (const auto& d : declarations_) {
    all.push_back(d.name);
    all.insert(all.end(), d.aliases.begin(), d.aliases.end());
  }
  return all;
}

void Schema::read(const ParameterSet& set, void* object) const {
  for (const Parameter& p : set.parameters) {
    const ParameterDeclaration* d = find(p.name);
    if (d && d->ignoredBecause.empty()) readParameter(*d, p, object);
  }
}

namespace {
template <class T>
std::vector<T> parseNumbers(std::string_view name, std::string_view words) {
  std::vector<T> out;
  const char* at = words.data();
  const char* const end = at + words.size();
  while (true) {
    while (at != end && (*at == ' ' || *at == ',')) ++at;
    if (at == end) return out;
    T v{};
    const auto [next, error] = std::from_chars(at, end, v);
    if (error != std::errc() || (next != end && *next != ' ' && *next != ','))
      throw SceneError(fmt::format("-D {}: \"{}\" is not {}", name, words,
                                   std::is_integral_v<T> ? "an integer" : "a number"));
    out.push_back(v);
    at = next;
  }
}
}  // namespace

std::unique_ptr<OwnedParameter> parseOverride(const ParameterDeclaration& d,
                                              std::string_view value) {
  auto owned = std::make_unique<OwnedParameter>();
  owned->name = d.name;
  Parameter& p = owned->parameter;
  switch (d.target) {
    case TargetType::Int:
    case TargetType::IntList:
      p.type = ParameterType::Integer;
      owned->integers = parseNumbers<int32_t>(d.name, value);
      break;
    case TargetType::Bool:
      if (value != "true" && value != "false")
        throw SceneError(fmt::format("-D {}: expected true or false, got \"{}\"", d.name, value));
      [[fallthrough]];
    case TargetType::String:
    case TargetType::StringList:
      p.type = d.target == TargetType::Bool ? ParameterType::Bool : ParameterType::String;
      owned->strings.emplace_back(value);
      break;
    case TargetType::Vec2:
    case TargetType::Vec2List:
      p.type = d.exactType.value_or(ParameterType::Point2);
      break;
    case TargetType::Vec3:
    case TargetType::Vec3List:
      p.type = d.exactType.value_or(ParameterType::Point3);
      break;
    case TargetType::Rgb:
    case TargetType::RgbInput:
      p.type = ParameterType::Rgb;
      break;
    default:
      p.type = ParameterType::Float;
  }
  if (p.type != ParameterType::Integer && owned->strings.empty())
    owned->floats = parseNumbers<float>(d.name, value);
  owned->views.assign(owned->strings.begin(), owned->strings.end());
  p.name = owned->name;
  p.floats = owned->floats;
  p.integers = owned->integers;
  p.strings = owned->views;
  return owned;
}

}  // namespace lampyris
