// SPDX-License-Identifier: Apache-2.0
/// What every fuzz target begins with.
#pragma once

#include <cstdint>
#include <exception>
#include <string_view>

#include "bounds.h"
#include "core/error.h"

namespace lampyris::fuzz {

/// Keeps a result that is otherwise unused.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

/// Defines the target: `f(text)` may throw `Expected`, and nothing else.
template <class Expected, class F>
int run(const uint8_t* data, size_t size, size_t bytes, F&& f) {
  const Bounds bound(bytes);
  try {
    f(std::string_view(reinterpret_cast<const char*>(data), size));
  } catch (const Expected& e) {
    keep(e);
  }
  return 0;
}

constexpr size_t kMebi = size_t{1} << 20;

}  // namespace lampyris::fuzz
