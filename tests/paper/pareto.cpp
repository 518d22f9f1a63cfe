#include "pareto.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "chosen.hpp"
#include "evaluated_law.hpp"
#include "linear/linear_form.hpp"

namespace dashpot::paper {
namespace {

struct NetworkFile {
  const char* title;
  const char* text;
};

constexpr NetworkFile networks[] = {
    {"Fig. 5", R"({ "dashpot": 1, "name": "fig5", "motion": "translation", "network": { "parallel": [
       { "series": [ { "damper": 5 }, { "spring": 12 } ] }, { "series": [ { "damper": 6 }, { "spring": 10 } ] },
       { "spring": 5 } ] } })"},
    {"Fig. 6", R"({ "dashpot": 1, "name": "fig6", "motion": "translation", "network": { "series": [
       { "damper": 5 }, { "spring": 50 } ] } })"}};

// The rig, with a brake that reaches as far as it is asked to: its own end is drawn as a line. The bounds that are
// drawn are those for samples on time; jitter would only add a search for every damping.
compiler::Device rig_with(const velocity_description& velocity, double brake_error) {
  compiler::Device device = rig();
  device.description.velocity = velocity;
  device.description.loop.jitter = 0;
  device.description.brake.max_damping = 1;
  device.description.brake.tolerance = brake_error;
  return device;
}

Split split_of(const char* network, double brake, compiler::StateInput input, const velocity_description& velocity) {
  compiler::Choices choices;
  choices.decomposition = brake;
  choices.state_input = input;
  const compiler::Device device = rig_with(velocity, 0);
  const Compiled judged = compiled(network, choices, device);
  const compiler::Candidate& candidate = judged->decomposition.choice();
  choices.rate = 1 / device.description.loop.sample_period;
  const Compiled law = compiled(network, choices);  // without what a certificate would add
  const auto motor = compiler::motor_constants(law->law);
  Split split{brake, candidate.motor_noise.value_or(0), candidate.largest_error, {}};
  for (std::size_t i = 0; i < brake_errors.size(); ++i) {
    const compiler::SampledLoop loop = loop_around(law, rig_with(velocity, brake_errors[i]));
    split.missing[i] = compiler::missing_damping(compiler::passivity_bound(motor, loop), loop, brake);
  }
  return split;
}

Pareto::Sweep sweep_of(const NetworkFile& network, compiler::StateInput input, const NamedEstimator& estimator) {
  const double viscosity = compiled(network.text, {})->decomposition.candidates[1].damping;  // zero-frequency
  Pareto::Sweep sweep{network.title, estimator, std::string(name_of(input)), viscosity, {}};
  const double steps = chosen("pareto.steps"), reach = chosen("pareto.reach") * viscosity;  // b from 0
  for (double i = 0; i <= steps; ++i)
    sweep.splits.push_back(split_of(network.text, reach * i / steps, input, estimator.velocity));
  return sweep;
}

// Velocity driven, then position driven.
constexpr Style of_estimator[][3] = {{{"#7f7f7f", 1.8}, {"#c1440e", 1.8}, {"#0b5fa5", 1.4}},
                                     {{"#7f7f7f", 1.8, "2 2"}, {"#c1440e", 1.8, "2 2"}, {"#0b5fa5", 1.4, "2 2"}}};

template <class Value>
std::vector<Curve> curves_of(const Pareto& pareto, const char* network, Value value) {
  std::vector<Curve> curves;
  for (const Pareto::Sweep& sweep : pareto.sweeps) {
    if (sweep.network != network) continue;
    const bool by_position = sweep.state_input == "position";
    const std::string name = by_position ? "" : sweep.estimator.name;
    Curve curve{name, of_estimator[by_position][curves.size() % 3], {}, {}, Maker::analysis};
    for (const Split& split : sweep.splits) {
      curve.x.push_back(split.brake);
      curve.y.push_back(value(split));
    }
    curves.push_back(curve);
  }
  return curves;
}

// Where the rig's brake ends, and half of Z_d(0).
std::vector<Curve> with_marks(std::vector<Curve> curves, double viscosity) {
  double top = 0;
  for (const Curve& curve : curves) top = std::max(top, *std::max_element(curve.y.begin(), curve.y.end()));
  const double reach =
      rig().description.brake.max_damping / (rig().description.arm_radius * rig().description.arm_radius);
  curves.push_back({fmt::format("the rig’s brake ends, {:.2g} N·s/m", reach),
                    {"#2f8f5b", 1.2, "6 3"},
                    {reach, reach},
                    {0, top},
                    Maker::mark});
  curves.push_back({"½ Z_d(0)", bound, {viscosity / 2, viscosity / 2}, {0, top}, Maker::mark});
  return curves;
}

Figure figure_of(const Pareto& pareto, const char* network) {
  double viscosity = 0;
  for (const Pareto::Sweep& sweep : pareto.sweeps)
    if (sweep.network == network) viscosity = sweep.viscosity;
  const char* b = "damping b of the brake [N·s/m]";
  const auto panel = [&](const char* title, const char* label, auto value) {
    return Panel{title, b, label, with_marks(curves_of(pareto, network, value), viscosity)};
  };
  return {fmt::format("Decompositions of {}’s network on the rig", network),
          {"Solid: states driven by the velocity; dotted: by the position.",
           "Extra damping: beyond (1 − ε) b and the arm’s own."},
          {panel("Extra damping, exact brake", "damping [N·s/m]", [](const Split& s) { return s.missing[0]; }),
           panel("Extra damping, brake 5 % short", "damping [N·s/m]", [](const Split& s) { return s.missing[2]; }),
           panel("Motor’s noise", "force, rms [mN]", [](const Split& s) { return s.noise * 1e3; }),
           panel("Largest error, 0.1 to 30 Hz", "error [%]", [](const Split& s) { return s.error * 100; })}};
}

Table winners(const Pareto& pareto) {
  Table table{
      "The b that needs least extra damping; of equals, the one of least error",
      {"network", "states by", "estimator", "brake error [%]", "b [N·s/m]", "extra [N·s/m]", "noise [mN]", "error [%]"},
      {}};
  for (const Pareto::Sweep& sweep : pareto.sweeps)
    for (std::size_t i = 0; i < brake_errors.size(); ++i) {
      const Split& best = sweep.best(i);
      table.rows.push_back({sweep.network, sweep.state_input, sweep.estimator.name,
                            fmt::format("{}", 100 * brake_errors[i]), fmt::format("{:.2f}", best.brake),
                            fmt::format("{:.4f}", best.missing[i]), fmt::format("{:.3g}", best.noise * 1e3),
                            fmt::format("{:.3g}", 100 * best.error)});
    }
  return table;
}

const Pareto::Sweep& sweep(const Pareto& pareto, const char* network, const char* state_input, std::size_t estimator) {
  std::size_t seen = 0;
  for (const Pareto::Sweep& each : pareto.sweeps)
    if (each.network == network && each.state_input == state_input && seen++ == estimator) return each;
  throw std::out_of_range(network);
}

// Whether b = 0 is the best of every sweep that position drives.
bool is_won_without_brake(const Pareto& pareto) {
  for (const Pareto::Sweep& each : pareto.sweeps)
    for (std::size_t i = 0; i < brake_errors.size() && each.state_input == "position"; ++i)
      if (each.best(i).brake != 0) return false;
  return true;
}

// The least b that needs nothing beside an exact brake; none where every b does.
std::optional<double> first_passive(const Pareto::Sweep& sweep) {
  for (const Split& split : sweep.splits)
    if (split.missing[0] == 0) return split.brake;
  return std::nullopt;
}

bool rises(const Pareto& pareto, double Split::*value) {
  for (const Pareto::Sweep& each : pareto.sweeps)
    if (each.state_input == "velocity" && each.splits.front().*value >= each.splits.back().*value) return false;
  return true;
}

std::string within_reach(const Pareto::Sweep& sweep) {
  const double half = sweep.viscosity / 2, reach = rig().description.brake.max_damping /
                                                   (rig().description.arm_radius * rig().description.arm_radius);
  if (half <= reach)
    return fmt::format("{}’s element, ½ Z_d(0) = {:.2g} N·s/m, is within the reach of the rig’s brake, {:.2g} N·s/m.",
                       sweep.network, half, reach);
  return fmt::format(
      "The rig’s brake of {:.2g} N·s/m is below ½ Z_d(0) = {:.2g} N·s/m of {}: on that rig its network "
      "cannot be rendered in the paper’s form with a passivity that holds for any delay, however good the "
      "brake.",
      reach, half, sweep.network);
}

std::vector<std::string> words_of(const Pareto& pareto) {
  const Pareto::Sweep &fig5 = sweep(pareto, "Fig. 5", "velocity", 1), &fig6 = sweep(pareto, "Fig. 6", "velocity", 1),
                      &prompt = sweep(pareto, "Fig. 5", "velocity", 0),
                      &window = sweep(pareto, "Fig. 5", "velocity", 2);
  const std::optional<double> first = first_passive(fig5);
  const bool is_won = is_won_without_brake(pareto),
             needs_none = prompt.splits[0].missing[0] == 0 && window.splits[0].missing[0] == 0;
  return {
      fmt::format("Neither network has a damper at its feedthrough, so that position drives all of it without any "
                  "estimate. b = 0 {} for every estimator and every error of the brake. The paper drives the states by "
                  "the velocity, (17).",
                  is_won ? "then needs least, and wins" : "does not win even then"),
      fmt::format(
          "Driven by the velocity there is no one winner. With the paper’s filter and an exact brake {} for Fig. "
          "5, where the theorem of half the viscosity has {:.2g} for any delay; with a brake that is 2 or 5 % "
          "short the best b is {:.2g} and {:.2g} N·s/m. With a difference over 1 or 15 samples b = 0 {} for Fig. "
          "5. Noise and error {} with b.",
          first ? fmt::format("b from {:.2g} N·s/m on needs nothing beside it", *first)
                : "every b needs further damping",
          fig5.viscosity / 2, fig5.best(1).brake, fig5.best(2).brake, needs_none ? "needs nothing" : "needs damping",
          rises(pareto, &Split::noise) && rises(pareto, &Split::error) ? "grow" : "do not always grow"),
      within_reach(fig5) + " " + within_reach(fig6)};
}

}  // namespace

const Split& Pareto::Sweep::best(std::size_t brake_error) const {
  return *std::min_element(splits.begin(), splits.end(), [&](const Split& a, const Split& b) {
    return a.missing[brake_error] != b.missing[brake_error] ? a.missing[brake_error] < b.missing[brake_error]
                                                            : a.error < b.error;
  });
}

Pareto measure_pareto() {
  const std::vector<NamedEstimator> estimators = compared_estimators();
  Pareto pareto;
  for (const NetworkFile& network : networks)
    for (const auto input : {compiler::StateInput::velocity, compiler::StateInput::position})
      for (const std::size_t i : {0U, 1U, 3U}) pareto.sweeps.push_back(sweep_of(network, input, estimators[i]));
  return pareto;
}

const Pareto& measured_pareto() {
  static const Pareto measured = measure_pareto();
  return measured;
}

Section show(const Pareto& pareto) {
  return {"pareto",
          "Pareto: what every split costs",
          words_of(pareto),
          {figure_of(pareto, "Fig. 5"), figure_of(pareto, "Fig. 6")},
          {winners(pareto)}};
}

}  // namespace dashpot::paper
