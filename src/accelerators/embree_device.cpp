// SPDX-License-Identifier: Apache-2.0
#include "accelerators/embree_device.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace lampyris::embree {

Device& Device::instance() {
  static Device device;
  return device;
}

Device::Device() : device_(rtcNewDevice(nullptr)) {
  if (!device_)
    throw std::runtime_error(fmt::format("Embree cannot start on this processor (error {})",
                                         static_cast<int>(rtcGetDeviceError(nullptr))));
  rtcSetDeviceErrorFunction(device_, onError, &errors_);
}

void Device::onError(void* user, RTCError code, const char* message) {
  auto& errors = *static_cast<Errors*>(user);
  const std::lock_guard lock(errors.mutex);
  if (errors.code != RTC_ERROR_NONE) return;
  errors.code = code;
  errors.message = message ? message : "";
}

void Device::check() {
  rtcGetDeviceError(device_);
  const std::lock_guard lock(errors_.mutex);
  const RTCError code = std::exchange(errors_.code, RTC_ERROR_NONE);
  if (code == RTC_ERROR_NONE) return;
  if (code == RTC_ERROR_OUT_OF_MEMORY)
    throw std::runtime_error(
        "not enough memory for the ray tracing structure of the scene's geometry");
  throw std::runtime_error(
      fmt::format("Embree failed: {} (error {})", errors_.message, static_cast<int>(code)));
}

}  // namespace lampyris::embree
