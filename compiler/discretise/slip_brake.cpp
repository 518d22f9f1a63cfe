#include "discretise/slip_brake.hpp"

#include <algorithm>
#include <cmath>

namespace dashpot::compiler {
namespace {

using Shares = std::vector<BrakeShare>;

double least_of(const Shares& shares) {
  double least = shares.front().damping;
  for (const BrakeShare& share : shares) least = std::min(least, share.damping);
  return least;
}

double largest_of(const Shares& shares) {
  double largest = 0;
  for (const BrakeShare& share : shares) largest = std::max(largest, share.damping);
  return largest;
}

bool differ(const Shares& shares, bool (*same)(const BrakeShare&, const BrakeShare&)) {
  return std::any_of(shares.begin(), shares.end(),
                     [&](const BrakeShare& share) { return !same(share, shares.front()); });
}

bool same_damping(const BrakeShare& x, const BrakeShare& y) { return x.damping == y.damping; }
bool same_feedthrough(const BrakeShare& x, const BrakeShare& y) { return x.feedthrough == y.feedthrough; }

// The way of this regime: b = b_least + (b_most − b_least) way²
Real way_of(const BrakeShare& share, const Shares& all) {
  const double least = least_of(all), span = largest_of(all) - least;
  return span > 0 ? Real(std::sqrt((share.damping - least) / span)) : Real(0);
}

bool is_ramped(const ComponentSplit* split) { return split != nullptr && split->law == SlipLaw::ramped; }

// The shares of a part that leaves nothing to the brake.
const Shares nothing_taken = {BrakeShare{}};

const Shares& shares_of(const ComponentSplit* split) { return split ? split->shares : nothing_taken; }

template <class ValueOf>
Real sum(const std::vector<const ComponentSplit*>& splits, ValueOf value_of) {
  Real total = 0;
  for (const ComponentSplit* split : splits) total += Real(value_of(shares_of(split)));
  return total;
}

}  // namespace

void SlipBrake::add(const ComponentSplit* split) { splits_.push_back(split); }

SlipBrake::Shape SlipBrake::shape(const ComponentSplit* split) {
  const Shares& shares = shares_of(split);
  if (!differ(shares, same_damping)) return {};
  return {true, compiler::is_ramped(split), shares.front().damping == least_of(shares)};
}

bool SlipBrake::takes_part() const { return largest_damping() > 0; }
bool SlipBrake::damping_changes() const { return !splits_.empty() && differ(shares_of(splits_.front()), same_damping); }
bool SlipBrake::changes() const {
  return damping_changes() || (!splits_.empty() && differ(shares_of(splits_.front()), same_feedthrough));
}
bool SlipBrake::is_ramped() const { return damping_changes() && compiler::is_ramped(splits_.front()); }
const std::vector<SlipElements>& SlipBrake::slips() const { return splits_.front()->regimes.slips; }

void SlipBrake::declare(const std::string& prefix, const Names& places, const Names& slips) {
  prefix_ = prefix;
  places_ = places;
  if (!damping_changes()) return;
  if (settings_.hysteresis > 0)
    for (const std::string& slip : slips) {
      const auto one_a_place = [&](const char* what, const std::string& unit, const char* meaning, Role role) {
        return writer_.vector({slip, what}, unit, meaning, role, places_.size() > 1 ? places_ : Names{slip});
      };
      memories_.emplace_back(writer_, Real(settings_.hysteresis), one_a_place);
    }
  if (!has_way()) return;
  way_ = variable("way", "1", "way of the brake from its least b, 0, to its most, 1", Role::state);
  const Shares& first = shares_of(splits_.front());
  writer_.law().variables[way_].rest_value = rounded(way_of(first.front(), first), writer_.law().scalar);
  if (is_ramped() && coil_lags())
    reached_ = variable("reached", "1", "the part of the way that the coil has surely gone", Role::state);
}

void SlipBrake::write_output(const std::vector<ExpressionId>& slides, VariableId position) {
  if (!changes()) return;
  const bool of_one = splits_.front()->regimes.slips.size() == 1;
  regime_of_force_ = regime_ = of_one ? slides.front() : writer_.read(write_regime("regime", slides));
  if (!memories_.empty()) {
    std::vector<ExpressionId> commanded = slides;
    for (std::size_t i = 0; i < memories_.size(); ++i) commanded[i] = memories_[i].write_output(slides[i], position);
    regime_ = of_one ? commanded.front() : writer_.read(write_regime("commanded_regime", commanded));
  }
  if (!damping_changes()) return;
  write_damping();
  if (is_ramped()) write_compensation();
}

// Σ 2^i over the slips that slide
VariableId SlipBrake::write_regime(const char* what, const std::vector<ExpressionId>& slides) {
  ExpressionId sum = nothing;
  for (std::size_t i = 0; i < slides.size(); ++i) {
    const std::size_t weight = std::size_t{1} << i;
    const ExpressionId bit = i == 0 ? one()
                                    : writer_.constant("bit_" + std::to_string(i + 1), "1",
                                                       "set in the regime where this slip gives way", Real(weight));
    sum = writer_.plus(sum, writer_.where(slides[i], bit, none()));
  }
  const VariableId regime = variable(what, "1", "which slips give way", Role::local);
  writer_.assign(writer_.law().output, regime, sum, "bit i: slip i gives way");
  return regime;
}

void SlipBrake::write_damping() {
  std::vector<Statement>& output = writer_.law().output;
  const bool may_fall_short = has_way() && !is_ramped() && settings_.make_up > 0;
  const auto of_regime = [&] {
    return by_regime("damping_by_regime", writer_.damping(), "b",
                     [](const BrakeShare& share, const Shares&) { return Real(share.damping); });
  };
  const ExpressionId wanted = !has_way() || may_fall_short ? of_regime() : nothing;
  damping_ = variable("damping", writer_.damping(), "b of these slips", Role::local);
  if (!has_way()) return writer_.assign(output, damping_, wanted, "b of the regime");
  write_way();
  const ExpressionId least = per_place("least_damping", writer_.damping(), "least b of all regimes",
                                       [](const Shares& shares) { return least_of(shares); });
  const ExpressionId more = per_place("more_damping", writer_.damping(), "largest b of all regimes less the least",
                                      [](const Shares& shares) { return largest_of(shares) - least_of(shares); });
  writer_.assign(
      output, damping_,
      writer_.add(least, writer_.multiply(more, writer_.multiply(writer_.read(way_now_), writer_.read(way_now_)))),
      "b = b_least + (b_most − b_least) way²");
  if (!may_fall_short) return;
  shortfall_ = variable("shortfall", writer_.damping(), "", Role::local);
  writer_.assign(output, shortfall_, writer_.subtract(wanted, writer_.read(damping_)), "b of the regime less b now");
}

void SlipBrake::write_way() {
  const ExpressionId goal = by_regime("way_by_regime", "1", "way of this regime",
                                      [](const BrakeShare& share, const Shares& all) { return way_of(share, all); });
  ExpressionId step = writer_.subtract(goal, writer_.read(way_));
  if (coil_lags()) {
    const ExpressionId share = writer_.constant(
        "coil_share", "1", "κ, share of the missing way that the coil goes in a sample", settings_.coil_share);
    step = writer_.multiply(share, step);
  }
  way_now_ = variable("way_now", "1", "", Role::local);
  if (is_ramped())
    step = writer_.clamp(step, writer_.constant("ramp", "1", "ρ, largest step of the way in a sample", settings_.ramp));
  writer_.assign(writer_.law().output, way_now_, writer_.add(writer_.read(way_), step),
                 is_ramped() ? "way ← way + clamp(κ (way_regime − way), ±ρ)" : "way ← way + κ (way_regime − way)");
}

// β = β_most ((reached − (N + n) ρ)⁺)²
void SlipBrake::write_compensation() {
  std::vector<Statement>& output = writer_.law().output;
  ExpressionId reached = writer_.read(way_now_);
  if (reached_ != nothing) {
    reached_now_ = variable("reached_now", "1", "", Role::local);
    const ExpressionId ahead = writer_.subtract(writer_.read(reached_), reached);
    writer_.assign(output, reached_now_, writer_.where(ahead, reached, writer_.read(reached_)),
                   "reached ← min(reached, way)");
    reached = writer_.read(reached_now_);
  }
  const ExpressionId unsure =
      writer_.constant("ramp_behind", "1", "(N + n) ρ, change of the way over the memory of the velocity estimate",
                       Real(settings_.memory) * Real(settings_.ramp));
  const VariableId earned = variable("earned", "1", "", Role::local);
  const ExpressionId left = writer_.subtract(reached, unsure);
  writer_.assign(output, earned, writer_.where(left, left, none()), "(reached − (N + n) ρ)⁺");
  const ExpressionId most = per_place("compensation_most", writer_.damping(), "largest β", [](const Shares& shares) {
    double largest = 0;
    for (const BrakeShare& share : shares) largest = std::max(largest, share.compensation);
    return largest;
  });
  compensation_ = variable("compensation", writer_.damping(), "", Role::local);
  writer_.assign(output, compensation_,
                 writer_.multiply(most, writer_.multiply(writer_.read(earned), writer_.read(earned))),
                 "β = β_most ((reached − (N + n) ρ)⁺)²");
}

ExpressionId SlipBrake::without_feedthrough(ExpressionId force, VariableId change, const Real& sample_period) {
  if (!takes_part()) return force;
  const auto over_period = [&](const BrakeShare& share, const Shares&) {
    return Real(share.feedthrough / sample_period);
  };
  const Shares& shares = shares_of(splits_.front());
  std::swap(regime_, regime_of_force_);
  const ExpressionId stiffness = changes() ? by_regime("feedthrough_by_regime", writer_.stiffness(), "b∞/h",
                                                       over_period, ConstantRole::regime_feedthrough)
                                           : writer_.constant(joined(prefix_, "feedthrough"), writer_.stiffness(),
                                                              "b∞/h", over_period(shares.front(), shares),
                                                              {ConstantRole::regime_feedthrough, of_regime({})});
  std::swap(regime_, regime_of_force_);
  return writer_.subtract(force, writer_.multiply(stiffness, writer_.read(change)));
}

void SlipBrake::write_update(VariableId released) {
  std::vector<Statement>& update = writer_.law().update;
  const auto keep = [&](VariableId state, ExpressionId now, bool ends_with_touch) {
    if (ends_with_touch && released != no_variable)
      now = writer_.where(writer_.read(writer_.kept(released)), none(), now);
    writer_.assign(update, state, now, "");
  };
  for (SlideMemory& memory : memories_) memory.write_update();
  if (way_ == nothing) return;
  const ExpressionId way = writer_.read(writer_.kept(way_now_));
  keep(way_, way, is_ramped());
  if (reached_ == nothing) return;
  const ExpressionId reached = writer_.read(writer_.kept(reached_now_));
  const ExpressionId share = writer_.constant(
      "coil_share", "1", "κ, share of the missing way that the coil goes in a sample", settings_.coil_share);
  keep(reached_, writer_.add(reached, writer_.multiply(share, writer_.subtract(way, reached))), true);
}

Real SlipBrake::steady_compensation() const {
  return damping_changes() ? Real(0) : sum(splits_, [](const Shares& s) { return s.front().compensation; });
}
Real SlipBrake::steady_damping() const {
  return damping_changes() ? Real(0) : sum(splits_, [](const Shares& s) { return s.front().damping; });
}
Real SlipBrake::damping_at_rest() const {
  return sum(splits_, [](const Shares& s) { return s.front().damping; });
}
Real SlipBrake::least_damping() const { return sum(splits_, least_of); }
Real SlipBrake::largest_damping() const { return sum(splits_, largest_of); }

VariableId SlipBrake::variable(const std::string& what, const std::string& unit, const std::string& meaning,
                               Role role) {
  return writer_.vector({prefix_, what}, unit, meaning, role, places_);
}

Subject SlipBrake::of_regime(std::optional<std::size_t> regime) const { return OfRegime{slips(), regime}; }

template <class ValueOf>
ExpressionId SlipBrake::per_place(const char* name, const std::string& unit, const char* meaning, ValueOf value_of,
                                  Derivation from) {
  std::vector<Real> values;
  for (const ComponentSplit* split : splits_) values.push_back(Real(value_of(shares_of(split))));
  return writer_.constants({prefix_, name}, unit, meaning, values, places_, std::move(from));
}

// With one slip a choice between two values, with several a table.
template <class ValueOf>
ExpressionId SlipBrake::by_regime(const char* name, const std::string& unit, const char* meaning, ValueOf value_of,
                                  ConstantRole role) {
  const bool is_chosen = role == ConstantRole::brake_choice;
  const auto from = [&](std::size_t regime) {
    return is_chosen ? Derivation(role) : Derivation(role, of_regime(regime));
  };
  const auto at = [&](std::size_t regime) {
    return [&, regime](const Shares& shares) { return value_of(shares[regime], shares); };
  };
  if (splits_.front()->regimes.slips.size() == 1)
    return writer_.where(regime_, per_place((std::string("sliding_") + name).c_str(), unit, meaning, at(1), from(1)),
                         per_place((std::string("stuck_") + name).c_str(), unit, meaning, at(0), from(0)));
  std::vector<Real> values;
  std::vector<Subject> subjects;
  for (const BrakeShare& share : splits_.front()->shares) {
    if (!is_chosen) subjects.push_back(of_regime(values.size()));
    values.push_back(value_of(share, splits_.front()->shares));
  }
  return writer_.pick(joined(prefix_, name), unit, meaning, values, regime_, {role, std::move(subjects)});
}

}  // namespace dashpot::compiler
