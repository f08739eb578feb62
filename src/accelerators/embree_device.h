// SPDX-License-Identifier: Apache-2.0
/// Embree's devices: one for most scenes, and one for those of very many balls.
#pragma once

#include <embree3/rtcore.h>

#include <cstddef>
#include <mutex>
#include <string>

namespace lampyris::embree {

class Device {
 public:
  /// For a scene with so many elements that Shape::ball() bounds. What is built with one device can
  /// not be used with the other. Throws if Embree cannot start.
  static Device& forBalls(size_t count);
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  operator RTCDevice() const { return device_; }  // NOLINT(google-explicit-constructor)
  /// Throws what went wrong since the last call.
  void check();

 private:
  /// What Embree said last; its callback and the thread that reads it may differ.
  struct Errors {
    std::mutex mutex;
    std::string message;
    RTCError code = RTC_ERROR_NONE;
  };
  explicit Device(const char* settings);
  ~Device() { rtcReleaseDevice(device_); }
  static void onError(void* user, RTCError code, const char* message);

  Errors errors_;
  RTCDevice device_;
};

}  // namespace lampyris::embree
