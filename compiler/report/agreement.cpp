#include "report/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "emit/banner.hpp"
#include "report/law_run.hpp"
#include "report/number_text.hpp"
#include "report/plot.hpp"

namespace dashpot::compiler {
namespace {

constexpr double agreement_samples = 50'000;
constexpr std::size_t agreement_points = 200;
constexpr std::size_t agreement_dots = 36;

// Presses at `rate` for `samples` samples, then holds.
struct RampAndHold {
  double period;        // [s]
  std::size_t samples;  // of the ramp
  double rate;          // [m/s] or [rad/s]

  double length() const { return double(samples) * period; }
  double position(double t) const { return rate * std::min(t, length()); }
  double velocity(double t) const { return t > 0 && t <= length() ? rate : 0; }  // left limits, as of the closed form
};

// Long enough for the relaxations, in the geometric mean of their times.
RampAndHold motion_for(const Compilation& c) {
  double time = 0.1;  // [s]
  if (!c.form.linear.modes.empty()) {
    double logarithms = 0;
    for (const Mode& mode : c.form.linear.modes) logarithms -= std::log(to_double(mode.relaxation_rate));
    time = std::exp(logarithms / double(c.form.linear.modes.size()));
  }
  const double samples = std::clamp(std::round(2 * time / c.law.sample_period), 20.0, agreement_samples / 4);
  const double depth = c.network.port_motion == motion::rotation ? 0.1 : 0.001;
  return {c.law.sample_period, static_cast<std::size_t>(samples), depth / (samples * c.law.sample_period)};
}

// f(t) = r [k0 t + b∞ + Σ B_i (1 − e^{−λ_i t})], t ≤ t_r; then r [k0 t_r + Σ B_i (e^{−λ_i (t − t_r)} − e^{−λ_i t})].
Real closed_form(const LinearForm& form, double added_damping, const RampAndHold& press, double time) {
  if (time == 0) return 0;  // the left limit: at rest
  const Real t = time, ramp = press.length();
  const bool presses = time <= press.length();
  const Real damping = presses ? Real(form.feedthrough_damping + added_damping) : Real(0);
  Real force = form.static_stiffness * (presses ? t : ramp) + damping;
  for (const Mode& mode : form.modes) {
    const Real late = exp(-mode.relaxation_rate * t);
    const Real early = presses ? Real(1) : exp(-mode.relaxation_rate * (t - ramp));
    force += mode.damping() * (early - late);
  }
  return force * press.rate;
}

struct Comparison {
  LawRun run;
  std::vector<std::size_t> shown;          // samples that are compared
  std::vector<double> closed, difference;  // at those
  double peak = 0, largest = 0;

  double relative() const { return peak > 0 ? largest / peak : 0; }
};

Comparison compare(const Compilation& c, const RampAndHold& press) {
  Comparison result;
  const std::size_t count = 4 * press.samples;
  result.run = run_law(
      c.law, count, [&](double t) { return press.position(t); }, [&](double t) { return press.velocity(t); });
  for (std::size_t i = 0; i <= agreement_points; ++i) {
    const std::size_t sample = i * count / agreement_points;
    if (!result.shown.empty() && sample == result.shown.back()) continue;
    const Real closed = closed_form(c.form.linear, c.certificate.added_damping, press, result.run.time[sample]);
    result.shown.push_back(sample);
    result.closed.push_back(to_double(closed));
    result.difference.push_back(to_double(Real(result.run.force(sample)) - closed));
    result.peak = std::max(result.peak, std::abs(result.closed.back()));
    result.largest = std::max(result.largest, std::abs(result.difference.back()));
  }
  return result;
}

Curve of_samples(const std::string& name, Channel channel, const Comparison& c, const std::vector<double>& values,
                 std::size_t stride) {
  Curve curve{name, channel, {}, {}};
  for (std::size_t i = 0; i < c.shown.size(); i += stride) {
    curve.x.push_back(c.run.time[c.shown[i]]);
    curve.y.push_back(values[i]);
  }
  return curve;
}

std::vector<double> at_shown(const Comparison& c, const std::vector<double>& all) {
  std::vector<double> values;
  for (const std::size_t sample : c.shown) values.push_back(all[sample]);
  return values;
}

Plot forces(const Comparison& c, const PortUnits& units) {
  std::vector<double> total;
  for (const std::size_t sample : c.shown) total.push_back(c.run.force(sample));
  Curve dots =
      of_samples("emitted code", Channel::total, c, total, std::max<std::size_t>(1, c.shown.size() / agreement_dots));
  dots.dots = true;
  return {"Press and hold",
          {"time", "s"},
          {"force", units.force},
          AxisScale::linear,
          AxisScale::linear,
          {of_samples("brake b·v̂", Channel::brake, c, at_shown(c, c.run.brake), 1),
           of_samples("motor m", Channel::motor, c, at_shown(c, c.run.motor), 1),
           of_samples("closed form", Channel::closed_form, c, c.closed, 1), dots},
          true};
}

Plot difference(const Comparison& c) {
  std::vector<double> relative;
  for (const double value : c.difference) relative.push_back(c.peak > 0 ? value / c.peak : 0);
  Curve dots = of_samples("", Channel::total, c, relative, 1);
  dots.dots = true;
  return {"Emitted code − closed form",
          {"time", "s"},
          {"difference / peak", "1"},
          AxisScale::linear,
          AxisScale::linear,
          {dots},
          true};
}

}  // namespace

std::string agreement_html(const Compilation& c) {
  const PortUnits units = dotted_units(c.network.port_motion);
  const RampAndHold press = motion_for(c);
  const Comparison comparison = compare(c, press);
  const bool is_exact = c.law.scheme == Scheme::exact && !mixes_schemes(c.law);
  const char* scheme = is_exact ? "The scheme is exact for this motion: what is left is rounding."
                                : "Backward Euler errs by the order of the period.";
  return fmt::format(
             "<p>The law's statements, run in the order of the emitted code, against the network's closed form: {} {} "
             "in {} s, then held, at {} Hz. {} The largest difference is <b>{}</b> of the peak of {} {}.</p>\n"
             "<div class=\"figures\">\n",
             number_text(press.rate * press.length()), units.position, number_text(press.length()),
             number_text(c.rate, 6), scheme, number_text(comparison.relative(), 2), number_text(comparison.peak),
             units.force) +
         plot_figure(forces(comparison, units)) + plot_figure(difference(comparison)) + "</div>\n";
}

}  // namespace dashpot::compiler
