// SPDX-License-Identifier: Apache-2.0
#include "tools/snapshots.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "tools/arguments.h"

namespace lampyris {

namespace {

constexpr uint64_t kMaxSamples = uint64_t{1} << 30;

/// The number that makes up all of `text`; `T()` if it is none.
template <class T>
T number(std::string_view text) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && next == end ? value : T();
}

Snapshot parseSnapshot(std::string_view text) {
  Snapshot s{std::string(text), {}};
  if (text.ends_with("spp")) {
    s.stop.samples = number<uint64_t>(text.substr(0, text.size() - 3));
    if (s.stop.samples > 0 && s.stop.samples <= kMaxSamples) return s;
  } else if (text.ends_with("s")) {
    s.stop.seconds = number<double>(text.substr(0, text.size() - 1));
    if (s.stop.seconds > 0 && s.stop.seconds < 1e9) return s;
  }
  throw UsageError(fmt::format(
      "--snapshots: expected times and sample counts like 0.5s,10s,16spp, got \"{}\"", text));
}

}  // namespace

std::vector<Snapshot> parseSnapshots(const std::string& list) {
  std::vector<Snapshot> snapshots;
  for (size_t at = 0; at <= list.size();) {
    const size_t comma = std::min(list.find(',', at), list.size());
    snapshots.push_back(parseSnapshot(std::string_view(list).substr(at, comma - at)));
    at = comma + 1;
    for (size_t i = 0; i + 1 < snapshots.size(); ++i)
      if (snapshots[i].name == snapshots.back().name)
        throw UsageError(fmt::format("--snapshots: \"{}\" stands twice", snapshots[i].name));
  }
  return snapshots;
}

std::string snapshotPath(const std::string& output, const std::string& name) {
  const std::filesystem::path path = output;
  return (path.parent_path() / (path.stem().string() + "-" + name + ".exr")).string();
}

}  // namespace lampyris
