// SPDX-License-Identifier: Apache-2.0
#include "fourier_file.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace lampyris::test {

namespace {

/// A folder that goes with the program.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "lampyris-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string next() { return (path_ / (std::to_string(count_++) + ".bsdf")).string(); }

 private:
  std::filesystem::path path_;
  int count_ = 0;
};

}  // namespace

std::string FourierFile::write() const {
  static Folder folder;
  const std::string path = folder.next();
  std::ofstream out(path, std::ios::binary);
  const auto put = [&out](const auto* data, size_t count) {
    out.write(reinterpret_cast<const char*>(data),
              static_cast<std::streamsize>(count * sizeof *data));
  };
  const int32_t zeros[4] = {};
  put(magic.data(), magic.size());
  for (const int32_t v : {flags, nodeCount, coefficientCount, orders, channels, bases}) put(&v, 1);
  put(zeros, 3);
  put(&eta, 1);
  put(zeros, 4);
  put(mu.data(), mu.size());
  put(cdf.data(), cdf.size());
  put(places.data(), places.size());
  put(coefficients.data(), coefficients.size());
  return path;
}

FourierFile fourierFile(const std::vector<FourierFunction>& channels, int nodes, int orders) {
  FourierFile file;
  file.nodeCount = nodes;
  file.orders = orders;
  file.channels = static_cast<int32_t>(channels.size());
  // Dense at grazing angles on both sides of 0, where reflection and transmission meet.
  for (int i = 0; i < nodes; ++i) {
    const double x = (i + 0.5) / nodes * 2 - 1;
    file.mu.push_back(static_cast<float>(std::copysign(1 - std::pow(1 - std::abs(x), 1.5), x)));
  }
  file.mu.front() = -1, file.mu.back() = 1;
  for (const float o : file.mu)
    for (const float i : file.mu) {
      file.places.push_back(static_cast<int32_t>(file.coefficients.size()));
      file.places.push_back(orders);
      for (const auto& f : channels)
        for (int k = 0; k < orders; ++k) {
          const int steps = 4 * orders;
          double sum = 0;
          for (int s = 0; s < steps; ++s) {
            const double phi = 2 * M_PI * (s + 0.5) / steps;
            sum += f(static_cast<double>(i), static_cast<double>(o), phi) * std::cos(k * phi);
          }
          file.coefficients.push_back(static_cast<float>((k ? 2 : 1) * sum / steps));
        }
    }
  file.cdf.resize(file.mu.size() * file.mu.size());
  file.coefficientCount = static_cast<int32_t>(file.coefficients.size());
  return file;
}

double paper(double muI, double muO, double phi) {
  const double sines = std::sqrt((1 - muI * muI) * (1 - muO * muO));
  // Light goes down where μi < 0: reflected if wo is above. Forward is φ = 0.
  const double angle = sines * std::cos(phi) - std::abs(muI * muO);
  const double lobe = std::exp(4 * (angle - 1 + 2 * std::abs(muI * muO)));
  return (muI * muO < 0 ? 0.5 : 0.2) / M_PI * (1 + 0.5 * lobe);
}

const std::string& paperFile() {
  static const std::string path = [] {
    const auto values = [](double i, double o, double phi) {
      return paper(i, o, phi) * std::abs(i);
    };
    return fourierFile({values}, 48, 24).write();
  }();
  return path;
}

}  // namespace lampyris::test
