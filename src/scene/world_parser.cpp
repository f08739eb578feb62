// SPDX-License-Identifier: Apache-2.0
#include "scene/world_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/parser.h"

namespace lampyris {

namespace {

constexpr size_t kDeepestInclude = 64, kDeepestBlock = 10'000;
/// A few files that include each other twice at each level would have no end.
constexpr size_t kMostIncludes = 100'000;

std::string_view beginName(OpenBlock::Kind kind) {
  switch (kind) {
    case OpenBlock::Kind::Attribute:
      return "AttributeBegin";
    case OpenBlock::Kind::Transform:
      return "TransformBegin";
    case OpenBlock::Kind::Object:
      return "ObjectBegin";
  }
  return "";
}

}  // namespace

std::span<const WorldParser::Directive> WorldParser::directives() {
  using P = WorldParser;
  static constexpr Directive kAll[] = {
      {"Identity", Block::Any, &P::identity},
      {"Translate", Block::Any, &P::translate},
      {"Scale", Block::Any, &P::scale},
      {"Rotate", Block::Any, &P::rotate},
      {"LookAt", Block::Any, &P::lookAt},
      {"CoordinateSystem", Block::Any, &P::coordinateSystem},
      {"CoordSysTransform", Block::Any, &P::coordSysTransform},
      {"Transform", Block::Any, &P::transform},
      {"ConcatTransform", Block::Any, &P::concatTransform},
      {"TransformTimes", Block::Options, &P::transformTimes},
      {"ActiveTransform", Block::Any, &P::activeTransform},
      {"TransformBegin", Block::World, &P::transformBegin},
      {"TransformEnd", Block::World, &P::transformEnd},
      {"AttributeBegin", Block::World, &P::attributeBegin},
      {"AttributeEnd", Block::World, &P::attributeEnd},
      {"Camera", Block::Options, &P::camera},
      {"Sampler", Block::Options, &P::sampler},
      {"Integrator", Block::Options, &P::integrator},
      {"Accelerator", Block::Options, &P::accelerator},
      {"Film", Block::Options, &P::film},
      {"PixelFilter", Block::Options, &P::pixelFilter},
      {"WorldBegin", Block::Options, &P::worldBegin},
      {"WorldEnd", Block::World, &P::worldEnd},
      {"MakeNamedMedium", Block::Any, &P::makeNamedMedium},
      {"MediumInterface", Block::Any, &P::mediumInterface},
      {"MakeNamedMaterial", Block::World, &P::makeNamedMaterial},
      {"NamedMaterial", Block::World, &P::namedMaterial},
      {"Material", Block::World, &P::material},
      {"Texture", Block::World, &P::texture},
      {"LightSource", Block::World, &P::lightSource},
      {"AreaLightSource", Block::World, &P::areaLightSource},
      {"Shape", Block::World, &P::shape},
      {"ReverseOrientation", Block::World, &P::reverseOrientation},
      {"ObjectBegin", Block::World, &P::objectBegin},
      {"ObjectEnd", Block::World, &P::objectEnd},
      {"ObjectInstance", Block::World, &P::objectInstance},
      {"Include", Block::Any, &P::include},
  };
  return kAll;
}

const WorldParser::Directive* WorldParser::findDirective(std::string_view name) {
  for (const Directive& d : directives())
    if (d.name == name) return &d;
  return nullptr;
}

WorldParser::WorldParser(Description& description, std::string folder, SourceFiles& files,
                         Diagnostics& diagnostics)
    : out_(description),
      folder_(std::move(folder)),
      files_(files),
      diagnostics_(diagnostics),
      reader_(description),
      pool_(description.transforms) {}

void WorldParser::run(uint16_t mainFile) {
  openFiles_.push_back(files_.name(mainFile));
  parseFile(mainFile);
  if (worldEnded_) return;
  const SourceLocation end = placeInFile(mainFile, files_.text(mainFile).size());
  if (!worldBegun_)
    throw SceneError(end,
                     "the file has no WorldBegin: shapes and lights stand between WorldBegin "
                     "and WorldEnd");
  diagnostics_.warn(end, "the file ends without WorldEnd");
  worldEnd();
}

void WorldParser::parseFile(uint16_t file) {
  Tokenizer in(files_.text(file), file);
  Tokenizer* const outer = std::exchange(in_, &in);
  while (!worldEnded_ && in.peek() != TokenKind::End) parseDirective();
  if (worldEnded_ && in.peek() != TokenKind::End)
    diagnostics_.warn(in.location(),
                      "what follows WorldEnd is ignored: a file is rendered to one image");
  in_ = outer;
}

void WorldParser::parseDirective() {
  at_ = in_->location();
  if (in_->peek() != TokenKind::Word || in_->atNumber())
    fail(fmt::format("expected a directive, got {}", in_->describe()));
  const std::string_view word = in_->readWord();
  if (!directive_ || directive_->name != word) directive_ = findDirective(word);
  if (!directive_) failNoDirective(word);
  if (directive_->block == Block::World && !worldBegun_)
    fail(fmt::format("{} must stand after WorldBegin", word));
  if (directive_->block == Block::Options && worldBegun_)
    fail(fmt::format("{} must stand before WorldBegin", word));
  (this->*directive_->carryOut)();
  ++order_;
}

void WorldParser::failNoDirective(std::string_view word) {
  for (const char c : word.substr(0, 256))
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) >= 127)
      fail(fmt::format("unexpected byte 0x{:02x}: a scene file is plain text",
                       static_cast<unsigned char>(c)));
  std::vector<std::string> names;
  for (const Directive& d : directives()) names.emplace_back(d.name);
  // Longer words are not worth the search for a near name.
  fail(fmt::format("unknown directive {}{}", inQuotes(word),
                   word.size() < 64 ? didYouMean(word, names) : ""));
}

std::string_view WorldParser::stringArgument(const char* what) {
  if (in_->peek() != TokenKind::String)
    throw SceneError(in_->location(), fmt::format("{} expects {} in quotes, got {}",
                                                  directive_->name, what, in_->describe()));
  return reader_.readString(*in_);
}

void WorldParser::include() {
  const std::string_view name = stringArgument("a file name");
  const std::string path = resolveScenePath(folder_, name);
  if (std::find(openFiles_.begin(), openFiles_.end(), path) != openFiles_.end())
    fail(fmt::format("{} includes itself", inQuotes(path)));
  if (openFiles_.size() > kDeepestInclude)
    fail(fmt::format("files are included deeper than {} levels", kDeepestInclude));
  auto known = knownFiles_.find(path);
  if (known == knownFiles_.end()) {
    try {
      known = knownFiles_.emplace(path, files_.open(path)).first;
    } catch (const IoError& e) {
      fail(e.what());
    }
  }
  if (++includes_ > kMostIncludes)
    fail(fmt::format("files are included more than {} times", kMostIncludes));
  openFiles_.push_back(path);
  parseFile(known->second);
  openFiles_.pop_back();
}

void WorldParser::worldBegin() {
  worldBegun_ = true;
  state_.transform = {};
  coordinateSystems_["world"] = state_.transform.ctm;
}

void WorldParser::worldEnd() {
  worldEnded_ = true;
  out_.cameraMediumInterface = state_.mediumInterface;
  for (const OpenBlock& b : blocks_)
    diagnostics_.warn(b.location,
                      fmt::format("{} is not closed before WorldEnd", beginName(b.kind)));
  if (inObject()) out_.objects[object_].lastShape = static_cast<uint32_t>(out_.shapes.size());
}

void WorldParser::openBlock(OpenBlock::Kind kind) {
  if (blocks_.size() >= kDeepestBlock)
    fail(fmt::format("blocks are nested deeper than {} levels", kDeepestBlock));
  blocks_.push_back({kind, at_, state_, out_.floatTextureNames.openCount(),
                     out_.spectrumTextureNames.openCount(), out_.materialNames.openCount()});
}

void WorldParser::closeBlock(OpenBlock::Kind kind) {
  if (blocks_.empty()) fail(fmt::format("{} without {}", directive_->name, beginName(kind)));
  const OpenBlock& b = blocks_.back();
  if (b.kind != kind)
    fail(fmt::format("{} does not match the {} in line {}", directive_->name, beginName(b.kind),
                     files_.position(b.location).line));
  if (kind == OpenBlock::Kind::Transform) {
    state_.transform = b.saved.transform;
  } else {
    state_ = b.saved;
    out_.floatTextureNames.close(b.floatTextures, order_);
    out_.spectrumTextureNames.close(b.spectrumTextures, order_);
    out_.materialNames.close(b.materials, order_);
  }
  blocks_.pop_back();
}

void WorldParser::attributeBegin() { openBlock(OpenBlock::Kind::Attribute); }
void WorldParser::attributeEnd() { closeBlock(OpenBlock::Kind::Attribute); }
void WorldParser::transformBegin() { openBlock(OpenBlock::Kind::Transform); }
void WorldParser::transformEnd() { closeBlock(OpenBlock::Kind::Transform); }

void WorldParser::objectBegin() {
  const std::string_view name = stringArgument("the object's name");
  if (inObject())
    fail(fmt::format("ObjectBegin inside of object {}: objects do not nest",
                     inQuotes(out_.objects[object_].name)));
  openBlock(OpenBlock::Kind::Object);
  object_ = static_cast<uint32_t>(out_.objects.size());
  const auto first = static_cast<uint32_t>(out_.shapes.size());
  out_.objects.push_back({name, at_, first, first});
  if (!objects_.insert_or_assign(name, object_).second)
    diagnostics_.warn(at_, fmt::format("object {} is defined again", inQuotes(name)));
}

void WorldParser::objectEnd() {
  if (!inObject()) fail("ObjectEnd without ObjectBegin");
  closeBlock(OpenBlock::Kind::Object);
  out_.objects[object_].lastShape = static_cast<uint32_t>(out_.shapes.size());
  object_ = kNone;
}

}  // namespace lampyris
