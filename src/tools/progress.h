// SPDX-License-Identifier: Apache-2.0
/// What people see while an image is rendered.
#pragma once

#include <optional>
#include <string>

#include "base/integrator.h"

namespace lampyris {

/// "1.5 s", "2 min 05 s", "3 h 07 min".
std::string formatDuration(double seconds);
/// "950", "1.2k", "3.4M".
std::string formatCount(double count);

/// A line on standard error that is updated in place; where that is no terminal, a new line now and
/// then. Not thread-safe: the caller's calls are serialised.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows the progress if it is time to.
  void update(const RenderProgress& progress);
  /// True where a new noise estimate would be worth its time (about once a second).
  bool wantsNoise(double seconds) const;
  void setNoise(double relativeError, double seconds);
  /// Ends the line in place, so that other text can follow.
  void clear();

 private:
  std::string text(const RenderProgress& progress) const;
  bool due(const RenderProgress& progress);

  bool quiet_, terminal_;
  bool shown_ = false;
  std::optional<double> startFraction_, noise_;
  double noiseTime_ = -1, lastTime_ = 0, lastFraction_ = 0;
};

}  // namespace lampyris
