// SPDX-License-Identifier: Apache-2.0
#include "tools/outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "core/error.h"
#include "core/image.h"
#include "tools/arguments.h"

namespace lampyris {

namespace fs = std::filesystem;

namespace {

constexpr double kLargestShare = 0.02;  ///< of the time, for partial images

void checkWritable(const std::string& path, bool fromScene) {
  if (!isWritableImagePath(path)) {
    const std::string message = fmt::format(
        "cannot tell the format of the image \"{}\": expected an ending like .exr, .png or .pfm",
        path);
    if (fromScene) throw SceneError(message);
    throw UsageError(message);
  }
  const fs::path folder = fs::absolute(path).parent_path();
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw IoError(fmt::format("cannot write \"{}\": the folder \"{}\" does not exist", path,
                              folder.string()));
  if (access(folder.c_str(), W_OK) != 0)
    throw IoError(fmt::format("cannot write \"{}\": no permission to write into \"{}\"", path,
                              folder.string()));
}

}  // namespace

Outputs::Outputs(const std::vector<std::string>& requested, const Film& film) : paths_(requested) {
  if (paths_.empty()) {
    const fs::path own = film.filename();
    paths_.push_back(own.string());
    if (own.extension() == ".exr")
      paths_.push_back(fs::path(own).replace_extension(".png").string());
  }
  for (const std::string& p : paths_) checkWritable(p, requested.empty());
}

bool Outputs::takesLayers() const {
  return std::any_of(paths_.begin(), paths_.end(),
                     [](const fs::path& p) { return p.extension() == ".exr"; });
}

void Outputs::write(const Film& film, const ImageMetadata& metadata) const {
  for (const std::string& p : paths_) film.write(p, metadata);
}

void Outputs::writePartial(const Film& film, const ImageMetadata& metadata, double seconds) {
  if (seconds < next_) return;
  const auto before = std::chrono::steady_clock::now();
  write(film, metadata);
  const double cost =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  interval_ = std::max(interval_ * 1.5, cost / kLargestShare);
  next_ = seconds + cost + interval_;
}

}  // namespace lampyris
