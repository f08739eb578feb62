// SPDX-License-Identifier: Apache-2.0
/// Scene files in memory, and places in them.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace lampyris {

/// A byte of a loaded file: cheap to store, turned into line and column only for a message.
struct SourceLocation {
  uint64_t file : 16 = 0xffff;  ///< index in SourceFiles; 0xffff: nowhere
  uint64_t offset : 48 = 0;     ///< in bytes

  bool known() const { return file != 0xffff; }
};

/// A file's contents, mapped into memory; read-only, movable.
class MappedFile {
 public:
  MappedFile() = default;
  /// Throws IoError if the file cannot be opened or mapped.
  explicit MappedFile(const std::string& path);
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  std::string_view text() const { return {data_, size_}; }

 private:
  const char* data_ = nullptr;
  size_t size_ = 0;
};

/// The files of a scene. Views into them stay valid as long as this object.
class SourceFiles {
 public:
  /// Maps a file; throws IoError.
  uint16_t open(const std::string& path);
  /// Adds a text that is in no file (standard input, a command line, a test).
  uint16_t add(std::string name, std::string text);

  /// Files have the numbers 0 … count() − 1.
  size_t count() const { return files_.size(); }
  std::string_view text(uint16_t file) const { return files_[file].text; }
  const std::string& name(uint16_t file) const { return files_[file].name; }

  struct Position {
    std::string file;
    int line, column;  ///< from 1; the column counts bytes
    std::string_view lineText;
  };
  Position position(SourceLocation location) const;

 private:
  struct File {
    std::string name;
    MappedFile mapping;
    std::string owned;
    std::string_view text;
  };
  void checkCount() const;
  std::deque<File> files_;
};

}  // namespace lampyris
