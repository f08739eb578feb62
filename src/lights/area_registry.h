// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/light.h"

namespace lampyris {

const AreaLightRegistry& areaLightRegistry();

}  // namespace lampyris
