#include "certify/hold_bound.hpp"

#include <cmath>
#include <limits>

namespace dashpot::compiler {

namespace mp = boost::multiprecision;

namespace {

constexpr unsigned grid = 1200;  // binary places; 126 finer than the smallest double

// A fraction, not necessarily in lowest terms, rounded up to whole steps of the grid.
mp::cpp_int steps_up(const mp::cpp_int& numerator, const mp::cpp_int& denominator) {
  mp::cpp_int quotient, remainder;
  mp::divide_qr(mp::cpp_int(numerator << grid), denominator, quotient, remainder);
  if (remainder > 0) ++quotient;
  return quotient;
}

}  // namespace

mp::cpp_int grid_steps_up(const Rational& value) { return steps_up(mp::numerator(value), mp::denominator(value)); }

Rational of_grid_steps(const mp::cpp_int& steps) { return Rational(steps, mp::cpp_int(1) << grid); }

double ceiling(const Rational& value) {
  double nearest = value.convert_to<double>();
  while (std::isfinite(nearest) && Rational(nearest) < value)
    nearest = std::nextafter(nearest, std::numeric_limits<double>::infinity());
  return nearest;
}

// Computes in whole steps of the grid, which every double is: fractions in lowest terms are slow.
Rational hold_stiffness(const MotorConstants& motor) {
  mp::cpp_int beta = grid_steps_up(Rational(motor.static_stiffness) / 2);
  mp::cpp_int rest = grid_steps_up(Rational(motor.step_stiffness));
  for (const MotorMode& mode : motor.modes) {
    const Rational decay = exact_decay(motor, mode), drive = mode.position_drive;
    const mp::cpp_int a = mp::numerator(decay), of_a = mp::denominator(decay);
    const mp::cpp_int d = mp::numerator(drive), of_d = mp::denominator(drive);
    if (a == 0) {
      beta += grid_steps_up(drive);
      continue;
    }
    // c = d/a. c/(1 + a) is rounded up, and c down: what is left of the rest comes out larger, never smaller in size by
    // more than a step.
    beta += steps_up(d * of_a * of_a, of_d * a * (of_a + a));
    rest += steps_up(-d * of_a, of_d * a);
  }
  return of_grid_steps(beta + abs(rest) + motor.modes.size());
}

}  // namespace dashpot::compiler
