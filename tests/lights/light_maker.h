// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/image.h"
#include "lights/area_registry.h"
#include "lights/registry.h"
#include "support/resolvers.h"

namespace lampyris::test {

/// Makes lights through their registries, with parameters as text.
struct LightMaker {
  TestBuild build;
  ImageCache images;

  std::unique_ptr<Light> make(const std::string& name, const TestParameters::List& list,
                              const Transform& lightToWorld = {}) {
    const auto& plugin = lightRegistry().get(name, {});
    const TestParameters p(plugin.schema, list);
    return plugin.create(p.set(), LightContext{build.base(), lightToWorld, images});
  }
  std::unique_ptr<Light> makeArea(const Shape& shape, const TestParameters::List& list,
                                  const std::string& name = "diffuse") {
    const auto& plugin = areaLightRegistry().get(name, {});
    const TestParameters p(plugin.schema, list);
    return plugin.create(p.set(), AreaLightContext{build.base(), shape, images, build.textures});
  }
};

}  // namespace lampyris::test
