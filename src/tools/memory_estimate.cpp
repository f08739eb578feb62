// SPDX-License-Identifier: Apache-2.0
#include "tools/memory_estimate.h"

#include "core/memory.h"
#include "film/film_sums.h"

namespace lampyris {

double expectRenderMemory(const RenderJob& job, bool savesState) {
  const Film& film = *job.film;
  const FilmFrame frame{film.resolution(), film.bounds(), film.aovs()};
  const auto pixels = static_cast<double>(frame.bounds.area());
  const auto layers = static_cast<double>(AovSums::sumsPerPixel(frame.aovs));
  // Channels as floats, once more where they are clamped, and as the file's bytes.
  const double image = pixels * sizeof(float) * 3 * (3 + layers);
  // The sums as bytes; a file's reader holds them twice.
  const double state = savesState ? 2 * FilmSums::memory(frame) : 0;
  const double own = job.integrator->memory(film);
  expectMemory(own + std::max(image, state), "the render, beside the scene and the image's sums,",
               {});
  return std::max(peakMemory(), usedMemory() + own + std::max(image, state));
}

}  // namespace lampyris
