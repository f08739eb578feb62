// SPDX-License-Identifier: Apache-2.0
// How fast scene files are read: bytes a second of the tokenizer and of the parser.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <iterator>

#include "core/hash.h"
#include "scene/parser.h"
#include "scene/tokenizer.h"

namespace lampyris {
namespace {

constexpr size_t kBytes = 20'000'000;

float random(uint64_t i) { return toUnitFloat(mixBits(i)) * 20 - 10; }

std::string makeLights() {
  std::string text = "WorldBegin\n";
  for (uint64_t i = 0; text.size() < kBytes; i += 6)
    fmt::format_to(std::back_inserter(text),
                   "LightSource \"point\" \"point from\" [ {:.6f} {:.6f} {:.6f} ] \"color I\" [ "
                   "{:.5f} {:.5f} {:.5f} ]\n",
                   random(i), random(i + 1), random(i + 2), random(i + 3), random(i + 4),
                   random(i + 5));
  return text + "WorldEnd\n";
}

std::string makeMesh() {
  std::string text = "WorldBegin\nShape \"trianglemesh\" \"point P\" [\n";
  for (uint64_t i = 0; text.size() < kBytes / 2; i += 3)
    fmt::format_to(std::back_inserter(text), "{:.6f} {:.6f} {:.6f}\n", random(i), random(i + 1),
                   random(i + 2));
  text += "] \"integer indices\" [\n";
  for (uint64_t i = 0; text.size() < kBytes; ++i)
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", i, i + 1, i + 2);
  return text + "]\nWorldEnd\n";
}

const std::string& text(int64_t which) {
  static const std::string lights = makeLights(), mesh = makeMesh();
  return which == 0 ? lights : mesh;
}

void setLabel(benchmark::State& state) {
  state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(text(state.range(0)).size()));
  state.SetLabel(state.range(0) == 0 ? "point lights" : "mesh");
}

void tokenize(benchmark::State& state) {
  const std::string& source = text(state.range(0));
  for (auto _ : state) {
    Tokenizer in(source, 0);
    float sum = 0;
    for (TokenKind kind = in.peek(); kind != TokenKind::End; kind = in.peek()) {
      if (kind == TokenKind::String) {
        benchmark::DoNotOptimize(in.readString());
      } else if (kind != TokenKind::Word) {
        in.skipBracket();
      } else if (in.atNumber()) {
        sum += in.readFloat();
      } else {
        benchmark::DoNotOptimize(in.readWord());
      }
    }
    benchmark::DoNotOptimize(sum);
  }
  setLabel(state);
}
BENCHMARK(tokenize)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void parse(benchmark::State& state) {
  SourceFiles files;
  Diagnostics diagnostics(files, [](const std::string&) {});
  const uint16_t file = files.add("scene", text(state.range(0)));
  for (auto _ : state) {
    const Description d = parseScene(file, "", files, diagnostics);
    benchmark::DoNotOptimize(d.lights.data());
  }
  setLabel(state);
}
BENCHMARK(parse)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lampyris
