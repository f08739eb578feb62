// SPDX-License-Identifier: Apache-2.0
/// The directives of a scene file, one member function each.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/graphics_state.h"
#include "scene/parameter_reader.h"
#include "scene/tokenizer.h"

namespace lampyris {

/// Carries out directives on a graphics state and writes what results into a description.
class WorldParser {
 public:
  WorldParser(Description& description, std::string folder, SourceFiles& files,
              Diagnostics& diagnostics);
  /// Reads the file and what it includes, up to WorldEnd.
  void run(uint16_t mainFile);

 private:
  /// Where a directive may stand.
  enum class Block : uint8_t { Any, Options, World };
  struct Directive {
    std::string_view name;
    Block block;
    void (WorldParser::*carryOut)();
  };
  static std::span<const Directive> directives();
  static const Directive* findDirective(std::string_view name);

  // world_parser.cpp
  void parseFile(uint16_t file);
  void parseDirective();
  [[noreturn]] void failNoDirective(std::string_view word);
  void include();
  void worldBegin();
  void worldEnd();
  void attributeBegin();
  void attributeEnd();
  void transformBegin();
  void transformEnd();
  void objectBegin();
  void objectEnd();
  void openBlock(OpenBlock::Kind kind);
  void closeBlock(OpenBlock::Kind kind);

  // transform_directives.cpp
  template <size_t N>
  std::array<float, N> numbers();
  void identity();
  void translate();
  void scale();
  void rotate();
  void lookAt();
  void transform();
  void concatTransform();
  void coordinateSystem();
  void coordSysTransform();
  void activeTransform();
  void transformTimes();
  Transform matrix();

  // scene_directives.cpp
  void camera();
  void film();
  void pixelFilter();
  void sampler();
  void integrator();
  void accelerator();
  void makeNamedMedium();
  void mediumInterface();
  void makeNamedMaterial();
  void namedMaterial();
  void material();
  void texture();
  void lightSource();
  void areaLightSource();
  void shape();
  void reverseOrientation();
  void objectInstance();
  PluginUse pluginUse();
  PluginUse namedPluginUse(const char* kind);
  ParameterSet parameters();

  /// Takes a quoted string: the directive's argument called `what` in messages.
  std::string_view stringArgument(const char* what);
  [[noreturn]] void fail(const std::string& message) const { throw SceneError(at_, message); }
  bool inObject() const { return object_ != kNone; }
  uint32_t transformIndex() { return pool_.indexOf(state_.transform, at_); }

  Description& out_;
  std::string folder_;
  SourceFiles& files_;
  Diagnostics& diagnostics_;
  ParameterReader reader_;
  TransformPool pool_;

  Tokenizer* in_ = nullptr;  ///< of the file being read
  SourceLocation at_;        ///< of the directive being carried out
  const Directive* directive_ = nullptr;
  std::vector<std::string> openFiles_;
  std::map<std::string, uint16_t, std::less<>> knownFiles_;
  size_t includes_ = 0;
  bool worldBegun_ = false, worldEnded_ = false;

  GraphicsState state_;
  std::vector<OpenBlock> blocks_;
  std::map<std::string, TransformPair, std::less<>> coordinateSystems_;
  std::map<std::string_view, uint32_t> objects_;
  uint32_t object_ = kNone;  ///< the definition that is open
  uint32_t order_ = 1;       ///< 0 is before the file
};

}  // namespace lampyris
