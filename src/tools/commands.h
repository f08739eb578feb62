// SPDX-License-Identifier: Apache-2.0
/// The subcommands. Each takes the arguments after its name and returns an exit code; they throw
/// UsageError, SceneError and IoError.
#pragma once

#include <string>

#include "tools/arguments.h"

namespace lampyris {

int runRender(const Arguments& arguments);
int runAssemble(const Arguments& arguments);
int runCompare(const Arguments& arguments);
int runConvert(const Arguments& arguments);
int runInfo(const Arguments& arguments);
int runMakeSky(const Arguments& arguments);
int runMerge(const Arguments& arguments);
int runLights(const Arguments& arguments);
int runCache(const Arguments& arguments);
int runHelpScene(const Arguments& arguments);

/// The reference page of all scene parameters, in Markdown.
std::string sceneReference();

}  // namespace lampyris
