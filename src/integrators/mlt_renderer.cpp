// SPDX-License-Identifier: Apache-2.0
// Metropolis sampling (Veach and Guibas 1997) in primary sample space (Kelemen et al. 2002). A
// chain keeps to one number of bounces. Chains start at bootstrap paths that are drawn by
// brightness, and count with the mean brightness of all of these: so there is no start-up bias
// (Veach 1997, §11.3.1), however short the chains are. A mutation counts on both sides, by the
// probability that it is accepted.
//
// Cost a mutation, for b bounces: about b + 1 rays, one shadow ray.
#include "integrators/mlt_renderer.h"

#include <algorithm>
#include <cmath>

#include "core/hash.h"
#include "core/parallel.h"

namespace lampyris {

namespace {

constexpr size_t kBootstrapGrain = 256;
/// Mutations between looks at the clock.
constexpr uint64_t kMutationsAtATime = 256;

/// What the bits are for.
enum Purpose : uint64_t { kBootstrap, kStart, kChain, kProposal, kStep, kAcceptance };

uint64_t hash(uint64_t seed, Purpose purpose, uint64_t n) {
  return hashCombine(hashCombine(seed, purpose), n);
}

/// No light is without it, whatever its colour.
double brightnessOf(const Rgb& c) {
  return static_cast<double>(Rgb(std::abs(c.r), std::abs(c.g), std::abs(c.b)).luminance());
}

uint64_t targetOf(const RenderOptions& options, const MltSettings& settings) {
  if (options.sampleCount > 0) return options.sampleCount;
  return options.seconds > 0 ? 0 : settings.mutationsPerPixel;
}

}  // namespace

MltRenderer::MltRenderer(RenderContext& context, const LightDistribution* distribution,
                         const MltSettings& settings)
    : PassLoop(context, targetOf(context.options, settings), false),
      settings_(settings),
      paths_(context, distribution, 1 / std::sqrt(static_cast<float>(settings.mutationsPerPixel))),
      pixels_(static_cast<uint64_t>(context.film.bounds().area())) {}

double MltRenderer::memory(const MltSettings& s) {
  const double bootstrap = static_cast<double>(s.bootstrapSamples) * (s.maxDepth + 1);
  const auto numbers = static_cast<double>(MltPaths::dimensions(s.maxDepth));
  return sizeof(double) * bootstrap +
         static_cast<double>(s.chains) * (sizeof(Chain) + 2 * sizeof(float) * numbers);
}

uint64_t MltRenderer::render() {
  bootstrap();
  // Nothing ends a render without limit if all is black.
  const uint64_t samples = chains_.empty() && target_ == 0 ? 0 : run();
  report(total_.rays);
  total_.bad.report(context_.statistics);
  Statistics& s = context_.statistics;
  s.set("metropolis", "chains", static_cast<double>(chains_.size()));
  s.set("metropolis", "mean brightness", mean_);
  if (total_.mutations > 0)
    s.set("metropolis", "accepted mutations",
          static_cast<double>(total_.accepted) / static_cast<double>(total_.mutations));
  return samples;
}

PassLoop::Samples MltRenderer::samples() const {
  return {static_cast<double>(total_.mutations) / static_cast<double>(pixels_), total_.mutations};
}

MltRenderer::State MltRenderer::evaluate(const Chain& chain, Work& work) const {
  State state{paths_.path(chain.depth, chain.numbers, work.rays), 0};
  state.brightness = brightnessOf(state.splat.value);
  if (std::isfinite(state.brightness)) return state;
  work.bad.add({Int2(state.splat.film), chain.mutations}, state.splat.value);
  return {};
}

/// Of all bootstrap paths: number i has i mod (maxdepth + 1) bounces.
std::vector<double> MltRenderer::bootstrapBrightness() {
  const auto depths = static_cast<size_t>(settings_.maxDepth) + 1;
  std::vector<double> brightness(settings_.bootstrapSamples * depths);
  parallelFor(brightness.size(), kBootstrapGrain, [&](size_t first, size_t last) {
    Work work;
    Chain chain{0, PrimarySamples(MltPaths::dimensions(settings_.maxDepth)), {}};
    for (size_t i = first; i < last && !cancelled(); ++i) {
      chain.depth = static_cast<int>(i % depths);
      chain.numbers.proposeAnew(hash(settings_.seed, kBootstrap, i));
      brightness[i] = evaluate(chain, work).brightness;
    }
    add(work);
  });
  return brightness;
}

/// The mean brightness, and where chains start.
void MltRenderer::bootstrap() {
  std::vector<double> sums = bootstrapBrightness();
  double sum = 0;
  for (double& b : sums) b = sum += b;
  mean_ = sum / static_cast<double>(settings_.bootstrapSamples);
  if (cancelled() || !(mean_ > 0)) return;
  context_.film.openLightImage(mean_);
  // Evenly over the sums, whatever the number of chains that get to run; each alone is uniform.
  constexpr double kGoldenSection = 0.618033988749894848;
  const double shift = std::ldexp(static_cast<double>(hash(settings_.seed, kStart, 0) >> 11), -53);
  chains_.reserve(settings_.chains);
  for (size_t c = 0; c < settings_.chains; ++c) {
    const double at = shift + static_cast<double>(chainNumber(c)) * kGoldenSection;
    const double u = std::min((at - std::floor(at)) * sum, std::nextafter(sum, 0.));
    const auto start = std::upper_bound(sums.begin(), sums.end(), u);
    startChain(static_cast<size_t>(start - sums.begin()));
  }
}

void MltRenderer::startChain(size_t start) {
  const auto depth = static_cast<int>(start % (static_cast<size_t>(settings_.maxDepth) + 1));
  Chain& chain =
      chains_.emplace_back(Chain{depth, PrimarySamples(MltPaths::dimensions(depth)), {}});
  chain.numbers.proposeAnew(hash(settings_.seed, kBootstrap, start));
  Work work;
  chain.state = evaluate(chain, work);
  chain.numbers.accept();
}

/// Mutations are dealt to chains in turn.
PassLoop::Pass MltRenderer::renderPass(uint64_t samples) {
  const uint64_t before = total_.mutations;
  const uint64_t all = (done_ + samples) * pixels_, count = chains_.size();
  parallelFor(chains_.size(), 1, [&](size_t first, size_t last) {
    for (size_t c = first; c < last; ++c) advance(c, (all + count - 1 - c) / count);
  });
  const bool whole = chains_.empty() || total_.mutations == all;
  return {whole ? samples : 0,
          static_cast<double>(total_.mutations - before) / static_cast<double>(pixels_)};
}

/// Until the chain has had `end` mutations.
void MltRenderer::advance(size_t number, uint64_t end) {
  Chain& chain = chains_[number];
  const uint64_t seed = hash(settings_.seed, kChain, chainNumber(number));
  while (chain.mutations < end && !cutShort()) {
    Work work;
    const uint64_t count = std::min(end - chain.mutations, kMutationsAtATime);
    for (uint64_t i = 0; i < count; ++i) mutate(chain, seed, work);
    addToFilm(chain.state, chain.weight, work);
    chain.weight = 0;
    context_.film.addLightPaths(count);
    work.mutations = count;
    add(work);
  }
}

void MltRenderer::mutate(Chain& chain, uint64_t seed, Work& work) const {
  const uint64_t n = chain.mutations++, bits = hash(seed, kProposal, n);
  if (toUnitFloat(hash(seed, kStep, n)) < settings_.largeStepProbability)
    chain.numbers.proposeAnew(bits);
  else
    chain.numbers.proposeNear(bits, settings_.sigma);
  const State proposed = evaluate(chain, work);
  const double acceptance = std::min(1., proposed.brightness / chain.state.brightness);
  chain.weight += 1 - acceptance;
  const bool accepted = static_cast<double>(toUnitFloat(hash(seed, kAcceptance, n))) < acceptance;
  if (!accepted) {
    addToFilm(proposed, acceptance, work);
    return;
  }
  addToFilm(chain.state, chain.weight, work);
  chain.numbers.accept();
  chain.state = proposed;
  chain.weight = acceptance;
  ++work.accepted;
}

void MltRenderer::addToFilm(const State& state, double weight, Work& work) const {
  if (!(weight > 0)) return;
  const Splat& s = state.splat;
  const Rgb value = s.value * static_cast<float>(weight * mean_ / state.brightness);
  if (!context_.film.addSplat(s.film, value)) work.bad.add({Int2(s.film), 0}, value);
}

void MltRenderer::add(const Work& work) {
  const std::lock_guard lock(mutex_);
  total_.rays += work.rays;
  total_.mutations += work.mutations;
  total_.accepted += work.accepted;
  if (!work.bad.empty()) total_.bad.merge(work.bad);
  tellProgress();
}

}  // namespace lampyris
