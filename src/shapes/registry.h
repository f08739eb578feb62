// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/shape.h"

namespace lampyris {

const ShapeRegistry& shapeRegistry();

}  // namespace lampyris
