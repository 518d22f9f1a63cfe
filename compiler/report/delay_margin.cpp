#include "report/delay_margin.hpp"

#include <cmath>
#include <numbers>

#include "decompose/spectrum.hpp"
#include "report/linear_responses.hpp"
#include "report/number_text.hpp"
#include "report/plot.hpp"

namespace dashpot::compiler {
namespace {

using std::numbers::pi;
constexpr int delay_points = 200;

double tolerance_of(const Compilation& c) { return c.device ? c.device->description.brake.tolerance : 0; }

// (1 − ε) b + Re position driven − |velocity driven|
Curve margin(const Compilation& c, const Candidate& candidate, const std::string& name, bool dashed) {
  const LinearForm& form = candidate.state_input == StateInput::nodal ? c.decomposition.realisation : c.form.linear;
  const Interval range = frequencies_of_interest(c.form.linear);
  Curve curve{name, dashed ? Channel::motor : Channel::total, {}, {}, dashed};
  for (int i = 0; i < delay_points; ++i) {
    const double frequency = range.low * std::pow(range.high / range.low, double(i) / (delay_points - 1));
    const MotorImpedance motor = motor_impedance(form, candidate.damping, candidate.state_input, 2 * pi * frequency);
    curve.x.push_back(frequency);
    curve.y.push_back((1 - tolerance_of(c)) * candidate.damping + motor.position_driven.real() -
                      std::abs(motor.velocity_driven));
  }
  return curve;
}

}  // namespace

std::string delay_margin_html(const Compilation& c) {
  const Candidate& choice = c.decomposition.choice();
  const PortUnits units = dotted_units(c.network.port_motion);
  Plot plot{"Damping left under any delay of the estimate",
            {"frequency", "Hz"},
            {"margin", units.damping},
            AxisScale::logarithmic,
            AxisScale::linear,
            {margin(c, choice, choice.name, false)},
            true};
  for (const Candidate& candidate : c.decomposition.candidates)
    if (candidate.name == "virtual" && choice.name != "virtual")
      plot.curves.push_back(margin(c, candidate, "virtual (no brake)", true));
  plot.note = "Below zero some delay, or some averaging of the velocity, makes the viscous part of the motor active.";
  return plot_figure(plot);
}

}  // namespace dashpot::compiler
