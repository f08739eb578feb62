// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "core/huge_pages.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "tools/memory_estimate.h"
#include "tools/messages.h"
#include "tools/outputs.h"
#include "tools/pixel_probe.h"
#include "tools/print_command.h"
#include "tools/progress.h"
#include "tools/render_settings.h"
#include "tools/run_report.h"
#include "tools/saved_state.h"
#include "tools/with_scene.h"

namespace lampyris {

namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// All of it; throws IoError where that is more than memory can be meant for.
std::string readStandardInput() {
  const double most = availableMemory() / 8;
  std::string text;
  std::array<char, 1 << 16> piece;
  while (const size_t n = std::fread(piece.data(), 1, piece.size(), stdin)) {
    text.append(piece.data(), n);
    if (static_cast<double>(text.size()) > most)
      throw IoError(fmt::format("standard input has no end: {} bytes and more", text.size()));
  }
  return text;
}

/// One scene file from its text to its images.
class RenderSession {
 public:
  RenderSession(const RenderSettings& settings, std::string scene, SourceFiles& files,
                Diagnostics& diagnostics)
      : settings_(settings), scene_(std::move(scene)), files_(files), diagnostics_(diagnostics) {}

  /// Returns whether it was interrupted.
  bool run();

 private:
  std::unique_ptr<RenderJob> load(const BuildOptions& options);
  void loadJob();
  void checkIntegrator() const;
  RenderOptions renderOptions();
  Outputs openOutputs();
  void renderImage(const Outputs& outputs);
  void renderPixel();
  void passDone(const RenderProgress& progress);
  void saveCheckpoint(uint64_t samples, const LearnedState* learned);
  void attempt(const std::function<void()>& save);
  uint64_t render(Film& film, const RenderOptions& options);
  ImageMetadata metadata(double samples) const;
  void takeSnapshot(size_t number, const std::string& output, const RenderProgress& progress);
  void warnOfMissedSnapshots();

  const RenderSettings& settings_;
  const std::string scene_;
  std::string standardInput_;
  SourceFiles& files_;
  Statistics statistics_;
  Diagnostics& diagnostics_;
  std::unique_ptr<RenderJob> job_;
  std::string part_;                         ///< the partial file to write; empty: images
  std::optional<InterruptGuard> interrupt_;  ///< once the scene is loaded
  RunReport report_;
  std::optional<SavedState> saved_;  ///< where the state is read or written
  double lastCheckpoint_ = 0;
};

std::unique_ptr<RenderJob> RenderSession::load(const BuildOptions& options) {
  return scene_ == "-"
             ? loadSceneText(standardInput_, ".", options, files_, diagnostics_, statistics_)
             : loadScene(scene_, options, files_, diagnostics_, statistics_);
}

void RenderSession::loadJob() {
  if (scene_ == "-") standardInput_ = readStandardInput();
  job_ = load(settings_.build);
  if (!settings_.quick) return;
  // The film's size is known only once the scene has been read.
  const Int2 size = glm::max(job_->film->resolution() / 4, Int2(1));
  BuildOptions options = settings_.build;
  options.overrides.emplace_back("film.xresolution", std::to_string(size.x));
  options.overrides.emplace_back("film.yresolution", std::to_string(size.y));
  if (options.samplesPerPixel == 0) options.samplesPerPixel = 1;
  job_ = load(options);
}

RenderOptions RenderSession::renderOptions() {
  RenderOptions o;
  o.sampleCount = static_cast<uint64_t>(settings_.build.samplesPerPixel);
  if (settings_.samples) {
    o.firstIndex = settings_.samples->begin;
    o.sampleCount = settings_.samples->size();
  }
  if (!settings_.resume.empty()) saved_->resume(o);
  o.seconds = settings_.seconds;
  o.noise = settings_.noise;
  for (const Snapshot& s : settings_.snapshots) o.stops.push_back(s.stop);
  o.cancel = &interrupt_->flag();
  return o;
}

ImageMetadata RenderSession::metadata(double samples) const {
  return imageMetadata(samples, settings_.build.seed);
}

void RenderSession::saveCheckpoint(uint64_t samples, const LearnedState* learned) {
  if (!settings_.checkpoint.empty()) saved_->write(settings_.checkpoint, samples, learned);
}

/// What cannot be written while the render goes on is left for the next time.
void RenderSession::attempt(const std::function<void()>& save) {
  try {
    save();
  } catch (const IoError& e) {
    diagnostics_.warn({}, fmt::format("{}; the render goes on", e.what()));
  }
}

uint64_t RenderSession::render(Film& film, const RenderOptions& options) {
  RenderContext context{job_->scene, *job_->camera, *job_->sampler, film, options, statistics_};
  const uint64_t samples = job_->integrator->render(context);
  report_.renderSeconds = statistics_.value("render", "seconds");
  report_.interrupted = interrupt_->flag();
  return samples;
}

void RenderSession::takeSnapshot(size_t number, const std::string& output,
                                 const RenderProgress& progress) {
  const std::string& name = settings_.snapshots[number].name;
  const std::string file = snapshotPath(output, name);
  attempt([&] {
    job_->film->write(file, metadata(progress.meanSamples));
    report_.snapshots.push_back({name, progress.seconds, progress.meanSamples, file});
  });
}

void RenderSession::warnOfMissedSnapshots() {
  for (const Snapshot& s : settings_.snapshots) {
    const bool taken = std::any_of(report_.snapshots.begin(), report_.snapshots.end(),
                                   [&s](const TakenSnapshot& t) { return t.name == s.name; });
    if (!taken)
      diagnostics_.warn(
          {}, fmt::format("snapshot \"{}\" was not taken: the render ended before it", s.name));
  }
}

void RenderSession::renderImage(const Outputs& initial) {
  Outputs outputs = initial;
  ProgressLine line(settings_.quiet);
  RenderOptions options = renderOptions();
  bool learns = false;
  options.onProgress = [&](const RenderProgress& p) { line.update(p); };
  options.onPass = [&](const RenderProgress& p) {
    if (line.wantsNoise(p.seconds)) line.setNoise(job_->film->noise(), p.seconds);
    line.update(p);
    // Who learns does so between passes, which are few and long: part of one cannot be gone on
    // from.
    learns = p.learned != nullptr;
    if (learns || p.seconds - lastCheckpoint_ >= settings_.checkpointInterval) {
      lastCheckpoint_ = p.seconds;
      attempt([&] { saveCheckpoint(p.samplesDone, p.learned); });
    }
    attempt([&] { outputs.writePartial(*job_->film, metadata(p.meanSamples), p.seconds); });
  };
  options.onStop = [&](size_t number, const RenderProgress& p) {
    takeSnapshot(number, outputs.paths().front(), p);
  };
  const uint64_t samples = render(*job_->film, options);
  line.clear();
  warnOfMissedSnapshots();
  // The image first: it can be had without the checkpoint, but not the other way round.
  outputs.write(*job_->film, metadata(statistics_.value("render", "samples per pixel")));
  if (!part_.empty())
    writeOrRescue({part_}, [&](const std::string& path) { saved_->write(path, samples, nullptr); });
  if (!learns) saveCheckpoint(samples, nullptr);
  report_.noise = job_->film->noise();
}

/// A part of an image is no image, but a file of its own.
Outputs RenderSession::openOutputs() {
  if (!settings_.samples) return Outputs(settings_.outputs, *job_->film);
  const auto [begin, end] = *settings_.samples;
  part_ = settings_.outputs.empty()
              ? std::filesystem::path(job_->film->filename())
                    .replace_extension(fmt::format("{}-{}{}", begin, end, kPartEnding))
                    .string()
              : settings_.outputs.front();
  checkWritable(part_);
  const std::string_view why = job_->integrator->partsDiffer();
  if (!why.empty() && !settings_.quiet)
    say("{}: note: {}: the merged image is unbiased, but not bit for bit that of one render\n",
        scene_, why);
  return Outputs();
}

void RenderSession::renderPixel() {
  const PixelBounds bounds = job_->film->bounds();
  if (!bounds.contains(*settings_.pixel))
    throw UsageError(fmt::format("--pixel: the image has pixels {},{} to {},{}", bounds.min.x,
                                 bounds.min.y, bounds.max.x - 1, bounds.max.y - 1));
  PixelProbe probe(*job_->film, *settings_.pixel);
  render(probe, renderOptions());
  fmt::print("{}", probe.report(settings_.verbose));
}

/// What not every integrator can do.
void RenderSession::checkIntegrator() const {
  const Integrator& integrator = *job_->integrator;
  const bool resumes = !settings_.checkpoint.empty() || !settings_.resume.empty();
  if (resumes && !integrator.resumes())
    throw UsageError(
        "this integrator carries more than an image from pass to pass: --checkpoint and --resume "
        "cannot be used with it");
  if (integrator.samplesPixels()) return;
  const char* const option = settings_.pixel               ? "--pixel"
                             : settings_.noise > 0         ? "--noise"
                             : !job_->film->aovs().empty() ? "--aov"
                                                           : nullptr;
  if (option)
    throw UsageError(fmt::format(
        "this integrator has no samples of single pixels: {} cannot be used with it", option));
}

bool RenderSession::run() {
  const auto start = std::chrono::steady_clock::now();
  loadJob();
  gatherIntoHugePages();
  checkIntegrator();
  report_.scene = scene_;
  report_.loadSeconds = secondsSince(start);
  interrupt_.emplace();  // until here there is nothing to lose
  if (settings_.pixel) {
    renderPixel();
  } else {
    const Outputs outputs = openOutputs();
    if (!job_->film->aovs().empty() && part_.empty() && !outputs.takesLayers() &&
        settings_.snapshots.empty())
      diagnostics_.warn({},
                        "layers are asked for, but only EXR files can hold them: "
                        "add --out FILE.exr");
    if (settings_.samples || !settings_.checkpoint.empty())
      saved_.emplace(settings_, *job_, files_);
    if (!settings_.checkpoint.empty()) checkWritable(settings_.checkpoint);
    statistics_.set("memory", "estimated bytes", expectRenderMemory(*job_, saved_.has_value()));
    renderImage(outputs);
    if (!settings_.quiet)
      say("{}: {}\n", scene_,
          part_.empty() ? fmt::to_string(fmt::join(outputs.paths(), ", ")) : part_);
  }
  report_.warnings = diagnostics_.warnings();
  statistics_.set("memory", "peak bytes", peakMemory());
  if (!settings_.quiet) say("{}", summary(report_, statistics_, settings_.verbose));
  if (!settings_.statistics.empty()) writeStatistics(settings_.statistics, report_, statistics_);
  return report_.interrupted;
}

}  // namespace

int runRender(const Arguments& arguments) {
  const auto settings = RenderArguments().parse(arguments);
  if (!settings) return kDone;
  if (settings->print) return runPrint(*settings);
  ignoreWriteSignals();
  const ThreadLimit threads(settings->threads);
  for (const std::string& scene : settings->scenes) {
    bool interrupted = false;
    const int code = withScene(settings->quiet, [&](SourceFiles& files, Diagnostics& diagnostics) {
      interrupted = RenderSession(*settings, scene, files, diagnostics).run();
    });
    if (code != kDone) return code;
    if (interrupted) return kInterrupted;
  }
  return kDone;
}

}  // namespace lampyris
