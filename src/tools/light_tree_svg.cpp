// SPDX-License-Identifier: Apache-2.0
#include "tools/light_tree_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace lampyris {

namespace {

constexpr double kWidth = 960, kMargin = 32, kGap = 32, kTop = 96;
constexpr double kPanel = (kWidth - 2 * kMargin - kGap) / 2;
constexpr double kFilled = 0.92;  // of a panel, by the lights
constexpr double kRow = 26, kRowGap = 3;
constexpr size_t kColours = 8;

// Colours by depth from blue to red, of one lightness in each scheme.
constexpr const char* kStyle = R"(<style>
  svg { --back: #fcfcfa; --text: #24292f; --soft: #6a737d; --frame: #d0d4d9; --light: #b06f00;
        --bar: #e08a00; --d0: #3b5bdb; --d1: #1c7ed6; --d2: #0c8599; --d3: #2f9e44; --d4: #7a8b00;
        --d5: #c27c00; --d6: #d9480f; --d7: #c2255c; }
  @media (prefers-color-scheme: dark) {
    svg { --back: #15181c; --text: #e6e8ea; --soft: #9aa4ae; --frame: #3a4149; --light: #ffd27a;
          --bar: #ffb02e; --d0: #8aa4ff; --d1: #6cb8f5; --d2: #4fd0e0; --d3: #69db7c; --d4: #c4d34a;
          --d5: #f5b84a; --d6: #ff9466; --d7: #f783ac; }
  }
  text { font: 13px system-ui, sans-serif; fill: var(--text); }
  .title { font-size: 18px; font-weight: 600; }
  .soft { fill: var(--soft); font-size: 12px; }
  .frame { fill: none; stroke: var(--frame); }
  .box { fill-opacity: 0.05; stroke-opacity: 0.9; }
  .light { fill: var(--light); fill-opacity: 0.55; }
  .bar { fill: var(--bar); stroke: var(--frame); stroke-width: 0.5; }
</style>
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (static_cast<unsigned char>(c) >= 32)
      out += c;
  }
  return out;
}

class Svg {
 public:
  explicit Svg(double height) {
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.0f}\" "
        "height=\"{:.0f}\">\n{}<rect width=\"100%\" height=\"100%\" style=\"fill:var(--back)\"/>\n",
        kWidth, height, kWidth, height, kStyle);
  }
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }
  void label(double x, double y, const char* style, const std::string& text) {
    add("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x, y, style, escaped(text));
  }
  std::string finish() { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

/// Two axes of space and where they go on the page.
struct Projection {
  int across, up;
  double x, y, height;  ///< of the panel
  Bounds3 bounds;

  double scale() const {
    const auto most = static_cast<double>(bounds.extent()[across]);
    return most > 0 ? kFilled * kPanel / most : 0;
  }
  double atX(const Vec3& p) const {
    return x + kPanel / 2 + scale() * static_cast<double>(p[across] - bounds.centroid()[across]);
  }
  double atY(const Vec3& p) const {
    return y + height / 2 - scale() * static_cast<double>(p[up] - bounds.centroid()[up]);
  }
};

void drawPanel(Svg& svg, const Projection& p, const LightTreePicture& picture) {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  svg.label(p.x, p.y - 8, "soft",
            fmt::format("{} to the right, {} up", kAxes[static_cast<size_t>(p.across)],
                        kAxes[static_cast<size_t>(p.up)]));
  svg.add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"frame\"/>\n",
          p.x, p.y, kPanel, p.height);
  for (const Vec3& light : picture.lights)
    svg.add("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.3\" class=\"light\"/>\n", p.atX(light),
            p.atY(light));
  for (const LightTreeNode& n : picture.nodes) {
    const double left = p.atX(n.box.min), right = p.atX(n.box.max);
    const double top = p.atY(n.box.max), bottom = p.atY(n.box.min);
    svg.add(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"box\" "
        "style=\"fill:var(--d{});stroke:var(--d{});stroke-width:{:.2f}\"/>\n",
        left, top, std::max(right - left, 0.5), std::max(bottom - top, 0.5), n.depth % kColours,
        n.depth % kColours, std::max(0.6, 2.4 - 0.3 * n.depth));
  }
}

double meanIntensity(const LightTreeNode& n) { return n.intensity / n.lights; }

/// What most nodes lie between: few outliers shall not take all the colours.
std::pair<double, double> brightnessRange(std::span<const LightTreeNode> nodes) {
  std::vector<double> means;
  for (const LightTreeNode& n : nodes) means.push_back(meanIntensity(n));
  std::sort(means.begin(), means.end());
  const size_t left = means.size() / 20;
  return {means[left], means[means.size() - 1 - left]};
}

/// Bars of equal height, one row a level; a child lies below its part of the parent.
void drawLevels(Svg& svg, double y, std::span<const LightTreeNode> nodes) {
  const auto [dark, bright] = brightnessRange(nodes);
  const double perLight = (kWidth - 2 * kMargin) / nodes[0].lights;
  std::vector<double> next;  ///< by depth: where the next node begins, in lights
  for (const LightTreeNode& n : nodes) {
    next.resize(n.depth + 2);
    const double begin = next[n.depth];
    next[n.depth] = begin + n.lights;
    next[n.depth + 1] = begin;
    const double brightness = dark > 0 && bright > dark
                                  ? std::log(meanIntensity(n) / dark) / std::log(bright / dark)
                                  : 0.5;
    svg.add(
        "<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.1f}\" class=\"bar\" "
        "fill-opacity=\"{:.2f}\"><title>depth {}: {} light{}, intensity {:.4g}</title></rect>\n",
        kMargin + begin * perLight, y + n.depth * (kRow + kRowGap), n.lights * perLight, kRow,
        0.12 + 0.88 * std::clamp(brightness, 0., 1.), n.depth, n.lights, n.lights == 1 ? "" : "s",
        n.intensity);
  }
}

}  // namespace

std::string lightTreeSvg(const LightTreePicture& picture) {
  uint32_t levels = 0;
  for (const LightTreeNode& n : picture.nodes) levels = std::max(levels, n.depth + 1);
  const Bounds3 bounds = picture.nodes.empty() ? Bounds3() : picture.nodes[0].box;
  const Vec3 extent = bounds.extent();
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return extent[a] > extent[b]; });
  const float longest = extent[axes[0]], second = extent[axes[1]];
  const double height =
      kPanel * (1 - kFilled + kFilled * (longest > 0 ? static_cast<double>(second / longest) : 0));
  const double barsTop = kTop + height + 56;
  Svg svg(levels == 0 ? kTop : barsTop + levels * (kRow + kRowGap) + kMargin);
  svg.label(kMargin, 38, "title", picture.title);
  svg.label(kMargin, 58, "soft", picture.caption);
  if (levels == 0) return svg.finish();
  drawPanel(svg, {axes[0], axes[1], kMargin, kTop, height, bounds}, picture);
  drawPanel(svg, {axes[0], axes[2], kMargin + kPanel + kGap, kTop, height, bounds}, picture);
  svg.label(kMargin, barsTop - 14, "soft",
            "levels of the tree: bars as wide as they have lights, stronger in colour the brighter "
            "their lights are on average");
  drawLevels(svg, barsTop, picture.nodes);
  return svg.finish();
}

}  // namespace lampyris
