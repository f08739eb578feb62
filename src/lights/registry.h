// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/light.h"

namespace lampyris {

const LightRegistry& lightRegistry();

}  // namespace lampyris
