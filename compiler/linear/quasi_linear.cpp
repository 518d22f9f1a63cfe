#include "linear/quasi_linear.hpp"

#include <algorithm>
#include <cmath>

#include "linear/motion_map.hpp"

namespace dashpot::compiler {

double distance_from_quasi_linear(const Network& network, const LinearForm& form, double speed) {
  constexpr int steps = 2000;  // of the ramp; the difference is reported in per cent
  const MotionMap& map = *network.map;
  const double period = map.reach / speed / steps, viscosity = to_double(form.feedthrough_damping);
  const double static_stiffness = to_double(form.static_stiffness);
  std::vector<double> decay, stiffness, mapped(form.modes.size()), quasi_linear(form.modes.size());
  for (const Mode& mode : form.modes) {
    decay.push_back(std::exp(-to_double(mode.relaxation_rate) * period));
    stiffness.push_back(to_double(mode.stiffness));
  }
  double furthest = 0, largest = 0, w = 0, y = 0;
  for (int i = 1; i <= steps; ++i) {
    const double u = map.reach * i / steps, tangent = map.tangent_at(u);
    const double w_now = map.value_at(u), y_now = to_double(force_at(*network.static_curve, u)) / map.stiffness;
    double behind = static_stiffness * w_now + viscosity * tangent * speed;
    double other = static_stiffness * y_now + viscosity * (y_now - y) / period;
    for (std::size_t m = 0; m < decay.size(); ++m) {
      const double answer = stiffness[m] * (1 + decay[m]) / 2;  // the trapezoid of a ramp within a step
      behind += mapped[m] = decay[m] * mapped[m] + answer * (w_now - w);
      other += quasi_linear[m] = decay[m] * quasi_linear[m] + answer * (y_now - y);
    }
    furthest = std::max(furthest, std::abs(tangent * behind - other));
    largest = std::max(largest, std::abs(tangent * behind));
    w = w_now;
    y = y_now;
  }
  return furthest / largest;
}

}  // namespace dashpot::compiler
