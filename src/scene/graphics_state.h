// SPDX-License-Identifier: Apache-2.0
/// What directives change for the directives after them.
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/error.h"
#include "scene/description.h"

namespace lampyris {

/// The current transforms: at the start and at the end of the shutter's time.
struct CurrentTransform {
  TransformPair ctm;
  bool startActive = true, endActive = true;
  /// Index of `ctm` in the pool; kNone after a change.
  uint32_t index = 0;

  /// Multiplies the active transforms from the right.
  void concatenate(const Transform& t);
  void set(const Transform& t);
};

/// What AttributeBegin saves. pbrt-v3 also saves the named textures and materials: see NameIndex.
struct GraphicsState {
  CurrentTransform transform;
  uint32_t material = 0, areaLight = kNone, mediumInterface = kNone;
  bool reverseOrientation = false;
};

/// An open Begin directive.
struct OpenBlock {
  enum class Kind : uint8_t { Attribute, Transform, Object };
  Kind kind;
  SourceLocation location;
  GraphicsState saved;
  size_t floatTextures = 0, spectrumTextures = 0, materials = 0;  ///< NameIndex::openCount
};

/// Enters transforms into a description, equal ones once.
class TransformPool {
 public:
  explicit TransformPool(std::vector<TransformPair>& pool);
  /// The index of the current transform. Throws SceneError if it has no inverse.
  uint32_t indexOf(CurrentTransform& current, SourceLocation where);

 private:
  std::vector<TransformPair>& pool_;
  std::unordered_multimap<uint64_t, uint32_t> byHash_;
};

}  // namespace lampyris
