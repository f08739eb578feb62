// SPDX-License-Identifier: Apache-2.0
/// What subcommands do with a scene file.
#pragma once

#include <functional>

#include "core/error.h"
#include "core/source.h"

namespace lampyris {

/// Calls `work`, and says its warnings, unless `quiet`. Returns an exit code: a SceneError is told
/// with its place; what else `work` throws goes through.
int withScene(bool quiet, const std::function<void(SourceFiles&, Diagnostics&)>& work);

}  // namespace lampyris
