// SPDX-License-Identifier: Apache-2.0
/// What a run reports: named figures.
#pragma once

#include <mutex>
#include <string>
#include <vector>

namespace lampyris {

/// Named figures of a run, in the order of their first mention, by section, e.g.
/// ("light tree", "nodes", 1023). Thread-safe.
class Statistics {
 public:
  struct Entry {
    std::string section, name;
    double value = 0;
    std::string text;  ///< not empty: a text instead of the value
  };
  void set(const std::string& section, const std::string& name, double value);
  void set(const std::string& section, const std::string& name, const std::string& text);
  void add(const std::string& section, const std::string& name, double value);
  std::vector<Entry> entries() const;
  /// The value, or 0.
  double value(const std::string& section, const std::string& name) const;

 private:
  Entry& at(const std::string& section, const std::string& name);
  mutable std::mutex mutex_;
  std::vector<Entry> entries_;
};

}  // namespace lampyris
