// SPDX-License-Identifier: Apache-2.0
/// What every stress test asks of a render: finite, not negative, nothing rejected, and the mean of
/// a computation in double precision.
#pragma once

#include <string>
#include <vector>

#include "stress/double_scene.h"

namespace lampyris::test {

using Views = std::vector<TinyView>;

/// "path" with every light distribution. `parameters` of the integrator, here and below.
Views lightSamplerViews(const std::string& parameters);
/// Every integrator whose image is the radiance after one bounce off matte surfaces.
Views directViews(const std::string& parameters);
/// Those of them that follow light of any kind, without a blur.
Views pathViews(const std::string& parameters);
Views operator+(Views a, const Views& b);

/// Renders; the mean of the pixels must be the expected one but for noise (false alarms: 1e-9) and
/// the slack.
void expectRadiance(const TinyView& view, const std::string& scene, const Expected& expected,
                    uint64_t samples);
/// What is true of every render.
void expectSound(TinyScene& scene);
/// The contract of every light distribution (base/light_distribution.h) at what the middle of the
/// image sees. Asks for all lights one by one if there are no more than 10'000.
void expectLightContract(TinyScene& scene);

}  // namespace lampyris::test
