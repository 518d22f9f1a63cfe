#include "certify/felt_error.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dashpot::compiler {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr int felt_points_per_decade = 100;
constexpr double beyond_measure = 1e300;  // stands for an error that is no finite double [1]
constexpr double endless = std::numeric_limits<double>::infinity();

std::vector<double> logarithmic(double low, double high) {
  if (!(high > low)) return {low};
  const int intervals = std::max(1, static_cast<int>(std::ceil(std::log10(high / low) * felt_points_per_decade)));
  std::vector<double> values;
  for (int i = 0; i <= intervals; ++i) values.push_back(low * std::pow(high / low, double(i) / intervals));
  values.back() = high;
  return values;
}

// 1 − e^{−jθ} without cancellation.
Complex difference_at(double theta) {
  const double half = std::sin(theta / 2);
  return {2 * half * half, std::sin(theta)};
}

// A canonical form, rounded once because it is evaluated at hundreds of frequencies.
class ClosedForm {
 public:
  explicit ClosedForm(const LinearForm& form)
      : static_stiffness_(to_double(form.static_stiffness)), feedthrough_(to_double(form.feedthrough_damping)) {
    for (const Mode& mode : form.modes) modes_.push_back({to_double(mode.damping()), to_double(mode.relaxation_rate)});
  }

  // D(jω) = k0 + jω (b∞ + Σ B_i/(1 + jω/λ_i))
  Complex stiffness(double w) const {
    Complex impedance = feedthrough_;
    for (const RoundedMode& mode : modes_)
      impedance += mode.damping / Complex(1, std::min(w / mode.relaxation_rate, 1e150));
    return static_stiffness_ + Complex(0, w) * impedance;
  }

 private:
  struct RoundedMode {
    double damping, relaxation_rate;
  };
  double static_stiffness_, feedthrough_;
  std::vector<RoundedMode> modes_;
};

// Sums over modes of c δ/(1 − a w) and e w/(1 − a w), with c = d/a; and what remains of s, and of modes with a = 0.
struct ModeForces {
  Complex by_position, by_velocity;
};
ModeForces mode_forces(const MotorConstants& motor, const Complex& difference) {
  const Complex w = 1.0 - difference;
  ModeForces forces{0, 0};
  double rest = motor.step_stiffness;
  for (const MotorMode& mode : motor.modes) {
    const Complex pole = 1.0 / (mode.loss + mode.decay * difference);
    forces.by_velocity += mode.velocity_drive * w * pole;
    if (mode.decay < 1e-200) continue;
    const double c = mode.position_drive / mode.decay;
    forces.by_position += c * difference * pole;
    rest -= c;
  }
  forces.by_position += rest * difference;
  return forces;
}

// A difference of two such numbers that may be due to rounding alone counts as none.
Complex departure(const Complex& felt, const Complex& rendered) {
  const Complex error = felt - rendered;
  return std::abs(error) <= 8 * std::numeric_limits<double>::epsilon() * std::abs(rendered) ? Complex(0) : error;
}

// The root; beyond_measure if the square is infinite or NaN.
double error_of(double square) {
  return square < endless ? std::min(std::sqrt(square), beyond_measure) : beyond_measure;
}

}  // namespace

FeltError::FeltError(const MotorConstants& motor, const LinearForm& rendered, const LinearForm& whole,
                     const SampledLoop& loop, const PortDevice& device)
    : device_(device),
      sample_period_(loop.sample_period),
      factors_(estimator_factors(loop)),
      tolerance_(loop.tolerance),
      frequencies_(logarithmic(device.band_low() / (2 * pi), device.band_high() / (2 * pi))) {
  const ClosedForm felt(rendered), reference(whole);
  for (const double frequency : frequencies_) {
    const double w = 2 * pi * frequency;
    const Place here = place(motor, felt.stiffness(w), reference.stiffness(w), w);
    append(without_brake_, here.without_brake);
    append(of_motor_, here.of_motor);
    append(of_brake_, here.of_brake);
  }
}

void FeltError::append(Parts& parts, Complex value) {
  parts.real.push_back(value.real());
  parts.imaginary.push_back(value.imag());
}

// E: taps and zeros over the poles, times δ/T; jω G where the estimator is no pulse transfer function.
Complex FeltError::estimate(double w, Complex difference) const {
  if (!factors_) return Complex(0, w) * device_.velocity_response(w);
  const Complex back = 1.0 - difference;
  Complex sum = 0;
  for (std::size_t i = factors_->taps.size(); i-- > 0;) sum = sum * back + factors_->taps[i];
  for (const EstimatorPole& pole : factors_->poles) {
    if (pole.has_zero()) sum *= pole.gain * (2.0 - difference);
    sum /= pole.loss + pole.pole * difference;
  }
  return sum * difference / sample_period_;
}

FeltError::Place FeltError::place(const MotorConstants& motor, Complex rendered, Complex reference, double w) const {
  if (reference == 0.0) return {0, 0, beyond_measure};  // nothing should be felt, so that any brake is too much
  const double theta = w * sample_period_;
  const Complex difference = difference_at(theta), rate(0, w), estimated = estimate(w, difference);
  const Complex late = device_.motor_response(w) * difference / Complex(0, theta);
  const ModeForces modes = mode_forces(motor, difference);
  const Complex law =
      motor.static_stiffness + modes.by_position + estimated * (motor.velocity_gain + modes.by_velocity);
  return {departure(late * law, rendered) / reference, -late * estimated / reference, rate / reference};
}

// All frequencies in one loop, since a search for the best decomposition calls this hundreds of thousands of times. A
// square is NaN or infinite if the felt force is.
template <class Take>
auto FeltError::of_squares(double damping, double added, Take take) const {
  using Values = Eigen::Map<const Eigen::ArrayXd>;
  const double braked = damping + added;
  const auto error = [&](double off, const std::vector<double> Parts::*part) {
    const auto all = [&](const Parts& parts) {
      return Values((parts.*part).data(), Eigen::Index((parts.*part).size()));
    };
    return all(without_brake_) + damping * all(of_motor_) + braked * all(of_brake_) + off * all(of_brake_);
  };
  const auto square = [&](double off) {
    return error(off, &Parts::real).square() + error(off, &Parts::imaginary).square();
  };
  return take(square(tolerance_ * braked).max(square(-tolerance_ * braked)));
}

double FeltError::largest(double damping, double added) const {
  return of_squares(damping, added,
                    [](const auto& squares) { return error_of(squares.template maxCoeff<Eigen::PropagateNaN>()); });
}

std::vector<double> FeltError::over_band(double damping, double added) const {
  return of_squares(damping, added, [](const auto& squares) {
    std::vector<double> errors;
    for (const double square : Eigen::ArrayXd(squares)) errors.push_back(error_of(square));
    return errors;
  });
}

}  // namespace dashpot::compiler
