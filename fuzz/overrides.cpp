// SPDX-License-Identifier: Apache-2.0
// A command line, an argument a line, that renders a small scene.
#include "scene_input.h"
#include "tools/render_settings.h"

namespace {

constexpr std::string_view kScene = R"(
Film "image" "integer xresolution" 4 "integer yresolution" 4
Camera "perspective"
WorldBegin
LightSource "point"
AttributeBegin
AreaLightSource "diffuse"
Shape "sphere"
AttributeEnd
Shape "disk"
WorldEnd
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lampyris;
  Arguments arguments{"scene.pbrt"};
  std::string_view text(reinterpret_cast<const char*>(data), size);
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    arguments.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  try {
    if (const auto settings = parseRenderSettings(arguments))
      return fuzz::loadScene(kScene, settings->build);
  } catch (const UsageError& e) {
    fuzz::keep(e);
  } catch (const SceneError& e) {
    fuzz::keep(e);
  }
  return 0;
}
