// SPDX-License-Identifier: Apache-2.0
/// Embree's device: one per process, as Embree wants it.
#pragma once

#include <embree3/rtcore.h>

#include <mutex>
#include <string>

namespace lampyris::embree {

class Device {
 public:
  /// Throws if Embree cannot start.
  static Device& instance();
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
  Device();
  ~Device() { rtcReleaseDevice(device_); }
  static void onError(void* user, RTCError code, const char* message);

  Errors errors_;
  RTCDevice device_;
};

}  // namespace lampyris::embree
