// SPDX-License-Identifier: Apache-2.0
/// From a parameter of a scene file to a member of a struct.
#pragma once

#include "core/parameters.h"

namespace lampyris {

/// Sets the declared member of `object` to what the parameter says. Throws SceneError at the
/// parameter: wrong type, count, range or choice, or a number that is not finite.
void readParameter(const ParameterDeclaration& declaration, const Parameter& parameter,
                   void* object);

}  // namespace lampyris
