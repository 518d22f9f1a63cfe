// device.json in numbers. Whoever changes one changes the other; a test of dashpot compares them.
#pragma once

#include <dashpot/device_description.hpp>

inline dashpot::device_description knee_rig() {
  constexpr double pi = 3.141592653589793;
  dashpot::device_description facts;
  facts.motion = dashpot::motion::rotation;
  facts.loop.sample_period = 1 / 4000.0;
  facts.loop.jitter = 25e-6;
  facts.loop.band_high = 10;
  facts.encoder = {2 * pi / 262144, dashpot::quantiser::floor, -10 * pi / 180, 40 * pi / 180, 20};  // [rad], [rad/s]
  facts.velocity.estimator = dashpot::estimator_kind::butterworth;
  facts.velocity.order = 2;
  facts.velocity.cutoff = 100;
  facts.motor.max_torque = 5;
  facts.motor.saturation_allowed = 0.2;
  facts.brake.kind = dashpot::brake_kind::eddy_current;
  facts.brake.max_damping = 0.05;
  facts.brake.tolerance = 0.05;
  facts.brake.safe_damping = 0.02;
  facts.mechanics.inertia = 2e-3;
  facts.mechanics.damping = 3e-3;
  return facts;
}
