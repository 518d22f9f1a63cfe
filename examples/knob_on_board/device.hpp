// device.json in numbers. Whoever changes one changes the other; a test of dashpot compares them.
#pragma once

#include <dashpot/device_description.hpp>

inline dashpot::device_description knob_board() {
  dashpot::device_description facts;
  facts.loop.sample_period = 1 / 1000.0;
  facts.loop.jitter = 0.5e-3;
  facts.loop.delay_samples = 1;
  facts.loop.missed_deadlines_allowed = 5000;
  facts.encoder = {10e-6, dashpot::quantiser::floor, -50e-3, 50e-3, 20};  // step, rounding, range [m], top speed [m/s]
  facts.velocity.window = 15;
  facts.motor.max_torque = 50;
  facts.motor.saturation_allowed = 0.5;
  facts.brake.kind = dashpot::brake_kind::eddy_current;
  facts.brake.max_damping = 30;
  facts.brake.tolerance = 0.05;
  facts.brake.safe_damping = 5;
  facts.mechanics.inertia = 0.1;
  return facts;
}
