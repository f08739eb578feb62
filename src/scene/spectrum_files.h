// SPDX-License-Identifier: Apache-2.0
/// Spectra that stand in files of their own.
#pragma once

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/error.h"
#include "core/parameters.h"

namespace lampyris {

/// The wavelength (nm), value pairs of a loaded text file; # begins a comment. Throws SceneError.
std::vector<float> readSpectrum(const SourceFiles& files, uint16_t file);

/// Reads text files of wavelength (nm), value pairs (# begins a comment), each once. Not
/// thread-safe, for SourceFiles is not.
class SpectrumFiles {
 public:
  SpectrumFiles(std::string folder, SourceFiles& files)
      : folder_(std::move(folder)), files_(files) {}

  /// The set (of a description, for it is known again by its address) with the values of the files
  /// that it names; the set itself if it names none. What the result points to lives as long as
  /// this object. Throws SceneError.
  ParameterSet resolve(const ParameterSet& set);

 private:
  const std::vector<float>& pairs(const Parameter& p);

  std::string folder_;
  SourceFiles& files_;
  std::unordered_map<std::string, std::vector<float>> byPath_;
  std::unordered_map<const Parameter*, std::vector<Parameter>> resolved_;
};

}  // namespace lampyris
