// SPDX-License-Identifier: Apache-2.0
#include "core/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/error.h"

namespace lampyris {

namespace {

[[noreturn]] void failOpen(const std::string& path, int error) {
  throw IoError(fmt::format("cannot write \"{}\": {}", path, std::strerror(error)));
}

/// The file itself where `path` is a symbolic link: a rename would replace the link.
std::string resolveLink(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_symlink(path, ignored)) return path;
  const auto target = std::filesystem::weakly_canonical(path, ignored);
  return ignored ? path : target.string();
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(resolveLink(path)) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path_, ignored)) failOpen(path_, EISDIR);
  // The rename would put a file in the place of a device or a pipe.
  if (std::filesystem::exists(path_, ignored) && !std::filesystem::is_regular_file(path_, ignored))
    throw IoError(fmt::format("cannot write \"{}\": not a regular file", path_));
  // A rename asks for rights to the folder only; a file that is protected itself must stay.
  if (::access(path_.c_str(), F_OK) == 0 && ::access(path_.c_str(), W_OK) != 0)
    failOpen(path_, errno);
  int fd = -1;
  for (int attempt = 0; fd < 0 && attempt < 1000; ++attempt) {
    temporary_ = fmt::format("{}.{}-{}.tmp", path_, ::getpid(), attempt);
    fd = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0 && errno != EEXIST) break;
  }
  if (fd < 0) failOpen(path_, errno);
  file_ = ::fdopen(fd, "wb");
  if (!file_) {
    const int error = errno;
    ::close(fd);
    ::unlink(temporary_.c_str());
    failOpen(path_, error);
  }
}

AtomicFile::~AtomicFile() {
  if (!file_) return;
  std::fclose(file_);
  ::unlink(temporary_.c_str());
}

void AtomicFile::fail(int error) {
  if (error_ == 0) error_ = error != 0 ? error : EIO;
  failOpen(path_, error_);
}

void AtomicFile::write(const void* data, size_t size) {
  if (size > 0 && std::fwrite(data, 1, size, file_) != size) fail(errno);
}

uint64_t AtomicFile::tell() {
  const off_t at = ::ftello(file_);
  if (at < 0) fail(errno);
  return static_cast<uint64_t>(at);
}

void AtomicFile::seek(uint64_t offset) {
  if (::fseeko(file_, static_cast<off_t>(offset), SEEK_SET) != 0) fail(errno);
}

void AtomicFile::commit() {
  if (error_ != 0) fail(error_);
  if (std::fflush(file_) != 0) fail(errno);
  // Some file systems report a full disk only here. Those that know no fsync say EINVAL.
  if (::fsync(::fileno(file_)) != 0 && errno != EINVAL && errno != ENOTSUP) fail(errno);
  std::FILE* const file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0 || std::rename(temporary_.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary_.c_str());
    fail(error);
  }
}

}  // namespace lampyris
