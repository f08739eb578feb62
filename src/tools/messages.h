// SPDX-License-Identifier: Apache-2.0
/// What is said on standard error.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace lampyris {

/// Prints; says nothing where standard error is closed or full, for no render is to end because
/// nobody can read about it.
template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace lampyris
