// SPDX-License-Identifier: Apache-2.0
#include "core/source.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.h"

namespace lampyris {

MappedFile::MappedFile(const std::string& path) {
  // Without O_NONBLOCK opening a pipe would wait for its writer.
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) throw IoError("cannot open \"" + path + "\": " + std::strerror(errno));
  struct stat info {};
  if (::fstat(fd, &info) != 0 || !S_ISREG(info.st_mode)) {
    ::close(fd);
    throw IoError("cannot read \"" + path + "\": not a regular file");
  }
  size_ = static_cast<size_t>(info.st_size);
  if (size_ > 0) {
    void* p = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, fd, 0);
    if (p == MAP_FAILED) {
      const int error = errno;
      ::close(fd);
      throw IoError("cannot map \"" + path + "\": " + std::strerror(error));
    }
    ::madvise(p, size_, MADV_SEQUENTIAL);
    data_ = static_cast<const char*>(p);
  }
  ::close(fd);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

MappedFile::~MappedFile() {
  if (data_) ::munmap(const_cast<char*>(data_), size_);
}

void SourceFiles::checkCount() const {
  if (files_.size() >= 0xffff) throw IoError("more than 65535 files are included");
}

uint16_t SourceFiles::open(const std::string& path) {
  checkCount();
  MappedFile mapping(path);
  File& f = files_.emplace_back();
  f.name = path;
  f.mapping = std::move(mapping);
  f.text = f.mapping.text();
  return static_cast<uint16_t>(files_.size() - 1);
}

uint16_t SourceFiles::add(std::string name, std::string text) {
  checkCount();
  File& f = files_.emplace_back();
  f.name = std::move(name);
  f.owned = std::move(text);
  f.text = f.owned;
  return static_cast<uint16_t>(files_.size() - 1);
}

SourceFiles::Position SourceFiles::position(SourceLocation location) const {
  if (!location.known() || location.file >= files_.size()) return {"", 0, 0, {}};
  const File& f = files_[location.file];
  const size_t at = std::min<size_t>(location.offset, f.text.size());
  const std::string_view before = f.text.substr(0, at);
  const size_t newline = before.rfind('\n');
  const size_t start = newline == std::string_view::npos ? 0 : newline + 1;
  const size_t end = std::min(f.text.find('\n', at), f.text.size());
  return {f.name, static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
          static_cast<int>(at - start) + 1, f.text.substr(start, end - start)};
}

}  // namespace lampyris
