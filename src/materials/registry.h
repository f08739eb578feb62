// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/material.h"

namespace lampyris {

const MaterialRegistry& materialRegistry();

}  // namespace lampyris
