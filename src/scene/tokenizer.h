// SPDX-License-Identifier: Apache-2.0
/// From text to tokens: words, numbers, quoted strings and brackets.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "core/source.h"

namespace lampyris {

enum class TokenKind : uint8_t {
  End,
  Word,    ///< a directive's name or a number
  String,  ///< begins with a quote
  Open,    ///< [
  Close,   ///< ]
};

inline SourceLocation placeInFile(uint16_t file, size_t offset) {
  return {file, offset & ((uint64_t{1} << 48) - 1)};
}

/// Walks over a text without copying it. The caller looks at the kind of the next token and then
/// takes it as what it needs; numbers are converted where they stand. Every fault is a SceneError
/// at its byte.
class Tokenizer {
 public:
  /// Skips a UTF-8 byte order mark.
  Tokenizer(std::string_view text, uint16_t file);

  /// Skips white space and comments (# to the end of the line); the kind of what follows.
  TokenKind peek() {
    for (; at_ != end_; ++at_) {
      switch (classOf(*at_)) {
        case CharClass::Space:
          continue;
        case CharClass::Hash:
          at_ = static_cast<const char*>(std::memchr(at_, '\n', static_cast<size_t>(end_ - at_)));
          if (at_) continue;
          at_ = end_;
          return TokenKind::End;
        case CharClass::Quote:
          return TokenKind::String;
        case CharClass::Open:
          return TokenKind::Open;
        case CharClass::Close:
          return TokenKind::Close;
        default:
          return TokenKind::Word;
      }
    }
    return TokenKind::End;
  }
  /// Where the token is that peek() found.
  SourceLocation location() const { return placeInFile(file_, static_cast<size_t>(at_ - begin_)); }
  /// After peek() == Word: whether it begins as a number does.
  bool atNumber() const {
    return (*at_ >= '0' && *at_ <= '9') || *at_ == '-' || *at_ == '.' || *at_ == '+';
  }

  // Each takes the token that peek() found, which must be of that kind.
  void skipBracket() { ++at_; }
  float readFloat();
  /// Accepts integral values written with a point or an exponent ("3.0").
  int32_t readInteger();
  std::string_view readWord();
  struct QuotedString {
    std::string_view text;  ///< between the quotes
    bool escaped = false;   ///< has backslash escapes: see unescape()
  };
  QuotedString readString();

  /// The token at the cursor as a message shows it: `"Shap"`, `[`, `the end of the file`.
  std::string describe();

 private:
  enum class CharClass : uint8_t { Other, Control, Backslash, Space, Hash, Quote, Open, Close };
  static constexpr std::array<CharClass, 256> kClasses = [] {
    std::array<CharClass, 256> t{};
    for (size_t c = 0; c < 32; ++c) t[c] = CharClass::Control;
    t[127] = CharClass::Control;
    for (const char c : {' ', '\t', '\n', '\r', '\v', '\f'})
      t[static_cast<unsigned char>(c)] = CharClass::Space;
    t['\\'] = CharClass::Backslash;
    t['#'] = CharClass::Hash;
    t['"'] = CharClass::Quote;
    t['['] = CharClass::Open;
    t[']'] = CharClass::Close;
    return t;
  }();
  static CharClass classOf(char c) { return kClasses[static_cast<unsigned char>(c)]; }
  bool endsToken(const char* p) const { return p == end_ || classOf(*p) >= CharClass::Space; }
  double readNumberSlowly();

  const char* begin_;
  const char* at_;
  const char* end_;
  uint16_t file_;
};

/// Replaces \" \\ \' \n \t \r \b \f. Throws SceneError at `where` on any other escape.
std::string unescape(std::string_view text, SourceLocation where);

/// `text` in quotes, fit for a message: shortened, with bytes that are no text written as \xNN.
std::string inQuotes(std::string_view text);

}  // namespace lampyris
