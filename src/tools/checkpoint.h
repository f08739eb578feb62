// SPDX-License-Identifier: Apache-2.0
/// A film's sums, and what has been learned, in a file: a checkpoint, from which a later run goes
/// on to the same bits, or a partial file, whose samples are part of a larger image.
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

/// Indices of samples of every pixel: begin ≤ index < end.
struct SampleRange {
  uint64_t begin = 0, end = 0;

  uint64_t size() const { return end - begin; }
  bool operator==(const SampleRange&) const = default;
};

struct Checkpoint {
  uint64_t fingerprint = 0;
  uint64_t seed = 0;
  uint64_t whole = 0;    ///< samples a pixel of the larger image; 0: this is no part of one
  SampleRange range;     ///< of a part: what it is to have at its end
  uint64_t samples = 0;  ///< that all pixels have
  std::string film;      ///< Film::save()
  std::string learned;   ///< LearnedState::save(); empty: nothing was learned

  bool isPart() const { return whole > 0; }
};

/// Written beside `path` first, then renamed, so that a crash leaves the old or the new file.
/// Throws IoError.
void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint);
/// Throws IoError if the file is missing, damaged or of another kind.
Checkpoint readCheckpoint(const std::string& path);

}  // namespace lampyris
