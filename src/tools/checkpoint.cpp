// SPDX-License-Identifier: Apache-2.0
#include "tools/checkpoint.h"

#include <fmt/format.h>

#include <cstring>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/source.h"

namespace lampyris {

namespace {

constexpr std::string_view kMagic = "lampyris checkpoint 3\n";

struct Header {
  uint64_t fingerprint, seed, whole;
  SampleRange range;
  uint64_t samples, filmSize, filmHash, learnedSize, learnedHash;
  uint64_t hash;  ///< of all before
};

uint64_t hashOf(std::string_view bytes) {
  Fingerprint f;
  f.add(bytes);
  return f.value();
}

uint64_t hashOf(const Header& header) {
  return hashOf({reinterpret_cast<const char*>(&header), offsetof(Header, hash)});
}

}  // namespace

void Fingerprint::add(uint64_t word) { hash_ = hashCombine(hash_, word); }

void Fingerprint::add(std::string_view bytes) {
  add(bytes.size());
  while (!bytes.empty()) {
    uint64_t word = 0;
    const size_t n = std::min(sizeof word, bytes.size());
    std::memcpy(&word, bytes.data(), n);
    add(word);
    bytes.remove_prefix(n);
  }
}

void writeCheckpoint(const std::string& path, const Checkpoint& c) {
  Header header{c.fingerprint, c.seed,         c.whole,          c.range,           c.samples,
                c.film.size(), hashOf(c.film), c.learned.size(), hashOf(c.learned), 0};
  header.hash = hashOf(header);
  AtomicFile file(path);
  file.write(kMagic.data(), kMagic.size());
  file.write(&header, sizeof header);
  file.write(c.film.data(), c.film.size());
  file.write(c.learned.data(), c.learned.size());
  file.commit();
}

Checkpoint readCheckpoint(const std::string& path) {
  const MappedFile file(path);
  std::string_view text = file.text();
  if (!text.starts_with(kMagic))
    throw IoError(fmt::format("\"{}\" is no checkpoint or partial file of this version", path));
  text.remove_prefix(kMagic.size());
  Header header{};
  std::memcpy(&header, text.data(), std::min(text.size(), sizeof header));
  text.remove_prefix(std::min(text.size(), sizeof header));
  const std::string_view film = text.substr(0, header.filmSize);
  const std::string_view learned = text.substr(film.size());
  if (header.hash != hashOf(header) || film.size() != header.filmSize ||
      learned.size() != header.learnedSize || hashOf(film) != header.filmHash ||
      hashOf(learned) != header.learnedHash)
    throw IoError(fmt::format("\"{}\" is damaged", path));
  return {header.fingerprint, header.seed,       header.whole,        header.range,
          header.samples,     std::string(film), std::string(learned)};
}

}  // namespace lampyris
