// SPDX-License-Identifier: Apache-2.0
/// Checkpoints: a film's sums, and what has been learned, in a file, from which a later run goes on
/// to the same bits.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lampyris {

/// Hash of everything that decides what a sample is; fed piece by piece, order counts.
class Fingerprint {
 public:
  void add(std::string_view bytes);
  void add(uint64_t word);
  uint64_t value() const { return hash_; }

 private:
  uint64_t hash_ = 0x4c616d7079726973;
};

struct Checkpoint {
  uint64_t fingerprint = 0;
  uint64_t nextSample = 0;  ///< samples that all pixels have
  std::string film;         ///< Film::save()
  std::string learned;      ///< LearnedState::save(); empty: nothing was learned
};

/// Written beside `path` first, then renamed, so that a crash leaves the old or the new file.
/// Throws IoError.
void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint);
/// Throws IoError if the file is missing, damaged or no checkpoint.
Checkpoint readCheckpoint(const std::string& path);

}  // namespace lampyris
