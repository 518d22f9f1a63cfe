#include "decompose/port_device.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/estimators/estimator_names.hpp>
#include <dashpot/estimators/frequency_response.hpp>

namespace dashpot::compiler {
namespace {

using std::numbers::pi;

// Σ h²: the variance of the estimate if the position has white noise of variance 1. The estimator itself gives the
// impulse response h, since for a slow filter the coefficients of a transfer function are mostly rounding. Stops when a
// whole window no longer changes the sum.
double noise_power_gain(any_estimator<double> estimator, double sample_period) {
  constexpr int most_samples = 1 << 22;  // a slower filter would not settle while a loop runs
  estimator.reset(0);
  const auto period_ns = static_cast<std::uint64_t>(std::llround(sample_period * 1e9));
  device_sample impulse;
  impulse.position = 1;
  double sum = 0;
  for (int i = 0, unchanged = 0; i < most_samples && (sum == 0 || unchanged <= int(longest_window));
       ++i, impulse.position = 0, impulse.timestamp_ns += period_ns) {
    const double answer = estimator.update(impulse), more = sum + answer * answer;
    unchanged = more == sum ? unchanged + 1 : 0;
    sum = more;
  }
  return sum;
}

}  // namespace

std::optional<PortDevice> PortDevice::of(const Device& device, const Network& network, Diagnostics& diagnostics) {
  const device_description& d = device.description;
  PortDevice port;
  port.take(device);
  const double steepest = network.map ? network.map->steepest() : 1;
  port.steepest_ = steepest;
  if (d.motion == network.port_motion) return port.behind_lever(steepest);
  // B_joint = B r², u = q r (theory, section 7).
  if (network.port_motion == motion::translation && d.arm_radius > 0)
    return port.behind_lever(d.arm_radius).behind_lever(steepest);
  diagnostics.report<DiagnosticCode::motion_mismatch>(network.name_span, network.name, device.name);
  return std::nullopt;
}

const device_description& PortDevice::description() const {
  static const device_description ideal;
  return device_ ? device_->description : ideal;
}

PortDevice PortDevice::behind_lever(double ratio) const {
  PortDevice port = *this;
  port.damping_scale_ /= ratio * ratio;
  port.position_scale_ *= ratio;
  return port;
}

PortDevice PortDevice::at_tool() const {
  PortDevice port = behind_lever(1 / steepest_);
  port.steepest_ = 1;
  return port;
}

PortDevice PortDevice::replaced_by(const Device& device) const {
  PortDevice port = *this;
  port.take(device);
  return port;
}

// Computed once: a slow filter needs millions of samples, and many candidates use the result.
void PortDevice::take(const Device& device) {
  device_ = device;
  const bool is_asked = estimator_is_linear() && device.description.velocity.estimator != estimator_kind::sensor;
  noise_power_gain_ = is_asked ? noise_power_gain(estimator(), device.description.loop.sample_period) : 0;
}

std::optional<double> PortDevice::max_damping() const {
  if (is_ideal()) return std::nullopt;
  const brake_description& brake = description().brake;
  return brake.kind == brake_kind::none ? 0 : brake.max_damping * damping_scale_;
}

double PortDevice::tolerance() const { return description().brake.tolerance; }

double PortDevice::assured_share() const {
  const double fades_at = description().brake.critical_speed, fastest = description().encoder.max_speed;
  if (fades_at == 0) return 1 - tolerance();
  return fastest == 0 ? 0 : (1 - tolerance()) / (1 + fastest / fades_at * (fastest / fades_at));
}

double PortDevice::residual_damping() const { return description().brake.residual_damping * damping_scale_; }

double PortDevice::band_low() const { return 2 * pi * description().loop.band_low; }
double PortDevice::band_high() const { return 2 * pi * description().loop.band_high; }
double PortDevice::largest_estimator_gain() const {
  if (is_ideal()) return 1;
  if (divides_by_varying_interval()) {
    const double shortest = sample_period() - description().loop.jitter;
    return shortest > 0 ? sample_period() / shortest : std::numeric_limits<double>::infinity();
  }
  return estimator_is_linear() ? estimator().max_gain() : std::numeric_limits<double>::infinity();
}

double PortDevice::sample_period() const { return description().loop.sample_period; }
double PortDevice::longest_hold() const {
  const loop_description& loop = description().loop;
  return loop.sample_period + loop.jitter + (loop.write_latest - loop.write_earliest);
}
double PortDevice::amplifier_lag() const { return description().motor.amplifier_lag; }
bool PortDevice::acts_late() const {
  const loop_description& loop = description().loop;
  return loop.delay_samples > 0 || loop.write_latest > 0 || amplifier_lag() > 0;
}
double PortDevice::coil_lag() const { return description().brake.coil_lag; }

double PortDevice::coil_slew() const {
  const brake_description& brake = description().brake;
  return brake.slew * std::sqrt(brake.damping_per_current_squared * damping_scale_);
}

std::string_view PortDevice::estimator_name() const {
  return is_ideal() ? "exact" : name_of(description().velocity.estimator);
}

// An estimate acts in the hold after its sample, one period after the last motion that it has seen.
std::optional<unsigned> PortDevice::estimate_memory() const {
  const velocity_description& velocity = description().velocity;
  const loop_description& loop = description().loop;
  const unsigned delay = loop.delay_samples + (loop.write_latest > 0 ? 1 : 0);
  switch (velocity.estimator) {
    case estimator_kind::backward_difference:
    case estimator_kind::least_squares: return delay + velocity.window;
    case estimator_kind::interval_difference:
      return divides_by_varying_interval() ? std::nullopt : std::optional(delay + 1);
    default: return std::nullopt;  // a sensor reads the velocity of an instant, not the mean over the hold before
  }
}

double PortDevice::encoder_step() const { return description().encoder.step * position_scale_; }

double PortDevice::reference_frequency() const { return 2 * pi * description().loop.reference_frequency; }

PortDevice::Estimator PortDevice::estimator() const {
  const device_description& d = description();
  return Estimator(d.velocity, d.loop.sample_period, d.encoder.step);
}

bool PortDevice::divides_by_varying_interval() const {
  const device_description& d = description();
  return d.velocity.estimator == estimator_kind::interval_difference && d.loop.jitter > 0;
}

bool PortDevice::estimator_is_linear() const { return is_linear(description().velocity.estimator); }

std::complex<double> PortDevice::velocity_response(double angular_frequency) const {
  if (is_ideal()) return 1;
  const velocity_description& velocity = description().velocity;
  if (velocity.estimator == estimator_kind::sensor)
    return velocity.bandwidth > 0 ? 1.0 / std::complex(1.0, angular_frequency / (2 * pi * velocity.bandwidth)) : 1.0;
  if (!estimator_is_linear()) return std::polar(1.0, -angular_frequency * estimator().delay());
  return dashpot::velocity_response(estimator().transfer(), angular_frequency, sample_period());
}

std::complex<double> PortDevice::motor_response(double angular_frequency) const {
  if (is_ideal()) return 1;
  const device_description& d = description();
  const double delay = d.loop.delay_samples * d.loop.sample_period + (d.loop.write_earliest + d.loop.write_latest) / 2;
  return std::polar(1.0, -angular_frequency * delay) / std::complex(1.0, angular_frequency * d.motor.amplifier_lag);
}

// A linear estimator with gain 1 at rest follows the displacement in the long run; the others do not promise it.
// Nor does one that divides by the time that has passed, while the law counts in nominal periods.
bool PortDevice::estimate_sums_to_displacement() const {
  return estimator_is_linear() && !divides_by_varying_interval();
}

std::optional<double> PortDevice::velocity_noise() const {
  if (is_ideal()) return 0;
  const device_description& d = description();
  if (d.velocity.estimator == estimator_kind::sensor) return d.velocity.noise * position_scale_;
  if (!estimator_is_linear()) return std::nullopt;
  const double quantum = d.encoder.step / std::sqrt(12.0);
  return quantum * position_scale_ * std::sqrt(noise_power_gain_);
}

}  // namespace dashpot::compiler
