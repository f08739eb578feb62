// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/medium.h"

namespace lampyris {

const MediumRegistry& mediumRegistry();

}  // namespace lampyris
