// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace lampyris {

/// A base for classes of which a scene may have millions, read at random: their objects lie side by
/// side in pages of 2 MiB (huge_pages.h), in the order in which a thread makes them. At most 64 KiB
/// an object, aligned as by malloc. A page is given back when its last object is gone.
class HugePageObject {
 public:
  static void* operator new(size_t bytes);
  static void operator delete(void* p) noexcept;

 protected:
  ~HugePageObject() = default;
};

}  // namespace lampyris
