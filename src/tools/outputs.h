// SPDX-License-Identifier: Apache-2.0
/// The image files of a render.
#pragma once

#include <string>
#include <vector>

#include "base/film.h"

namespace lampyris {

class Outputs {
 public:
  /// `requested`: what the command line names; if empty the film's own file, and for an EXR file a
  /// PNG beside it. Throws IoError where a folder is missing or not writable, UsageError
  /// (SceneError if the scene names it) where a file's ending says nothing: before any time has
  /// been spent.
  Outputs(const std::vector<std::string>& requested, const Film& film);

  const std::vector<std::string>& paths() const { return paths_; }
  /// Whether any of the files can hold layers (EXR).
  bool takesLayers() const;
  /// Writes all files. An image that cannot be written where it should is saved in the current
  /// folder, that of temporary files or /dev/shm, whichever takes it first; the IoError which is
  /// thrown in the end says why and where.
  void write(const Film& film, const ImageMetadata& metadata) const;
  /// Writes an image of what there is now and then: rarely enough to cost under 2 % of the time.
  /// Throws IoError; further calls try again.
  void writePartial(const Film& film, const ImageMetadata& metadata, double seconds);

 private:
  std::vector<std::string> paths_;
  double next_ = 15, interval_ = 15;
};

}  // namespace lampyris
