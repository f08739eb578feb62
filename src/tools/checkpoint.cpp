// SPDX-License-Identifier: Apache-2.0
#include "tools/checkpoint.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/error.h"
#include "core/hash.h"
#include "core/source.h"

namespace lampyris {

namespace {

constexpr std::string_view kMagic = "lampyris checkpoint 1\n";

struct Header {
  uint64_t fingerprint, nextSample, filmSize, filmHash;
};

uint64_t hashOf(std::string_view bytes) {
  Fingerprint f;
  f.add(bytes);
  return f.value();
}

void writeAll(int fd, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      throw IoError(fmt::format("cannot write checkpoint \"{}\": {}", path, std::strerror(errno)));
    bytes.remove_prefix(static_cast<size_t>(n));
  }
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
  const std::string temporary = fmt::format("{}.{}.tmp", path, getpid());
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0)
    throw IoError(fmt::format("cannot write checkpoint \"{}\": {}", path, std::strerror(errno)));
  const Header header{c.fingerprint, c.nextSample, c.film.size(), hashOf(c.film)};
  std::array<char, sizeof header> bytes;
  std::memcpy(bytes.data(), &header, sizeof header);
  try {
    writeAll(fd, kMagic, path);
    writeAll(fd, {bytes.data(), bytes.size()}, path);
    writeAll(fd, c.film, path);
    // On disk before it takes the old one's name.
    if (::fsync(fd) != 0 && errno != EINVAL)
      throw IoError(fmt::format("cannot write checkpoint \"{}\": {}", path, std::strerror(errno)));
  } catch (...) {
    ::close(fd);
    ::unlink(temporary.c_str());
    throw;
  }
  ::close(fd);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary.c_str());
    throw IoError(fmt::format("cannot write checkpoint \"{}\": {}", path, std::strerror(error)));
  }
}

Checkpoint readCheckpoint(const std::string& path) {
  const MappedFile file(path);
  std::string_view text = file.text();
  Header header{};
  if (!text.starts_with(kMagic) || text.size() < kMagic.size() + sizeof header)
    throw IoError(fmt::format("\"{}\" is no checkpoint that this version can read", path));
  text.remove_prefix(kMagic.size());
  std::memcpy(&header, text.data(), sizeof header);
  text.remove_prefix(sizeof header);
  if (text.size() != header.filmSize || hashOf(text) != header.filmHash)
    throw IoError(fmt::format("checkpoint \"{}\" is damaged", path));
  return {header.fingerprint, header.nextSample, std::string(text)};
}

}  // namespace lampyris
