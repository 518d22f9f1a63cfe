#include "decompose/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dashpot::compiler {
namespace {

constexpr int points_per_decade = 40;

std::vector<double> logarithmic_grid(double low, double high) {
  const int intervals = std::max(1, static_cast<int>(std::ceil(std::log10(high / low) * points_per_decade)));
  std::vector<double> grid;
  for (int i = 0; i <= intervals; ++i) grid.push_back(low * std::pow(high / low, double(i) / intervals));
  return grid;
}

// Largest value of `f` over the grid, improved by golden section between the neighbours of the best point.
template <class Function>
double maximum(const std::vector<double>& grid, Function f) {
  std::size_t best = 0;
  double value = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (const double here = f(grid[i]); here > value) {
      value = here;
      best = i;
    }
  double low = std::log(grid[best == 0 ? 0 : best - 1]);
  double high = std::log(grid[std::min(best + 1, grid.size() - 1)]);
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  for (int i = 0; i < 40; ++i) {
    const double left = high - ratio * (high - low), right = low + ratio * (high - low);
    const double at_left = f(std::exp(left)), at_right = f(std::exp(right));
    value = std::max({value, at_left, at_right});
    (at_left < at_right ? low : high) = at_left < at_right ? left : right;
  }
  return value;
}

// Every relaxation lies three decades inside: beyond, D has reached its limits to 1e-6.
std::vector<double> whole_axis(const LinearForm& form) {
  if (form.modes.empty()) return {1.0};
  return logarithmic_grid(to_double(form.modes.front().relaxation_rate) * 1e-3,
                          to_double(form.modes.back().relaxation_rate) * 1e3);
}

}  // namespace

MotorImpedance motor_impedance(const LinearForm& form, double damping, StateInput input, double angular_frequency) {
  MotorImpedance z{0.0, to_double(form.feedthrough_damping) - damping};
  for (const Mode& mode : form.modes) {
    const std::complex<double> whole =
        to_double(mode.stiffness) / std::complex<double>(to_double(mode.relaxation_rate), angular_frequency);
    const double share = input == StateInput::position   ? 1.0
                         : input == StateInput::velocity ? 0.0
                                                         : to_double(mode.spring_share);
    z.position_driven += share * whole;
    z.velocity_driven += (1.0 - share) * whole;
  }
  return z;
}

double largest_error(const LinearForm& form, double damping, StateInput input, const PortDevice& device) {
  if (device.is_ideal()) return 0;
  const auto error_at = [&](double w) {
    const MotorImpedance motor = motor_impedance(form, damping, input, w);
    const std::complex<double> error = motor.velocity_driven * (device.velocity_response(w) - 1.0);
    const std::complex<double> whole =
        damping + motor.position_driven + motor.velocity_driven + to_double(form.static_stiffness) / std::complex(0.0, w);
    return std::abs(error) == 0 ? 0.0 : std::abs(error) / std::abs(whole);
  };
  return maximum(logarithmic_grid(device.band_low(), device.band_high()), error_at);
}

double extra_damping_any_delay(const LinearForm& form, double damping, StateInput input, double tolerance) {
  const auto lack_at = [&](double w) {
    const MotorImpedance motor = motor_impedance(form, damping, input, w);
    return std::abs(motor.velocity_driven) - motor.position_driven.real() - (1 - tolerance) * damping;
  };
  const double at_high_frequency =
      std::abs(to_double(form.feedthrough_damping) - damping) - (1 - tolerance) * damping;
  return std::max({0.0, at_high_frequency, lack_at(0), maximum(whole_axis(form), lack_at)});
}

}  // namespace dashpot::compiler
