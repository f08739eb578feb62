// SPDX-License-Identifier: Apache-2.0
#include "tools/light_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "accelerators/light_bvh.h"

namespace lampyris {

namespace {

LightKind kindOf(const Light& light) {
  if (light.isInfinite()) return light.isDelta() ? LightKind::Distant : LightKind::Infinite;
  if (!light.isDelta()) return LightKind::Area;
  const auto bounds = light.bounds(0);
  const bool allAround = bounds && (bounds->cosThetaO <= -1 || bounds->cosThetaE <= -1);
  return allAround ? LightKind::Point : LightKind::Spot;
}

LightReport::Flux fluxOf(std::vector<double> powers) {
  LightReport::Flux flux;
  if (powers.empty()) return flux;
  std::sort(powers.begin(), powers.end());
  for (const double p : powers) flux.total += p;
  flux.least = powers.front();
  flux.median = powers[powers.size() / 2];
  flux.most = powers.back();
  if (!(flux.total > 0)) return flux;
  const size_t brightest = (powers.size() + 99) / 100;
  double entropy = 0, brightestSum = 0;
  for (size_t i = 0; i < powers.size(); ++i) {
    const double share = powers[i] / flux.total;
    if (share > 0) entropy -= share * std::log(share);
    if (i + brightest >= powers.size()) brightestSum += powers[i];
  }
  flux.brightestShare = brightestSum / flux.total;
  flux.effective = std::exp(entropy);
  return flux;
}

double perLight(size_t bytes, size_t lights) {
  return lights > 0 ? static_cast<double>(bytes) / static_cast<double>(lights) : 0;
}

}  // namespace

LightReport reportLights(const LightTable& lights, const LightBVHAccel& tree) {
  LightReport report;
  report.lights = lights.size();
  std::vector<double> powers;
  for (size_t o = 0; o < lights.objectCount(); ++o) {
    const Light& light = lights.object(o);
    LightReport::Kind& kind = report.kinds[static_cast<size_t>(kindOf(light))];
    ++kind.objects;
    kind.lights += light.elementCount();
    for (uint32_t e = 0; e < light.elementCount(); ++e) {
      const auto power = static_cast<double>(light.power(e).luminance());
      if (!std::isfinite(power)) continue;
      kind.power += power;
      if (!light.isInfinite()) powers.push_back(power);
    }
  }
  report.flux = fluxOf(std::move(powers));
  report.tree = reportLightTree(tree);
  return report;
}

std::string formatLightReport(const LightReport& r) {
  std::string text =
      fmt::format("{:<10}{:>12}{:>12}{:>14}\n", "lights", "objects", "lights", "power, W");
  for (size_t k = 0; k < r.kinds.size(); ++k)
    if (r.kinds[k].objects > 0)
      text += fmt::format("{:<10}{:>12}{:>12}{:>14.5g}\n", kLightKinds[k], r.kinds[k].objects,
                          r.kinds[k].lights, r.kinds[k].power);
  if (r.lights == 0) return "no lights\n";
  if (r.tree.lights == 0) return text + "no light has a position: there is no tree\n";
  const LightReport::Flux& f = r.flux;
  const LightTreeReport& t = r.tree;
  text += fmt::format("flux      least {:.4g}, median {:.4g}, most {:.4g}, total {:.5g} W\n",
                      f.least, f.median, f.most, f.total);
  text +=
      fmt::format("          the brightest 1 % emit {:.1f} %; spread as over {:.1f} equal lights\n",
                  100 * f.brightestShare, f.effective);
  text += fmt::format("tree      {} lights, {} nodes, {:.1f} bytes a light\n", t.lights, t.nodes,
                      perLight(t.bytes, t.lights));
  text += fmt::format("depth     least {}, mean {:.2f}, most {} (balanced: {:.2f})\n", t.leastDepth,
                      t.meanDepth, t.mostDepth, std::log2(static_cast<double>(t.lights)));
  text += fmt::format("leaves    {}, mean {:.2f} lights, largest {}\n", t.leaves, t.meanLeaf,
                      t.largestLeaf);
  text +=
      fmt::format("SAOH cost {:.4g} (all nodes below the root, in units of the root's)\n", t.cost);
  return text;
}

std::string lightReportJson(const LightReport& r) {
  nlohmann::ordered_json json;
  json["lights"] = r.lights;
  for (size_t k = 0; k < r.kinds.size(); ++k)
    json["kinds"][kLightKinds[k]] = {{"objects", r.kinds[k].objects},
                                     {"lights", r.kinds[k].lights},
                                     {"power", r.kinds[k].power}};
  const LightReport::Flux& f = r.flux;
  json["flux"] = {{"total", f.total},
                  {"least", f.least},
                  {"median", f.median},
                  {"most", f.most},
                  {"brightestShare", f.brightestShare},
                  {"effectiveLights", f.effective}};
  const LightTreeReport& t = r.tree;
  json["tree"] = {
      {"lights", t.lights},
      {"nodes", t.nodes},
      {"leaves", t.leaves},
      {"bytes", t.bytes},
      {"bytesPerLight", perLight(t.bytes, t.lights)},
      {"depth", {{"least", t.leastDepth}, {"mean", t.meanDepth}, {"most", t.mostDepth}}},
      {"leafSize", {{"mean", t.meanLeaf}, {"largest", t.largestLeaf}}},
      {"saohCost", t.cost},
      {"nodesByDepth", t.nodesByDepth}};
  return json.dump(2) + "\n";
}

}  // namespace lampyris
