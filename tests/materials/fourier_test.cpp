// SPDX-License-Identifier: Apache-2.0
// The reader of BSDF files and the tabulated BSDF, against functions that files were made of.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numeric>

#include "fourier_file.h"
#include "material_cases.h"
#include "materials/catmull_rom.h"
#include "materials/fourier_table.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

TEST(CatmullRom, ReproducesParabolasInsideAndTheirIntegral) {
  const std::vector<float> nodes = {-1, -0.5f, 0, 0.5f, 1, 1.5f};
  const auto f = [](float x) { return 2 + x + x * x; };
  for (float x = -0.5f; x <= 1; x += 0.05f) {
    const auto w = splineWeights(nodes, x);
    ASSERT_TRUE(w);
    float sum = 0;
    for (size_t k = 0; k < 4; ++k)
      sum += w->weight[k] * f(nodes[static_cast<size_t>(w->first) + k]);
    EXPECT_NEAR(sum, f(x), 1e-5f);
  }
  EXPECT_FALSE(splineWeights(nodes, -1.01f));
  EXPECT_FALSE(splineWeights(nodes, 1.51f));
  EXPECT_FALSE(splineWeights(nodes, std::nanf("")));
}

TEST(CatmullRom, WeightsAddUpToOneOnUnequalNodes) {
  const std::vector<float> nodes = {0, 0.1f, 0.15f, 0.9f, 2};
  for (float x = 0; x <= 2; x += 0.01f) {
    const auto w = splineWeights(nodes, x);
    ASSERT_TRUE(w);
    EXPECT_NEAR(std::accumulate(w->weight.begin(), w->weight.end(), 0.f), 1, 1e-5f);
    for (size_t k = 0; k < 4; ++k) {
      const int node = w->first + static_cast<int>(k);
      EXPECT_TRUE((node >= 0 && node < 5) || w->weight[k] == 0);
    }
  }
}

TEST(CatmullRom, InversionGoesBack) {
  const std::vector<float> nodes = {0, 0.2f, 0.5f, 0.6f, 1}, values = {1, 2, 2.5f, 4, 7};
  const SplineGrid grid({0, 1}, nodes, {1, 2, 2.5f, 4, 7, 1, 2, 2.5f, 4, 7});
  for (float y = 1; y <= 7; y += 0.13f)
    EXPECT_NEAR(grid.row(0.4f)->value(invertSpline(nodes, values, y)), y, 1e-4f);
  EXPECT_EQ(invertSpline(nodes, values, 0), 0);
  EXPECT_EQ(invertSpline(nodes, values, 9), 1);
}

TEST(SplineGrid, DrawsWithTheDensityOfTheSpline) {
  const SplineGrid grid({0, 1}, {0, 0.2f, 0.5f, 0.6f, 1}, {1, 2, 3, 1, 2, 2, 1, 5, 4, 1});
  const auto row = grid.row(0.3f);
  ASSERT_TRUE(row);
  constexpr int kCells = 40, kDraws = 40'000;
  std::vector<double> observed(kCells), expected(kCells);
  for (uint64_t i = 0; i < kDraws; ++i) {
    const auto y = row->sample(uniform(51, i, 0));
    ASSERT_TRUE(y && *y >= 0 && *y <= 1);
    ++observed[std::min<size_t>(static_cast<size_t>(*y * kCells), kCells - 1)];
  }
  for (size_t c = 0; c < kCells; ++c)
    for (int k = 0; k < 10; ++k)
      expected[c] += static_cast<double>(
          kDraws / (10.f * kCells) / row->total() *
          row->value((static_cast<float>(c) + (static_cast<float>(k) + 0.5f) / 10) / kCells));
  EXPECT_EQ(chiSquareTest(observed, expected), "");
}

TEST(Fourier, AzimuthsFollowTheSeries) {
  const std::vector<float> a = {1, 0.8f, -0.1f, 0.15f};
  constexpr int kCells = 40, kDraws = 40'000;
  std::vector<double> observed(kCells), expected(kCells);
  const auto value = [&](double phi) {
    double sum = 0;
    for (size_t k = 0; k < a.size(); ++k)
      sum += static_cast<double>(a[k]) * std::cos(static_cast<double>(k) * phi);
    return sum;
  };
  for (uint64_t i = 0; i < kDraws; ++i) {
    const auto phi = sampleFourier(a, uniform(52, i, 0));
    ASSERT_TRUE(phi);
    ++observed[std::min<size_t>(static_cast<size_t>(*phi / (2 * M_PI) * kCells), kCells - 1)];
  }
  for (size_t c = 0; c < kCells; ++c)
    for (int k = 0; k < 10; ++k)
      expected[c] += kDraws / (10. * kCells) *
                     value((static_cast<double>(c) + (k + 0.5) / 10) / kCells * 2 * M_PI);
  EXPECT_EQ(chiSquareTest(observed, expected), "");
  EXPECT_FALSE(sampleFourier({}, 0.5f));
  EXPECT_FALSE(sampleFourier(std::vector<float>{0, 1}, 0.5f));
}

/// f of the material made of `file`, by cosines and the difference of azimuths of wo and −wi.
Rgb value(const std::string& path, float muI, float muO, float phi) {
  Bsdf b;
  const MaterialFixture m("fourier", {{"bsdffile", path}});
  m.evaluate(b);
  const auto direction = [&](float mu, float azimuth) {
    return b.frame().toWorld(sphericalDirection(std::sqrt(1 - mu * mu), mu, azimuth));
  };
  return b.f(direction(muO, 0.3f), -direction(muI, 0.3f + phi));
}

TEST(Fourier, GivesTheFunctionBackThatTheFileHolds) {
  for (const float muO : {0.9f, 0.4f, -0.6f})
    for (const float muI : {-0.85f, -0.3f, 0.5f})
      for (const float phi : {0.f, 1.f, 2.5f, 4.f}) {
        const double expected =
            paper(static_cast<double>(muI), static_cast<double>(muO), static_cast<double>(phi));
        EXPECT_NEAR(value(paperFile(), muI, muO, phi).g, expected, 0.01 * expected);
      }
}

TEST(Fourier, RefractionScalesRadiance) {
  FourierFile file = fourierFile({[](double i, double, double) { return std::abs(i); }}, 24, 1);
  file.eta = 1.5f;
  const std::string path = file.write();
  EXPECT_NEAR(value(path, -0.5f, 0.5f, 1).g, 1, 0.01f) << "reflected";
  EXPECT_NEAR(value(path, 0.5f, 0.5f, 1).g, 1 / 2.25f, 0.01f) << "from inside";
  EXPECT_NEAR(value(path, -0.5f, -0.5f, 1).g, 2.25f, 0.01f) << "from outside";
}

TEST(Fourier, ColoursComeFromLuminanceRedAndBlue) {
  const Rgb colour(0.4f, 0.2f, 0.1f);
  const auto channel = [](float v) {
    return [v](double i, double, double) { return static_cast<double>(v) * std::abs(i); };
  };
  const FourierFile file =
      fourierFile({channel(colour.luminance()), channel(colour.r), channel(colour.b)}, 24, 2);
  const Rgb f = value(file.write(), -0.5f, 0.7f, 1);
  EXPECT_NEAR(f.r, colour.r, 0.005f);
  EXPECT_NEAR(f.g, colour.g, 0.005f);
  EXPECT_NEAR(f.b, colour.b, 0.005f);
}

TEST(Fourier, WhitePaperReflectsAll) {
  const auto lambert = [](double i, double o, double) {
    return i * o < 0 ? std::abs(i) / M_PI : 0.;
  };
  const std::string path = fourierFile({lambert}, 64, 1).write();
  Bsdf b;
  const MaterialFixture m("fourier", {{"bsdffile", path}});
  m.evaluate(b);
  for (const float angle : {0.f, 40.f, 70.f, 120.f}) {
    std::vector<double> weights;
    for (uint64_t i = 0; i < 5000; ++i) {
      const auto s =
          b.sample(outgoing(b, angle), uniform(53, i, 0), {uniform(53, i, 1), uniform(53, i, 2)});
      weights.push_back(s ? static_cast<double>(s->f.g * b.absCosTheta(s->wi) / s->pdf) : 0);
    }
    EXPECT_EQ(meanTest(weights, 1, 0.005), "") << angle;
  }
}

TEST(FourierTable, RefusesDamagedFiles) {
  const auto one = [](double, double, double) { return 1.; };
  const FourierFile good = fourierFile({one}, 4, 3);
  EXPECT_NO_THROW(FourierTable{good.write()});
  const auto refuses = [&](const char* what, auto&& spoil) {
    FourierFile file = good;
    spoil(file);
    try {
      const FourierTable table{file.write()};
      ADD_FAILURE() << what;
    } catch (const IoError& e) {
      EXPECT_NE(std::string(e.what()).find(what), std::string::npos) << e.what();
    }
  };
  const float nan = std::nanf("");
  refuses("does not begin", [](auto& f) { f.magic[7] = '\2'; });
  refuses("ends too early", [](auto& f) { f.coefficients.pop_back(); });
  refuses("ends too early", [](auto& f) { f.coefficientCount = 2'000'000'000; });
  refuses("ends too early", [](auto& f) { f.nodeCount = 16'000; });
  refuses("elevations", [](auto& f) { f.nodeCount = -4; });
  refuses("elevations", [](auto& f) { f.nodeCount = 2'000'000'000; });
  refuses("orders", [](auto& f) { f.orders = 1 << 20; });
  refuses("one or three channels", [](auto& f) { f.channels = 2; });
  refuses("one or three channels", [](auto& f) { f.bases = 4; });
  refuses("one material", [](auto& f) { f.flags = 3; });
  refuses("refraction", [&](auto& f) { f.eta = nan; });
  refuses("ascend", [](auto& f) { f.mu[2] = f.mu[1]; });
  refuses("elevations is not a number", [&](auto& f) { f.mu[2] = nan; });
  refuses("cosines", [](auto& f) { f.mu[3] = 2; });
  refuses("coefficients is not a number", [&](auto& f) { f.coefficients[5] = nan; });
  refuses("outside", [](auto& f) { f.places[2] = -1; });
  refuses("outside", [](auto& f) { f.places[3] = 4; });
  refuses("outside", [](auto& f) { f.places[4] = f.coefficientCount - 2; });
  refuses("outside", [](auto& f) { f.places[4] = f.coefficientCount + 1, f.places[5] = 0; });
  EXPECT_THROW(FourierTable{"/nowhere/there.bsdf"}, IoError);
  EXPECT_THROW(FourierTable{std::filesystem::temp_directory_path().string()}, IoError);
}

TEST(Fourier, NeedsAFile) {
  EXPECT_THROW(MaterialFixture("fourier", {}), SceneError);
  EXPECT_THROW(MaterialFixture("fourier", {{"bsdffile", "missing.bsdf"}}), SceneError);
}

}  // namespace
}  // namespace lampyris::test
