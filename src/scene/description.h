// SPDX-License-Identifier: Apache-2.0
/// A scene file as plain data: what the world contains, with places in the text.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameters.h"
#include "core/transform.h"
#include "scene/arena.h"
#include "scene/name_index.h"

namespace lampyris {

/// A directive that names a plugin. The directive's place is `parameters.location`.
struct PluginUse {
  std::string_view name;
  ParameterSet parameters{};
};

/// The current transform at the two TransformTimes.
struct TransformPair {
  Transform start, end;
  bool isAnimated() const { return !(start == end); }
};

// Indices: `transform` in Description::transforms; `order` is the place in the sequence of
// directives, at which names are looked up.

struct TextureDefinition {
  std::string_view name;
  PluginUse plugin;
  uint32_t transform = 0, order = 0;
  bool isSpectrum = false;
};

/// Of Material or MakeNamedMaterial; "" and "none" are no surface.
struct MaterialDefinition {
  PluginUse plugin;
  uint32_t order = 0;
};

struct LightDescription {
  PluginUse plugin;
  uint32_t transform = 0, order = 0;
};

struct ShapeDescription {
  PluginUse plugin;
  uint32_t transform = 0, order = 0;
  uint32_t material = 0;       ///< in Description::materials
  uint32_t areaLight = kNone;  ///< in Description::areaLights
  uint32_t mediumInterface = kNone;
  bool reverseOrientation = false;
};

/// Between ObjectBegin and ObjectEnd: shapes [firstShape, lastShape).
struct ObjectDescription {
  std::string_view name;
  SourceLocation location;
  uint32_t firstShape = 0, lastShape = 0;
};

struct InstanceDescription {
  uint32_t object = 0;  ///< in Description::objects
  uint32_t transform = 0;
  SourceLocation location;
};

struct MediumDefinition {
  std::string_view name;
  PluginUse plugin;
  uint32_t transform = 0, order = 0;
};

struct MediumInterfaceDescription {
  std::string_view inside, outside;
  SourceLocation location;
  uint32_t order = 0;
};

/// Movable, not copyable: the views point into its arenas and into the SourceFiles it was read
/// from.
struct Description {
  PluginUse camera, film, filter, sampler, integrator,
      accelerator;               ///< location unknown: not given
  uint32_t cameraTransform = 0;  ///< world to camera
  float transformTimes[2] = {0, 1};

  std::vector<TransformPair> transforms{TransformPair{}};  ///< first the identity
  std::vector<TextureDefinition> textures;
  std::vector<MaterialDefinition> materials{MaterialDefinition{{"matte"}, 0}};
  std::vector<PluginUse> areaLights;
  std::vector<LightDescription> lights;
  std::vector<ShapeDescription> shapes;  ///< those of objects among them
  std::vector<ObjectDescription> objects;
  std::vector<InstanceDescription> instances;
  std::vector<MediumDefinition> media;
  std::vector<MediumInterfaceDescription> mediumInterfaces;
  /// The one that holds at WorldEnd: as in pbrt-v3, its outside is what the camera stands in.
  uint32_t cameraMediumInterface = kNone;

  NameIndex floatTextureNames, spectrumTextureNames;  ///< of `textures`
  NameIndex materialNames;                            ///< of `materials`

  /// Whether any light has a spectrum that stands in a file.
  bool lightsNameSpectrumFiles = false;

  Arena<float> floats;
  Arena<int32_t> integers;
  Arena<std::string_view> strings;
  Arena<Parameter> parameters;
  std::deque<std::string> unescapedStrings;
};

}  // namespace lampyris
