#include "certify/state_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "discretise/rounding.hpp"

namespace dashpot::compiler {
namespace {

// Σ c_i x_i over the states and inputs at the beginning of a step, a constant, and a rest of which the magnitude alone
// is known: roundings, and what a slip or a contact decides where its cases are not told apart.
struct Affine {
  std::map<std::size_t, double> shares;
  double constant = 0;
  double rest = 0;
  bool has_kept_share = false;  // depends on the share of all forces that a shedding law keeps
};

// Which of its cases each decision of a step takes, for all combinations in turn.
class Cases {
 public:
  unsigned choose(unsigned count) {
    if (at_ == taken_.size()) taken_.push_back({0, count});
    return taken_[at_++].first;
  }

  // False after the last.
  bool next() {
    at_ = 0;
    while (!taken_.empty() && ++taken_.back().first == taken_.back().second) taken_.pop_back();
    return !taken_.empty();
  }

 private:
  std::vector<std::pair<unsigned, unsigned>> taken_;  // case and number of cases
  std::size_t at_ = 0;
};

constexpr int most_cases = 512;

// What every variable is in terms of the step's beginning, and how large that can be.
class Magnitudes {
 public:
  // With the cases told apart, what one takes away from another is seen; where there are too many they are not.
  Magnitudes(const UpdateLaw& law, const InputRange& range, bool tells_cases_apart)
      : law_(law), roundoff_(unit_roundoff(law.scalar)), tells_cases_apart_(tells_cases_apart) {
    for (const Variable& v : law.variables) {
      starts_.push_back(bounds_.size());
      for (std::size_t place = 0; place < v.size; ++place)
        bounds_.push_back(v.role == Role::state ? std::abs(v.rest_value) : 0.0);
    }
    bounds_[first(law.position)] = range.position;
    bounds_[first(law.velocity)] = range.velocity;
  }

  void step() {
    std::vector<double> then = bounds_;
    for_each_state([&](std::size_t at) { then[at] = 0; });
    in_every_case({&law_.output, &law_.keep, &law_.update}, [&] {
      for_each_state([&](std::size_t at) { then[at] = std::max(then[at], magnitude(values_[at])); });
    });
    bounds_ = then;
  }

  double force() {
    double most = 0;
    in_every_case({&law_.output}, [&] { most = std::max(most, magnitude(values_[first(law_.force)])); });
    return most;
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

  template <class Action>
  void in_every_case(std::initializer_list<const std::vector<Statement>*> programs, Action action) {
    int count = 0;
    do {
      begin();
      for (const std::vector<Statement>* program : programs) run(*program);
      action();
    } while (cases_.next() && ++count < most_cases);
    if (count == most_cases) tells_cases_apart_ = false, cases_ = {}, in_every_case(programs, action);
  }

  void begin() {
    values_.assign(bounds_.size(), {});
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i].shares[i] = 1;
  }

  void run(const std::vector<Statement>& program) {
    for (const Statement& s : program)
      for (std::size_t place = 0; place < law_.variables[s.target].size; ++place)
        values_[first(s.target) + place] = s.target == law_.mapped ? mapped() : of(s.value, place);
  }

  // |w| ≤ w′_most |u − start|, but for the roundings of a cubic.
  Affine mapped() const {
    return sized(law_.steepest * (bounds_[first(law_.position)] + std::abs(law_.map_start)) * (1 + 64 * roundoff_));
  }

  double magnitude(const Affine& value) const {
    double sum = std::abs(value.constant) + value.rest;
    for (const auto& [at, share] : value.shares) sum += std::abs(share) * bounds_[at];
    return sum;
  }

  // Adding zero is exact. Without that, a state that a case leaves as it is would grow by a rounding a step for ever.
  Affine sum(const Affine& a, const Affine& b, double sign) const {
    Affine all = a;
    all.has_kept_share |= b.has_kept_share;
    if (magnitude(b) == 0) return all;
    for (const auto& [at, share] : b.shares) all.shares[at] += sign * share;
    all.constant += sign * b.constant;
    all.rest += b.rest;
    all.rest += roundoff_ * magnitude(all);
    return all;
  }

  Affine scaled(const Affine& a, double factor) const {
    Affine all = a;
    for (auto& [at, share] : all.shares) share *= factor;
    all.constant *= factor;
    all.rest *= std::abs(factor);
    all.rest += roundoff_ * magnitude(all);
    return all;
  }

  static double largest(const std::vector<double>& table) {
    double most = 0;
    for (const double value : table) most = std::max(most, std::abs(value));
    return most;
  }

  static Affine sized(double magnitude) { return {{}, 0, magnitude, false}; }

  // A value that is linear in the kept share is largest where the share is 0 or 1, and both are tried. A product of two
  // such values is not linear: no bound is given.
  Affine product(const Affine& a, const Affine& b) const {
    if (a.has_kept_share && b.has_kept_share) return sized(std::numeric_limits<double>::infinity());
    const Affine &factor = a.shares.empty() ? a : b, &other = a.shares.empty() ? b : a;
    Affine all = sized(magnitude(a) * magnitude(b));
    if (factor.shares.empty()) {
      all = scaled(other, factor.constant);
      all.rest += factor.rest * magnitude(other);
    }
    all.has_kept_share = a.has_kept_share || b.has_kept_share;
    return all;
  }

  Affine kept_share() {
    if (!tells_cases_apart_) return sized(1);
    return {{}, double(cases_.choose(2)), 0, true};
  }

  Affine clamped(const Affine& value, double limit) const {
    return {{}, 0, std::min(magnitude(value), limit), value.has_kept_share};
  }

  bool is_read_of(ExpressionId id, VariableId variable) const {
    return law_.expressions[id].operation == Operation::read && law_.expressions[id].variable == variable;
  }

  Affine of(ExpressionId id, std::size_t place) {
    const Expression& e = law_.expressions[id];
    const auto part = [&](std::size_t i) { return of(e.operands[i], place); };
    const auto size = [&](std::size_t i) { return magnitude(part(i)); };
    const auto at = [&](const std::vector<double>& values) { return values[values.size() == 1 ? 0 : place]; };
    switch (e.operation) {
      case Operation::read: return values_[first(e.variable) + (law_.variables[e.variable].size == 1 ? 0 : place)];
      case Operation::constant: return {{}, at(law_.coefficients[e.coefficient].values), 0, false};
      case Operation::add: return sum(part(0), part(1), 1);
      case Operation::subtract: return sum(part(0), part(1), -1);
      case Operation::multiply: return product(part(0), part(1));
      case Operation::divide:  // nothing bounds another quotient than that of what the motor gives and what was wanted
        return law_.sheds() && is_read_of(e.operands[0], law_.force) && is_read_of(e.operands[1], law_.wanted)
                   ? kept_share()
                   : sized(std::numeric_limits<double>::infinity());
      case Operation::flush: return part(0);
      case Operation::clamp: return clamped(part(0), size(1));
      case Operation::where:
        if (tells_cases_apart_) return part(cases_.choose(2) == 0 ? 1 : 2);
        return sized(std::max(size(1), size(2)));
      case Operation::relax: return sum(part(2), product(part(0), part(1)), 1);
      case Operation::pick: return sized(largest(law_.coefficients[e.coefficient].values));
      case Operation::sum: break;
    }
    Affine all;
    for (std::size_t i = 0; i < law_.variables[e.variable].size; ++i) all = sum(all, values_[first(e.variable) + i], 1);
    return all;
  }

  std::size_t first(VariableId id) const { return starts_[id.place()]; }

  const UpdateLaw& law_;
  double roundoff_;
  bool tells_cases_apart_;
  Cases cases_;
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

std::optional<std::map<std::string, double>> box_by(Magnitudes run, const UpdateLaw& law) {
  constexpr double room = 1 + 1e-6;  // of which a step of the slowest mode takes less than its loss, 1e-6 at least
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

}  // namespace

std::string state_name(const Variable& state, std::size_t place) {
  return (state.element_names.empty() ? state.name : state.element_names[place]) + "_";
}

InputRange input_range(const PortDevice& port) {
  const InputRange range = {10, 100};
  if (port.is_ideal()) return range;
  const encoder_description& encoder = port.description().encoder;
  const double scale = port.at_tool().position_scale();
  const double reach = std::max(std::abs(encoder.range_low), std::abs(encoder.range_high)) * scale;
  const double speed = encoder.max_speed * scale;
  return {reach > 0 ? reach : range.position, speed > 0 ? speed : range.velocity};
}

std::optional<std::map<std::string, double>> state_box(const UpdateLaw& law, const InputRange& range) {
  if (!law.couplings.empty() || !law.networks.empty() || law.tunable) return std::nullopt;
  const auto box = box_by(Magnitudes(law, range, false), law);
  return box ? box : box_by(Magnitudes(law, range, true), law);
}

double sum_of_terms(const UpdateLaw& law, const InputRange& range, const std::map<std::string, double>& box) {
  Magnitudes run(law, range, false);
  std::vector<double> states;
  for (const Variable& v : law.variables)
    for (std::size_t place = 0; v.role == Role::state && place < v.size; ++place)
      states.push_back(box.at(state_name(v, place)));
  run.set_states(states);
  return run.force();
}

}  // namespace dashpot::compiler
