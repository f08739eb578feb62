// SPDX-License-Identifier: Apache-2.0
#include "materials/fourier_table.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lampyris;
  return fuzz::run<IoError>(data, size, fuzz::kMebi + 64 * size, [](std::string_view text) {
    const FourierTable table("input", text);
    std::array<float, FourierTable::kMaxOrders> a;
    for (const float muO : {-1.f, -0.3f, 0.f, 0.7f, 1.f})
      for (const float muI : {-1.f, -0.2f, 0.f, 0.9f, 1.f}) {
        fuzz::keep(table.row(muO));
        const auto series = table.series(muI, muO);
        if (!series) continue;
        const size_t orders = series->coefficients(a);
        fuzz::keep(series->value(table.isColored() ? 2 : 0, 0.5));
        fuzz::keep(sampleFourier({a.data(), std::min<size_t>(orders, 64)}, 0.3f));
      }
  });
}
