// SPDX-License-Identifier: Apache-2.0
/// The image files of a render.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/film.h"

namespace lampyris {

/// Nothing that differs between two runs of the same render: images are compared bit for bit.
/// `samples`: per pixel, mean.
ImageMetadata imageMetadata(double samples, uint64_t seed);

/// Throws IoError where a file cannot be made, UsageError where its ending names no format.
void checkWritableImage(const std::string& path);
/// Throws IoError where a file cannot be made.
void checkWritable(const std::string& path);

/// Calls save(path) for each path. What cannot be written where it should is saved in the current
/// folder, that of temporary files or /dev/shm, whichever takes it first; the IoError which is
/// thrown in the end says why and where.
void writeOrRescue(const std::vector<std::string>& paths,
                   const std::function<void(const std::string& path)>& save);

class Outputs {
 public:
  Outputs() = default;  ///< none
  /// `requested`: what the command line names; if empty the film's own file, and for an EXR file a
  /// PNG beside it. Throws like checkWritableImage(): before any time has been spent.
  Outputs(const std::vector<std::string>& requested, const Film& film);

  const std::vector<std::string>& paths() const { return paths_; }
  /// Whether any of the files can hold layers (EXR).
  bool takesLayers() const;
  /// Writes all files, like writeOrRescue().
  void write(const Film& film, const ImageMetadata& metadata) const;
  /// Writes an image of what there is now and then: rarely enough to cost under 2 % of the time.
  /// Throws IoError; further calls try again.
  void writePartial(const Film& film, const ImageMetadata& metadata, double seconds);

 private:
  std::vector<std::string> paths_;
  double next_ = 15, interval_ = 15;
};

}  // namespace lampyris
