// SPDX-License-Identifier: Apache-2.0
/// How much memory there is.
#pragma once

namespace lampyris {

/// Bytes that this process may use: the installed memory, or less where limits of the process
/// (`ulimit -v`) or limitMemory() say so. Infinity where nothing is known.
double availableMemory();

/// Lets availableMemory() return `bytes` at most, from now on.
void limitMemory(double bytes);

}  // namespace lampyris
