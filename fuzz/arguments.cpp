// SPDX-License-Identifier: Apache-2.0
// A command line, an argument a line.
#include "target.h"
#include "tools/render_settings.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lampyris;
  // Options take longer to state than to read, but CLI11 keeps a list of all it has ever read.
  static std::unique_ptr<RenderArguments> parser;
  static int runs = 0;
  if (runs++ % 64 == 0) parser = std::make_unique<RenderArguments>();
  return fuzz::run<UsageError>(data, size, fuzz::kMebi + 1024 * size, [](std::string_view text) {
    Arguments arguments{"scene.pbrt"};
    while (!text.empty()) {
      const size_t end = std::min(text.find('\n'), text.size());
      arguments.emplace_back(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    fuzz::keep(parser->parse(arguments));
  });
}
