// SPDX-License-Identifier: Apache-2.0
/// Reads the `"type name" value` lists of a scene file.
#pragma once

#include <array>

#include "scene/description.h"
#include "scene/tokenizer.h"

namespace lampyris {

class ParameterReader {
 public:
  /// Writes into the arenas of `description`.
  explicit ParameterReader(Description& description) : out_(description) {}

  /// Reads parameters as far as there are any, to be taken from Description::parameters. Throws
  /// SceneError: unknown type, wrong kind or number of values, missing bracket.
  void read(Tokenizer& in);
  /// Takes a quoted string with its escapes replaced.
  std::string_view readString(Tokenizer& in);

 private:
  struct DeclarationText {
    std::string_view text;  ///< as written, e.g. "point from"
    std::string_view name;
    ParameterType type = ParameterType::Float;
  };
  const DeclarationText& declaration(std::string_view text, SourceLocation where);
  void readValues(Tokenizer& in, Parameter& p);
  /// Takes one value; false if the next token is none (a bracket or what follows the list).
  bool readValue(Tokenizer& in, const Parameter& p);
  bool readStringValue(Tokenizer& in, const Parameter& p);

  Description& out_;
  std::array<DeclarationText, 64> cache_;  ///< a file repeats few declarations many times
};

}  // namespace lampyris
