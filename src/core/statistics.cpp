// SPDX-License-Identifier: Apache-2.0
#include "core/statistics.h"

namespace lampyris {

Statistics::Entry& Statistics::at(const std::string& section, const std::string& name) {
  for (Entry& e : entries_)
    if (e.section == section && e.name == name) return e;
  return entries_.emplace_back(Entry{section, name, 0, {}});
}

void Statistics::set(const std::string& section, const std::string& name, double value) {
  const std::lock_guard lock(mutex_);
  Entry& e = at(section, name);
  e.value = value;
  e.text.clear();
}

void Statistics::set(const std::string& section, const std::string& name, const std::string& text) {
  const std::lock_guard lock(mutex_);
  at(section, name).text = text;
}

void Statistics::add(const std::string& section, const std::string& name, double value) {
  const std::lock_guard lock(mutex_);
  at(section, name).value += value;
}

std::vector<Statistics::Entry> Statistics::entries() const {
  const std::lock_guard lock(mutex_);
  return entries_;
}

double Statistics::value(const std::string& section, const std::string& name) const {
  const std::lock_guard lock(mutex_);
  for (const Entry& e : entries_)
    if (e.section == section && e.name == name) return e.value;
  return 0;
}

}  // namespace lampyris
