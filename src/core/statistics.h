// SPDX-License-Identifier: Apache-2.0
/// What a run reports: counters and named figures.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace lampyris {

/// A counter that many threads may add to; reading sums it up. Hot code counts in a local variable
/// and adds once per tile.
class Counter {
 public:
  void add(uint64_t n) { value_.fetch_add(n, std::memory_order_relaxed); }
  uint64_t value() const { return value_.load(std::memory_order_relaxed); }

 private:
  std::atomic<uint64_t> value_{0};
};

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
