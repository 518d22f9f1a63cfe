// device.json in numbers. Whoever changes one changes the other; a test of dashpot compares them.
#pragma once

#include <dashpot/device_description.hpp>

inline dashpot::device_description probe() {
  dashpot::device_description facts;
  facts.loop.sample_period = 1 / 1000.0;
  facts.loop.jitter = 50e-6;
  facts.loop.band_high = 20;
  facts.encoder = {5e-6, dashpot::quantiser::floor, -5e-3, 40e-3, 1.0};  // step, rounding, range [m], top speed [m/s]
  facts.velocity.window = 10;
  facts.motor.max_torque = 12;
  facts.motor.saturation_allowed = 0.5;
  facts.brake.kind = dashpot::brake_kind::eddy_current;
  facts.brake.max_damping = 10;
  facts.brake.tolerance = 0.05;
  facts.brake.safe_damping = 2;
  facts.mechanics.inertia = 0.15;
  facts.mechanics.damping = 1.2;
  return facts;
}
