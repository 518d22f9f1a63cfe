#include "certify/hold_bound.hpp"

#include <cmath>
#include <limits>

namespace dashpot::compiler {

namespace mp = boost::multiprecision;

namespace {

constexpr unsigned grid = 1200;  // finer than the least double by 126 binary places

}  // namespace

mp::cpp_int grid_steps_up(const Rational& value) {
  const mp::cpp_int scaled = mp::numerator(value) << grid;
  mp::cpp_int quotient, remainder;
  mp::divide_qr(scaled, mp::denominator(value), quotient, remainder);
  if (remainder > 0) ++quotient;
  return quotient;
}

Rational of_grid_steps(const mp::cpp_int& steps) { return Rational(steps, mp::cpp_int(1) << grid); }

double ceiling(const Rational& value) {
  double nearest = value.convert_to<double>();
  while (Rational(nearest) < value) nearest = std::nextafter(nearest, std::numeric_limits<double>::infinity());
  return nearest;
}

Rational hold_stiffness(const MotorConstants& motor) {
  Rational beta = Rational(motor.static_stiffness) / 2;
  Rational rest = Rational(motor.step_stiffness);
  mp::cpp_int more = 0,
              less = 0;  // of all modes, in steps of the grid: fractions that are kept in lowest terms are slow
  for (const MotorMode& mode : motor.modes) {
    const Rational a = exact_decay(motor, mode);
    const Rational d = mode.position_drive;
    if (a == 0) {
      beta += d;
      continue;
    }
    const Rational c = d / a;
    more += grid_steps_up(c / (1 + a));
    less +=
        grid_steps_up(-c);  // c rounded down: what is left comes out larger, never smaller in size by more than 2⁻¹²⁰⁰
  }
  beta += of_grid_steps(more);
  rest += of_grid_steps(less);
  return beta + abs(rest) + of_grid_steps(mp::cpp_int(motor.modes.size()));
}

}  // namespace dashpot::compiler
