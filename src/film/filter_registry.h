// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/filter.h"

namespace lampyris {

const FilterRegistry& filterRegistry();

}  // namespace lampyris
