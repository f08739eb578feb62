// SPDX-License-Identifier: Apache-2.0
#include "tools/saved_state.h"

#include <fmt/format.h>

#include <bit>
#include <filesystem>

#include "core/error.h"
#include "core/source.h"

namespace lampyris {

namespace {

uint64_t contentHash(const std::string& path) {
  Fingerprint f;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) f.add(MappedFile(path).text());
  return f.value();
}

/// Of all that decides a sample's value. The number of samples counts for parts only, since that of
/// a whole image may be raised later.
uint64_t fingerprintOf(const RenderSettings& settings, const RenderJob& job,
                       const SourceFiles& files, uint64_t whole) {
  Fingerprint f;
  f.add(LAMPYRIS_VERSION);
  for (size_t i = 0; i < files.count(); ++i) f.add(files.text(static_cast<uint16_t>(i)));
  // Another machine may have them in other places.
  uint64_t named = 0;
  for (const std::string& path : job.files) named += contentHash(path);
  f.add(named);
  for (const auto& [name, value] : settings.build.overrides) f.add(name), f.add(value);
  f.add(settings.build.seed);
  f.add(settings.quick ? 1 : 0);
  for (const float c : settings.build.cropWindow) f.add(std::bit_cast<uint32_t>(c));
  f.add(whole);
  return f.value();
}

}  // namespace

SavedState::SavedState(const RenderSettings& settings, const RenderJob& job,
                       const SourceFiles& files)
    : settings_(settings), film_(*job.film) {
  common_.seed = settings.build.seed;
  if (settings.samples) {
    common_.whole = static_cast<uint64_t>(job.sampler->samplesPerPixel());
    common_.range = *settings.samples;
    if (common_.range.end > common_.whole)
      throw UsageError(fmt::format(
          "--samples {}:{}: the image has {} samples a pixel; --spp tells the number of all parts "
          "together",
          common_.range.begin, common_.range.end, common_.whole));
  }
  common_.fingerprint = fingerprintOf(settings, job, files, common_.whole);
}

void SavedState::resume(RenderOptions& options) const {
  const std::string& path = settings_.resume;
  const Checkpoint c = readCheckpoint(path);
  if (c.fingerprint != common_.fingerprint)
    throw IoError(
        fmt::format("checkpoint \"{}\" is of another scene or of other options (-D, --seed, "
                    "--crop, --quick{}); use those of the interrupted run",
                    path, c.isPart() || settings_.samples ? ", --spp, --samples" : ""));
  if (c.range != common_.range)
    throw IoError(
        fmt::format("checkpoint \"{}\" is of --samples {}:{}", path, c.range.begin, c.range.end));
  if (!film_.restore(c.film))
    throw IoError(fmt::format("checkpoint \"{}\" is of another film", path));
  options.firstSample = c.samples;
  options.learned = c.learned;
}

void SavedState::write(const std::string& path, uint64_t samples,
                       const LearnedState* learned) const {
  Checkpoint c = common_;
  c.samples = samples;
  c.film = film_.save();
  if (learned) c.learned = learned->save();
  writeCheckpoint(path, c);
}

}  // namespace lampyris
