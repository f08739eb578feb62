// SPDX-License-Identifier: Apache-2.0
#include "scene/spectrum_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/parser.h"
#include "scene/tokenizer.h"

namespace lampyris {

namespace {

bool isInFile(const Parameter& p) {
  return p.type == ParameterType::Spectrum && !p.strings.empty();
}

}  // namespace

std::vector<float> readSpectrum(const SourceFiles& files, uint16_t file) {
  std::vector<float> values;
  Tokenizer in(files.text(file), file);
  for (TokenKind kind = in.peek(); kind != TokenKind::End; kind = in.peek()) {
    if (kind != TokenKind::Word || !in.atNumber())
      throw SceneError(in.location(), "expected a wavelength or a value, got " + in.describe());
    values.push_back(in.readFloat());
  }
  if (values.empty() || values.size() % 2)
    throw SceneError(placeInFile(file, files.text(file).size()),
                     fmt::format("a spectrum file holds pairs of a wavelength and a value, this "
                                 "one {} numbers",
                                 values.size()));
  return values;
}

ParameterSet SpectrumFiles::resolve(const ParameterSet& set) {
  if (std::none_of(set.parameters.begin(), set.parameters.end(), isInFile)) return set;
  const auto known = resolved_.find(set.parameters.data());
  if (known != resolved_.end()) return {known->second, set.location};
  std::vector<Parameter> list(set.parameters.begin(), set.parameters.end());
  for (Parameter& p : list) {
    if (!isInFile(p)) continue;
    p.floats = pairs(p);
    p.strings = {};
  }
  std::vector<Parameter>& kept = resolved_[set.parameters.data()];
  kept = std::move(list);
  return {kept, set.location};
}

const std::vector<float>& SpectrumFiles::pairs(const Parameter& p) {
  if (p.strings.size() != 1)
    throw SceneError(p.location, fmt::format("parameter \"{}\": expected one spectrum file, got {}",
                                             p.name, p.strings.size()));
  const std::string path = resolveScenePath(folder_, p.strings[0]);
  const auto known = byPath_.find(path);
  if (known != byPath_.end()) return known->second;
  uint16_t file = 0;
  try {
    file = files_.open(path);
  } catch (const IoError& e) {
    throw SceneError(p.location, fmt::format("parameter \"{}\": {}", p.name, e.what()));
  }
  return byPath_.emplace(path, readSpectrum(files_, file)).first->second;
}

}  // namespace lampyris
