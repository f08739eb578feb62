// SPDX-License-Identifier: Apache-2.0
#include "scene/tokenizer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace lampyris {
namespace {

std::string words(std::string_view text) {
  Tokenizer in(text, 0);
  std::string out;
  while (true) {
    switch (in.peek()) {
      case TokenKind::End:
        return out;
      case TokenKind::Open:
        out += "<", in.skipBracket();
        break;
      case TokenKind::Close:
        out += ">", in.skipBracket();
        break;
      case TokenKind::String:
        out += "'" + std::string(in.readString().text) + "'";
        break;
      case TokenKind::Word:
        out += "{" + std::string(in.readWord()) + "}";
    }
  }
}

float number(const std::string& text) {
  Tokenizer in(text, 0);
  in.peek();
  const float v = in.readFloat();
  EXPECT_EQ(in.peek(), TokenKind::End);
  return v;
}
int32_t integer(const std::string& text) {
  Tokenizer in(text, 0);
  in.peek();
  return in.readInteger();
}
template <class F>
std::string error(F read) {
  try {
    read();
  } catch (const SceneError& e) {
    return std::to_string(e.location.offset) + ": " + e.what();
  }
  return "";
}

TEST(Tokenizer, SplitsWithoutSpaces) {
  EXPECT_EQ(words("Shape\"a b\"[1 2]3#c \"x\n\"\"\r\n\t]x"), "{Shape}'a b'<{1}{2}>{3}''>{x}");
  EXPECT_EQ(words(""), "");
  EXPECT_EQ(words("# only a comment"), "");
  EXPECT_EQ(words("\xef\xbb\xbfWorldBegin"), "{WorldBegin}");
  EXPECT_EQ(words("a#b\nc"), "{a}{c}");
}

TEST(Tokenizer, ReadsNumbersAsTheNearestFloat) {
  for (const char* text : {"0", "-0", "1", "3.14159274", ".5", "-.5", "5.", "1e3", "1E-3", "5e-1",
                           "1e-45", "3.4028234e38", "0.1", "16777217", "123456789012345678901234",
                           "1.00000017881393432617187499", "+2.5", "1e-60", "-1e-400"})
    EXPECT_EQ(number(text), std::strtof(text, nullptr)) << text;
  EXPECT_TRUE(std::signbit(number("-0")));
}

TEST(Tokenizer, ReadsIntegers) {
  EXPECT_EQ(integer("42"), 42);
  EXPECT_EQ(integer("-7"), -7);
  EXPECT_EQ(integer("+7"), 7);
  EXPECT_EQ(integer("3.0"), 3);
  EXPECT_EQ(integer("1e3"), 1000);
  EXPECT_EQ(integer("16777217"), 16777217);
  EXPECT_EQ(integer("2147483647"), 2147483647);
  EXPECT_EQ(integer("-2147483648"), -2147483647 - 1);
  EXPECT_EQ(integer("007"), 7);
  EXPECT_EQ(integer("00000000000007"), 7);
}

TEST(Tokenizer, RefusesWhatIsNoNumber) {
  EXPECT_EQ(error([] { number("1.2.3"); }), "0: \"1.2.3\" is not a number");
  EXPECT_EQ(error([] { number(" 1x"); }), "1: \"1x\" is not a number");
  EXPECT_EQ(error([] { number("-"); }), "0: \"-\" is not a number");
  EXPECT_EQ(error([] { number("+-1"); }), "0: \"+-1\" is not a number");
  EXPECT_EQ(error([] { number("0x10"); }), "0: \"0x10\" is not a number");
  EXPECT_EQ(error([] { number("-inf"); }), "0: \"-inf\" is not a number");
  EXPECT_EQ(error([] { number("-nan"); }), "0: \"-nan\" is not a number");
  EXPECT_EQ(error([] { number("1e39"); }), "0: \"1e39\" is too large: numbers go to 3.4e38");
  EXPECT_EQ(error([] { number("1e400"); }), "0: \"1e400\" is too large: numbers go to 3.4e38");
  EXPECT_EQ(error([] { integer("3.5"); }), "0: expected an integer, got \"3.5\"");
  EXPECT_EQ(error([] { integer("2147483648"); }),
            "0: \"2147483648\" does not fit into a 32-bit integer");
  EXPECT_EQ(error([] { integer("99999999999999999999"); }),
            "0: \"99999999999999999999\" does not fit into a 32-bit integer");
}

TEST(Tokenizer, FindsFaultsOfStrings) {
  EXPECT_EQ(error([] { words("  \"abc"); }), "2: string without closing quote");
  EXPECT_EQ(error([] { words("\"abc\ndef\""); }), "0: string without closing quote");
  EXPECT_EQ(error([] { words("\"abc\\"); }), "0: string without closing quote");
  EXPECT_EQ(error([] { words(std::string("\"a\0b\"", 5)); }), "2: byte 0x00 in a string");
}

TEST(Tokenizer, ReplacesEscapes) {
  Tokenizer in(R"("a\"b\\c")", 0);
  in.peek();
  const auto s = in.readString();
  EXPECT_TRUE(s.escaped);
  EXPECT_EQ(unescape(s.text, {}), "a\"b\\c");
  EXPECT_EQ(unescape(R"(\n\t\r\b\f\')", {}), "\n\t\r\b\f'");
  EXPECT_EQ(error([] { unescape("\\q", {}); }).substr(0, 0), "");
  EXPECT_THROW(unescape("\\q", {}), SceneError);
}

TEST(Tokenizer, QuotesForMessages) {
  EXPECT_EQ(inQuotes("a"), "\"a\"");
  EXPECT_EQ(inQuotes(std::string_view("\0\x7f", 2)), "\"\\x00\\x7f\"");
  EXPECT_EQ(inQuotes(std::string(100, 'x')), "\"" + std::string(60, 'x') + "…\"");
}

}  // namespace
}  // namespace lampyris
