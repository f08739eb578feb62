// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/texture.h"
#include "core/rgb.h"

namespace lampyris {

/// The product of a light's colour and its "scale", fit to be emitted: components < 0 (colours
/// outside of the gamut) become 0 with a warning. Throws SceneError if it is not finite.
Rgb emittedColor(const Rgb& color, const Rgb& scale, const BuildContext& context);

/// True if the linear part of `t` is a rotation or reflection times a uniform scale, so that angles
/// are kept.
bool keepsAngles(const Transform& t);

}  // namespace lampyris
