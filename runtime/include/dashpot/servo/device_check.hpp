// The device concept of device.hpp, checked in words, and its optional parts:
//     device_status reset() noexcept;      // asks the device, with the loop's reset, to leave a safe state of its own
//     const char* cause() const noexcept;  // why it answers `fault`: goes into the log
#pragma once

#include <type_traits>
#include <utility>

#include <dashpot/arm_device.hpp>
#include <dashpot/detected.hpp>
#include <dashpot/device.hpp>

namespace dashpot {

namespace device_claim {

template <class D>
using read = std::enable_if_t<noexcept(device_status(std::declval<D&>().read(std::declval<device_sample&>())))>;
template <class D>
using write = std::enable_if_t<noexcept(device_status(std::declval<D&>().write(std::declval<const actuation&>())))>;
template <class D>
using description =
    std::enable_if_t<noexcept(static_cast<const device_description&>(std::declval<const D&>().description()))>;
template <class D>
using reset = std::enable_if_t<noexcept(device_status(std::declval<D&>().reset()))>;

template <class D>
using arm_read = std::enable_if_t<noexcept(device_status(std::declval<D&>().read(std::declval<arm_sample&>())))>;
template <class D>
using arm_write =
    std::enable_if_t<noexcept(device_status(std::declval<D&>().write(std::declval<const arm_actuation&>())))>;
template <class D>
using arm_describes =
    std::enable_if_t<noexcept(static_cast<const arm_description&>(std::declval<const D&>().description()))>;

template <class D>
using cause = std::enable_if_t<noexcept(static_cast<const char*>(std::declval<const D&>().cause()))>;

}  // namespace device_claim

// Refuses, in words, to compile a class that is no device. Always true where it compiles.
template <class Device>
constexpr bool check_device() {
  static_assert(is_detected<device_claim::read, Device>,
                "the device needs 'dashpot::device_status read(dashpot::device_sample&) noexcept'");
  static_assert(is_detected<device_claim::write, Device>,
                "the device needs 'dashpot::device_status write(const dashpot::actuation&) noexcept'");
  static_assert(is_detected<device_claim::description, Device>,
                "the device needs 'const dashpot::device_description& description() const noexcept'");
  return true;
}

// The same for a device of two axes.
template <class Device>
constexpr bool check_arm_device() {
  static_assert(is_detected<device_claim::arm_read, Device>,
                "the device needs 'dashpot::device_status read(dashpot::arm_sample&) noexcept'");
  static_assert(is_detected<device_claim::arm_write, Device>,
                "the device needs 'dashpot::device_status write(const dashpot::arm_actuation&) noexcept'");
  static_assert(is_detected<device_claim::arm_describes, Device>,
                "the device needs 'const dashpot::arm_description& description() const noexcept'");
  return true;
}

}  // namespace dashpot
