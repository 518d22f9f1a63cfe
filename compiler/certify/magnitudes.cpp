#include "certify/magnitudes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "discretise/rounding.hpp"
#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_cases = 2048;

double largest(const std::vector<double>& table) {
  double most = 0;
  for (const double value : table) most = std::max(most, std::abs(value));
  return most;
}

// A bound that came out as NaN is no bound.
double at_least(double value) { return std::isnan(value) ? -infinity : value; }
double at_most(double value) { return std::isnan(value) ? infinity : value; }

}  // namespace

Magnitudes::Magnitudes(const UpdateLaw& law, const InputRange& range, Detail detail, Anchors anchors)
    : law_(law), roundoff_(unit_roundoff(law.scalar)), detail_(detail), anchors_(std::move(anchors)) {
  for (const Variable& v : law.variables) {
    starts_.push_back(bounds_.low.size());
    for (std::size_t place = 0; place < v.size; ++place) {
      const double rest = v.role == Role::state ? v.rest_value : 0.0;
      bounds_.low.push_back(std::min(rest, 0.0));
      bounds_.high.push_back(std::max(rest, 0.0));
    }
  }
  bounds_.include(first(law.position), -range.position, range.position);
  bounds_.include(first(law.velocity), -range.velocity, range.velocity);
  if (law.mapped != no_variable) {  // |w| ≤ w′_most |u − start|, apart from rounding
    const double most = law.steepest * (range.position + std::abs(law.map_start)) * (1 + 64 * roundoff_);
    bounds_.include(first(law.mapped), -most, most);
  }
  for (const CarriedError& carried : carried_errors(law))
    for (std::size_t place = 0; place < law.variables[carried.force].size; ++place) {
      errors_[first(carried.force) + place] = first(carried.error) + place;
      added_[first(carried.force) + place] = first(carried.added) + place;
    }
}

void Magnitudes::Bounds::include(std::size_t at, double least, double most) {
  low[at] = std::min(low[at], least);
  high[at] = std::max(high[at], most);
}

void Magnitudes::step() {
  Bounds then = bounds_;
  for_each_state([&](std::size_t at) { then.low[at] = then.high[at] = 0; });
  in_every_case({&law_.output, &law_.keep, &law_.update}, [&] {
    for_each_state([&](std::size_t at) {
      const std::vector<Share>* anchor = anchor_of(at);
      const Amount next = anchor ? tightened(plus(values_[at], *anchor, -1)) : values_[at];
      if (errors_.count(at) > 0) carry(at, then);
      else then.include(at, lowest(next), highest(next));
    });
  });
  bounds_ = then;
}

// Looks only for the form of such a relation, and one case with that form is enough: whether the difference is bounded
// is computed afterwards.
Anchors Magnitudes::find_anchors() {
  std::map<std::size_t, double> springs;
  in_every_case({&law_.output, &law_.keep, &law_.update}, [&] {
    for_each_state([&](std::size_t at) {
      if (const double stiffness = spring_of(at); stiffness > 0) springs.emplace(at, stiffness);
    });
  });
  Anchors found;
  const std::size_t surface = first(law_.rest_position);
  for (const auto& [force, stiffness] : springs) found.push_back({force, {{surface, stiffness}}});
  for (const Statement& s : law_.update)
    if (std::vector<Share> terms = sum_at(s); terms.size() > 1) found.push_back({first(s.target), std::move(terms)});
  return found;
}

const std::vector<Share>* Magnitudes::anchor_of(std::size_t at) const {
  const auto found = std::find_if(anchors_.begin(), anchors_.end(), [&](const Anchored& a) { return a.at == at; });
  return found != anchors_.end() ? &found->shares : nullptr;
}

// g/a of a force that the surface's movement drives; 0 for another state.
double Magnitudes::spring_of(std::size_t force) const {
  const auto own = values_[force].shares.find(force);
  const double decay = own != values_[force].shares.end() ? own->second : 0;
  const std::size_t surface = first(law_.rest_position);
  if (!(decay > 0 && decay < 1) || errors_.count(force) > 0 || force == surface) return 0;
  const auto& driven = values_[force].shares;
  const auto change = plus(values_[surface], symbol(surface), -1).shares;
  const auto widest = std::max_element(change.begin(), change.end(), [](const auto& a, const auto& b) {
    return std::abs(a.second) < std::abs(b.second);
  });
  const auto with_widest = driven.find(widest->first);
  const double gain = with_widest != driven.end() ? with_widest->second / widest->second : 0;
  const bool is_driven = std::all_of(change.begin(), change.end(), [&](const auto& share) {
    const auto there = driven.find(share.first);
    const double answer = there != driven.end() ? there->second : 0;
    return share.first == force || std::abs(answer - gain * share.second) <= 1e-9 * std::abs(gain * widest->second);
  });
  return is_driven ? gain / decay : 0;
}

// The shares of a state that a step computes as a sum of other states' new values.
std::vector<Share> Magnitudes::sum_at(const Statement& s) const {
  std::vector<Share> terms;
  if (!s.assigns() || law_.variables[s.target].size != 1 || !add_terms(s.value, terms)) return {};
  return terms;
}

bool Magnitudes::add_terms(ExpressionId id, std::vector<Share>& terms) const {
  const Expression& e = law_.expressions[id];
  if (e.operation == Operation::add) return add_terms(e.operands[0], terms) && add_terms(e.operands[1], terms);
  const bool is_state = (e.operation == Operation::read || e.operation == Operation::sum) &&
                        law_.variables[e.variable].role == Role::state;
  if (!is_state || (e.operation == Operation::read && law_.variables[e.variable].size != 1)) return false;
  for (std::size_t i = 0; i < law_.variables[e.variable].size; ++i) terms.push_back({first(e.variable) + i, 1});
  return true;
}

double Magnitudes::force() {
  double most = 0;
  in_every_case({&law_.output}, [&] { most = std::max(most, magnitude(values_[first(law_.force)])); });
  return most;
}

std::vector<double> Magnitudes::states() const {
  std::vector<double> flat;
  for_each_state([&](std::size_t at) {
    flat.push_back(-bounds_.low[at]);
    flat.push_back(bounds_.high[at]);
  });
  return flat;
}

void Magnitudes::set_states(const std::vector<double>& flat) {
  auto next = flat.begin();
  for_each_state([&](std::size_t at) {
    bounds_.low[at] = -*next++;
    bounds_.high[at] = *next++;
  });
}

template <class Action>
void Magnitudes::for_each_state(Action action) const {
  for (const Variable& v : law_.variables)
    for (std::size_t place = 0; v.role == Role::state && place < v.size; ++place)
      action(first(law_.variables.id_of(v)) + place);
}

// A step of coupled slips is bounded for each of them by itself.
std::size_t Magnitudes::effort_of(const std::vector<Statement>& program) const {
  std::size_t sum = program.size();
  for (const Statement& statement : program)
    if (const auto* solve = std::get_if<SolveTree>(&statement.step))
      sum += static_cast<std::size_t>(law_.couplings[solve->coupling].operations());
  return sum;
}

template <class Action>
void Magnitudes::in_every_case(std::initializer_list<const std::vector<Statement>*> programs, Action action) {
  int count = 0;
  do {
    begin();
    for (const std::vector<Statement>* program : programs) effort_ += effort_of(*program), run(*program);
    if (is_possible_) action();
  } while (cases_.next() && ++count < most_cases);
  if (count == most_cases) detail_ = Detail::none, cases_ = {}, in_every_case(programs, action);
}

void Magnitudes::begin() {
  slip_forces_.clear();
  known_.clear();
  positive_.clear();
  is_possible_ = true;
  values_.clear();
  for (std::size_t i = 0; i < bounds_.low.size(); ++i) values_.push_back(symbol(i));
  for (const Anchored& anchored : anchors_) values_[anchored.at] = plus(symbol(anchored.at), anchored.shares, 1);
}

// The cases of a map are not told apart: the bounds of its result w are known.
void Magnitudes::run(const std::vector<Statement>& program) {
  const Detail asked = detail_;
  const bool has_map = std::any_of(program.begin(), program.end(), [&](const Statement& s) { return is_map(s); });
  if (has_map) detail_ = Detail::none;
  for (const Statement& s : program) {
    if (!s.assigns()) {
      solve(s);
      continue;
    }
    for (std::size_t place = 0; place < law_.variables[s.target].size && is_possible_; ++place)
      values_[first(s.target) + place] = is_map(s) ? symbol(first(s.target)) : tightened(of(s.value, place));
    if (is_map(s)) detail_ = asked;
  }
}

void Magnitudes::solve(const Statement& statement) {
  if (!is_possible_) return;
  const Amount change = of(statement.value, 0);
  visit_solved(law_, statement, [&](const auto& solved) { solve(solved, statement.target, change); });
}

template <class Solved>
const SlipAnswer& Magnitudes::answer_of(const Solved& solved, bool is_free) {
  const auto key = std::pair(&solved.name, is_free);
  const auto found = answers_.find(key);
  return found != answers_.end() ? found->second : answers_.emplace(key, slip_answer(solved, is_free)).first->second;
}

template <class Solved>
void Magnitudes::solve(const Solved& solved, VariableId force, const Amount& change) {
  const bool is_free = solved.is_pushed() && cases_.choose(2) == 1;
  const SlipAnswer& answer = answer_of(solved, is_free);
  std::vector<Amount> held, slips;
  for (const VariableId id : solved.held) held.push_back(id == no_variable ? exactly(0) : values_[first(id)]);
  for (const double yield : answer.yields) {
    slip_forces_.push_back(yield);
    slips.push_back(symbol(bounds_.low.size() + slip_forces_.size() - 1));
  }
  const auto assign = [&](VariableId id, const SlipAnswerRow& row) {
    if (id != no_variable) values_[first(id)] = tightened(combined(row, change, held, slips, solved.operations()));
  };
  if (solved.is_pushed()) {
    const SlipAnswerRow free = answer_of(solved, true).surface;
    know(sum(combined(free, change, held, slips, solved.operations()), change, -1), is_free ? 1 : -1);
  }
  for (std::size_t i = 0; i < solved.moved.size(); ++i) assign(solved.moved[i], answer.moved[i]);
  assign(solved.surface, answer.surface);
  if (solved.is_pushed() && !is_free) values_[first(solved.surface)] = change;
  assign(force, answer.force);
  for (const VariableId sign : solved.sign)
    if (sign != no_variable) values_[first(sign)] = sized(1);
}

// Rounding of a solver's step is bounded by the sizes of the terms of its result.
Amount Magnitudes::combined(const SlipAnswerRow& row, const Amount& change, const std::vector<Amount>& held,
                            const std::vector<Amount>& slips, int operations) const {
  Amount all = exactly(0);
  double terms = 0;
  const auto add = [&](const Amount& term, double factor) {
    all = plus(all, term, factor);
    terms += std::abs(factor) * magnitude(term);
  };
  add(change, row.by_change);
  for (std::size_t i = 0; i < held.size(); ++i) add(held[i], row.by_held[i]);
  for (std::size_t i = 0; i < slips.size(); ++i) add(slips[i], row.by_slip[i]);
  all.rest += operations * roundoff_ * terms;
  return within(all, -infinity, infinity);
}

// a + factor b, exactly: without the rounding that a law would add.
Amount Magnitudes::plus(const Amount& a, const Amount& b, double factor) const {
  Amount all = a;
  for (const auto& [at, share] : b.shares) all.shares[at] += factor * share;
  all.constant += factor * b.constant;
  all.rest += std::abs(factor) * b.rest;
  all.has_kept_share |= b.has_kept_share;
  return within(all, -infinity, infinity);
}

Amount Magnitudes::plus(Amount a, const std::vector<Share>& shares, double sign) const {
  for (const Share& share : shares) a = plus(a, values_[share.at], sign * share.factor);
  return a;
}

// A force F with a rounding error e that is carried along, to which y is added (Kahan): apart from one rounding of y
// and one of e, F + e becomes F + y = F + e + drive − α F. If F + e is within S = (drive + α |e| + roundings)/α, it
// stays there, even if α is small compared with a rounding of F.
void Magnitudes::carry(std::size_t force, Bounds& then) const {
  const std::size_t error = errors_.at(force);
  Amount drive = values_[added_.at(force)];
  const double own = drive.shares.count(force) > 0 ? -drive.shares[force] : 0;
  const double other = drive.shares[error] - (1 - own);
  const double added = magnitude(drive), whole = size_of(force) + added;
  drive.shares.erase(force);
  drive.shares.erase(error);
  drive.low = -infinity, drive.high = infinity;
  const double lost = roundoff_ * (1 + 4 * roundoff_) * (whole + added);
  const double roundings = roundoff_ * (added + 4 * lost) + 2 * law_.flush_threshold;
  const double fed = magnitude(drive) + std::abs(other) * size_of(error) + roundings;
  const double most = own > 0 && own <= 1 ? fed / own : whole + fed;
  then.include(force, -most, most);
  then.include(error, -lost, lost);
}

// The force alone is F + e less e, so that its bound is the sum of both bounds.
double Magnitudes::low_of(std::size_t symbol) const {
  if (symbol >= bounds_.low.size()) return -slip_forces_[symbol - bounds_.low.size()];
  const auto error = errors_.find(symbol);
  return bounds_.low[symbol] + (error != errors_.end() ? bounds_.low[error->second] : 0);
}

double Magnitudes::high_of(std::size_t symbol) const {
  if (symbol >= bounds_.high.size()) return slip_forces_[symbol - bounds_.high.size()];
  const auto error = errors_.find(symbol);
  return bounds_.high[symbol] + (error != errors_.end() ? bounds_.high[error->second] : 0);
}

double Magnitudes::lowest(const Amount& value) const {
  double sum = value.constant - value.rest;
  for (const auto& [at, share] : value.shares)
    if (share != 0) sum += share * (share > 0 ? low_of(at) : high_of(at));
  return std::max(at_least(sum), value.low);
}

double Magnitudes::highest(const Amount& value) const {
  double sum = value.constant + value.rest;
  for (const auto& [at, share] : value.shares)
    if (share != 0) sum += share * (share > 0 ? high_of(at) : low_of(at));
  return std::min(at_most(sum), value.high);
}

void Magnitudes::know(const Amount& amount, double sign) {
  Amount all = amount;
  for (auto& [at, share] : all.shares) share *= sign;
  all.constant *= sign;
  if (law_.surface_at && !all.shares.empty()) positive_.push_back(all);
}

// If c ≥ 0 is known, x lies between x − λ c and x + λ c for any λ > 0: each λ that cancels one share of x is tried.
Amount Magnitudes::tightened(Amount value) const {
  for (const Amount& known : positive_)
    for (const auto& [at, share] : known.shares) {
      const auto own = value.shares.find(at);
      if (own == value.shares.end() || own->second == 0 || share == 0) continue;
      const double factor = own->second / share;
      Amount less = plus(value, known, -factor);
      less.shares.erase(at);
      less.low = -infinity, less.high = infinity;
      if (factor > 0) value.low = std::max(value.low, lowest(less));
      else value.high = std::min(value.high, highest(less));
    }
  return value;
}

double Magnitudes::rounded(double value) const {
  return law_.scalar == ScalarType::float32 ? double(float(value)) : value;
}

Amount Magnitudes::exactly(double value) const { return {{}, value, 0, false, value, value}; }
Amount Magnitudes::sized(double magnitude) const { return {{}, 0, magnitude, false, -magnitude, magnitude}; }

Amount Magnitudes::within(Amount value, double low, double high) const {
  value.low = at_least(low), value.high = at_most(high);
  const double least = lowest(value), most = highest(value);
  value.low = least, value.high = most;
  return value;
}

Amount Magnitudes::symbol(std::size_t at) const { return {{{at, 1.0}}, 0, 0, false, low_of(at), high_of(at)}; }

// Adding zero is exact. Otherwise the bound of a state that a case does not change would grow at every step.
Amount Magnitudes::sum(const Amount& a, const Amount& b, double sign) const {
  Amount all = a;
  all.has_kept_share |= b.has_kept_share;
  if (magnitude(b) == 0) return all;
  for (const auto& [at, share] : b.shares) all.shares[at] += sign * share;
  all.constant += sign * b.constant;
  all.rest += b.rest;
  const double low = rounded(a.low + (sign > 0 ? b.low : -b.high)),
               high = rounded(a.high + (sign > 0 ? b.high : -b.low));
  all = within(all, -infinity, infinity);
  all.rest += roundoff_ * magnitude(all);
  return within(all, low, high);
}

// A compiler may fuse a product with an addition and skip its rounding: the interval allows for that.
Amount Magnitudes::scaled(const Amount& a, double factor) const {
  Amount all = a;
  for (auto& [at, share] : all.shares) share *= factor;
  all.constant *= factor;
  all.rest *= std::abs(factor);
  const double one = a.low * factor, other = a.high * factor, room = 1 + 4 * roundoff_;
  all = within(all, -infinity, infinity);
  all.rest += roundoff_ * magnitude(all);
  const double low = std::min(at_least(one), at_least(other)), high = std::max(at_most(one), at_most(other));
  return within(all, low > 0 ? low / room : low * room, high > 0 ? high * room : high / room);
}

// A value that is linear in the kept share is largest at share 0 or 1, so both are tried. For a product of two such
// values, which is not linear, no bound is given.
Amount Magnitudes::product(const Amount& a, const Amount& b) const {
  if (a.has_kept_share && b.has_kept_share) return sized(infinity);
  const Amount &factor = a.shares.empty() ? a : b, &other = a.shares.empty() ? b : a;
  Amount all = sized(magnitude(a) * magnitude(b));
  if (factor.shares.empty()) all = scaled(other, factor.constant);
  if (factor.shares.empty() && factor.rest > 0) {
    all.rest += factor.rest * magnitude(other);
    all = within(all, -infinity, infinity);
  }
  all.has_kept_share = a.has_kept_share || b.has_kept_share;
  return all;
}

Amount Magnitudes::kept_share() {
  if (detail_ == Detail::none) return sized(1);
  Amount share = exactly(double(cases_.choose(2)));
  share.has_kept_share = true;
  return share;
}

Amount Magnitudes::clamped(const Amount& value, double limit) {
  Amount all = sized(std::min(magnitude(value), limit));
  if (detail_ == Detail::slips) {
    const unsigned side = cases_.choose(3);
    if (side == 0) all = within(value, std::max(value.low, -limit), std::min(value.high, limit));
    else all = exactly(side == 1 ? limit : -limit);
    if (side != 0 && magnitude(value) < limit) is_possible_ = false;
  }
  all.has_kept_share = value.has_kept_share;
  return all;
}

bool Magnitudes::is_read_of(ExpressionId id, VariableId variable) const {
  return law_.expressions[id].operation == Operation::read && law_.expressions[id].variable == variable;
}

Amount Magnitudes::chosen(const Expression& where, std::size_t place) {
  if (detail_ == Detail::none) {
    const Amount one = of(where.operands[1], place), other = of(where.operands[2], place);
    Amount all = sized(std::max(magnitude(one), magnitude(other)));
    all.low = std::min(one.low, other.low), all.high = std::max(one.high, other.high);
    return all;
  }
  const Amount condition = of(where.operands[0], place);
  const bool is_above = cases_.choose(2) == 0;
  if (is_above ? condition.high <= 0 : condition.low > 0) is_possible_ = false;
  know(condition, is_above ? 1 : -1);
  if (place == 0) take(where.operands[0], is_above);
  return of(where.operands[is_above ? 1 : 2], place);
}

// Records what holds in this case: a > 0, or a − b > 0, which rounding cannot change. Locals and inputs are assigned
// once, so that the same condition has the same answer for the rest of the step.
void Magnitudes::take(ExpressionId condition, bool is_above) {
  const Expression& e = law_.expressions[condition];
  const auto scalar = [&](ExpressionId id) {
    const Expression& read = law_.expressions[id];
    const bool is_known = read.operation == Operation::read && law_.variables[read.variable].size == 1 &&
                          law_.variables[read.variable].role != Role::state;
    return is_known ? read.variable : no_variable;
  };
  const bool is_difference = e.operation == Operation::subtract;
  const VariableId a = scalar(is_difference ? e.operands[0] : condition),
                   b = is_difference ? scalar(e.operands[1]) : no_variable;
  if (a == no_variable || (is_difference && b == no_variable)) return;
  if (known_.emplace(std::pair(a, b), is_above).first->second != is_above) is_possible_ = false;
  Amount zero = exactly(0);
  Amount& first_one = values_[first(a)];
  Amount& second = is_difference ? values_[first(b)] : zero;
  Amount &upper = is_above ? first_one : second, &lower = is_above ? second : first_one;
  const double low = lower.low, high = upper.high;
  upper.low = std::max(upper.low, low);
  lower.high = std::min(lower.high, high);
  if (upper.low > upper.high || lower.low > lower.high) is_possible_ = false;
}

Amount Magnitudes::of(ExpressionId id, std::size_t place) {
  const Expression& e = law_.expressions[id];
  const auto part = [&](std::size_t i) { return of(e.operands[i], place); };
  const auto size = [&](std::size_t i) { return magnitude(part(i)); };
  const auto at = [&](const std::vector<double>& values) { return values[values.size() == 1 ? 0 : place]; };
  if (!is_possible_) return exactly(0);
  switch (e.operation) {
    case Operation::read: return values_[first(e.variable) + (law_.variables[e.variable].size == 1 ? 0 : place)];
    case Operation::constant: return exactly(at(law_.coefficients[e.coefficient].values));
    case Operation::add: return sum(part(0), part(1), 1);
    case Operation::subtract: return sum(part(0), part(1), -1);
    case Operation::multiply: return product(part(0), part(1));
    case Operation::divide:  // only the quotient of the motor's force and the wanted force has a bound
      return law_.sheds() && is_read_of(e.operands[0], law_.force) && is_read_of(e.operands[1], law_.wanted)
                 ? kept_share()
                 : sized(infinity);
    case Operation::mean_decay: return sized(1);
    case Operation::square_root: return sized(infinity);  // occurs in motion maps only, which are bounded elsewhere
    case Operation::flush: return part(0);
    case Operation::clamp: return clamped(part(0), size(1));
    case Operation::where: return chosen(e, place);
    case Operation::relax: return sum(part(2), product(part(0), part(1)), 1);
    case Operation::pick: return sized(largest(law_.coefficients[e.coefficient].values));
    case Operation::sum: break;
  }
  Amount all = exactly(0);
  for (std::size_t i = 0; i < law_.variables[e.variable].size; ++i) all = sum(all, values_[first(e.variable) + i], 1);
  return all;
}

}  // namespace dashpot::compiler
