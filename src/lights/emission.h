// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/texture.h"
#include "core/rgb.h"

namespace lampyris {

/// Declares a light's colour, and its factor "scale".
template <class Colour>
void declareColor(Declaration& d, const std::string& name, Colour& color, std::string doc,
                  Rgb& scale) {
  const char* const range = "any; a product below 0 counts as 0";
  d.add(name, color, std::move(doc)).rangeIs(range);
  d.add("scale", scale, "Factor on " + name + ".").rangeIs(range);
}

/// The product of a light's colour and its "scale", fit to be emitted: components < 0 (colours
/// outside of the gamut) become 0 with a warning. Throws SceneError if it is not finite.
Rgb emittedColor(const Rgb& color, const Rgb& scale, const BuildContext& context);

/// True if the linear part of `t` is a rotation or reflection times a uniform scale, so that angles
/// are kept.
bool keepsAngles(const Transform& t);

}  // namespace lampyris
