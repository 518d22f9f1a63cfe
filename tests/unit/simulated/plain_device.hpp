// A device without any imperfection, for tests that add the one they are about; and the way to run it.
#pragma once

#include <cstdint>

#include <dashpot/simulated/simulated_device.hpp>

namespace dashpot::simulated {

// Inertia 0.2 kg, 1 kHz, ideal encoder, motor and brake without lags or limits.
inline device_description plain_device() {
  device_description device;
  device.loop.sample_period = 0.001;
  device.mechanics.inertia = 0.2;
  device.brake.kind = brake_kind::eddy_current;
  device.brake.max_damping = 100;
  return device;
}

// A rotary arm with everything that a real one has.
inline device_description imperfect_arm() {
  device_description device;
  device.motion = motion::rotation;
  device.arm_radius = 0.05;
  device.loop.sample_period = 1e-4;
  device.loop.jitter = 4e-5;
  device.loop.delay_samples = 1;
  device.encoder.step = 2 * 3.14159265358979323846 / 65536;
  device.motor = {0.02, 0.08, 2e-4, 0};
  device.brake.kind = brake_kind::eddy_current;
  device.brake.max_damping = 7e-3;
  device.brake.damping_per_current_squared = 1e-3;
  device.brake.residual_damping = 2e-5;
  device.brake.tolerance = 0.05;
  device.brake.coil_lag = 1e-3;
  device.brake.slew = 3000;
  device.brake.critical_speed = 20;
  device.mechanics = {5e-5, 1e-5, 1e-3};
  return device;
}

// Reads `samples` samples under one unchanging demand and returns the last.
inline device_sample run(simulated_device& device, std::uint64_t samples, const actuation& demand = {}) {
  device_sample sample;
  for (std::uint64_t k = 0; k < samples; ++k) {
    device.write(demand);
    device.read(sample);
  }
  return sample;
}

}  // namespace dashpot::simulated
