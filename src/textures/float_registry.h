// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/texture.h"

namespace lampyris {

const FloatTextureRegistry& floatTextureRegistry();

}  // namespace lampyris
