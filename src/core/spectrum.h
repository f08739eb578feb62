// SPDX-License-Identifier: Apache-2.0
/// Spectra to RGB, as pbrt-v3's RGB build converts them.
#pragma once

#include <span>

#include "core/rgb.h"
#include "core/vector.h"

namespace lampyris {

/// CIE XYZ to linear sRGB.
Rgb xyzToRgb(const Vec3& xyz);

/// RGB of a spectrum given as wavelength (nm), value pairs in any order: linear between the
/// wavelengths, constant beyond them, weighed by the CIE 1931 matching functions on 360–830 nm.
/// As in pbrt-v3 a spectrum that is 1 everywhere gives 470/471 of Y, not 1 (471 samples at 1 nm
/// stand for an interval of 470 nm).
Rgb spectrumToRgb(std::span<const float> pairs);

/// RGB of a blackbody's emission at a temperature in kelvin, scaled so that the spectrum's maximum
/// is 1. Black at temperatures ≤ 0.
Rgb blackbodyRgb(float kelvin);

}  // namespace lampyris
