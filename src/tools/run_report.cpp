// SPDX-License-Identifier: Apache-2.0
#include "tools/run_report.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/memory.h"
#include "core/rejections.h"
#include "tools/progress.h"

namespace lampyris {

namespace {

std::string valueText(const Statistics::Entry& e) {
  if (!e.text.empty()) return e.text;
  return e.value == std::floor(e.value) && std::abs(e.value) < 1e15
             ? fmt::format("{:.0f}", e.value)
             : fmt::format("{:.4g}", e.value);
}

std::string badSamples(const Statistics& s) {
  const double nan = s.value("bad samples", "not a number"),
               infinite = s.value("bad samples", "infinite"),
               negative = s.value("bad samples", "negative");
  if (nan + infinite + negative == 0) return "";
  std::string where;
  for (const auto& e : s.entries())
    if (e.section == "bad samples" && !e.text.empty()) where = e.text;
  return fmt::format(
      "warning: {:.0f} samples were not a number, {:.0f} infinite, {:.0f} negative; "
      "they count as black. Replay with --pixel x,y: {}\n",
      nan, infinite, negative, where);
}

std::string rejectedSamples(const Statistics& s) {
  std::string list;
  for (const auto& e : s.entries())
    if (e.section == kRejectionSection && e.value > 0)
      list += fmt::format("{}{} {:.0f}", list.empty() ? "" : ", ", e.name, e.value);
  return list.empty() ? "" : "rejected samples: " + list + "\n";
}

}  // namespace

std::string summary(const RunReport& report, const Statistics& s, bool verbose) {
  const double paths = s.value("render", "camera paths");
  std::string text =
      fmt::format("{} spp in {} (loaded in {})",
                  valueText({"", "", s.value("render", "samples per pixel"), ""}),
                  formatDuration(report.renderSeconds), formatDuration(report.loadSeconds));
  if (paths > 0)
    text += fmt::format(", {} samples/s, {} rays/s",
                        formatCount(s.value("render", "camera paths per second")),
                        formatCount(s.value("render", "rays per second")));
  if (const double peak = s.value("memory", "peak bytes"); peak > 0)
    text += fmt::format(", {}", memoryText(peak));
  if (std::isfinite(report.noise) && report.noise > 0)
    text += fmt::format(", noise {:.2f} %", 100 * report.noise);
  if (report.warnings > 0)
    text += fmt::format(", {} warning{}", report.warnings, report.warnings == 1 ? "" : "s");
  text += report.interrupted ? ", interrupted\n" : "\n";
  text += badSamples(s);
  text += rejectedSamples(s);
  if (!verbose) return text;
  std::string section;
  for (const auto& e : s.entries()) {
    if (e.section != section) text += fmt::format("{}\n", section = e.section);
    text += fmt::format("  {:<32} {}\n", e.name, valueText(e));
  }
  return text;
}

void writeStatistics(const std::string& path, const RunReport& report, const Statistics& s) {
  nlohmann::ordered_json json;
  json["scene"] = report.scene;
  json["interrupted"] = report.interrupted;
  json["seconds"] = {{"load", report.loadSeconds}, {"render", report.renderSeconds}};
  json["noise"] = std::isfinite(report.noise) ? nlohmann::ordered_json(report.noise) : nullptr;
  json["warnings"] = report.warnings;
  json["snapshots"] = nlohmann::ordered_json::array();
  for (const TakenSnapshot& t : report.snapshots)
    json["snapshots"].push_back(
        {{"name", t.name}, {"seconds", t.seconds}, {"spp", t.samplesPerPixel}, {"file", t.file}});
  for (const auto& e : s.entries()) {
    auto& figure = json["statistics"][e.section][e.name];
    if (e.text.empty())
      figure = e.value;
    else
      figure = e.text;
  }
  std::ofstream out(path);
  // Names from a scene may hold anything: bytes that are no UTF-8 are replaced.
  out << json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
  out.close();
  if (!out) throw IoError(fmt::format("cannot write statistics to \"{}\"", path));
}

}  // namespace lampyris
