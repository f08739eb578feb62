// SPDX-License-Identifier: Apache-2.0
/// An order between threads that ThreadSanitizer cannot see.
#pragma once

#ifdef LAMPYRIS_TSAN
extern "C" {
void __tsan_acquire(void* address);
void __tsan_release(void* address);
}
#endif

namespace lampyris {

/// What libraries that are compiled without the sanitizer do for us, told to it: all that is
/// written before give() is there after take(). Nothing in any other build.
class HandOver {
 public:
#ifdef LAMPYRIS_TSAN
  void give() const { __tsan_release(const_cast<HandOver*>(this)); }
  void take() const { __tsan_acquire(const_cast<HandOver*>(this)); }
#else
  void give() const {}
  void take() const {}
#endif
};

}  // namespace lampyris
