// SPDX-License-Identifier: Apache-2.0
#include "core/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
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

/// Locks are often known to the machine only: others take other names.
std::string hostName() {
  std::array<char, 64> name{};
  ::gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// Opens a file that nobody writes: a new one, or one that a killed process has left, emptied; it
/// stays locked until it is closed. -1 where it cannot be had, with errno.
int openUnused(const std::string& path) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (fd < 0) return -1;
  // Between the two, whoever wrote it may have renamed it.
  struct stat mine {
  }, named{};
  const bool unused = ::flock(fd, LOCK_EX | LOCK_NB) == 0 && ::fstat(fd, &mine) == 0 &&
                      ::stat(path.c_str(), &named) == 0 && mine.st_ino == named.st_ino &&
                      mine.st_dev == named.st_dev && S_ISREG(mine.st_mode) && mine.st_nlink == 1 &&
                      mine.st_uid == ::geteuid() && ::ftruncate(fd, 0) == 0;
  if (unused) return fd;
  ::close(fd);
  errno = EEXIST;
  return -1;
}

/// Where files cannot be locked, or belong to others.
int openNew(const std::string& path) {
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
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
  constexpr int kShared = 100;  // attempts before the name is this process's own
  for (int attempt = 0; fd < 0 && attempt < 2 * kShared; ++attempt) {
    const bool own = attempt >= kShared;
    temporary_ =
        fmt::format("{}.{}-{}.tmp", path_, own ? std::to_string(::getpid()) : hostName(), attempt);
    fd = own ? openNew(temporary_) : openUnused(temporary_);
    if (fd < 0 && errno != EEXIST && ::access(temporary_.c_str(), F_OK) != 0) break;
  }
  if (fd < 0) failOpen(path_, errno);
  file_ = ::fdopen(fd, "wb");
  if (!file_) {
    const int error = errno;
    ::unlink(temporary_.c_str());
    ::close(fd);
    failOpen(path_, error);
  }
}

AtomicFile::~AtomicFile() {
  if (!file_) return;
  ::unlink(temporary_.c_str());
  std::fclose(file_);
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
  // Renamed while it is locked, or another writer would take it for one that is left over.
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(errno);
  std::FILE* const file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0) fail(errno);
}

}  // namespace lampyris
