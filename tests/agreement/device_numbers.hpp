// Every number of a device's description, in C++ or in C; a new one that is not listed does not compile.
#pragma once

#include <vector>

namespace dashpot::testing {

template <class Loop, class Encoder, class Velocity>
std::vector<double> numbers_of_loop(const Loop& loop, const Encoder& encoder, const Velocity& velocity) {
  const auto& [period, jitter, delay, earliest, latest, band_low, band_high, reference, missed] = loop;
  const auto& [step, rounding, range_low, range_high, max_speed] = encoder;
  const auto& [estimator, window, order, cutoff, best, acceleration, factor, noise, bandwidth] = velocity;
  return {
      period,         jitter, double(delay),    earliest,     latest,     band_low,  band_high,         reference,
      double(missed), step,   double(rounding), range_low,    range_high, max_speed, double(estimator), double(window),
      double(order),  cutoff, double(best),     acceleration, factor,     noise,     bandwidth};
}

template <class Motor, class Brake, class Mechanics>
std::vector<double> numbers_of_machine(const Motor& motor, const Brake& brake, const Mechanics& mechanics) {
  const auto& [torque_constant, torque, lag, slew, saturation, motor_noise] = motor;
  const auto& [kind, damping, per_current, residual, tolerance, coil, brake_slew, critical, safe] = brake;
  const auto& [inertia, own, friction, mode, backlash] = mechanics;
  const auto& [frequency, ratio, mass] = mode;
  return {torque_constant, torque,    lag,  slew,       saturation, motor_noise, double(kind), damping, per_current,
          residual,        tolerance, coil, brake_slew, critical,   safe,        inertia,      own,     friction,
          frequency,       ratio,     mass, backlash};
}

inline std::vector<double> joined(double motion, double arm, std::vector<double> one, const std::vector<double>& two) {
  one.insert(one.end(), two.begin(), two.end());
  one.insert(one.begin(), {motion, arm});
  return one;
}

template <class Description>
std::vector<double> numbers_in_cpp(const Description& described) {
  const auto& [motion, arm, loop, encoder, velocity, motor, brake, mechanics] = described;
  return joined(double(motion), arm, numbers_of_loop(loop, encoder, velocity),
                numbers_of_machine(motor, brake, mechanics));
}

template <class Device>
std::vector<double> numbers_in_c(const Device& described) {
  const auto& [name, digest, estimator, motion, arm, loop, encoder, velocity, motor, brake, mechanics] = described;
  static_cast<void>(name), static_cast<void>(digest), static_cast<void>(estimator);
  return joined(double(motion), arm, numbers_of_loop(loop, encoder, velocity),
                numbers_of_machine(motor, brake, mechanics));
}

}  // namespace dashpot::testing
