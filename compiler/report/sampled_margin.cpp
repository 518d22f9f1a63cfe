#include "report/sampled_margin.hpp"

#include <cmath>
#include <numbers>

#include "certify/certificate.hpp"
#include "certify/needed_damping.hpp"
#include "report/number_text.hpp"
#include "report/plot.hpp"

namespace dashpot::compiler {
namespace {

using std::numbers::pi;
constexpr double decades = 4;  // below Nyquist
constexpr int margin_points = 240;

// θ = 4 atan x
Arc arc_at(double frequency, double period) {
  const double x = std::tan(pi * frequency * period / 2);
  return {x, x};
}

// Jitter behind an amplifier's lag, or of an interval that the estimate divides by, asks for more than S, at no
// frequency of its own.
bool has_jitter_apart(const Certificate& certificate) {
  const SampledLoop& loop = certificate.loop;
  const bool is_apart = loop.amplifier_lag > 0 || divides_by_varying_interval(loop);
  return is_apart && loop.jitter > 0 && !certificate.bound.constant_period_only;
}

// S(ω), over the longest hold where no amplifier lags; the bound holds between the margin_points as well.
Curve needed(const Certificate& certificate, const MotorConstants& motor) {
  const SampledLoop& loop = certificate.loop;
  const double period = loop.sample_period, nyquist = 0.5 / period;
  const NeededDamping damping(motor, loop, estimator_factors(loop).value_or(EstimatorFactors{}));
  const bool is_apart = has_jitter_apart(certificate);
  Curve curve{is_apart ? "needed at punctual samples" : "needed by motor and hold", Channel::motor, {}, {}};
  const double hold = certificate.bound.constant_period_only || is_apart ? 1 : loop.longest_hold() / period;
  for (int i = 0; i < margin_points; ++i) {
    curve.x.push_back(nyquist * std::pow(10, decades * (double(i) / (margin_points - 1) - 1)));
    const double S = damping.on(i + 1 == margin_points ? Arc{1, 1} : arc_at(curve.x.back(), period)).at_centre;
    curve.y.push_back(S > 0 ? S * hold : S);
  }
  return curve;
}

}  // namespace

std::string sampled_margin_html(const Compilation& c) {
  const std::optional<MotorConstants> motor = motor_constants(c.law);
  const SampledLoop& loop = c.certificate.loop;
  if (!motor || c.certificate.bound.proof == Proof::none) return "";
  if (motor->follows_estimate() && !estimator_factors(loop)) return "";
  const PortUnits units = dotted_units(c.network.port_motion);
  Curve curve = needed(c.certificate, *motor);
  const double sure = c.certificate.assured;
  const std::vector<double> ends = {curve.x.front(), curve.x.back()};
  std::vector<Curve> curves = {std::move(curve), {"assured by brake and device", Channel::brake, ends, {sure, sure}}};
  const double most = c.certificate.bound.needed;
  if (has_jitter_apart(c.certificate))
    curves.push_back({"needed under jitter", Channel::motor, ends, {most, most}, true});
  return plot_figure({"Damping of the sampled loop",
                      {"frequency", "Hz"},
                      {"damping", units.damping},
                      AxisScale::logarithmic,
                      AxisScale::linear,
                      std::move(curves),
                      true});
}

}  // namespace dashpot::compiler
