#include "discretise/slip_brake.hpp"

#include <algorithm>
#include <cmath>

namespace dashpot::compiler {
namespace {

template <class ValueOf>
Real sum(const std::vector<BrakePair>& pairs, ValueOf value_of) {
  Real total = 0;
  for (const BrakePair& pair : pairs) total += Real(value_of(pair));
  return total;
}

}  // namespace

BrakePair brake_pair(const ComponentSplit& split) {
  return split.shares.size() == 2 ? BrakePair{split.shares.front(), split.shares.back()} : BrakePair{};
}

std::string SlipBrake::shape(const BrakePair& pair) const {
  return std::string(pair.changes() ? "b" : "-") + (pair.compensates() ? "c" : "-");
}

// s·t stays above Y (Y − d ∂t/∂u) while the tool goes back by less than d. In any case a rounding below Y is no end,
// and a slip that is pulled the other way is one.
void SlipBrake::add(const BrakePair& pair, const Real& yield_force, const Real& trial_by_change) {
  const Real back = std::max(Real(Real(settings_.hysteresis) * trial_by_change), Real(yield_force * Real("1e-6")));
  pairs_.push_back(pair);
  leave_.push_back(yield_force * std::max(Real(yield_force - back), Real(0)));
}

void SlipBrake::declare(const std::string& prefix, const Names& names) {
  prefix_ = prefix;
  names_ = names;
  if (!changes() && !compensates()) return;
  if (has_hysteresis())
    slid_ = state("slid", writer_.force(), "the slip's force where the command takes it for sliding, else 0");
  if (changes() && coil_lags()) way_ = state("way", "1", "q of √b, from stuck to sliding");
  if (!compensates()) return;
  samples_ = state("samples", "1", "for which the command has taken it for sliding");
  if (!coil_lags()) return;
  earned_way_ = state("earned_way", "1", "of √b, what has been demanded at least");
  earned_ = state("earned", "1", "of √b, what the coil has reached at least");
}

void SlipBrake::write_output(ExpressionId sliding, VariableId trial, VariableId slip, VariableId excess) {
  if (!changes() && !compensates()) return;
  const ExpressionId commanded = has_hysteresis() ? keep_sliding(sliding, trial, slip, excess) : sliding;
  if (changes()) write_damping(commanded);
  if (compensates()) write_compensation(commanded);
}

void SlipBrake::write_damping(ExpressionId commanded) {
  const ExpressionId stuck = per_place("stuck_damping", writer_.damping(), "b while the slip holds",
                                       [](const BrakePair& p) { return p.stuck.damping; });
  const ExpressionId slides = per_place("sliding_damping", writer_.damping(), "b while it slides",
                                        [](const BrakePair& p) { return p.sliding.damping; });
  const ExpressionId wanted = writer_.where(commanded, slides, stuck);
  damping_ = local("damping", writer_.damping(), "share of the brake");
  if (!coil_lags()) return writer_.assign(writer_.law().output, damping_, wanted, "b of the regime");
  const VariableId target = local("wanted_damping", writer_.damping(), "");
  const ExpressionId one = writer_.constant(joined(prefix_, "arrived"), "1", "the whole way", 1);
  const ExpressionId none = writer_.constant(joined(prefix_, "departed"), "1", "nothing of it", 0);
  writer_.assign(writer_.law().output, target, wanted, "b of the regime");
  way_now_ = local("way_now", "1", "");
  writer_.assign(writer_.law().output, way_now_, nearer(way_, writer_.where(commanded, one, none)),
                 "q ← q + κ (1 - q), or q - κ q");
  write_limited_damping(writer_.read(target));
}

// q + κ (goal − q)
ExpressionId SlipBrake::nearer(VariableId from, ExpressionId goal) {
  if (share_ == nothing)
    share_ = writer_.constant(joined(prefix_, "coil_share"), "1", "κ of a sample", settings_.coil_share);
  return writer_.add(writer_.read(from), writer_.multiply(share_, writer_.subtract(goal, writer_.read(from))));
}

// The larger b is reached by the square of the way to it, b = b_least + |Δb| w², w = q or 1 − q: no coil that makes up
// κ of √b in a sample is asked for more (Cauchy and Schwarz over all components).
void SlipBrake::write_limited_damping(ExpressionId wanted) {
  const auto rises = [](const BrakePair& p) { return p.sliding.damping > p.stuck.damping; };
  const ExpressionId least = per_place("least_damping", writer_.damping(), "b of the regime with less",
                                       [](const BrakePair& p) { return std::min(p.stuck.damping, p.sliding.damping); });
  const ExpressionId more = per_place("more_damping", writer_.damping(), "and what the other has more",
                                      [](const BrakePair& p) { return std::abs(p.sliding.damping - p.stuck.damping); });
  const ExpressionId start =
      per_place("way_start", "1", "where the slip holds", [=](const BrakePair& p) { return rises(p) ? 0 : 1; });
  const ExpressionId ahead = per_place("way_ahead", "1", "from there to where it slides",
                                       [=](const BrakePair& p) { return rises(p) ? 1 : -1; });
  const VariableId root = local("root", "1", "");
  writer_.assign(writer_.law().output, root, writer_.add(start, writer_.multiply(ahead, writer_.read(way_now_))),
                 "of b, between its least and its largest");
  writer_.assign(writer_.law().output, damping_,
                 writer_.add(least, writer_.multiply(more, writer_.multiply(writer_.read(root), writer_.read(root)))),
                 "b as the coil can follow");
  if (settings_.make_up <= 0) return;
  shortfall_ = local("shortfall", writer_.damping(), "");
  writer_.assign(writer_.law().output, shortfall_, writer_.subtract(wanted, writer_.read(damping_)),
                 "b of the regime less b");
}

// Above zero where the command takes the slip for sliding.
ExpressionId SlipBrake::keep_sliding(ExpressionId sliding, VariableId trial, VariableId slip, VariableId excess) {
  const ExpressionId leave = writer_.constants({prefix_, "leave"}, writer_.force() + "²",
                                               "Y (Y - 1.5 steps of the encoder ∂t/∂u)", leave_, names_);
  const ExpressionId still = writer_.subtract(writer_.multiply(writer_.read(slid_), writer_.read(trial)), leave);
  slide_ = local("slide", writer_.force(), "");
  writer_.assign(
      writer_.law().output, slide_,
      writer_.where(sliding, writer_.read(slip), writer_.where(still, writer_.read(slid_), writer_.read(excess))),
      "for the command, sliding ends with s t < Y (Y - 1.5 steps ∂t/∂u); here r = 0");
  return writer_.multiply(writer_.read(slide_), writer_.read(slide_));
}

// β = β_most q₂², q₂ by a coil that lags behind a demand that lags, from the sample on in which all that the estimate
// knows of was braked.
void SlipBrake::write_compensation(ExpressionId commanded) {
  std::vector<Statement>& output = writer_.law().output;
  const ExpressionId none = writer_.constant(joined(prefix_, "none"), "1", "nothing", 0);
  const ExpressionId one = writer_.constant(joined(prefix_, "one"), "1", "one sample, the whole", 1);
  samples_now_ = local("sliding_samples", "1", "");
  writer_.assign(output, samples_now_, writer_.where(commanded, writer_.add(writer_.read(samples_), one), none),
                 "samples of this slide");
  const ExpressionId hold =
      writer_.constant(joined(prefix_, "hold"), "1", "samples before a slide is compensated", settings_.hold_samples);
  const ExpressionId long_enough = writer_.subtract(writer_.read(samples_now_), hold);
  const ExpressionId most = per_place("compensation_most", writer_.damping(), "β at most",
                                      [](const BrakePair& p) { return p.sliding.compensation; });
  compensation_ = local("compensation", writer_.damping(), "");
  if (earned_ == nothing) {
    writer_.assign(output, compensation_, writer_.where(long_enough, most, none), "β, held");
    return;
  }
  // The brake is itself demanded on the way, so that the coil comes a second lag behind.
  earned_way_now_ = local("earned_way_now", "1", "");
  earned_now_ = local("earned_now", "1", "");
  writer_.assign(output, earned_now_, writer_.where(long_enough, nearer(earned_, writer_.read(earned_way_)), none),
                 "q₂ ← q₂ + κ (q₁ - q₂)");
  writer_.assign(output, earned_way_now_, writer_.where(long_enough, nearer(earned_way_, one), none),
                 "q₁ ← q₁ + κ (1 - q₁)");
  writer_.assign(output, compensation_,
                 writer_.multiply(most, writer_.multiply(writer_.read(earned_now_), writer_.read(earned_now_))),
                 "β = β_most q₂²");
}

void SlipBrake::write_update() {
  std::vector<Statement>& update = writer_.law().update;
  for (const auto& [kept, now] :
       {std::pair(slid_, slide_), std::pair(samples_, samples_now_), std::pair(way_, way_now_),
        std::pair(earned_way_, earned_way_now_), std::pair(earned_, earned_now_)})
    if (kept != nothing) writer_.assign(update, kept, writer_.read(writer_.kept(now)), "");
}

Real SlipBrake::steady_damping() const {
  return changes() ? Real(0) : sum(pairs_, [](const BrakePair& p) { return p.stuck.damping; });
}
Real SlipBrake::damping_at_rest() const {
  return sum(pairs_, [](const BrakePair& p) { return p.stuck.damping; });
}
Real SlipBrake::least_damping() const {
  return sum(pairs_, [](const BrakePair& p) { return std::min(p.stuck.damping, p.sliding.damping); });
}
Real SlipBrake::largest_damping() const {
  return sum(pairs_, [](const BrakePair& p) { return std::max(p.stuck.damping, p.sliding.damping); });
}

VariableId SlipBrake::local(const std::string& what, const std::string& unit, const std::string& meaning) {
  return writer_.vector({prefix_, what}, unit, meaning, Role::local, names_);
}

VariableId SlipBrake::state(const std::string& what, const std::string& unit, const std::string& meaning) {
  return writer_.vector({prefix_, what}, unit, meaning, Role::state, names_);
}

template <class ValueOf>
ExpressionId SlipBrake::per_place(const char* name, const std::string& unit, const char* meaning, ValueOf value_of) {
  std::vector<Real> values;
  for (const BrakePair& pair : pairs_) values.push_back(Real(value_of(pair)));
  return writer_.constants({prefix_, name}, unit, meaning, values, names_);
}

}  // namespace dashpot::compiler
