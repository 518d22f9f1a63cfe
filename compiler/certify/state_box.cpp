#include "certify/state_box.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "certify/magnitudes.hpp"

namespace dashpot::compiler {
namespace {

std::vector<double> after_steps(Magnitudes& run, const std::vector<double>& states, int steps) {
  run.set_states(states);
  for (int i = 0; i < steps; ++i) run.step();
  return run.states();
}

// Extrapolates the bounds towards their fixed point, as a geometric series with the pace of each state's slowest input.
std::vector<double> extrapolated(const std::vector<double>& x0, const std::vector<double>& x1,
                                 const std::vector<double>& x2) {
  std::vector<double> limit = x2;
  for (std::size_t i = 0; i < limit.size(); ++i) {
    const double first = x1[i] - x0[i], second = x2[i] - x1[i];
    if (second > 0 && first > second) limit[i] = x0[i] + first / (1 - second / first);
  }
  return limit;
}

bool is_in_box(const std::vector<double>& states, const std::vector<double>& box) {
  return std::equal(states.begin(), states.end(), box.begin(), [](double a, double b) { return a <= b; });
}

// Widens the bounds a little, in the scalar type. States that a step computes from others get their bounds from those
// afterwards.
std::vector<double> widened(Magnitudes& run, const UpdateLaw& law, std::vector<double> states) {
  constexpr double room = 1 + 1e-6;  // of which a step of the slowest mode takes less than its loss, 1e-6 at least
  for (double& value : states) value *= room;
  states = after_steps(run, states, 2);
  for (double& value : states) value = law.scalar == ScalarType::float32 ? double(float(value * room)) : value * room;
  for (int i = 0; i < 2; ++i) {
    const std::vector<double> then = after_steps(run, states, 1);
    for (std::size_t at = 0; at < then.size(); ++at)
      if (then[at] > states[at]) states[at] = law.scalar == ScalarType::float32 ? then[at] : then[at] * (1 + 1e-12);
  }
  return states;
}

Magnitudes anchored(const UpdateLaw& law, const InputRange& range) {
  Magnitudes run(law, range, Detail::choices);
  for (int i = 0; i < 3; ++i) run.step();
  return Magnitudes(law, range, Detail::choices, run.find_anchors());
}

// Limit on all attempts together, in statements: a few seconds. A contact on a limited motor has many cases.
constexpr std::size_t most_effort = 2'500'000;

StateBox named(const std::vector<double>& states, const Anchors& anchors, const UpdateLaw& law) {
  std::map<std::size_t, std::string> names;
  std::size_t at = 0;
  for (const Variable& v : law.variables)
    for (std::size_t place = 0; place < v.size; ++place, ++at)
      if (v.role == Role::state) names[at] = state_name(v, place);
  StateBox box;
  auto value = states.begin();
  for (const auto& [state, name] : names) {
    const double low = 0 - *value++;
    box[name] = {low, *value++};
  }
  for (const Anchored& anchored : anchors)
    for (const Share& share : anchored.shares)
      box[names.at(anchored.at)].others.emplace_back(names.at(share.at), share.factor);
  return box;
}

std::optional<StateBox> box_by(Magnitudes run, const UpdateLaw& law, int rounds, std::size_t& effort) {
  std::vector<double> states = run.states();
  for (int round = 0; round < rounds && effort + run.effort() < most_effort; ++round) {
    states = after_steps(run, states, 4);
    const std::vector<double> next = after_steps(run, states, 1);
    states = extrapolated(states, next, after_steps(run, next, 1));
    const std::vector<double> wide = widened(run, law, states);
    if (!std::all_of(wide.begin(), wide.end(), [](double bound) { return std::isfinite(bound); })) break;
    if (is_in_box(after_steps(run, wide, 1), wide)) return named(wide, run.anchors(), law);
  }
  effort += run.effort();
  return std::nullopt;
}

}  // namespace

std::vector<CarriedError> carried_errors(const UpdateLaw& law) {
  std::vector<CarriedError> all;
  const auto value_of = [&](VariableId target) -> const Expression* {
    for (const Statement& s : law.update)
      if (s.target == target && s.assigns()) return &law.expressions[s.value];
    return nullptr;
  };
  const auto read = [&](ExpressionId id) {
    return law.expressions[id].operation == Operation::read ? law.expressions[id].variable : no_variable;
  };
  for (const Statement& s : law.update) {
    const Expression& kept = law.expressions[s.value];
    if (kept.operation != Operation::flush || read(kept.operands[0]) == no_variable) continue;
    const Expression* next = value_of(read(kept.operands[0]));
    if (!next || next->operation != Operation::add || read(next->operands[0]) != s.target) continue;
    const Expression* added = value_of(read(next->operands[1]));
    if (!added || added->operation != Operation::add || read(added->operands[1]) == no_variable) continue;
    all.push_back({s.target, read(added->operands[1]), read(next->operands[1])});
  }
  return all;
}

std::string state_name(const Variable& state, std::size_t place) {
  return (state.element_names.empty() ? state.name : state.element_names[place]) + "_";
}

InputRange input_range(const PortDevice& port) {
  const encoder_description& encoder = port.description().encoder;
  const double scale = port.at_tool().position_scale();
  const double reach = std::max(std::abs(encoder.range_low), std::abs(encoder.range_high)) * scale;
  const double speed = encoder.max_speed * scale;
  return {reach > 0 ? reach : 10, speed > 0 ? speed : 100};
}

std::optional<StateBox> state_box(const UpdateLaw& law, const InputRange& range) {
  if (law.tunable) return std::nullopt;
  std::size_t effort = 0;
  if (auto box = box_by(Magnitudes(law, range, Detail::none), law, 400, effort)) return box;
  if (law.surface_at)
    if (auto box = box_by(anchored(law, range), law, 60, effort)) return box;
  for (const Detail detail : {Detail::choices, Detail::slips})
    if (auto box = box_by(Magnitudes(law, range, detail), law, 60, effort)) return box;
  return std::nullopt;
}

double sum_of_terms(const UpdateLaw& law, const InputRange& range, const StateBox& box) {
  Magnitudes run(law, range, Detail::none);
  std::vector<double> states;
  for (const Variable& v : law.variables)
    for (std::size_t place = 0; v.role == Role::state && place < v.size; ++place)
      for (const double far : {-box.at(state_name(v, place)).low, box.at(state_name(v, place)).high})
        states.push_back(far);
  run.set_states(states);
  return run.force();
}

}  // namespace dashpot::compiler
