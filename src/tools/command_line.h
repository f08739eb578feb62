// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace lampyris {

/// Runs the program; returns its exit code: 0 done, 1 scene error, 2 usage, 3 input, output or
/// memory, 130 interrupted (what there was has been written).
int runCommandLine(int argc, char** argv);

}  // namespace lampyris
