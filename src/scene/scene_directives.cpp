// SPDX-License-Identifier: Apache-2.0
// Directives that say what is in the scene and how it is rendered.
#include <fmt/format.h>

#include <algorithm>

#include "scene/world_parser.h"

namespace lampyris {

ParameterSet WorldParser::parameters() {
  reader_.read(*in_);
  return {out_.parameters.take(), at_};
}

PluginUse WorldParser::pluginUse() {
  const std::string_view name = stringArgument("a type");
  return {name, parameters()};
}

PluginUse WorldParser::namedPluginUse(const char* kind) {
  reader_.read(*in_);
  const auto all = out_.parameters.open();
  std::string_view type;
  size_t kept = 0;
  for (const Parameter& p : all) {
    if (p.name == "type" && p.type == ParameterType::String && p.strings.size() == 1) {
      type = p.strings[0];
    } else {
      all[kept++] = p;
    }
  }
  if (kept == all.size())
    fail(fmt::format("{} needs a parameter \"string type\" that names the {}", directive_->name,
                     kind));
  out_.parameters.truncate(kept);
  return {type, {out_.parameters.take(), at_}};
}

void WorldParser::film() { out_.film = pluginUse(); }
void WorldParser::pixelFilter() { out_.filter = pluginUse(); }
void WorldParser::sampler() { out_.sampler = pluginUse(); }
void WorldParser::integrator() { out_.integrator = pluginUse(); }
void WorldParser::accelerator() { out_.accelerator = pluginUse(); }

void WorldParser::camera() {
  out_.camera = pluginUse();
  out_.cameraTransform = transformIndex();
  const TransformPair& ctm = state_.transform.ctm;
  coordinateSystems_["camera"] = {ctm.start.inverse(), ctm.end.inverse()};
}

void WorldParser::makeNamedMedium() {
  const std::string_view name = stringArgument("a medium's name");
  out_.media.push_back({name, namedPluginUse("medium"), transformIndex(), order_});
}

void WorldParser::mediumInterface() {
  const std::string_view inside = stringArgument("a medium's name");
  const std::string_view outside =
      in_->peek() == TokenKind::String ? reader_.readString(*in_) : inside;
  state_.mediumInterface = static_cast<uint32_t>(out_.mediumInterfaces.size());
  out_.mediumInterfaces.push_back({inside, outside, at_, order_});
}

void WorldParser::makeNamedMaterial() {
  const std::string_view name = stringArgument("a material's name");
  const auto index = static_cast<uint32_t>(out_.materials.size());
  out_.materials.push_back({namedPluginUse("material"), order_});
  if (out_.materialNames.find(name, order_) != kNone)
    diagnostics_.warn(at_, fmt::format("named material {} is defined again", inQuotes(name)));
  out_.materialNames.add(name, index, order_);
}

void WorldParser::namedMaterial() {
  const std::string_view name = stringArgument("a material's name");
  const uint32_t index = out_.materialNames.find(name, order_);
  if (index == kNone)
    fail(out_.materialNames.knows(name)
             ? fmt::format("named material {} ended with its AttributeBegin block", inQuotes(name))
             : fmt::format("unknown named material {}{}", inQuotes(name),
                           didYouMean(name, out_.materialNames.names())));
  state_.material = index;
}

void WorldParser::material() {
  state_.material = static_cast<uint32_t>(out_.materials.size());
  out_.materials.push_back({pluginUse(), order_});
}

void WorldParser::texture() {
  TextureDefinition t;
  t.name = stringArgument("a texture's name");
  in_->peek();
  const SourceLocation typeAt = in_->location();
  const std::string_view type = stringArgument("\"float\" or \"spectrum\"");
  t.isSpectrum = type == "spectrum" || type == "color";
  if (!t.isSpectrum && type != "float")
    throw SceneError(typeAt, fmt::format("a texture is of type \"float\", \"spectrum\" or "
                                         "\"color\", not {}",
                                         inQuotes(type)));
  t.plugin = pluginUse();
  t.transform = transformIndex();
  t.order = order_;
  NameIndex& names = t.isSpectrum ? out_.spectrumTextureNames : out_.floatTextureNames;
  if (names.find(t.name, order_) != kNone)
    diagnostics_.warn(at_, fmt::format("texture {} is defined again", inQuotes(t.name)));
  names.add(t.name, static_cast<uint32_t>(out_.textures.size()), order_);
  out_.textures.push_back(t);
}

void WorldParser::lightSource() {
  const PluginUse use = pluginUse();
  for (const Parameter& p : use.parameters.parameters)
    if (p.type == ParameterType::Spectrum && !p.strings.empty())
      out_.lightsNameSpectrumFiles = true;
  out_.lights.push_back({use, transformIndex(), order_});
}

void WorldParser::areaLightSource() {
  state_.areaLight = static_cast<uint32_t>(out_.areaLights.size());
  out_.areaLights.push_back(pluginUse());
}

void WorldParser::shape() {
  ShapeDescription s;
  s.plugin = pluginUse();
  s.transform = transformIndex();
  s.order = order_;
  s.material = state_.material;
  s.areaLight = state_.areaLight;
  s.mediumInterface = state_.mediumInterface;
  s.reverseOrientation = state_.reverseOrientation;
  out_.shapes.push_back(s);
}

void WorldParser::reverseOrientation() { state_.reverseOrientation = !state_.reverseOrientation; }

void WorldParser::objectInstance() {
  const std::string_view name = stringArgument("an object's name");
  if (inObject()) fail("ObjectInstance inside of an object: objects do not nest");
  const auto known = objects_.find(name);
  if (known == objects_.end()) {
    std::vector<std::string> names;
    for (const auto& entry : objects_) names.emplace_back(entry.first);
    fail(fmt::format("unknown object {}{}", inQuotes(name), didYouMean(name, names)));
  }
  out_.instances.push_back({known->second, transformIndex(), at_});
}

}  // namespace lampyris
