// SPDX-License-Identifier: Apache-2.0
/// Parameters: the `"type name" value` lists of a scene file, and the schemas that plugins declare.
///
/// A plugin's parameters are a plain struct whose member initialisers are the defaults, with
///
///     void declare(Declaration& d) {
///       d.add("maxdepth", maxDepth, "Longest path, in bounces.").range(0, 1e6);
///     }
///
/// Reading, range checks, messages, `help-scene` and the reference page all come from it.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/rgb.h"
#include "core/vector.h"

namespace lampyris {

/// Types as written in scene files. `color` is read as Rgb, `point`/`vector` as Point3/Vector3.
enum class ParameterType : uint8_t {
  Integer,
  Float,
  Bool,
  String,
  Point2,
  Vector2,
  Point3,
  Vector3,
  Normal,
  Rgb,
  Xyz,
  Spectrum,
  Blackbody,
  Texture
};
/// The spelling in a scene file, e.g. "integer".
std::string_view typeName(ParameterType type);
/// The type of a spelling (aliases too), if it is one.
std::optional<ParameterType> typeFromName(std::string_view name);

/// One parameter of a scene file. The views point into storage of the description that holds it.
/// Numbers are in `integers` for Integer, else in `floats` (as written: XYZ not converted, a
/// spectrum, from files too, as λ, value pairs); Bool, String and Texture are in `strings`.
struct Parameter {
  std::string_view name;
  SourceLocation location;  ///< of the declaration string
  ParameterType type = ParameterType::Float;
  std::span<const float> floats{};
  std::span<const int32_t> integers{};
  std::span<const std::string_view> strings{};
};

/// The parameters of one directive. A view; a name that stands twice counts where it stands last.
struct ParameterSet {
  std::span<const Parameter> parameters;
  SourceLocation location;  ///< of the directive

  const Parameter* find(std::string_view name) const;
};

/// A float or a spectrum that may be a texture: a constant, or a texture's name.
struct FloatInput {
  float value = 0;
  std::string texture;  ///< empty: `value` counts
  SourceLocation location;
  FloatInput() = default;
  FloatInput(float v) : value(v) {}  // NOLINT(google-explicit-constructor): a default value
};
struct RgbInput {
  Rgb value;
  std::string texture;
  SourceLocation location;
  RgbInput() = default;
  RgbInput(const Rgb& v) : value(v) {}  // NOLINT(google-explicit-constructor): a default value
  RgbInput(float v) : value(v) {}       // NOLINT(google-explicit-constructor): a default value
};

/// What a parameter is read into.
enum class TargetType : uint8_t {
  Int,
  Float,
  Bool,
  String,
  Vec2,
  Vec3,
  Rgb,
  FloatInput,
  RgbInput,
  IntList,
  FloatList,
  StringList,
  Vec2List,
  Vec3List
};

/// One declared parameter.
struct ParameterDeclaration {
  std::string name;
  TargetType target;
  bool optional = false;  ///< the member is a std::optional
  size_t offset = 0;      ///< of the member in its struct, in bytes
  /// For Vec2/Vec3 targets and their lists: what the file must call it (point, vector, normal …).
  std::optional<ParameterType> exactType;
  std::string doc;
  std::string defaultText;  ///< for people
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool clamped = false;  ///< what is outside counts as the nearest end; else it is an error
  std::vector<std::string> choices;
  std::vector<std::string> aliases;
  std::string rangeWords;      ///< for people; empty: the members above say it all
  std::string ignoredBecause;  ///< not empty: accepted, warned of once, not read

  /// What the file may write for it, e.g. "float" or "rgb, xyz, spectrum, blackbody or texture".
  std::string typeText() const;
  /// Which values it takes, e.g. "at least 0"; empty if nothing was declared of it.
  std::string rangeText() const;
  bool matches(std::string_view n) const;
};

/// A mutable handle to the declaration just added.
class DeclarationHandle {
 public:
  explicit DeclarationHandle(ParameterDeclaration& d) : d_(d) {}
  DeclarationHandle& range(double min, double max) { return d_.min = min, d_.max = max, *this; }
  DeclarationHandle& atLeast(double min) { return d_.min = min, *this; }
  /// Values outside, also components of colours, count as the nearest end.
  DeclarationHandle& clamped(double min, double max = std::numeric_limits<double>::infinity()) {
    return d_.clamped = true, range(min, max);
  }
  DeclarationHandle& any() { return rangeIs("any"); }
  /// Says the range in words: what numbers and choices don't tell, and whoever reads it checks.
  DeclarationHandle& rangeIs(std::string text);
  DeclarationHandle& oneOf(std::vector<std::string> names) {
    return d_.choices = std::move(names), *this;
  }
  DeclarationHandle& alias(std::string name);
  DeclarationHandle& type(ParameterType t) { return d_.exactType = t, *this; }
  /// Says in words what the default is, where the member's initialiser doesn't.
  DeclarationHandle& defaultIs(std::string text) { return d_.defaultText = std::move(text), *this; }

 private:
  ParameterDeclaration& d_;
};

/// Collects the declarations of one struct. Vec2 and Vec3 members are "point2"/"point" unless
/// `.type(…)` says otherwise.
class Declaration {
 public:
  Declaration(const void* object, size_t size)
      : object_(static_cast<const char*>(object)), size_(size) {}

  DeclarationHandle add(std::string name, int& m, std::string doc);
  DeclarationHandle add(std::string name, float& m, std::string doc);
  DeclarationHandle add(std::string name, bool& m, std::string doc);
  DeclarationHandle add(std::string name, std::string& m, std::string doc);
  DeclarationHandle add(std::string name, Vec2& m, std::string doc);
  DeclarationHandle add(std::string name, Vec3& m, std::string doc);
  DeclarationHandle add(std::string name, Rgb& m, std::string doc);
  DeclarationHandle add(std::string name, FloatInput& m, std::string doc);
  DeclarationHandle add(std::string name, RgbInput& m, std::string doc);
  DeclarationHandle add(std::string name, std::vector<int>& m, std::string doc);
  DeclarationHandle add(std::string name, std::vector<float>& m, std::string doc);
  DeclarationHandle add(std::string name, std::vector<std::string>& m, std::string doc);
  DeclarationHandle add(std::string name, std::vector<Vec2>& m, std::string doc);
  DeclarationHandle add(std::string name, std::vector<Vec3>& m, std::string doc);
  DeclarationHandle add(std::string name, std::optional<int>& m, std::string doc);
  DeclarationHandle add(std::string name, std::optional<float>& m, std::string doc);
  DeclarationHandle add(std::string name, std::optional<bool>& m, std::string doc);
  DeclarationHandle add(std::string name, std::optional<std::string>& m, std::string doc);
  DeclarationHandle add(std::string name, std::optional<Rgb>& m, std::string doc);
  DeclarationHandle add(std::string name, std::optional<FloatInput>& m, std::string doc);
  DeclarationHandle add(std::string name, std::optional<RgbInput>& m, std::string doc);
  /// A parameter of pbrt-v3 that has no meaning here: accepted, with one warning that says why.
  void ignored(std::string name, std::string reason);

  std::vector<ParameterDeclaration> take() { return std::move(declarations_); }

 private:
  DeclarationHandle push(std::string name, TargetType target, bool optional, const void* member,
                         std::string defaultText, std::string doc);
  const char* object_;
  size_t size_;
  std::vector<ParameterDeclaration> declarations_;
};

/// The declared parameters of a plugin.
class Schema {
 public:
  Schema() = default;
  template <class P>
  static Schema of() {
    P prototype;
    Declaration d(&prototype, sizeof prototype);
    prototype.declare(d);
    Schema s;
    s.declarations_ = d.take();
    return s;
  }

  const std::vector<ParameterDeclaration>& declarations() const { return declarations_; }
  const ParameterDeclaration* find(std::string_view name) const;
  /// Names and aliases.
  std::vector<std::string> names() const;

  /// Sets the declared members of `object` (of the struct the schema was made of) that `set` names;
  /// others keep their values. Throws SceneError: wrong type, count, range or choice.
  void read(const ParameterSet& set, void* object) const;

 private:
  std::vector<ParameterDeclaration> declarations_;
};

/// Parses the value of a `-D` override, e.g. "3", "true" or "0.5 0.5 0.5", as `declaration` wants
/// it. `storage` owns what the result points to.
struct OwnedParameter {
  std::string name;
  std::vector<float> floats;
  std::vector<int32_t> integers;
  std::vector<std::string> strings;
  std::vector<std::string_view> views;
  Parameter parameter;
};
std::unique_ptr<OwnedParameter> parseOverride(const ParameterDeclaration& declaration,
                                              std::string_view text);

}  // namespace lampyris
