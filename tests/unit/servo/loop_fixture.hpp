// A simulated loop on scripted parts, as the base of tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <string>

#include <dashpot/servo/servo_loop.hpp>

#include "log_text.hpp"
#include "scripted_clock.hpp"
#include "scripted_device.hpp"
#include "scripted_model.hpp"

namespace dashpot::tests {

inline bool same_bits(const actuation& one, const actuation& other) {
  return std::memcmp(&one, &other, sizeof one) == 0;
}

// Every period may be acted on between its write and the next read.
class loop_fixture : public testing::Test {
 protected:
  using loop_type = servo_loop<scripted_model, scripted_device, scripted_estimator, scripted_clock>;

  servo_summary run(std::size_t periods, std::function<void(std::size_t, servo_control&)> act = {}) {
    options.duration = 0.001 * static_cast<double>(periods);
    options.outputs.log = log.file();
    loop_type loop(model, device, estimator, options, clock);
    if (act) device.on_write([&loop, act](std::size_t write) { return act(write, loop.control()), device_status::ok; });
    return loop.run();
  }

  bool is_safe(std::size_t write) const {
    return device.written()[write].motor_torque == 0 && device.written()[write].brake_damping == 7.5;
  }

  // The log without its first line, which warns of the missing certificate.
  std::string events() const {
    const std::string text = log.text();
    return text.substr(text.find('\n') + 1);
  }

  void make_position_nan_at(std::size_t instant) {
    device.on_read([instant](std::size_t read, device_sample& sample) {
      if (read == instant) sample.position = std::nan("");
      return device_status::ok;
    });
  }

  void restart_parts() {
    device = scripted_device();
    model = scripted_model();
    estimator = scripted_estimator();
  }

  scripted_device device;
  scripted_model model;
  scripted_estimator estimator;
  scripted_clock clock;
  servo_options options;
  log_text log;
};

}  // namespace dashpot::tests
