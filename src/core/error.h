// SPDX-License-Identifier: Apache-2.0
/// Errors and warnings for people: what is wrong, where, and what would be right.
#pragma once

#include <functional>
#include <mutex>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/source.h"

namespace lampyris {

/// A fault of the scene: exit code 1.
class SceneError : public std::runtime_error {
 public:
  SceneError(SourceLocation where, const std::string& what)
      : std::runtime_error(what), location(where) {}
  explicit SceneError(const std::string& what) : SceneError(SourceLocation{}, what) {}
  SourceLocation location;
};

/// A file that cannot be read or written: exit code 3.
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "file:line:col: severity: message", the line and a caret below it where the place is known.
std::string formatMessage(const SourceFiles& files, SourceLocation where, std::string_view severity,
                          std::string_view message);

/// The candidate nearest to `name` in edit distance, or "" if none is near (more than a third of
/// the letters differ).
std::string nearest(std::string_view name, std::span<const std::string> candidates);
/// "; did you mean "x"?" or "".
std::string didYouMean(std::string_view name, std::span<const std::string> candidates);

/// Takes warnings; thread-safe. Equal messages are passed on once.
class Diagnostics {
 public:
  using Sink = std::function<void(const std::string& text)>;
  Diagnostics(const SourceFiles& files, Sink sink) : files_(files), sink_(std::move(sink)) {}

  void warn(SourceLocation where, const std::string& message);
  size_t warnings() const { return warned_.size(); }

 private:
  const SourceFiles& files_;
  Sink sink_;
  std::mutex mutex_;
  std::set<std::string> warned_;
};

}  // namespace lampyris
