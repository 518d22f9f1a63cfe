#include "report/linear_responses.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "report/number_text.hpp"
#include "report/plot.hpp"

namespace dashpot::compiler {
namespace {

using std::numbers::pi;
constexpr int points = 160;

std::vector<double> logarithmic(const Interval& range) {
  std::vector<double> values;
  for (int i = 0; i < points; ++i)
    values.push_back(range.low * std::pow(range.high / range.low, double(i) / (points - 1)));
  return values;
}

template <class Function>
Curve curve(const std::string& name, const std::vector<double>& x, Function f, bool dashed = false) {
  Curve result{name, Channel::closed_form, x, {}, dashed};
  for (const double value : x) result.y.push_back(f(value));
  return result;
}

Interval times_around(const std::vector<double>& rates, const Interval& otherwise) {
  if (rates.empty()) return {0.1 / (2 * pi * otherwise.high), 10 / (2 * pi * otherwise.low)};
  return {0.01 / rates.back(), 10 / rates.front()};
}

// f(t)/ε = k0 + Σ k_i e^{−λ_i t}, t > 0
Plot relaxation(const LinearForm& form, const PortUnits& units) {
  std::vector<double> rates;
  for (const Mode& mode : form.modes) rates.push_back(to_double(mode.relaxation_rate));
  const auto modulus = [&](double t) {
    double force = to_double(form.static_stiffness);
    for (const Mode& mode : form.modes)
      force += to_double(mode.stiffness) * std::exp(-to_double(mode.relaxation_rate) * t);
    return force;
  };
  Plot plot{"Relaxation: force after a unit step",
            {"time", "s"},
            {"force per step", units.stiffness},
            AxisScale::logarithmic,
            AxisScale::linear,
            {curve("", logarithmic(times_around(rates, frequencies_of_interest(form))), modulus)},
            true};
  if (form.feedthrough_damping > 0)
    plot.note = fmt::format("An impulse of {} {} at t = 0 is not drawn.",
                            number_text(to_double(form.feedthrough_damping)), units.damping);
  return plot;
}

// u(t)/f = 1/k_g + t/b_g + Σ (1 − e^{−K_i t/B_i})/K_i, t > 0
Plot creep(const LinearForm& form, const PortUnits& units) {
  const KelvinForm kelvin = kelvin_form(form);
  std::vector<double> rates;
  for (const KelvinElement& e : kelvin.elements) rates.push_back(to_double(e.stiffness / e.damping));
  const auto compliance = [&](double t) {
    double displacement = to_double(kelvin.glass_compliance) + t * to_double(kelvin.fluidity);
    for (const KelvinElement& e : kelvin.elements)
      displacement -= std::expm1(-to_double(e.stiffness / e.damping) * t) / to_double(e.stiffness);
    return displacement;
  };
  Plot plot{"Creep: displacement under a unit force",
            {"time", "s"},
            {"displacement per force", units.compliance},
            AxisScale::logarithmic,
            AxisScale::linear,
            {curve("", logarithmic(times_around(rates, frequencies_of_interest(form))), compliance)},
            true};
  if (kelvin.fluidity > 0)
    plot.note = fmt::format("It flows on at {} {} for each {}.", number_text(to_double(kelvin.fluidity)),
                            units.velocity, units.force);
  return plot;
}

std::complex<double> stiffness_at(const LinearForm& form, double frequency) {
  const ComplexReal d = dynamic_stiffness(form, Real(2 * pi * frequency));
  return {to_double(d.real), to_double(d.imaginary)};
}

Plot moduli(const LinearForm& form, const PortUnits& units, const std::vector<double>& frequencies) {
  return {"Storage and loss modulus",
          {"frequency", "Hz"},
          {"modulus", units.stiffness},
          AxisScale::logarithmic,
          AxisScale::logarithmic,
          {curve("storage, Re D(jω)", frequencies, [&](double f) { return stiffness_at(form, f).real(); }),
           curve(
               "loss, Im D(jω)", frequencies, [&](double f) { return stiffness_at(form, f).imag(); }, true)}};
}

Plot loss_tangent(const LinearForm& form, const std::vector<double>& frequencies) {
  const auto tangent = [&](double f) {
    const std::complex<double> d = stiffness_at(form, f);
    return d.imag() / d.real();
  };
  const bool stores = form.static_stiffness > 0;
  return {"Loss tangent",
          {"frequency", "Hz"},
          {"loss / storage", "1"},
          AxisScale::logarithmic,
          stores && form.feedthrough_damping == 0 ? AxisScale::linear : AxisScale::logarithmic,
          {curve("", frequencies, tangent)},
          stores && form.feedthrough_damping == 0};
}

}  // namespace

Interval frequencies_of_interest(const LinearForm& form) {
  if (!form.modes.empty())
    return {to_double(form.modes.front().relaxation_rate) / (200 * pi),
            to_double(form.modes.back().relaxation_rate) * 50 / pi};
  const bool is_kelvin = form.static_stiffness > 0 && form.feedthrough_damping > 0;
  const double corner = is_kelvin ? to_double(form.static_stiffness / form.feedthrough_damping) / (2 * pi) : 1;
  return {corner / 100, corner * 100};
}

std::string linear_responses_html(const Compilation& c) {
  const LinearForm& form = c.form.linear;
  const PortUnits units = dotted_units(c.network.port_motion);
  const std::vector<double> frequencies = logarithmic(frequencies_of_interest(form));
  return plot_figure(relaxation(form, units)) + plot_figure(creep(form, units)) +
         plot_figure(moduli(form, units, frequencies)) + plot_figure(loss_tangent(form, frequencies));
}

}  // namespace dashpot::compiler
