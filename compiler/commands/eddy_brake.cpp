#include "commands/eddy_brake.hpp"

#include <cmath>

namespace dashpot::compiler {

double return_path_correction(double pole_length, double pole_width) {
  constexpr double two_pi = 6.28318530717958647692;
  const double a = pole_width / pole_length;
  return 1 - (4 * std::atan(a) + a * std::log1p(1 / (a * a)) - std::log1p(a * a) / a) / two_pi;
}

double linear_damping(const EddyBrake& brake, double correction) {
  return correction * brake.thickness * brake.pole_length * brake.pole_width * brake.field * brake.field /
         brake.resistivity;
}

}  // namespace dashpot::compiler
