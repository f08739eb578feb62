// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "core/atomic_file.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "tools/checkpoint.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "tools/messages.h"
#include "tools/outputs.h"
#include "tools/pixel_probe.h"
#include "tools/print_command.h"
#include "tools/progress.h"
#include "tools/render_settings.h"
#include "tools/run_report.h"

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
  RenderSession(const RenderSettings& settings, std::string scene)
      : settings_(settings),
        scene_(std::move(scene)),
        diagnostics_(files_, [this](const std::string& text) {
          if (!settings_.quiet) say("{}\n", text);
        }) {}

  /// Prints scene errors itself, since only it can tell their places; returns the exit code.
  int run();

 private:
  std::unique_ptr<RenderJob> load(const BuildOptions& options);
  void loadJob();
  void checkIntegrator() const;
  void resume();
  uint64_t fingerprint() const;
  RenderOptions renderOptions();
  void renderImage(const Outputs& outputs);
  void renderPixel();
  void passDone(const RenderProgress& progress);
  void saveCheckpoint(uint64_t nextSample, const LearnedState* learned);
  void attempt(const std::function<void()>& save);
  uint64_t render(Film& film, const RenderOptions& options);
  ImageMetadata metadata(double samples) const;
  void takeSnapshot(size_t number, const std::string& output, const RenderProgress& progress);
  void warnOfMissedSnapshots();

  const RenderSettings& settings_;
  const std::string scene_;
  std::string standardInput_;
  SourceFiles files_;
  Statistics statistics_;
  Diagnostics diagnostics_;
  std::unique_ptr<RenderJob> job_;
  std::optional<InterruptGuard> interrupt_;  ///< once the scene is loaded
  RunReport report_;
  uint64_t firstSample_ = 0;
  std::string learned_;  ///< until then
  uint64_t fingerprint_ = 0;
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

/// Of all that decides a sample's value; not of the number of samples, which may be raised.
uint64_t RenderSession::fingerprint() const {
  Fingerprint f;
  for (size_t i = 0; i < files_.count(); ++i) f.add(files_.text(static_cast<uint16_t>(i)));
  for (const auto& [name, value] : settings_.build.overrides) f.add(name), f.add(value);
  f.add(settings_.build.seed);
  f.add(settings_.quick ? 1 : 0);
  for (const float c : settings_.build.cropWindow) f.add(std::bit_cast<uint32_t>(c));
  return f.value();
}

void RenderSession::resume() {
  const Checkpoint c = readCheckpoint(settings_.resume);
  if (c.fingerprint != fingerprint_)
    throw IoError(
        fmt::format("checkpoint \"{}\" is of another scene or of other options (-D, --seed, "
                    "--crop, --quick); use those of the interrupted run",
                    settings_.resume));
  if (!job_->film->restore(c.film))
    throw IoError(fmt::format("checkpoint \"{}\" is of another film", settings_.resume));
  firstSample_ = c.nextSample;
  learned_ = c.learned;
}

RenderOptions RenderSession::renderOptions() {
  RenderOptions o;
  o.firstSample = firstSample_;
  o.learned = learned_;
  o.sampleCount = static_cast<uint64_t>(settings_.build.samplesPerPixel);
  o.seconds = settings_.seconds;
  o.noise = settings_.noise;
  for (const Snapshot& s : settings_.snapshots) o.stops.push_back(s.stop);
  o.cancel = &interrupt_->flag();
  return o;
}

ImageMetadata RenderSession::metadata(double samples) const {
  // Nothing that differs between two runs of the same render: images are compared bit for bit.
  return {{"software", "Lampyris"},
          {"samplesPerPixel", fmt::format("{:.10g}", samples)},
          {"seed", std::to_string(settings_.build.seed)}};
}

void RenderSession::saveCheckpoint(uint64_t nextSample, const LearnedState* learned) {
  if (settings_.checkpoint.empty()) return;
  writeCheckpoint(settings_.checkpoint, {fingerprint_, nextSample, job_->film->save(),
                                         learned ? learned->save() : std::string()});
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
  if (!learns) saveCheckpoint(samples, nullptr);
  report_.noise = job_->film->noise();
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

int RenderSession::run() {
  try {
    const auto start = std::chrono::steady_clock::now();
    loadJob();
    checkIntegrator();
    report_.scene = scene_;
    report_.loadSeconds = secondsSince(start);
    interrupt_.emplace();  // until here there is nothing to lose
    if (settings_.pixel) {
      renderPixel();
    } else {
      const Outputs outputs(settings_.outputs, *job_->film);
      if (!job_->film->aovs().empty() && !outputs.takesLayers() && settings_.snapshots.empty())
        diagnostics_.warn({},
                          "layers are asked for, but only EXR files can hold them: "
                          "add --out FILE.exr");
      if (!settings_.checkpoint.empty()) {
        const AtomicFile probe(settings_.checkpoint);  // fails now, not hours later
        fingerprint_ = fingerprint();
      }
      if (!settings_.resume.empty()) resume();
      renderImage(outputs);
      if (!settings_.quiet) say("{}: {}\n", scene_, fmt::join(outputs.paths(), ", "));
    }
    report_.warnings = diagnostics_.warnings();
    if (!settings_.quiet) say("{}", summary(report_, statistics_, settings_.verbose));
    if (!settings_.statistics.empty()) writeStatistics(settings_.statistics, report_, statistics_);
    return report_.interrupted ? kInterrupted : kDone;
  } catch (const SceneError& e) {
    say("{}\n", formatMessage(files_, e.location, "error", e.what()));
    return kSceneError;
  }
}

}  // namespace

int runRender(const Arguments& arguments) {
  const auto settings = parseRenderSettings(arguments);
  if (!settings) return kDone;
  if (settings->print) return runPrint(*settings);
  ignoreWriteSignals();
  const ThreadLimit threads(settings->threads);
  for (const std::string& scene : settings->scenes) {
    const int code = RenderSession(*settings, scene).run();
    if (code != kDone) return code;
  }
  return kDone;
}

}  // namespace lampyris
