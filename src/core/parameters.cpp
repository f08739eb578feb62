// SPDX-License-Identifier: Apache-2.0
#include "core/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

#include "core/spectrum.h"

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
    case TargetType::IntList: return t == P::Integer;
    case TargetType::Float:
    case TargetType::FloatList: return t == P::Float || t == P::Integer;
    case TargetType::Bool: return t == P::Bool;
    case TargetType::String:
    case TargetType::StringList: return t == P::String;
    case TargetType::Vec2:
    case TargetType::Vec2List:
      return t == P::Point2 || t == P::Vector2 || t == P::Float;
    case TargetType::Vec3:
    case TargetType::Vec3List: return t == P::Point3 || t == P::Vector3 || t == P::Normal;
    case TargetType::Rgb: return isColour(t);
    case TargetType::FloatInput: return t == P::Float || t == P::Integer || t == P::Texture;
    case TargetType::RgbInput: return isColour(t) || t == P::Texture;
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
      if (v.size() != 2) fail(p, fmt::format("expected temperature and scale, got {} values", v.size()));
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

void checkRange(const ParameterDeclaration& d, const Parameter& p, double v) {
  if (!(v >= d.min && v <= d.max)) {
    if (d.max >= 1e300) fail(p, fmt::format("{} is below {}", v, d.min));
    if (d.min <= -1e300) fail(p, fmt::format("{} is above {}", v, d.max));
    fail(p, fmt::format("{} is outside [{}, {}]", v, d.min, d.max));
  }
}

/// The member at the declared offset, made present first if it is optional.
template <class T>
T& member(const ParameterDeclaration& d, void* object) {
  void* at = static_cast<char*>(object) + d.offset;
  if (!d.optional) return *static_cast<T*>(at);
  auto& maybe = *static_cast<std::optional<T>*>(at);
  return maybe.emplace();
}

void readFloatInput(const ParameterDeclaration& d, const Parameter& p, FloatInput& out) {
  out = {};
  out.location = p.location;
  if (p.type == ParameterType::Texture) {
    expectCount(p, p.strings.size(), 1);
    out.texture = p.strings[0];
  } else {
    expectCount(p, numberCount(p), 1);
    out.value = floatAt(p, 0);
    checkRange(d, p, static_cast<double>(out.value));
  }
}

void readRgbInput(const Parameter& p, RgbInput& out) {
  out = {};
  out.location = p.location;
  if (p.type == ParameterType::Texture) {
    expectCount(p, p.strings.size(), 1);
    out.texture = p.strings[0];
  } else {
    out.value = readRgb(p);
  }
}

void readList(const ParameterDeclaration& d, const Parameter& p, void* object) {
  switch (d.target) {
    case TargetType::IntList:
      for (const int32_t v : p.integers) checkRange(d, p, v);
      member<std::vector<int>>(d, object).assign(p.integers.begin(), p.integers.end());
      return;
    case TargetType::FloatList: {
      auto& out = member<std::vector<float>>(d, object);
      out.resize(numberCount(p));
      for (size_t i = 0; i < out.size(); ++i) {
        out[i] = floatAt(p, i);
        checkRange(d, p, static_cast<double>(out[i]));
      }
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

void readOne(const ParameterDeclaration& d, const Parameter& p, void* object) {
  if (!accepts(d, p.type)) fail(p, fmt::format("expected {}, got {}", d.typeText(), typeName(p.type)));
  checkValues(p);
  switch (d.target) {
    case TargetType::Int:
      expectCount(p, p.integers.size(), 1);
      checkRange(d, p, p.integers[0]);
      member<int>(d, object) = p.integers[0];
      return;
    case TargetType::Float:
      expectCount(p, numberCount(p), 1);
      checkRange(d, p, static_cast<double>(floatAt(p, 0)));
      member<float>(d, object) = floatAt(p, 0);
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
    case TargetType::Rgb: member<Rgb>(d, object) = readRgb(p); return;
    case TargetType::FloatInput: readFloatInput(d, p, member<FloatInput>(d, object)); return;
    case TargetType::RgbInput: readRgbInput(p, member<RgbInput>(d, object)); return;
    default: readList(d, p, object);
  }
}

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
    case TargetType::IntList: return "integer";
    case TargetType::Float:
    case TargetType::FloatList: return "float";
    case TargetType::Bool: return "bool";
    case TargetType::String:
    case TargetType::StringList: return "string";
    case TargetType::Vec2:
    case TargetType::Vec2List: return "point2";
    case TargetType::Vec3:
    case TargetType::Vec3List: return "point";
    case TargetType::Rgb: return "rgb (or xyz, spectrum, blackbody)";
    case TargetType::FloatInput: return "float or texture";
    case TargetType::RgbInput: return "rgb (or xyz, spectrum, blackbody) or texture";
  }
  return "";
}

bool ParameterDeclaration::matches(std::string_view n) const {
  if (name == n) return true;
  return std::any_of(aliases.begin(), aliases.end(), [n](const std::string& a) { return a == n; });
}

// Not inline: GCC 12 at -O3 sees an overflow in it that is not there.
DeclarationHandle& DeclarationHandle::alias(std::string name) {
  d_.aliases.push_back(std::move(name));
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
    if (d && d->ignoredBecause.empty()) readOne(*d, p, object);
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
    case TargetType::Vec2List: p.type = d.exactType.value_or(ParameterType::Point2); break;
    case TargetType::Vec3:
    case TargetType::Vec3List: p.type = d.exactType.value_or(ParameterType::Point3); break;
    case TargetType::Rgb:
    case TargetType::RgbInput: p.type = ParameterType::Rgb; break;
    default: p.type = ParameterType::Float;
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
