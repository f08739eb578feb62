// SPDX-License-Identifier: Apache-2.0
#include "tools/render_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

namespace lampyris {

namespace {

constexpr const char* kFooter = R"(
Subcommands (each with --help):
  assemble FILE...   one image of those of several crop windows
  compare A B        how far an image is from a reference
  convert A B        an image in another format, scaled, flipped or tone-mapped
  info FILE          what an image file holds
  merge FILE...      the image of partial files, which --samples makes
  lights SCENE       what a scene's light tree looks like
  help-scene [KIND [NAME]]
                     what scene files may say

Exit codes: 0 done, 1 scene error, 2 usage, 3 input, output or memory, 130 interrupted.)";

/// "x,y".
Int2 parsePixel(const std::string& text) {
  Int2 p{0};
  const char* const end = text.data() + text.size();
  const auto x = std::from_chars(text.data(), end, p.x);
  if (x.ec == std::errc() && x.ptr != end && *x.ptr == ',') {
    const auto y = std::from_chars(x.ptr + 1, end, p.y);
    if (y.ec == std::errc() && y.ptr == end) return p;
  }
  throw UsageError(fmt::format("--pixel: expected x,y, got \"{}\"", text));
}

/// "a:b", 0 ≤ a < b.
SampleRange parseSamples(const std::string& text) {
  SampleRange r;
  const char* const end = text.data() + text.size();
  const auto a = std::from_chars(text.data(), end, r.begin);
  if (a.ec == std::errc() && a.ptr != end && *a.ptr == ':') {
    const auto b = std::from_chars(a.ptr + 1, end, r.end);
    if (b.ec == std::errc() && b.ptr == end && r.begin < r.end) return r;
  }
  throw UsageError(fmt::format(
      "--samples: expected a range like 0:16 (first, one behind the last), got \"{}\"", text));
}

std::pair<std::string, std::string> parseDefine(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError(fmt::format(
        "-D: expected kind.parameter=value or kind=plugin, e.g. integrator.maxdepth=3, got \"{}\"",
        text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// Turns "--crop 0,1,0,1" into four arguments, as pbrt-v3 scripts write them either way.
Arguments splitCrop(const Arguments& arguments) {
  Arguments out;
  bool value = false;
  for (const std::string& a : arguments) {
    const std::string name = a.substr(0, a.find('='));
    const bool crop = name == "--crop" || name == "--cropwindow" || name == "-cropwindow";
    if (crop && name.size() < a.size()) {
      out.push_back(name);
    } else if (!value || crop) {
      out.push_back(a);
      value = crop;
      continue;
    }
    const std::string list = crop ? a.substr(name.size() + 1) : a;
    value = false;
    for (size_t at = 0; at <= list.size();) {
      const size_t comma = std::min(list.find(',', at), list.size());
      out.push_back(list.substr(at, comma - at));
      at = comma + 1;
    }
  }
  return out;
}

void check(const RenderSettings& s) {
  if (s.scenes.empty()) throw UsageError("expected a scene file (or - for standard input)");
  const bool single = s.pixel || !s.resume.empty() || !s.checkpoint.empty() ||
                      !s.statistics.empty() || !s.outputs.empty() || s.samples;
  // What CLI11 lets through: a NaN is not out of any range.
  if (std::isnan(s.seconds) || std::isnan(s.noise))
    throw UsageError("--seconds and --noise: expected a number above 0");
  if (s.scenes.size() > 1 && single)
    throw UsageError(
        "--out, --pixel, --samples, --stats, --checkpoint and --resume need a single scene file");
  if (s.print && (s.scenes.size() > 1 || single))
    throw UsageError(
        "--cat and --toply print a single scene file, and render nothing: no --out, --pixel, "
        "--stats, --checkpoint or --resume goes with them");
  if (s.pixel && !(s.resume.empty() && s.checkpoint.empty()))
    throw UsageError("--pixel renders no image that could be resumed");
  if (s.pixel && !s.snapshots.empty())
    throw UsageError("--pixel renders no image that snapshots could be taken of");
  if (s.samples && (s.pixel || s.print || s.seconds > 0 || s.noise > 0 || !s.snapshots.empty()))
    throw UsageError(
        "--samples renders a part of an image: no --seconds, --noise, --snapshots, --pixel, --cat "
        "or --toply goes with it");
  const auto isPart = [](const std::string& path) { return path.ends_with(kPartEnding); };
  if (s.samples && (s.outputs.size() > 1 || (s.outputs.size() == 1 && !isPart(s.outputs[0]))))
    throw UsageError(
        fmt::format("--samples writes one partial file: expected --out NAME{}, got \"{}\"",
                    kPartEnding, s.outputs.back()));
  for (const Snapshot& snapshot : s.snapshots) {
    const bool late = s.seconds > 0 && snapshot.stop.seconds > s.seconds;
    const auto spp = static_cast<uint64_t>(s.build.samplesPerPixel);
    if (late || (spp > 0 && snapshot.stop.samples > spp))
      throw UsageError(fmt::format("--snapshots: \"{}\" is beyond {}", snapshot.name,
                                   late ? "--seconds" : "--spp"));
  }
  const auto& c = s.build.cropWindow;
  if (!c.empty() && !(c[0] < c[1] && c[2] < c[3]))
    throw UsageError("--crop: expected x0 x1 y0 y1 with x0 < x1 and y0 < y1");
}

/// The options as CLI11 leaves them.
struct Raw {
  RenderSettings settings;
  std::string pixel, snapshots, samples, aovs;
  std::vector<std::string> defines;
  bool cat = false, toPly = false;
};

RenderSettings interpret(Raw raw) {
  RenderSettings& s = raw.settings;
  if (!raw.pixel.empty()) s.pixel = parsePixel(raw.pixel);
  for (const std::string& d : raw.defines) s.build.overrides.push_back(parseDefine(d));
  if (!raw.snapshots.empty()) s.snapshots = parseSnapshots(raw.snapshots);
  if (!raw.samples.empty()) s.samples = parseSamples(raw.samples);
  if (!raw.aovs.empty()) s.build.overrides.emplace_back("film.aovs", raw.aovs);
  if (raw.cat || raw.toPly) s.print = PrintOptions{raw.toPly};
  check(s);
  if (s.checkpoint.empty()) s.checkpoint = s.resume;
  return std::move(s);
}

}  // namespace

struct RenderArguments::Options {
  Raw raw;
  CLI::App app{"Lampyris renders pbrt-v3 scene files.", "lampyris"};
};

RenderArguments::RenderArguments() : options_(std::make_unique<Options>()) {
  auto& [raw, app] = *options_;
  RenderSettings& s = raw.settings;
  app.set_version_flag("--version", "lampyris " LAMPYRIS_VERSION);
  app.footer(kFooter);
  app.add_option("scene", s.scenes, "Scene files; - is standard input");
  app.add_option("--spp", s.build.samplesPerPixel, "Samples a pixel")
      ->check(CLI::Range(1, 1 << 30));
  app.add_option("--seconds", s.seconds, "Render for this long; with --spp: or until it is reached")
      ->check(CLI::PositiveNumber);
  app.add_option("--noise", s.noise,
                 "Render until the estimated relative error is this, e.g. 0.01; with --spp or "
                 "--seconds: or until that is reached")
      ->check(CLI::PositiveNumber);
  app.add_option("--snapshots", raw.snapshots,
                 "Write OUT-NAME.exr on the way, at times and sample counts: 0.5s,1s or 1spp,4spp");
  app.add_option("--samples", raw.samples,
                 "Render only samples a to b - 1 of the --spp of each pixel, into a partial file "
                 "NAME.part for lampyris merge: a:b");
  app.add_option("--aov", raw.aovs,
                 fmt::format("Layers to write into EXR files, with commas between: {}",
                             fmt::join(kAovNames, ", ")));
  app.add_option("-o,--out,--outfile", s.outputs,
                 "Image to write (.exr, .png, .pfm …); may be given several times")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--threads,--nthreads", s.threads, "Threads; 0: all")->check(CLI::Range(0, 4096));
  app.add_option("--seed", s.build.seed, "Seed of the sampler");
  app.add_option("--crop,--cropwindow", s.build.cropWindow,
                 "Part of the image to render: x0 x1 y0 y1 in [0, 1]")
      ->expected(4)
      ->allow_extra_args(false)
      ->check(CLI::Range(0., 1.));
  app.add_option("--pixel", raw.pixel,
                 "Render only pixel x,y and print it; --verbose: each sample");
  app.add_option("--checkpoint", s.checkpoint, "File to save the state in now and then");
  app.add_option("--checkpoint-interval", s.checkpointInterval, "Seconds between checkpoints")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--resume", s.resume,
                 "Checkpoint to go on from (and to update, without --checkpoint)");
  app.add_option("--stats", s.statistics, "JSON file for the statistics");
  app.add_option(
         "-D,--define", raw.defines,
         "kind.parameter=value or kind=plugin: overrides the scene's integrator, sampler, film, "
         "camera, filter or lightsampler")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_flag("--quick", s.quick, "A quarter of the resolution, one sample a pixel");
  app.add_flag("-q,--quiet", s.quiet, "Only errors");
  app.add_flag("-v,--verbose", s.verbose, "All statistics");
  app.add_flag("--cat", raw.cat,
               "Print the scene as one text in an even layout, and render nothing");
  app.add_flag("--toply", raw.toPly,
               "The same, with triangle meshes in PLY files, which are written beside the scene");
}

RenderArguments::~RenderArguments() = default;

std::optional<RenderSettings> RenderArguments::parse(const Arguments& arguments) {
  options_->raw = {};
  if (parseArguments(options_->app, splitCrop(arguments))) return std::nullopt;
  return interpret(options_->raw);
}

}  // namespace lampyris
