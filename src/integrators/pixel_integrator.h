// SPDX-License-Identifier: Apache-2.0
/// What integrators share that sample pixels and, along their paths, lights.
#pragma once

#include "integrators/render_loop.h"

namespace lampyris {

/// `Parameters`: those of the scene file, with `pixelBounds` and `lightSampler` among them.
template <class Parameters>
class PixelIntegrator : public Integrator {
 public:
  PixelIntegrator(const Parameters& parameters, const IntegratorContext& context)
      : parameters_(parameters),
        location_(context.location),
        distribution_(context.lightDistribution(parameters.lightSampler)) {}

  uint64_t render(RenderContext& context) const final {
    return renderPixels(context, renderedPixels(context.film, parameters_.pixelBounds, location_));
  }

 protected:
  virtual uint64_t renderPixels(RenderContext& context, const PixelBounds& pixels) const = 0;

  const Parameters parameters_;
  const SourceLocation location_;
  const std::unique_ptr<LightDistribution> distribution_;
};

/// For makePlugin(), of a PixelIntegrator<Parameters>.
template <class I, class Parameters>
std::unique_ptr<Integrator> createPixelIntegrator(const Parameters& parameters,
                                                  const IntegratorContext& context) {
  return std::make_unique<I>(parameters, context);
}

}  // namespace lampyris
