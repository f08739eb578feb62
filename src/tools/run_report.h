// SPDX-License-Identifier: Apache-2.0
/// What a run tells about itself at its end.
#pragma once

#include <string>

#include "core/statistics.h"
#include "tools/snapshots.h"

namespace lampyris {

struct RunReport {
  std::string scene;
  bool interrupted = false;
  double loadSeconds = 0, renderSeconds = 0;
  double noise = 0;
  size_t warnings = 0;
  std::vector<TakenSnapshot> snapshots;
};

/// For people: a few lines, with `verbose` all figures.
std::string summary(const RunReport& report, const Statistics& statistics, bool verbose);
/// For programs: JSON with all figures by section. Throws IoError.
void writeStatistics(const std::string& path, const RunReport& report,
                     const Statistics& statistics);

}  // namespace lampyris
