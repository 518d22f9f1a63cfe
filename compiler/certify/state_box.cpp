#include "certify/state_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "discretise/rounding.hpp"

namespace dashpot::compiler {
namespace {

// Σ c_i x_i over the states and inputs at the beginning of a step, and a rest of which the magnitude alone is known:
// roundings, and what a slip or a contact decides.
struct Affine {
  std::map<std::size_t, double> shares;
  double rest = 0;
};

// What every variable is in terms of the step's beginning, and how large that can be.
class Magnitudes {
 public:
  Magnitudes(const UpdateLaw& law, const InputRange& range) : law_(law), roundoff_(unit_roundoff(law.scalar)) {
    for (const Variable& v : law.variables) {
      starts_.push_back(bounds_.size());
      for (std::size_t place = 0; place < v.size; ++place)
        bounds_.push_back(v.role == Role::state ? std::abs(v.rest_value) : 0.0);
    }
    bounds_[first(law.position)] = range.position;
    bounds_[first(law.velocity)] = range.velocity;
  }

  void step() {
    begin();
    for (const std::vector<Statement>* program : {&law_.output, &law_.keep, &law_.update}) run(*program);
    std::vector<double> then = bounds_;
    for_each_state([&](std::size_t at) { then[at] = magnitude(values_[at]); });
    bounds_ = then;
  }

  double force() {
    begin();
    run(law_.output);
    return magnitude(values_[first(law_.force)]);
  }

  std::vector<double> states() const {
    std::vector<double> flat;
    for_each_state([&](std::size_t at) { flat.push_back(bounds_[at]); });
    return flat;
  }

  void set_states(const std::vector<double>& flat) {
    auto next = flat.begin();
    for_each_state([&](std::size_t at) { bounds_[at] = *next++; });
  }

 private:
  template <class Action>
  void for_each_state(Action action) const {
    for (const Variable& v : law_.variables)
      for (std::size_t place = 0; v.role == Role::state && place < v.size; ++place)
        action(first(law_.variables.id_of(v)) + place);
  }

  void begin() {
    values_.assign(bounds_.size(), {});
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i].shares[i] = 1;
  }

  void run(const std::vector<Statement>& program) {
    for (const Statement& s : program)
      for (std::size_t place = 0; place < law_.variables[s.target].size; ++place)
        values_[first(s.target) + place] = of(s.value, place);
  }

  double magnitude(const Affine& value) const {
    double sum = value.rest;
    for (const auto& [at, share] : value.shares) sum += std::abs(share) * bounds_[at];
    return sum;
  }

  Affine sum(const Affine& a, const Affine& b, double sign) const {
    Affine all = a;
    for (const auto& [at, share] : b.shares) all.shares[at] += sign * share;
    all.rest += b.rest;
    all.rest += roundoff_ * magnitude(all);
    return all;
  }

  Affine scaled(const Affine& a, double factor) const {
    Affine all = a;
    for (auto& [at, share] : all.shares) share *= factor;
    all.rest *= std::abs(factor);
    all.rest += roundoff_ * magnitude(all);
    return all;
  }

  static double largest(const std::vector<double>& table) {
    double most = 0;
    for (const double value : table) most = std::max(most, std::abs(value));
    return most;
  }

  Affine product(ExpressionId left, ExpressionId right, std::size_t place) const {
    const Expression& factor = law_.expressions[left];
    if (factor.operation != Operation::constant) return {{}, magnitude(of(left, place)) * magnitude(of(right, place))};
    const std::vector<double>& values = law_.coefficients[factor.coefficient].values;
    return scaled(of(right, place), values[values.size() == 1 ? 0 : place]);
  }

  Affine of(ExpressionId id, std::size_t place) const {
    const Expression& e = law_.expressions[id];
    const auto part = [&](std::size_t i) { return of(e.operands[i], place); };
    const auto size = [&](std::size_t i) { return magnitude(part(i)); };
    const auto at = [&](const std::vector<double>& values) { return values[values.size() == 1 ? 0 : place]; };
    switch (e.operation) {
      case Operation::read: return values_[first(e.variable) + (law_.variables[e.variable].size == 1 ? 0 : place)];
      case Operation::constant: return {{}, std::abs(at(law_.coefficients[e.coefficient].values))};
      case Operation::add: return sum(part(0), part(1), 1);
      case Operation::subtract: return sum(part(0), part(1), -1);
      case Operation::multiply: return product(e.operands[0], e.operands[1], place);
      case Operation::divide: return {{}, std::numeric_limits<double>::infinity()};  // nothing bounds a quotient
      case Operation::flush: return part(0);
      case Operation::clamp: return {{}, std::min(size(0), size(1))};
      case Operation::where: return {{}, std::max(size(1), size(2))};
      case Operation::relax: return sum(part(2), product(e.operands[0], e.operands[1], place), 1);
      case Operation::pick: return {{}, largest(law_.coefficients[e.coefficient].values)};
      case Operation::sum: break;
    }
    Affine all;
    for (std::size_t i = 0; i < law_.variables[e.variable].size; ++i) all = sum(all, values_[first(e.variable) + i], 1);
    return all;
  }

  std::size_t first(VariableId id) const { return starts_[id.place()]; }

  const UpdateLaw& law_;
  double roundoff_;
  std::vector<std::size_t> starts_;  // place of each variable in the lists below
  std::vector<double> bounds_;
  std::vector<Affine> values_;
};

std::vector<double> after_steps(Magnitudes& run, const std::vector<double>& states, int steps) {
  run.set_states(states);
  for (int i = 0; i < steps; ++i) run.step();
  return run.states();
}

// Magnitudes grow by a geometric series towards the fixed point, each state at the pace of the slowest that feeds it.
std::vector<double> extrapolated(const std::vector<double>& x0, const std::vector<double>& x1,
                                 const std::vector<double>& x2) {
  std::vector<double> limit = x2;
  for (std::size_t i = 0; i < limit.size(); ++i) {
    const double first = x1[i] - x0[i], second = x2[i] - x1[i];
    if (second > 0 && first > second) limit[i] = x0[i] + first / (1 - second / first);
  }
  return limit;
}

}  // namespace

std::string state_name(const Variable& state, std::size_t place) {
  return (state.element_names.empty() ? state.name : state.element_names[place]) + "_";
}

InputRange input_range(const PortDevice& port) {
  const InputRange range = {10, 100};
  if (port.is_ideal()) return range;
  const encoder_description& encoder = port.description().encoder;
  const double reach = std::max(std::abs(encoder.range_low), std::abs(encoder.range_high)) * port.position_scale();
  const double speed = encoder.max_speed * port.position_scale();
  return {reach > 0 ? reach : range.position, speed > 0 ? speed : range.velocity};
}

std::optional<std::map<std::string, double>> state_box(const UpdateLaw& law, const InputRange& range) {
  if (!law.couplings.empty() || !law.networks.empty() || law.tunable) return std::nullopt;
  constexpr double room = 1 + 1e-6;  // of which a step of the slowest mode takes less than its loss, 1e-6 at least
  Magnitudes run(law, range);
  std::vector<double> states = run.states();
  for (int round = 0; round < 60; ++round) {
    states = after_steps(run, states, 4);
    const std::vector<double> next = after_steps(run, states, 1);
    states = extrapolated(states, next, after_steps(run, next, 1));
    std::vector<double> wide = states;
    for (double& value : wide) value *= room;
    wide = after_steps(run, wide, 2);  // what follows others in the same step follows them
    for (double& value : wide) value *= room;
    const std::vector<double> then = after_steps(run, wide, 1);
    if (!std::equal(then.begin(), then.end(), wide.begin(), [](double a, double b) { return a <= b; })) continue;
    if (!std::all_of(wide.begin(), wide.end(), [](double bound) { return std::isfinite(bound); })) return std::nullopt;
    std::map<std::string, double> box;
    auto value = wide.begin();
    for (const Variable& v : law.variables)
      for (std::size_t place = 0; v.role == Role::state && place < v.size; ++place)
        box[state_name(v, place)] = *value++;
    return box;
  }
  return std::nullopt;
}

double sum_of_terms(const UpdateLaw& law, const InputRange& range, const std::map<std::string, double>& box) {
  Magnitudes run(law, range);
  std::vector<double> states;
  for (const Variable& v : law.variables)
    for (std::size_t place = 0; v.role == Role::state && place < v.size; ++place)
      states.push_back(box.at(state_name(v, place)));
  run.set_states(states);
  return run.force();
}

}  // namespace dashpot::compiler
