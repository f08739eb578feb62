// SPDX-License-Identifier: Apache-2.0
#include "scene/build_state.h"

#include <exception>
#include <mutex>

#include "core/parallel.h"
#include "scene/parser.h"

namespace lampyris {

BuildState::BuildState(const Description& description, const BuildOptions& options,
                       const std::string& folder, SourceFiles& files, Diagnostics& diagnostics,
                       Statistics& statistics, RenderJob& job)
    : description(description),
      options(options),
      diagnostics(diagnostics),
      statistics(statistics),
      job(job),
      resolvePath([this, folder](const std::string& name) {
        std::string path = resolveScenePath(folder, name);
        const std::lock_guard lock(filesMutex_);
        this->job.files.insert(path);
        return path;
      }),
      overrides(options.overrides),
      spectra(folder, files) {}

const Transform& BuildState::transform(uint32_t index, SourceLocation where) const {
  const TransformPair& pair = description.transforms[index];
  if (pair.isAnimated())
    diagnostics.warn(where,
                     "only shapes, instances and the camera move: this stands where it is at the "
                     "start time");
  return pair.start;
}

AnimatedTransform BuildState::motion(uint32_t index) const {
  const TransformPair& pair = description.transforms[index];
  return {pair.start, description.transformTimes[0], pair.end, description.transformTimes[1]};
}

void parallelForEach(size_t count, size_t grain, const std::function<void(size_t)>& body) {
  std::mutex mutex;
  std::exception_ptr error;
  size_t errorAt = count;
  parallelFor(count, grain, [&](size_t begin, size_t end) {
    size_t i = begin;
    try {
      for (; i < end; ++i) body(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (i < errorAt) errorAt = i, error = std::current_exception();
    }
  });
  if (error) std::rethrow_exception(error);
}

}  // namespace lampyris
