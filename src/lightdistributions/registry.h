// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/light_distribution.h"

namespace lampyris {

const LightDistributionRegistry& lightDistributionRegistry();

}  // namespace lampyris
