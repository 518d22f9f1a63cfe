#include "report/hysteresis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/law_run.hpp"
#include "report/linear_responses.hpp"
#include "report/number_text.hpp"
#include "report/plot.hpp"

namespace dashpot::compiler {
namespace {

using std::numbers::pi;
constexpr std::size_t cycles = 3;                             // the last one is drawn
constexpr double least_samples = 40, most_samples = 100'000;  // a cycle
constexpr std::size_t drawn_points = 180, drawn_dots = 30;

struct Oscillation {
  double amplitude;     // [m] or [rad]
  std::size_t samples;  // a cycle
  double frequency;     // [Hz]
  double centre;        // [m] or [rad]

  double angular() const { return 2 * pi * frequency; }
  double position(double t) const { return centre + amplitude * std::sin(angular() * t); }
  double velocity(double t) const { return amplitude * angular() * std::cos(angular() * t); }
};

Oscillation oscillation(const Compilation& c, double amplitude, double frequency) {
  const double samples = std::round(std::clamp(c.rate / frequency, least_samples, most_samples));
  return {amplitude, static_cast<std::size_t>(samples), c.rate / samples, c.network.surface()};
}

LawRun run(const Compilation& c, const Oscillation& motion, std::size_t cycle_count = cycles) {
  return run_law(
      c.law, cycle_count * motion.samples, [&](double t) { return motion.position(t); },
      [&](double t) { return motion.velocity(t); });
}

// The last cycle, closed.
template <class ValueAt>
Curve loop(const std::string& name, Channel channel, const Oscillation& motion, const LawRun& run, std::size_t points,
           ValueAt value) {
  Curve curve{name, channel, {}, {}};
  const std::size_t first = (cycles - 1) * motion.samples;
  for (std::size_t i = 0; i <= points; ++i) {
    const std::size_t sample = first + i * motion.samples / points;
    curve.x.push_back(run.position[sample]);
    curve.y.push_back(value(sample));
  }
  return curve;
}

// u = A sin ωt around 0, from rest: k0 u + b∞ u̇ + Σ k_i A ω (λ cos ωt + ω sin ωt − λ e^{−λt})/(λ² + ω²)
double closed_form(const LinearForm& form, double added_damping, const Oscillation& motion, double t) {
  const double w = motion.angular();
  const double damping = to_double(form.feedthrough_damping) + added_damping;
  double force = to_double(form.static_stiffness) * motion.position(t) + damping * motion.velocity(t);
  for (const Mode& mode : form.modes) {
    const double rate = to_double(mode.relaxation_rate), ratio = w / rate;
    force += to_double(mode.stiffness) * motion.amplitude * ratio *
             (std::cos(w * t) + ratio * std::sin(w * t) - std::exp(-rate * t)) / (1 + ratio * ratio);
  }
  return force;
}

double default_amplitude(const Network& network) {
  double reach = 0;
  for (const Network& port : network.ports) reach = std::max(reach, default_amplitude(port));
  if (reach > 0) return reach;
  if (const auto& range = network.valid.displacement) return std::max(std::abs(range->low), std::abs(range->high));
  return network.port_motion == motion::rotation ? 0.1 : 0.001;
}

Plot empty_plot(const std::string& title, const PortUnits& units) {
  return {title, {"displacement", units.position}, {"force", units.force}, AxisScale::linear, AxisScale::linear, {},
          true};
}

void add_shares(const Oscillation& motion, const LawRun& all, Plot& plot) {
  const auto brake = [&](std::size_t k) { return all.brake[k]; };
  const auto motor = [&](std::size_t k) { return all.motor[k]; };
  plot.curves.push_back(loop("brake b·v̂", Channel::brake, motion, all, drawn_points, brake));
  plot.curves.push_back(loop("motor m", Channel::motor, motion, all, drawn_points, motor));
}

Curve total(const std::string& name, const Oscillation& motion, const LawRun& all, std::size_t points) {
  return loop(name, Channel::total, motion, all, points, [&](std::size_t k) { return all.force(k); });
}

// The frequency, or the nearest that the network is valid for, at which a motion of this size is no faster than that
// either.
double within_valid(const Network& network, double amplitude, double frequency) {
  if (const auto& band = network.valid.frequency) frequency = std::clamp(frequency, band->low, band->high);
  const auto& rate = network.valid.rate;
  const double fastest = rate ? std::max(std::abs(rate->low), std::abs(rate->high)) : 0;
  return fastest > 0 ? std::min(frequency, fastest / (2 * pi * amplitude)) : frequency;
}

// In the geometric middle of what the network does, but slow enough for the loop and for what the network is valid for.
std::string linear_loop(const Compilation& c) {
  const Interval range = frequencies_of_interest(c.form.linear);
  const double amplitude = default_amplitude(c.network);
  const double frequency = within_valid(c.network, amplitude, std::sqrt(range.low * range.high));
  const Oscillation motion = oscillation(c, amplitude, frequency);
  const LawRun all = run(c, motion);
  const PortUnits units = dotted_units(c.network.port_motion);
  Plot plot = empty_plot("Hysteresis at " + number_text(motion.frequency, 3) + " Hz", units);
  const double added = c.certificate.added_damping;
  const auto closed = [&](std::size_t k) { return closed_form(c.form.linear, added, motion, all.time[k]); };
  plot.curves.push_back(loop("closed form", Channel::closed_form, motion, all, drawn_points, closed));
  add_shares(motion, all, plot);
  plot.curves.push_back(total("emitted code", motion, all, drawn_dots));
  plot.curves.back().dots = true;
  return plot_figure(plot);
}

// |f|max/A: falls where slips yield.
double secant_stiffness(const Compilation& c, double amplitude, double frequency) {
  const LawRun all = run(c, oscillation(c, amplitude, frequency), 1);
  double largest = 0;
  for (std::size_t k = 0; k < all.time.size(); ++k) largest = std::max(largest, std::abs(all.force(k)));
  return largest / amplitude;
}

// The least amplitude, in steps of a third of a decade, at which a quarter of the stiffness is gone.
double yielding_amplitude(const Compilation& c, double frequency) {
  const double usual = default_amplitude(c.network), first = usual * 1e-4, held = secant_stiffness(c, first, frequency);
  for (double amplitude = first; amplitude <= usual * 1e4; amplitude *= std::pow(10, 1.0 / 3))
    if (secant_stiffness(c, amplitude, frequency) < 0.75 * held) return amplitude;
  return usual;
}

double usual_frequency(const Compilation& c) {
  if (const auto& band = c.network.valid.frequency; band && band->low > 0) return std::sqrt(band->low * band->high);
  return 1;
}

std::string three_loops(const Compilation& c, double middle) {
  constexpr double smallest = 0.5, largest = 2;
  const double frequency = within_valid(c.network, largest * middle, usual_frequency(c));
  const PortUnits units = dotted_units(c.network.port_motion);
  Plot plot = empty_plot("", units);
  for (const double size : {smallest, 1.0, largest}) {
    const Oscillation motion = oscillation(c, size * middle, frequency);
    const LawRun all = run(c, motion);
    plot.title = "Hysteresis at " + number_text(motion.frequency, 3) + " Hz, three amplitudes";
    if (size == largest) add_shares(motion, all, plot);
    plot.curves.push_back(total(size == largest ? "force" : "", motion, all, drawn_points));
  }
  plot.note = "Shares of brake and motor in the largest loop.";
  return plot_figure(plot);
}

}  // namespace

double telling_amplitude(const Compilation& c) {
  return c.form.has_slips() ? yielding_amplitude(c, usual_frequency(c)) : default_amplitude(c.network);
}

std::string hysteresis_html(const Compilation& c, double amplitude) {
  if (c.network.map || !c.ports.empty())
    return three_loops(c, amplitude / 2);  // the largest as far as the curve is stated
  return c.form.has_slips() || c.network.contact ? three_loops(c, amplitude) : linear_loop(c);
}

}  // namespace dashpot::compiler
