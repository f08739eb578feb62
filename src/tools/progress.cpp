// SPDX-License-Identifier: Apache-2.0
#include "tools/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "tools/messages.h"

namespace lampyris {

std::string formatDuration(double seconds) {
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const auto s = std::llround(seconds);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

std::string formatCount(double count) {
  if (count < 1e3) return fmt::format("{:.0f}", count);
  if (count < 1e6) return fmt::format("{:.1f}k", count / 1e3);
  if (count < 1e9) return fmt::format("{:.1f}M", count / 1e6);
  return fmt::format("{:.1f}G", count / 1e9);
}

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}
ProgressLine::~ProgressLine() { clear(); }

bool ProgressLine::wantsNoise(double seconds) const {
  return !quiet_ && (noiseTime_ < 0 || seconds - noiseTime_ >= 1);
}

void ProgressLine::setNoise(double relativeError, double seconds) {
  noise_ = relativeError;
  noiseTime_ = seconds;
}

std::string ProgressLine::text(const RenderProgress& p) const {
  std::string line =
      fmt::format("{:3.0f} %  {}", std::floor(100 * p.fractionDone), formatDuration(p.seconds));
  const double gained = p.fractionDone - *startFraction_;
  if (gained > 0 && p.fractionDone < 1)
    line += fmt::format(", {} left", formatDuration(p.seconds * (1 - p.fractionDone) / gained));
  line += p.samplesTarget > 0 ? fmt::format("  {}/{} spp", p.samplesDone, p.samplesTarget)
                              : fmt::format("  {} spp", p.samplesDone);
  if (p.seconds > 0)
    line +=
        fmt::format("  {} samples/s", formatCount(static_cast<double>(p.cameraPaths) / p.seconds));
  if (noise_ && std::isfinite(*noise_)) line += fmt::format("  noise {:.2f} %", 100 * *noise_);
  return line;
}

/// Without a terminal: every tenth of the work, but neither in a burst nor never.
bool ProgressLine::due(const RenderProgress& p) {
  if (terminal_) return true;
  const double since = p.seconds - lastTime_;
  const bool step = std::floor(10 * p.fractionDone) > std::floor(10 * lastFraction_);
  if (!(step && since >= 2) && since < std::max(10., p.seconds / 10)) return false;
  lastTime_ = p.seconds;
  lastFraction_ = p.fractionDone;
  return true;
}

void ProgressLine::update(const RenderProgress& p) {
  if (quiet_) return;
  if (!startFraction_)
    startFraction_ = p.samplesTarget == 0 || p.samplesDone == 0 ? 0. : p.fractionDone;
  if (!due(p)) return;
  // The escape sequence erases what an older, longer line left.
  if (terminal_)
    say("\r{}\x1b[K", text(p));
  else
    say("{}\n", text(p));
  std::fflush(stderr);
  shown_ = terminal_;
}

void ProgressLine::clear() {
  if (!shown_) return;
  say("\r\x1b[K");
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace lampyris
