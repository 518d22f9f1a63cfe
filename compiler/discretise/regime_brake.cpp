#include "discretise/regime_brake.hpp"

#include <algorithm>
#include <cmath>

namespace dashpot::compiler {
namespace {

// √b whose square, rounded, is no more than b.
Real root_of(double damping, ScalarType scalar) {
  const bool is_double = scalar == ScalarType::float64;
  double root = rounded(Real(std::sqrt(damping)), scalar);
  const auto square = [&] {
    return is_double ? root * root : double(static_cast<float>(root) * static_cast<float>(root));
  };
  while (root > 0 && square() > damping)
    root = is_double ? std::nextafter(root, 0.0) : double(std::nextafter(static_cast<float>(root), 0.0F));
  return root;
}

bool same(const BrakeShare& x, const BrakeShare& y) {
  return x.damping == y.damping && x.feedthrough == y.feedthrough && x.compensation == y.compensation;
}

}  // namespace

bool RegimeBrake::changes() const {
  return std::any_of(split_.shares.begin(), split_.shares.end(),
                     [this](const BrakeShare& share) { return !same(share, split_.shares.front()); });
}

double RegimeBrake::least_damping() const {
  double least = split_.shares.front().damping;
  for (const BrakeShare& share : split_.shares) least = std::min(least, share.damping);
  return least;
}

double RegimeBrake::largest_damping() const {
  double largest = 0;
  for (const BrakeShare& share : split_.shares) largest = std::max(largest, share.damping);
  return largest;
}

void RegimeBrake::declare(const std::string& prefix, const Names& slip_names) {
  prefix_ = prefix;
  if (!changes()) return;
  if (has_hysteresis())
    for (const std::string& name : slip_names)
      memories_.push_back({writer_.scalar(joined(name, "slid"), "1",
                                          "1 where the command takes the slip for sliding, else 0", Role::state),
                           writer_.scalar(joined(name, "slid_at"), writer_.length(),
                                          "where the tool was when it last slid", Role::state),
                           writer_.scalar(joined(name, "slides_now"), "1", "", Role::local),
                           writer_.scalar(joined(name, "slides_at"), writer_.length(), "", Role::local)});
  if (compensates()) {
    regime_before_ =
        writer_.scalar(joined(prefix_, "regime_before"), "1", "the command's regime of the sample before", Role::state);
    samples_ = writer_.scalar(joined(prefix_, "samples"), "1", "for which it has been that", Role::state);
  }
  if (!coil_lags()) return;
  if (compensates()) {
    earned_way_ =
        writer_.scalar(joined(prefix_, "earned_way"), "1", "of √b, what has been demanded at least", Role::state);
    earned_ = writer_.scalar(joined(prefix_, "earned"), "1", "of √b, what the coil has reached at least", Role::state);
  }
  root_ = writer_.scalar(joined(prefix_, "root"), "√(" + writer_.damping() + ")", "√b", Role::state);
  writer_.law().variables[root_].rest_value =
      rounded(root_of(split_.shares.front().damping, writer_.law().scalar), writer_.law().scalar);
}

void RegimeBrake::write_output(const std::vector<VariableId>& signs, VariableId position) {
  if (!changes()) return;
  commanded_ = regime_ = write_regime("regime", signs);
  if (!memories_.empty()) {
    std::vector<VariableId> commanded;
    for (std::size_t i = 0; i < memories_.size(); ++i) {
      write_memory(i, signs[i], position);
      commanded.push_back(memories_[i].slides_now);
    }
    commanded_ = write_regime("commanded_regime", commanded);
  }
  write_damping(commanded_);
  if (compensates()) write_compensation(commanded_);
}

bool RegimeBrake::compensates() const {
  return std::any_of(split_.shares.begin(), split_.shares.end(),
                     [](const BrakeShare& share) { return share.compensation > 0; });
}

// q + κ (goal − q)
ExpressionId RegimeBrake::nearer(VariableId from, ExpressionId goal) {
  const ExpressionId share =
      writer_.constant(joined(prefix_, "coil_share"), "1", "κ of a sample", settings_.coil_share);
  return writer_.add(writer_.read(from), writer_.multiply(share, writer_.subtract(goal, writer_.read(from))));
}

// β = β_most q₂², q₂ by a coil that lags behind a demand that lags, from the sample on in which all that the estimate
// knows of was braked as this regime is. With another regime it begins anew.
void RegimeBrake::write_compensation(VariableId regime) {
  std::vector<Statement>& output = writer_.law().output;
  const ExpressionId none = writer_.constant("held", "1", "a slip that holds", 0),
                     one = writer_.constant("slid", "1", "a slip that gives way", 1);
  const VariableId turned = local("regime_change", "1", "not 0 where the command's regime is another");
  writer_.assign(output, turned, writer_.subtract(writer_.read(regime), writer_.read(regime_before_)), "");
  samples_now_ = local("regime_samples", "1", "");
  writer_.assign(output, samples_now_,
                 writer_.where(writer_.multiply(writer_.read(turned), writer_.read(turned)), one,
                               writer_.add(writer_.read(samples_), one)),
                 "samples of this regime");
  const ExpressionId hold =
      writer_.constant(joined(prefix_, "hold"), "1", "samples before a regime is compensated", settings_.hold_samples);
  const ExpressionId long_enough = writer_.subtract(writer_.read(samples_now_), hold);
  const ExpressionId most = by_regime(regime, "compensation_by_regime", writer_.damping(), "β at most",
                                      [](const BrakeShare& share) { return Real(share.compensation); });
  compensation_ = local("compensation", writer_.damping(), "");
  if (earned_ == nothing)
    return writer_.assign(output, compensation_, writer_.where(long_enough, most, none), "β, held");
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

// For the command a slide ends where the tool has gone 1.5 steps of the encoder, to either side, and the slip not with
// it.
void RegimeBrake::write_memory(std::size_t slip, VariableId sign, VariableId position) {
  std::vector<Statement>& output = writer_.law().output;
  const Memory& memory = memories_[slip];
  const Real reach = settings_.hysteresis;
  const ExpressionId slides = writer_.multiply(writer_.read(sign), writer_.read(sign));
  const ExpressionId one = writer_.constant("slid", "1", "a slip that gives way", 1),
                     none = writer_.constant("held", "1", "a slip that holds", 0);
  const ExpressionId area =
      writer_.constant("hysteresis_squared", writer_.length() + "²", "(1.5 steps of the encoder)²", reach * reach);
  const VariableId gone = local(joined("way_since", std::to_string(slip + 1)), writer_.length(), "");
  writer_.assign(output, gone, writer_.subtract(writer_.read(position), writer_.read(memory.at)), "since it last slid");
  const ExpressionId still = writer_.subtract(area, writer_.multiply(writer_.read(gone), writer_.read(gone)));
  writer_.assign(output, memory.slides_now,
                 writer_.where(slides, one, writer_.where(still, writer_.read(memory.slid), none)),
                 "for the command, sliding ends 1.5 steps of the encoder further on");
  writer_.assign(output, memory.at_now, writer_.where(slides, writer_.read(position), writer_.read(memory.at)), "");
}

// Σ 2^i over the slips that slide
ExpressionId RegimeBrake::regime_of(const std::vector<VariableId>& slides) {
  ExpressionId sum = nothing;
  for (std::size_t i = 0; i < slides.size(); ++i) {
    const ExpressionId slip = writer_.multiply(writer_.read(slides[i]), writer_.read(slides[i]));
    const std::size_t weight = std::size_t{1} << i;
    sum = writer_.plus(
        sum, i == 0 ? slip
                    : writer_.multiply(
                          writer_.constant("bit_" + std::to_string(i + 1), "1", "of a regime", Real(weight)), slip));
  }
  return sum;
}

VariableId RegimeBrake::write_regime(const char* what, const std::vector<VariableId>& slides) {
  const VariableId regime = local(what, "1", "which slips give way");
  writer_.assign(writer_.law().output, regime, regime_of(slides), "bit i: slip i gives way");
  return regime;
}

// b, or √b as the coil can follow: √b ← √b + κ (√b_regime − √b). What is on its way to lie within two demands lies
// within them too when components add up (Minkowski).
void RegimeBrake::write_damping(VariableId regime) {
  std::vector<Statement>& output = writer_.law().output;
  damping_ = local("damping", writer_.damping(), "share of the brake");
  const ExpressionId wanted = by_regime(regime, "damping_by_regime", writer_.damping(), "b",
                                        [](const BrakeShare& share) { return Real(share.damping); });
  if (!coil_lags()) return writer_.assign(output, damping_, wanted, "b of the regime");
  const ScalarType scalar = writer_.law().scalar;
  const ExpressionId goal = by_regime(regime, "root_by_regime", "√(" + writer_.damping() + ")", "√b",
                                      [=](const BrakeShare& share) { return root_of(share.damping, scalar); });
  const ExpressionId share =
      writer_.constant(joined(prefix_, "coil_share"), "1", "κ of a sample", settings_.coil_share);
  root_now_ = local("root_now", "√(" + writer_.damping() + ")", "");
  writer_.assign(output, root_now_,
                 writer_.add(writer_.read(root_), writer_.multiply(share, writer_.subtract(goal, writer_.read(root_)))),
                 "√b ← √b + κ (√b_regime − √b)");
  writer_.assign(output, damping_, writer_.multiply(writer_.read(root_now_), writer_.read(root_now_)),
                 "b as the coil can follow");
  if (settings_.make_up <= 0) return;
  shortfall_ = local("shortfall", writer_.damping(), "");
  writer_.assign(output, shortfall_, writer_.subtract(wanted, writer_.read(damping_)), "b of the regime less b");
}

ExpressionId RegimeBrake::without_feedthrough(ExpressionId force, VariableId change, const Real& sample_period) {
  const auto over_period = [&](const BrakeShare& share) { return Real(share.feedthrough / sample_period); };
  if (!takes_part()) return force;
  const ExpressionId stiffness =
      changes() ? by_regime(regime_, "feedthrough_by_regime", writer_.stiffness(), "b∞/h", over_period)
                : writer_.constant(joined(prefix_, "feedthrough"), writer_.stiffness(), "b∞/h",
                                   over_period(split_.shares.front()));
  return writer_.subtract(force, writer_.multiply(stiffness, writer_.read(change)));
}

void RegimeBrake::write_update(VariableId released) {
  std::vector<Statement>& update = writer_.law().update;
  const auto keep = [&](VariableId state, VariableId now) {
    if (state != nothing && now != nothing) writer_.assign(update, state, writer_.read(writer_.kept(now)), "");
  };
  for (const Memory& memory : memories_) {
    keep(memory.slid, memory.slides_now);
    keep(memory.at, memory.at_now);
  }
  keep(root_, root_now_);
  keep(earned_way_, earned_way_now_);
  keep(earned_, earned_now_);
  keep(regime_before_, commanded_);
  if (samples_ == nothing) return;
  const ExpressionId samples = writer_.read(writer_.kept(samples_now_));
  const ExpressionId none = writer_.constant("held", "1", "a slip that holds", 0);
  writer_.assign(update, samples_,
                 released == no_variable ? samples : writer_.where(writer_.read(writer_.kept(released)), none, samples),
                 "");
}

ExpressionId RegimeBrake::compensation() const {
  return compensation_ == nothing ? nothing : writer_.read(compensation_);
}
ExpressionId RegimeBrake::changing_damping() const { return damping_ == nothing ? nothing : writer_.read(damping_); }
ExpressionId RegimeBrake::shortfall() const { return shortfall_ == nothing ? nothing : writer_.read(shortfall_); }

template <class ValueOf>
ExpressionId RegimeBrake::by_regime(VariableId regime, const char* name, const std::string& unit, const char* meaning,
                                    ValueOf value_of) {
  std::vector<Real> values;
  for (const BrakeShare& share : split_.shares) values.push_back(value_of(share));
  return writer_.pick(joined(prefix_, name), unit, meaning, values, writer_.read(regime));
}

VariableId RegimeBrake::local(const std::string& what, const std::string& unit, const std::string& meaning) {
  return writer_.scalar(joined(prefix_, what), unit, meaning, Role::local);
}

}  // namespace dashpot::compiler
