// SPDX-License-Identifier: Apache-2.0
#include "scene/parameter_reader.h"

#include <fmt/format.h>

#include "core/error.h"

namespace lampyris {

namespace {

constexpr std::string_view kSpaces = " \t\r\v\f";

std::vector<std::string> allTypeNames() {
  std::vector<std::string> names{"color"};
  for (int t = 0; t <= static_cast<int>(ParameterType::Texture); ++t)
    names.emplace_back(typeName(static_cast<ParameterType>(t)));
  return names;
}

bool isText(ParameterType t) {
  return t == ParameterType::Bool || t == ParameterType::String || t == ParameterType::Texture;
}

/// How many numbers belong together, and what they are called.
struct Grouping {
  size_t size;
  const char* what;
};
Grouping grouping(ParameterType t) {
  switch (t) {
    case ParameterType::Point2:
    case ParameterType::Vector2:
      return {2, "2 numbers"};
    case ParameterType::Point3:
    case ParameterType::Vector3:
    case ParameterType::Normal:
    case ParameterType::Rgb:
    case ParameterType::Xyz:
      return {3, "3 numbers"};
    case ParameterType::Blackbody:
      return {2, "a temperature and a scale"};
    case ParameterType::Spectrum:
      return {2, "a wavelength and a value"};
    default:
      return {1, ""};
  }
}

}  // namespace

const ParameterReader::DeclarationText& ParameterReader::declaration(std::string_view text,
                                                                     SourceLocation where) {
  const size_t hash = text.empty() ? 0
                                   : text.size() + 5 * static_cast<unsigned char>(text.front()) +
                                         3 * static_cast<unsigned char>(text.back());
  DeclarationText& cached = cache_[hash % cache_.size()];
  if (cached.text == text && !text.empty()) return cached;

  auto nextWord = [rest = text]() mutable {
    const size_t from = std::min(rest.find_first_not_of(kSpaces), rest.size());
    const size_t to = std::min(rest.find_first_of(kSpaces, from), rest.size());
    const std::string_view word = rest.substr(from, to - from);
    rest = rest.substr(to);
    return word;
  };
  const std::string_view typeWord = nextWord(), name = nextWord();
  if (name.empty() || !nextWord().empty())
    throw SceneError(where,
                     fmt::format("expected a parameter's \"type name\", got {}", inQuotes(text)));
  const auto type = typeFromName(typeWord);
  if (!type)
    throw SceneError(where, fmt::format("unknown parameter type {}{}", inQuotes(typeWord),
                                        didYouMean(typeWord, allTypeNames())));
  cached = {text, name, *type};
  return cached;
}

std::string_view ParameterReader::readString(Tokenizer& in) {
  const SourceLocation where = in.location();
  const auto s = in.readString();
  if (!s.escaped) return s.text;
  return out_.unescapedStrings.emplace_back(unescape(s.text, where));
}

void ParameterReader::read(Tokenizer& in) {
  while (in.peek() == TokenKind::String) {
    Parameter p;
    p.location = in.location();
    const DeclarationText& d = declaration(readString(in), p.location);
    p.name = d.name;
    p.type = d.type;
    readValues(in, p);
    out_.parameters.push(p);
  }
}

void ParameterReader::readValues(Tokenizer& in, Parameter& p) {
  const bool isList = in.peek() == TokenKind::Open;
  const SourceLocation open = in.location();
  if (isList) {
    in.skipBracket();
    while (readValue(in, p)) {
    }
    const TokenKind end = in.peek();
    if (end == TokenKind::End)
      throw SceneError(open, fmt::format("parameter \"{}\": [ without ]", p.name));
    if (end != TokenKind::Close)
      throw SceneError(in.location(),
                       fmt::format("parameter \"{}\": expected {} or ], got {}", p.name,
                                   isText(p.type) ? "a quoted string" : "a number", in.describe()));
    in.skipBracket();
  } else if (!readValue(in, p)) {
    throw SceneError(in.location(),
                     fmt::format("parameter \"{}\": expected {}, got {}", p.name,
                                 isText(p.type) ? "a quoted string" : "a number", in.describe()));
  }
  p.floats = out_.floats.take();
  p.integers = out_.integers.take();
  p.strings = out_.strings.take();
  const Grouping g = grouping(p.type);
  if (p.floats.size() % g.size)
    throw SceneError(p.location,
                     fmt::format("parameter \"{}\": {} values do not divide into {}s of {}", p.name,
                                 p.floats.size(), typeName(p.type), g.what));
}

bool ParameterReader::readValue(Tokenizer& in, const Parameter& p) {
  const TokenKind kind = in.peek();
  if (isText(p.type)) return readStringValue(in, p);
  if (kind == TokenKind::Word && in.atNumber()) {
    if (p.type == ParameterType::Integer) {
      out_.integers.push(in.readInteger());
    } else {
      out_.floats.push(in.readFloat());
    }
    return true;
  }
  // A spectrum may stand in a file.
  if (p.type != ParameterType::Spectrum || kind != TokenKind::String || !out_.floats.open().empty())
    return false;
  out_.strings.push(readString(in));
  return true;
}

bool ParameterReader::readStringValue(Tokenizer& in, const Parameter& p) {
  const TokenKind kind = in.peek();
  const SourceLocation where = in.location();
  if (p.type != ParameterType::Bool) {
    if (kind != TokenKind::String) return false;
    out_.strings.push(readString(in));
    return true;
  }
  if (kind != TokenKind::String && kind != TokenKind::Word) return false;
  const std::string_view word = kind == TokenKind::Word ? in.readWord() : readString(in);
  if (word != "true" && word != "false")
    throw SceneError(where, fmt::format("parameter \"{}\": expected \"true\" or \"false\", got {}",
                                        p.name, inQuotes(word)));
  out_.strings.push(word);
  return true;
}

}  // namespace lampyris
