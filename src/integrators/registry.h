// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/integrator.h"

namespace lampyris {

const IntegratorRegistry& integratorRegistry();

}  // namespace lampyris
