// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace lampyris {

std::string formatMessage(const SourceFiles& files, SourceLocation where, std::string_view severity,
                          std::string_view message) {
  const auto at = files.position(where);
  if (at.line == 0) return fmt::format("{}: {}", severity, message);
  std::string text =
      fmt::format("{}:{}:{}: {}: {}", at.file, at.line, at.column, severity, message);
  constexpr size_t kWidth = 100;
  // A long line is shown from shortly before the place.
  const size_t column = static_cast<size_t>(at.column - 1);
  const size_t from = column > kWidth - 20 ? column - 40 : 0;
  std::string line(at.lineText.substr(from, kWidth));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text + fmt::format("\n  {}\n  {:>{}}", line, '^', column - from + 1);
}

namespace {

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

/// Insertions, deletions, substitutions and swaps of neighbours that make `a` of `b` (optimal
/// string alignment), if they are fewer than `limit`, else no less than it.
size_t editDistance(std::string_view a, std::string_view b, size_t limit) {
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) >= limit) return limit;
  std::vector<size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  std::iota(above.begin(), above.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t least = row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      size_t d = std::min(std::min(above[j], row[j - 1]) + 1,
                          above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d = std::min(d, before[j - 2] + 1);
      row[j] = d;
      least = std::min(least, d);
    }
    // No row's least is less than that of one above.
    if (least >= limit) return limit;
    std::swap(before, above);
    std::swap(above, row);
  }
  return above.back();
}

}  // namespace

std::string nearest(std::string_view name, std::span<const std::string> candidates) {
  const std::string lower = lowerCase(name);
  std::string best;
  size_t bestDistance = std::max<size_t>(name.size() / 3, 1) + 1;
  for (const std::string& c : candidates) {
    const size_t d = editDistance(lower, lowerCase(c), bestDistance);
    if (d < bestDistance && d < c.size()) bestDistance = d, best = c;
  }
  return best;
}

std::string didYouMean(std::string_view name, std::span<const std::string> candidates) {
  const std::string best = nearest(name, candidates);
  return best.empty() ? "" : fmt::format("; did you mean \"{}\"?", best);
}

void Diagnostics::warn(SourceLocation where, const std::string& message) {
  const std::lock_guard lock(mutex_);
  if (warned_.insert(message).second) sink_(formatMessage(files_, where, "warning", message));
}

}  // namespace lampyris
