// SPDX-License-Identifier: Apache-2.0
/// Files that are replaced as a whole or not at all.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace lampyris {

/// Writes to a temporary file in the folder of `path`, which takes the name in commit(). Without a
/// commit the temporary file is removed and an older file of that name stays as it was. What a
/// process that was killed has left of it is taken over by the next writer of the same file;
/// writers at the same time have a temporary file each, and the last commit() counts. All functions
/// throw IoError with the system's reason; after a failure commit() throws too, so that a writer
/// that swallowed the exception cannot publish a damaged file.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, size_t size);
  uint64_t tell();
  void seek(uint64_t offset);
  void commit();

 private:
  [[noreturn]] void fail(int error);

  std::string path_, temporary_;
  std::FILE* file_ = nullptr;
  int error_ = 0;
};

}  // namespace lampyris
