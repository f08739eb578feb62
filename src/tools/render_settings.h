// SPDX-License-Identifier: Apache-2.0
/// What the command line wants of a render.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/vector.h"
#include "scene/builder.h"
#include "scene/scene_printer.h"
#include "tools/arguments.h"
#include "tools/checkpoint.h"
#include "tools/snapshots.h"

namespace lampyris {

/// Of the names of partial files.
inline constexpr std::string_view kPartEnding = ".part";

struct RenderSettings {
  std::vector<std::string> scenes;  ///< "-": standard input
  std::vector<std::string> outputs;
  BuildOptions build;
  double seconds = 0;  ///< > 0: render for this long
  double noise = 0;    ///< > 0: render until the estimated relative error is no more than this
  std::vector<Snapshot> snapshots;
  std::optional<SampleRange> samples;  ///< to render these alone, into a partial file
  int threads = 0;                     ///< 0: all
  std::optional<Int2> pixel;
  std::optional<PrintOptions> print;  ///< the scene, in place of rendering it
  std::string resume, checkpoint, statistics;
  double checkpointInterval = 60;
  bool quiet = false, verbose = false, quick = false;
};

/// Reads command lines, each anew.
class RenderArguments {
 public:
  RenderArguments();
  ~RenderArguments();

  /// None where there is nothing to render (--help): the exit code is then 0. Throws UsageError.
  std::optional<RenderSettings> parse(const Arguments& arguments);

 private:
  struct Options;
  std::unique_ptr<Options> options_;
};

}  // namespace lampyris
