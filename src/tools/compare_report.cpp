// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/compare.h"

namespace lampyris {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 4> kChannels = {"red", "green", "blue", "luminance"};

std::string figure(const std::optional<double>& v) {
  return v ? fmt::format("{:.6g}", *v) : "undefined (the reference's mean is 0)";
}

std::string ratioText(const MeanRatio& r) {
  if (!std::isfinite(r.low)) return fmt::format("{:.6g}", r.ratio);
  return fmt::format("{:.6g}  [{:.6g}, {:.6g}]", r.ratio, r.low, r.high);
}

Json number(const std::optional<double>& v) {
  return v && std::isfinite(*v) ? Json(*v) : Json(nullptr);
}

}  // namespace

std::string formatComparison(const Comparison& c) {
  if (!c.error.empty()) return c.error + "\n";
  std::string text;
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("{:<18}{}\n", name, value);
  };
  line("MSE", figure(c.mse));
  line("RMSE", figure(c.rmse));
  line("MAE", figure(c.mae));
  line("max error", figure(c.maxError));
  line("relMSE", figure(c.relMse));
  line("relMSE, robust", figure(c.robustRelMse));
  line("relMSE, trimmed", figure(c.trimmedRelMse));
  line("mean", figure(c.meanImage));
  line("reference mean", figure(c.meanReference));
  line("mean ratio", figure(c.meanRatio));
  for (size_t i = 0; i < kChannels.size(); ++i)
    if (c.meanRatios[i]) line(fmt::format("  {}", kChannels[i]), ratioText(*c.meanRatios[i]));
  if (c.notFinite > 0)
    line("left out", fmt::format("{} pixels that are infinite or not a number", c.notFinite));
  return text;
}

std::string comparisonJson(const Comparison& c) {
  Json json;
  if (!c.error.empty()) {
    json["error"] = c.error;
  } else {
    json = {{"pixels", c.pixels},
            {"notFinite", c.notFinite},
            {"mse", c.mse},
            {"rmse", c.rmse},
            {"mae", c.mae},
            {"maxError", c.maxError},
            {"relMse", number(c.relMse)},
            {"robustRelMse", number(c.robustRelMse)},
            {"trimmedRelMse", number(c.trimmedRelMse)},
            {"mean", c.meanImage},
            {"referenceMean", c.meanReference},
            {"meanRatio", number(c.meanRatio)}};
    for (size_t i = 0; i < kChannels.size(); ++i) {
      Json& entry = json["meanRatios"][kChannels[i]];
      if (const auto& r = c.meanRatios[i])
        entry = {{"ratio", r->ratio}, {"low", number(r->low)}, {"high", number(r->high)}};
    }
  }
  return json.dump(2) + "\n";
}

}  // namespace lampyris
