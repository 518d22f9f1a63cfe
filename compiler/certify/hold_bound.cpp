#include "certify/hold_bound.hpp"

#include <cmath>
#include <limits>

namespace dashpot::compiler {

namespace mp = boost::multiprecision;

Rational rounded_up(const Rational& value) {
  constexpr unsigned grid = 1200;  // finer than the least double by 126 binary places
  const mp::cpp_int scaled = mp::numerator(value) << grid;
  mp::cpp_int quotient, remainder;
  mp::divide_qr(scaled, mp::denominator(value), quotient, remainder);
  if (remainder > 0) ++quotient;
  return Rational(quotient, mp::cpp_int(1) << grid);
}

double ceiling(const Rational& value) {
  double nearest = value.convert_to<double>();
  while (Rational(nearest) < value) nearest = std::nextafter(nearest, std::numeric_limits<double>::infinity());
  return nearest;
}

Rational hold_stiffness(const MotorConstants& motor) {
  Rational beta = Rational(motor.static_stiffness) / 2;
  Rational rest = Rational(motor.step_stiffness);
  for (const MotorMode& mode : motor.modes) {
    const Rational a = exact_decay(motor, mode);
    const Rational d = mode.position_drive;
    if (a == 0) {
      beta += d;
      continue;
    }
    const Rational c = d / a;
    beta += rounded_up(c / (1 + a));
    rest -= -rounded_up(-c);  // c rounded down: what is left comes out larger, never smaller in size by more than 2⁻¹²⁰⁰
  }
  return beta + abs(rest) + Rational(mp::cpp_int(motor.modes.size()), mp::cpp_int(1) << 1200);
}

}  // namespace dashpot::compiler
