// SPDX-License-Identifier: Apache-2.0
/// Images of a render on its way, at given times or numbers of samples.
#pragma once

#include <string>
#include <vector>

#include "base/integrator.h"

namespace lampyris {

/// A snapshot that is asked for, by its name: "0.5s" or "16spp".
struct Snapshot {
  std::string name;
  RenderStop stop;
};

/// Reads a list like "0.5s,1s,2s" or "1spp,4spp". Throws UsageError where it isn't one, or where a
/// name stands twice.
std::vector<Snapshot> parseSnapshots(const std::string& list);

/// The file of a snapshot: "out/a.png" and "1s" give "out/a-1s.exr".
std::string snapshotPath(const std::string& output, const std::string& name);

/// A snapshot that has been written.
struct TakenSnapshot {
  std::string name;
  double seconds = 0;          ///< of rendering
  double samplesPerPixel = 0;  ///< mean
  std::string file;
};

}  // namespace lampyris
