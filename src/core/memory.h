// SPDX-License-Identifier: Apache-2.0
/// How much memory there is, and what to say where it is too little.
#pragma once

#include <string>

#include "core/source.h"

namespace lampyris {

/// What this process may still take, and what limits it, e.g. "ulimit -v".
struct MemoryLimit {
  double bytes;
  const char* name;
};
/// The least of: what the machine can give without swapping (MemAvailable of /proc/meminfo), what
/// its control group leaves, what `ulimit -v` leaves, and limitMemory(). Infinite where nothing is
/// known.
MemoryLimit memoryLimit();
inline double availableMemory() { return memoryLimit().bytes; }

/// Lets memoryLimit() return `bytes` at most, from now on.
void limitMemory(double bytes);

/// Resident memory of this process in bytes, now and at its highest (VmRSS, VmHWM); 0 where
/// unknown.
double usedMemory();
double peakMemory();

/// "1.5 GiB".
std::string memoryText(double bytes);

/// Throws SceneError "WHAT needs about 12.0 GiB of memory; the limit is 7.5 GiB (ulimit -v)" where
/// `bytes` are more than memoryLimit(): before they are asked for, and the machine swaps.
void expectMemory(double bytes, const std::string& what, SourceLocation where);

}  // namespace lampyris
