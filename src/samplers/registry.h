// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/sampler.h"

namespace lampyris {

const SamplerRegistry& samplerRegistry();

}  // namespace lampyris
