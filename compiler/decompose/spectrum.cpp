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

// A range with every relaxation three decades inside: outside of it D has reached its limits to 1e-6.
std::vector<double> whole_axis(const LinearForm& form) {
  if (form.modes.empty()) return {1.0};
  return logarithmic_grid(to_double(form.modes.front().relaxation_rate) * 1e-3,
                          to_double(form.modes.back().relaxation_rate) * 1e3);
}

struct RoundedMode {
  double damping;          // B = k/λ [N·s/m]
  double relaxation_rate;  // [1/s]
  double position_share;   // of the drive [1]
};

double position_share(const Mode& mode, StateInput input) {
  switch (input) {
    case StateInput::position: return 1;
    case StateInput::velocity: return 0;
    case StateInput::nodal: return to_double(mode.spring_share);
  }
  return 1;
}

// The motor's modes, rounded once because a scan evaluates them hundreds of times.
class Motor {
 public:
  Motor(const LinearForm& form, double damping, StateInput input)
      : feedthrough_(to_double(form.feedthrough_damping) - damping) {
    for (const Mode& mode : form.modes)
      modes_.push_back({to_double(mode.damping()), to_double(mode.relaxation_rate), position_share(mode, input)});
  }

  // k/(λ + jω) = B (1 − jr)/(1 + r²), r = ω/λ: finite for every λ that a double can or cannot hold.
  MotorImpedance impedance(double w) const {
    MotorImpedance z{0.0, feedthrough_};
    for (const RoundedMode& mode : modes_) {
      const double r = w > 0 ? std::min(w / mode.relaxation_rate, 1e150) : 0;
      const double weight = mode.damping / (1 + r * r);
      const std::complex<double> whole(weight, -weight * r);
      z.position_driven += mode.position_share * whole;
      z.velocity_driven += (1.0 - mode.position_share) * whole;
    }
    return z;
  }

 private:
  double feedthrough_;  // b∞ − b [N·s/m]
  std::vector<RoundedMode> modes_;
};

}  // namespace

MotorImpedance motor_impedance(const LinearForm& form, double damping, StateInput input, double angular_frequency) {
  return Motor(form, damping, input).impedance(angular_frequency);
}

double largest_error(const LinearForm& form, double damping, StateInput input, const PortDevice& device) {
  if (device.is_ideal()) return 0;
  const Motor scanned(form, damping, input);
  const double static_stiffness = to_double(form.static_stiffness);
  const auto error_at = [&](double w) {
    const MotorImpedance motor = scanned.impedance(w);
    const std::complex<double> late = device.motor_response(w),
                               prompt = motor.position_driven + static_stiffness / std::complex(0.0, w);
    // (A − 1)(k0/jω + position_driven) + (A G − 1) velocity_driven
    const std::complex<double> error =
        (late - 1.0) * prompt + (late * device.velocity_response(w) - 1.0) * motor.velocity_driven;
    const std::complex<double> whole = damping + prompt + motor.velocity_driven;
    return std::abs(error) == 0 ? 0.0 : std::abs(error) / std::abs(whole);
  };
  return largest_in_band(device, error_at);
}

double largest_in_band(const PortDevice& device, const std::function<double(double)>& function) {
  return maximum(logarithmic_grid(device.band_low(), device.band_high()), function);
}

double largest_brake_share(const LinearForm& form, double damping, const PortDevice& device) {
  if (damping == 0) return 0;
  const Motor motor(form, damping, StateInput::position);
  const double static_stiffness = to_double(form.static_stiffness);
  const auto share_at = [&](double w) {
    const MotorImpedance z = motor.impedance(w);
    const std::complex<double> whole =
        damping + z.position_driven + z.velocity_driven + static_stiffness / std::complex(0.0, w);
    return std::abs(whole) == 0 ? 0.0 : damping / std::abs(whole);
  };
  return largest_in_band(device, share_at);
}

double extra_damping_any_delay(const LinearForm& form, double damping, StateInput input, double tolerance) {
  const Motor scanned(form, damping, input);
  const auto lack_at = [&](double w) {
    const MotorImpedance motor = scanned.impedance(w);
    return std::abs(motor.velocity_driven) - motor.position_driven.real() - (1 - tolerance) * damping;
  };
  const double at_high_frequency = std::abs(to_double(form.feedthrough_damping) - damping) - (1 - tolerance) * damping;
  return std::max({0.0, at_high_frequency, lack_at(0), maximum(whole_axis(form), lack_at)});
}

}  // namespace dashpot::compiler
