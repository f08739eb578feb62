// SPDX-License-Identifier: Apache-2.0
/// The state of a render, as checkpoints and partial files hold it.
#pragma once

#include "scene/builder.h"
#include "tools/checkpoint.h"
#include "tools/render_settings.h"

namespace lampyris {

/// What a render shares with all files that its state is in. Settings and film must live as long.
class SavedState {
 public:
  /// Reads the files of the scene once more. Throws UsageError where the settings want samples that
  /// the image does not have.
  SavedState(const RenderSettings& settings, const RenderJob& job, const SourceFiles& files);

  /// Restores the film, and says where the render goes on. Throws IoError.
  void resume(RenderOptions& options) const;
  /// Throws IoError.
  void write(const std::string& path, uint64_t samples, const LearnedState* learned) const;

 private:
  const RenderSettings& settings_;
  Film& film_;
  Checkpoint common_;  ///< without samples, film and what is learned
};

}  // namespace lampyris
