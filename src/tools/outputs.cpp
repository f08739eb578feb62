// SPDX-License-Identifier: Apache-2.0
#include "tools/outputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/image.h"
#include "tools/arguments.h"

namespace lampyris {

namespace fs = std::filesystem;

namespace {

constexpr double kLargestShare = 0.02;  ///< of the time, for partial images

/// Saves elsewhere what `path` did not take; says where.
std::string rescue(const std::string& path, const std::function<void(const std::string&)>& save) {
  const fs::path name(path);
  std::error_code error;
  for (const fs::path& folder :
       {fs::current_path(error), fs::temp_directory_path(error), fs::path("/dev/shm")}) {
    if (folder.empty() || fs::equivalent(folder, fs::absolute(name).parent_path(), error)) continue;
    const std::string elsewhere = folder / fmt::format("{}-rescued-{}{}", name.stem().string(),
                                                       getpid(), name.extension().string());
    try {
      save(elsewhere);
      return fmt::format("the image was saved as \"{}\"", elsewhere);
    } catch (const IoError&) {
      continue;
    }
  }
  return "nor could it be saved in another folder";
}

}  // namespace

ImageMetadata imageMetadata(double samples, uint64_t seed) {
  return {{"software", "Lampyris"},
          {"samplesPerPixel", fmt::format("{:.10g}", samples)},
          {"seed", std::to_string(seed)}};
}

void checkWritable(const std::string& path) {
  const fs::path folder = fs::absolute(path).parent_path();
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw IoError(fmt::format("cannot write \"{}\": the folder \"{}\" does not exist", path,
                              folder.string()));
  // Whether a file can be made is best told by making one.
  const AtomicFile probe(path);
}

void checkWritableImage(const std::string& path) {
  if (!isWritableImagePath(path))
    throw UsageError(fmt::format(
        "cannot tell the format of the image \"{}\": expected an ending like .exr, .png or .pfm",
        path));
  checkWritable(path);
}

void writeOrRescue(const std::vector<std::string>& paths,
                   const std::function<void(const std::string&)>& save) {
  std::vector<std::string> failures;
  for (const std::string& p : paths) {
    try {
      save(p);
    } catch (const IoError& e) {
      failures.push_back(fmt::format("{}; {}", e.what(), rescue(p, save)));
    }
  }
  if (!failures.empty()) throw IoError(fmt::format("{}", fmt::join(failures, "\n")));
}

Outputs::Outputs(const std::vector<std::string>& requested, const Film& film) : paths_(requested) {
  if (paths_.empty()) {
    const fs::path own = film.filename();
    paths_.push_back(own.string());
    if (own.extension() == ".exr")
      paths_.push_back(fs::path(own).replace_extension(".png").string());
  }
  for (const std::string& p : paths_) checkWritableImage(p);
}

bool Outputs::takesLayers() const {
  return std::any_of(paths_.begin(), paths_.end(),
                     [](const fs::path& p) { return p.extension() == ".exr"; });
}

void Outputs::write(const Film& film, const ImageMetadata& metadata) const {
  writeOrRescue(paths_, [&](const std::string& path) { film.write(path, metadata); });
}

void Outputs::writePartial(const Film& film, const ImageMetadata& metadata, double seconds) {
  if (seconds < next_) return;
  interval_ *= 1.5;
  next_ = seconds + interval_;
  const auto before = std::chrono::steady_clock::now();
  for (const std::string& p : paths_) film.write(p, metadata);
  const double cost =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  interval_ = std::max(interval_, cost / kLargestShare);
  next_ = seconds + cost + interval_;
}

}  // namespace lampyris
