// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "core/atomic_file.h"
#include "lightdistributions/light_set.h"
#include "scene/builder.h"
#include "tools/commands.h"
#include "tools/light_report.h"
#include "tools/light_tree_svg.h"
#include "tools/with_scene.h"

namespace lampyris {

namespace {

/// Positions that a picture marks at most.
constexpr size_t kMarks = 3000;

void writeText(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

struct LightsSettings {
  std::string scene, out;
  uint32_t levels = 7;
  bool json = false;
};

void draw(const LightsSettings& s, const LightReport& report, const LightBVHAccel& tree) {
  const auto nodes = lightTreeNodes(tree, s.levels - 1);
  const LightTreeReport& t = report.tree;
  const std::string caption =
      t.lights == 0 ? "no light has a position"
                    : fmt::format(
                          "{} lights, depth {} to {} (mean {:.1f}), SAOH cost {:.4g}; the top "
                          "{} levels are shown",
                          t.lights, t.leastDepth, t.mostDepth, t.meanDepth, t.cost,
                          std::min(s.levels, t.mostDepth + 1));
  writeText(s.out, lightTreeSvg({s.scene, caption, nodes, someLightPositions(tree, kMarks)}));
}

void report(const LightsSettings& s, SourceFiles& files, Diagnostics& diagnostics) {
  Statistics statistics;
  const auto job = loadScene(s.scene, BuildOptions(), files, diagnostics, statistics);
  const LightDistributionContext context{{diagnostics, [](const std::string& p) { return p; }, {}},
                                         job->scene.lightTable,
                                         job->scene.bounds,
                                         statistics};
  const LightBVHAccel tree = makeLightTree(context);
  const LightReport r = reportLights(job->scene.lightTable, tree);
  fmt::print("{}", s.json ? lightReportJson(r) : formatLightReport(r));
  if (!s.out.empty()) draw(s, r, tree);
}

}  // namespace

int runLights(const Arguments& arguments) {
  LightsSettings s;
  CLI::App app("What lights a scene has, and what the light tree over them looks like.",
               "lampyris lights");
  app.add_option("SCENE", s.scene, "Scene file")->required();
  app.add_option("-o,--out", s.out, "Picture of the tree to write (.svg)");
  app.add_option("--levels", s.levels, "Levels of the tree in the picture")
      ->check(CLI::Range(1, 12))
      ->capture_default_str();
  app.add_flag("--json", s.json, "Print JSON instead of lines");
  if (const auto code = parseArguments(app, arguments)) return *code;
  if (!s.out.empty() && !s.out.ends_with(".svg"))
    throw UsageError(fmt::format("--out: expected a name that ends in .svg, got \"{}\"", s.out));
  return withScene(
      false, [&s](SourceFiles& files, Diagnostics& diagnostics) { report(s, files, diagnostics); });
}

}  // namespace lampyris
