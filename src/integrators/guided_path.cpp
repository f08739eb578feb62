// SPDX-License-Identifier: Apache-2.0
// T. Bashford-Rogers, K. Debattista and A. Chalmers 2012, "A Significance Cache for Accelerating
// Global Illumination": path tracing whose next directions come from a mixture of the BSDF and a
// guide that learns from the paths. Each pass is unbiased given the passes before it, for the guide
// stands still meanwhile; passes double, and the image is their mean by sample counts.
#include "integrators/guided_path.h"

#include "core/bytes.h"
#include "guiding/guides.h"
#include "integrators/common_parameters.h"
#include "integrators/guide_photons.h"
#include "integrators/pixel_integrator.h"

namespace lampyris {

namespace {

/// 16 samples a pixel: a guide is not judged by what it did while it knew less. One that starts
/// from photons, which surfaces keep, knows most from the beginning: 4.
constexpr int kPassesBeforeRetiring = 5, kSeededPassesBeforeRetiring = 3;
/// Part of the mean promise of all paths that is too little to be guided for.
constexpr double kNegligible = 0.03;
/// Until a first pass has shown how many a path leaves.
constexpr double kFirstGuess = 8;

struct GuidedPathParameters : PathSettings {
  std::string lightSampler;
  GuideSettings guide;
  float ownShare = 0.5f;

  void declare(Declaration& d) {
    PathSettings::declare(d);
    declareLightSampler(d, lightSampler);
    guide.declare(d);
    d.add("bsdffraction", ownShare,
          "Share of directions drawn from the BSDF or phase function where there is a guide.")
        .range(0.01, 1);
  }
};

class GuidedPathIntegrator final : public PixelIntegrator<GuidedPathParameters> {
 public:
  using PixelIntegrator::PixelIntegrator;
  bool rendersMedia() const override { return true; }
  /// Of what a pass leaves to be learned from, twice while it is sorted, or of the photons before.
  double memory(const Film& film) const override {
    // In closed rooms a photon is kept at three of its bounces, as itself and twice while sorted.
    constexpr double kEach = 3 * (sizeof(GuidePhoton) + 2 * sizeof(GuideSample));
    // One for 16 paths, of usually 64 a pixel.
    const double photons = std::min(static_cast<double>(parameters_.guide.significance.photons),
                                    4. * static_cast<double>(film.bounds().area()));
    return std::max(2 * sizeof(GuideSample) * GuideTrainer::kSamplesPerPass, kEach * photons);
  }
  std::string_view partsDiffer() const override {
    return "each part learns from its own samples alone";
  }

 private:
  uint64_t renderPixels(RenderContext& context, const PixelBounds& pixels) const override {
    const int64_t samples = context.options.sampleCount > 0
                                ? static_cast<int64_t>(context.options.sampleCount)
                                : context.sampler.samplesPerPixel();
    const auto guide = makeGuide(
        parameters_.guide, context.scene, samples * pixels.area(),
        [&](int count) { return traceGuidePhotons(context.scene, count, parameters_.maxDepth); });
    Guidance guidance;
    guidance.guide = guide.get();
    guidance.ownShare = parameters_.ownShare;
    const VolumePathEstimator estimator(context.scene, parameters_, distribution_.get(), guidance);
    if (!guide) return renderPasses(context, pixels, estimator);
    const bool isSeeded = parameters_.guide.significance.photons > 0 && context.scene.media.empty();
    GuideTrainer trainer(*guide, guidance, pixels.area(),
                         isSeeded ? kSeededPassesBeforeRetiring : kPassesBeforeRetiring);
    if (context.options.firstSample > 0 && !trainer.restore(context.options.learned))
      throw SceneError(location_, "the checkpoint does not hold what this guide has learned");
    const uint64_t done = renderPasses(context, pixels, estimator, &trainer);
    trainer.report(context.statistics);
    return done;
  }
};

double secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void GuideTrainer::beginPass(const Pass& pass) {
  pass_ = pass;
  tiles_.resize(pass.tiles);
  guidance_.use = !retired_;
  guidance_.collect = !retired_ && !pass.isLast && guide_.learns();
  const double perPath = passes_ > 0 ? samplesPerPath_ : kFirstGuess;
  const double expected = static_cast<double>(pass.samples) * pixels_ * perPath;
  guidance_.stride =
      static_cast<uint64_t>(std::clamp(std::ceil(expected / kSamplesPerPass), 1., 1e15));
}

void GuideTrainer::tileDone(size_t tile, RenderState& state) {
  auto& memory = static_cast<GuidedMemory&>(*state.memory);
  memory.gain.finish();
  tiles_[tile] = {std::move(memory.samples), memory.gain, memory.promised, memory.paths};
  const std::lock_guard lock(mutex_);
  lookups_ += memory.lookups;
  guided_ += memory.guided;
  drawn_ += memory.drawn;
}

void GuideTrainer::endPass() {
  ++passes_;
  if (guidance_.use) {
    gain_.fade();
    double promised = 0, paths = 0;
    for (const Tile& tile : tiles_) {
      gain_ += tile.gain;
      promised += tile.promised;
      paths += static_cast<double>(tile.paths);
    }
    const double negligible = kNegligible * promised / paths;
    guidance_.negligible = std::isfinite(negligible) ? static_cast<float>(negligible) : 0;
  }
  if (pass_.isLast) return;
  const double start = secondsNow();
  double samples = 0;
  for (Tile& tile : tiles_) {
    guide_.learn(tile.samples);
    samples += static_cast<double>(tile.samples.size());
    tile = {};
  }
  guide_.endPass();
  retired_ = retired_ || (passes_ >= passesBeforeRetiring_ && guide_.learns() && !gain_.pays());
  const double paths =
      pixels_ * static_cast<double>(pass_.samples) / static_cast<double>(guidance_.stride);
  samplesPerPath_ = samples / paths;
  seconds_ += secondsNow() - start;
}

std::string GuideTrainer::save() const {
  ByteWriter out;
  out.put(passes_);
  out.put(samplesPerPath_);
  out.put(retired_);
  out.put(gain_);
  out.put(guidance_.negligible);
  return out.bytes() + guide_.save();
}

bool GuideTrainer::restore(std::string_view bytes) {
  ByteReader in(bytes);
  in.get(passes_);
  in.get(samplesPerPath_);
  in.get(retired_);
  in.get(gain_);
  in.get(guidance_.negligible);
  constexpr size_t kOwn = sizeof passes_ + sizeof samplesPerPath_ + sizeof retired_ + sizeof gain_ +
                          sizeof guidance_.negligible;
  return in.ok() && guide_.restore(bytes.substr(kOwn));
}

void GuideTrainer::report(Statistics& statistics) const {
  guide_.report(statistics);
  statistics.set("guide", "passes", passes_);
  statistics.set("guide", "retired", retired_ ? 1 : 0);
  statistics.set("guide", "variance with the guide over that without", gain_.varianceRatio());
  statistics.set("guide", "look-ups", static_cast<double>(lookups_));
  statistics.set("guide", "share of directions with a guide",
                 drawn_ > 0 ? static_cast<double>(guided_) / static_cast<double>(drawn_) : 0);
  statistics.set("guide", "seconds of learning", seconds_);
}

IntegratorRegistry::Entry guidedPathPlugin() {
  return makePlugin("guidedpath",
                    "Path tracing, with media, guided by what earlier passes have found.",
                    createPixelIntegrator<GuidedPathIntegrator, GuidedPathParameters>);
}

}  // namespace lampyris
