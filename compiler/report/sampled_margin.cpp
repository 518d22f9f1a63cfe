#include "report/sampled_margin.hpp"

#include <fmt/format.h>

#include <cmath>

#include "certify/certificate.hpp"
#include "certify/needed_damping.hpp"
#include "decompose/port_device.hpp"
#include "report/number_text.hpp"
#include "report/plot.hpp"

namespace dashpot::compiler {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double decades = 4;  // below Nyquist
constexpr int points = 240;

// θ = 4 atan x
Arc arc_at(double frequency, double period) {
  const double x = std::tan(pi * frequency * period / 2);
  return {x, x};
}

// S(ω); the bound holds between the points as well.
Curve needed(const SampledLoop& loop, const MotorConstants& motor) {
  const double period = loop.sample_period, nyquist = 0.5 / period;
  const NeededDamping damping(motor, loop, estimator_factors(loop).value_or(EstimatorFactors{}));
  Curve curve{"needed by motor and hold", Channel::motor, {}, {}};
  for (int i = 0; i < points; ++i) {
    curve.x.push_back(nyquist * std::pow(10, decades * (double(i) / (points - 1) - 1)));
    curve.y.push_back(damping.on(i + 1 == points ? Arc{1, 1} : arc_at(curve.x.back(), period)).at_centre);
  }
  return curve;
}

std::string fact(const std::string& name, const std::string& value, const std::string& unit) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n", name, value, unit);
}

std::string facts(const PassivityBound& bound, const SampledLoop& loop, double brake, const PortUnits& units) {
  const Rational assured = assured_damping(loop, brake);
  const bool holds = bound.proof == Proof::hold;
  std::string html = "<table class=\"facts\"><tbody>\n";
  html += fact("statement", holds ? "any motion, any jitter within the device's" : "any motion, samples in time", "");
  html += fact("damping needed at most", number_text(bound.needed, 6), units.damping);
  if (bound.frequency > 0) html += fact("where it binds", number_text(bound.frequency), "Hz");
  html += fact("damping assured", number_text(assured.convert_to<double>(), 6), units.damping);
  const double missing = missing_damping(bound, loop, brake);
  html += fact("lacking in the brake's command", std::isfinite(missing) ? number_text(missing, 6) : "no command would do", units.damping);
  if (loop.encoder_step > 0)
    html += fact("stiffest spring that friction covers, 2<i>f</i><sub>c</sub>/Δ", number_text(2 * loop.coulomb_friction / loop.encoder_step), units.stiffness);
  return html + fact("passive", assured >= Rational(bound.needed) ? "yes" : "not shown", "") + "</tbody></table>\n";
}

}  // namespace

std::string sampled_margin_html(const Compilation& c) {
  Diagnostics none;  // the device has been taken once already
  const std::optional<PortDevice> port = c.device ? PortDevice::of(*c.device, c.network, none) : PortDevice::ideal();
  const std::optional<MotorConstants> motor = motor_constants(c.law);
  if (!port || !motor) return "";
  const SampledLoop loop = sampled_loop(*port, c.law.sample_period);
  const PassivityBound bound = passivity_bound(motor, loop);
  if (bound.proof == Proof::none || (motor->follows_estimate() && !estimator_factors(loop))) return "";
  const PortUnits units = port_units(c.network.port_motion);
  const double sure = assured_damping(loop, c.law.damping).convert_to<double>();
  Curve curve = needed(loop, *motor);
  const Curve assured{"assured by brake and device", Channel::brake, {curve.x.front(), curve.x.back()}, {sure, sure}};
  const Plot plot{"Damping of the sampled loop", {"frequency", "Hz"}, {"damping", units.damping}, AxisScale::logarithmic,
                  AxisScale::linear, {std::move(curve), assured}, true};
  return "<div>" + facts(bound, loop, c.law.damping, units) + "</div>\n" + plot_figure(plot);
}

}  // namespace dashpot::compiler
