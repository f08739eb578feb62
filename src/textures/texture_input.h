// SPDX-License-Identifier: Apache-2.0
/// What textures of floats and of spectra have in common.
#pragma once

#include <type_traits>

#include "base/texture.h"

namespace lampyris {

/// The parameter type of a value of T that may be a texture.
template <class T>
using TextureInput = std::conditional_t<std::is_same_v<T, float>, FloatInput, RgbInput>;

template <class T>
using TexturePlugin = Plugin<Texture<T>, TextureContext>;

}  // namespace lampyris
