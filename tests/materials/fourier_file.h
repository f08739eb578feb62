// SPDX-License-Identifier: Apache-2.0
/// BSDF files of the format SCATFUN made of functions, for tests.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lampyris::test {

/// What a file holds; fields can be spoilt before it is written.
struct FourierFile {
  std::string magic = std::string("SCATFUN\1", 8);
  int32_t flags = 1, nodeCount = 0, coefficientCount = 0, orders = 0, channels = 1, bases = 1;
  float eta = 1;
  std::vector<float> mu, cdf;
  std::vector<int32_t> places;  ///< offset, length of each pair of elevations
  std::vector<float> coefficients;

  /// Writes it to a new file that is deleted when the program ends; returns its path.
  std::string write() const;
};

/// Projects functions of (μi, μo, φ), one a channel, on Fourier series.
using FourierFunction = std::function<double(double, double, double)>;
FourierFile fourierFile(const std::vector<FourierFunction>& channels, int nodes, int orders);

/// A rough coat over paper: f of light that is reflected or passes, azimuth included.
double paper(double muI, double muO, double phi);
/// A file of paper(), written once.
const std::string& paperFile();

}  // namespace lampyris::test
