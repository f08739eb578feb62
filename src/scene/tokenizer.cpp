// SPDX-License-Identifier: Apache-2.0
#include "scene/tokenizer.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/error.h"

namespace lampyris {

Tokenizer::Tokenizer(std::string_view text, uint16_t file)
    : begin_(text.data()), at_(text.data()), end_(text.data() + text.size()), file_(file) {
  if (text.starts_with("\xef\xbb\xbf")) at_ += 3;
}

float Tokenizer::readFloat() {
  // fast_float takes no plus sign.
  const char* const from = *at_ == '+' && at_ + 1 != end_ && at_[1] != '-' ? at_ + 1 : at_;
  float value = 0;
  const auto result = fast_float::from_chars(from, end_, value);
  if (result.ec == std::errc() && endsToken(result.ptr) && std::isfinite(value)) {
    at_ = result.ptr;
    return value;
  }
  const double slow = readNumberSlowly();
  return static_cast<float>(slow);
}

int32_t Tokenizer::readInteger() {
  const char* p = at_;
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  const char* const digits = p;
  int64_t value = 0;
  for (; p != end_ && *p >= '0' && *p <= '9' && p - digits < 11; ++p)
    value = 10 * value + (*p - '0');
  if (negative) value = -value;
  constexpr int64_t kMin = std::numeric_limits<int32_t>::min();
  constexpr int64_t kMax = std::numeric_limits<int32_t>::max();
  if (p != digits && endsToken(p) && value >= kMin && value <= kMax) {
    at_ = p;
    return static_cast<int32_t>(value);
  }
  const SourceLocation where = location();
  const std::string text = describe();
  const double number = readNumberSlowly();
  if (number != std::floor(number))
    throw SceneError(where, fmt::format("expected an integer, got {}", text));
  if (number < static_cast<double>(kMin) || number > static_cast<double>(kMax))
    throw SceneError(where, fmt::format("{} does not fit into a 32-bit integer", text));
  return static_cast<int32_t>(number);
}

double Tokenizer::readNumberSlowly() {
  const SourceLocation where = location();
  const std::string text(readWord());
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  // strtod also knows hexadecimal numbers, inf and nan.
  if (end != text.c_str() + text.size() || text.find_first_not_of("+-.0123456789eE") != text.npos)
    throw SceneError(where, fmt::format("{} is not a number", inQuotes(text)));
  if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
    throw SceneError(where, fmt::format("{} is too large: numbers go to 3.4e38", inQuotes(text)));
  return value;
}

std::string_view Tokenizer::readWord() {
  const char* const from = at_;
  while (!endsToken(at_)) ++at_;
  return {from, at_};
}

Tokenizer::QuotedString Tokenizer::readString() {
  const SourceLocation where = location();
  const char* const from = ++at_;
  bool escaped = false;
  for (; at_ != end_; ++at_) {
    switch (classOf(*at_)) {
      case CharClass::Quote:
        return {{from, at_++}, escaped};
      case CharClass::Backslash:
        escaped = true;
        if (++at_ == end_) --at_;
        break;
      case CharClass::Space:
        if (*at_ == '\n') throw SceneError(where, "string without closing quote");
        break;
      case CharClass::Control:
        throw SceneError(
            location(), fmt::format("byte 0x{:02x} in a string", static_cast<unsigned char>(*at_)));
      default:
        break;
    }
  }
  throw SceneError(where, "string without closing quote");
}

std::string Tokenizer::describe() {
  switch (peek()) {
    case TokenKind::End:
      return "the end of the file";
    case TokenKind::Open:
      return "[";
    case TokenKind::Close:
      return "]";
    case TokenKind::String:
      return "the string " + inQuotes(Tokenizer(*this).readString().text);
    case TokenKind::Word:
      break;
  }
  return inQuotes(Tokenizer(*this).readWord());
}

std::string unescape(std::string_view text, SourceLocation where) {
  constexpr std::string_view kLetters = "bfnrt\\'\"", kMeanings = "\b\f\n\r\t\\'\"";
  std::string out;
  out.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\') {
      out += text[i];
      continue;
    }
    const size_t known = ++i < text.size() ? kLetters.find(text[i]) : std::string_view::npos;
    if (known == std::string_view::npos)
      throw SceneError(where, fmt::format("unknown escape \\{} in a string; a backslash is "
                                          "written \\\\",
                                          i < text.size() ? text.substr(i, 1) : ""));
    out += kMeanings[known];
  }
  return out;
}

std::string inQuotes(std::string_view text) {
  constexpr size_t kLongest = 60;
  std::string out = "\"";
  for (const char c : text.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 32 || byte == 127) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      out += c;
    }
  }
  return out + (text.size() > kLongest ? "…\"" : "\"");
}

}  // namespace lampyris
