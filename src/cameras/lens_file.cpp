// SPDX-License-Identifier: Apache-2.0
#include "cameras/lens_file.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>
#include <string>

namespace lampyris {

namespace {

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// The numbers of the text, one after the other.
class Numbers {
 public:
  explicit Numbers(std::string_view text) : text_(text) {}

  /// False at the end of the text.
  bool next(double& value) {
    skip();
    if (at_ == text_.size()) return false;
    size_t end = at_;
    while (end < text_.size() && !isSpace(text_[end]) && text_[end] != '#') ++end;
    const char* const first = text_.data() + at_ + (text_[at_] == '+' ? 1 : 0);
    const char* const last = text_.data() + end;
    const auto [stop, error] = std::from_chars(first, last, value);
    if (error != std::errc() || stop != last)
      throw std::runtime_error(fmt::format("line {}: expected a number, got \"{}\"", line_,
                                           text_.substr(at_, std::min<size_t>(end - at_, 40))));
    at_ = end;
    return true;
  }

 private:
  void skip() {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size());
      if (at_ == text_.size() || !isSpace(text_[at_])) return;
      line_ += text_[at_] == '\n';
    }
  }

  std::string_view text_;
  size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

std::vector<LensElement> readLens(std::string_view text) {
  constexpr double kMillimetre = 0.001;
  constexpr size_t kMostElements = 1000;
  std::vector<double> values;
  Numbers in(text);
  for (double v; values.size() <= 4 * kMostElements && in.next(v);) values.push_back(v);
  if (values.empty() || values.size() % 4 || values.size() > 4 * kMostElements)
    throw std::runtime_error(
        fmt::format("a lens file holds four numbers for each of 1 to {} elements (radius of "
                    "curvature, thickness, index of refraction, diameter), this one {} numbers",
                    kMostElements, values.size()));
  std::vector<LensElement> elements;
  for (size_t i = 0; i < values.size(); i += 4)
    elements.push_back({values[i] * kMillimetre, values[i + 1] * kMillimetre, values[i + 2],
                        values[i + 3] * kMillimetre / 2});
  return elements;
}

}  // namespace lampyris
