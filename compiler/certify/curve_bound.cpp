#include "certify/curve_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "certify/box_hold.hpp"
#include "certify/box_motor.hpp"
#include "certify/estimator_factors.hpp"
#include "certify/forces_behind_slips.hpp"
#include "certify/hold_bound.hpp"
#include "certify/unproved.hpp"
#include "discretise/law_writer.hpp"
#include "discretise/rounding.hpp"
#include "law/representable.hpp"

namespace dashpot::compiler {
namespace {

constexpr double margin = 1 + 1e-9;  // for rounding of sums in double with some thousand terms
constexpr int stretches_of_cell = 8;

// Times that a brake's coil may have had to follow, in its time constants: the bound is computed for each, the best is
// taken.
std::span<const double> coil_times(double coil_lag) {
  static constexpr double lagging[] = {1, 2, 4, 8}, prompt[] = {0};
  return coil_lag > 0 ? std::span<const double>(lagging) : std::span<const double>(prompt);
}

// How far the tool moves within a hold and the delay.
double reach_of_hold(const SampledLoop& tool) {
  return tool.tool_speed * tool.longest_hold() * (1.0 + tool.delay_samples);
}

// The curve is the same on both sides of its start.
double flattest_within(const MotionMap& map, double from, double to) {
  if (from < 0) return map.least_tangent(0, std::max(to, -from));
  return map.least_tangent(from, to);
}

std::string hindrance(bool estimate_drives_modes, const std::optional<SlipMotor>& slips, const SampledLoop& tool) {
  if (estimate_drives_modes || (slips && slips->held_compensation > 0))
    return "the estimated velocity moves the law's states, and no proof covers that with a static curve";
  if (tool.may_overtake()) return overtaken;
  if (slips && tool.amplifier_lag > 0)
    return "the amplifier lags, and there are slips or a contact with a static curve";
  if (slips && tool.write_latest > 0)
    return "commands act later than their samples, and there are slips or a contact with a static curve";
  if (tool.motor_slew > 0) return "the motor's slew is limited, and there is a static curve";
  if (!tool.has_device)
    return "a static curve's steepness changes while the tool moves, and no device states how fast that is";
  if (tool.tool_speed == 0) return "the device states no largest speed, and a static curve's steepness changes with it";
  if (tool.travel == 0) return "the device states no range of its encoder, and forces with a static curve grow with it";
  return "";
}

// Bounds of the forces that the motor holds behind the map, and what holding them costs while w′ changes.
struct HeldForces {
  struct Relaxing {
    double decay;    // a
    double turning;  // cost per squared displacement of the tool: turn (turning w′ + turned turn), turn = ½ |w″| r
    double turned;   // infinite where nothing relaxes
    double per_way;  // largest force over the largest distance in w from here; infinite: unknown
    double largest;  // largest force [N]; infinite: unknown
    double leaving;  // for a contact that ends [N/m]
  };

  double static_stiffness = 0;  // k0 [N/m]
  double static_slack = 0;      // d, beyond which it gives up force; 0 if it is always at rest at w = 0 [m]
  double step_stiffness = 0;    // Σ c_i; with tunables `relaxing` has it all [N/m]
  double unsettled = 0;         // the part of the step stiffness that belongs to no mode
  double besides = 0;           // largest force of what is behind slips [N]
  std::vector<Relaxing> relaxing;
  bool is_stepwise = false;  // no delay, only springs and slips behind them: each step obeys an inequality of its own
  bool is_tunable = false;

  // Largest force of the relaxations, if the tool has been no further away in w than `way`.
  double of_relaxing(double way) const {
    if (!is_tunable) return step_stiffness * way;
    double sum = 0;
    for (const Relaxing& mode : relaxing) sum += std::min(mode.per_way * way, mode.largest);
    return sum;
  }
  // Largest force of the static spring; `change`: the largest change of w in the sample before.
  double of_static_spring(double w, double change) const {
    if (static_slack == 0) return static_stiffness * w;
    return static_stiffness * std::max(w + 2 * change, 2 * static_slack + change);
  }
};

HeldForces held_forces(const MotorConstants& motor, const Network& network, const std::optional<SlipMotor>& slips,
                       const SampledLoop& tool) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  HeldForces held;
  const ForcesBehindSlips behind = slips ? forces_behind_slips(network) : ForcesBehindSlips{};
  held.besides = behind.yields;
  const bool is_of_springs = slips && slips->springs_alone && (!network.contact || held.besides == 0);
  held.is_stepwise = tool.delay_samples == 0 && (!slips || is_of_springs);
  held.unsettled = motor.step_stiffness;
  for (const MotorMode& mode : motor.modes) {
    const double a = exact_decay(motor, mode).convert_to<double>();
    const double c = a > 0 ? mode.position_drive / a : mode.position_drive;
    held.relaxing.push_back(
        {a, c / (1 + a), a < 1 ? c / (2 * (1 - a) * (1 + a)) : unknown, c, unknown, c * (1 - a) / (1 + a)});
    if (a > 0) held.unsettled -= c;
  }
  held.unsettled = std::abs(held.unsettled) * margin;
  held.static_stiffness = std::abs(motor.static_stiffness);
  held.step_stiffness = std::abs(motor.step_stiffness);
  if (!behind.reach_round) return held;
  held.relaxing.push_back({0, 0, unknown, behind.stiffness, unknown, behind.stiffness});
  held.step_stiffness += behind.stiffness;
  return held;
}

// The largest change of w between samples is that at the steepest place.
HeldForces held_forces(const BoxHold& box, const SampledLoop& tool, double steepest) {
  const double change = steepest * tool.tool_speed * tool.longest_hold();
  HeldForces held;
  held.static_stiffness = box.static_stiffness;
  held.static_slack = box.static_slack;
  held.besides = box.yield_forces;
  held.is_stepwise = tool.delay_samples == 0 && box.yield_forces == 0;
  held.is_tunable = true;
  for (const HeldRelaxation& mode : box.relaxations)
    held.relaxing.push_back({0, mode.turning, mode.turned, mode.stiffness, mode.per_way * change, 0});
  return held;
}

class CurveNeed {
 public:
  // `stiffness`: β of the law behind the map.
  CurveNeed(HeldForces held, double stiffness, double damping, const Network& network, const SampledLoop& tool,
            const std::vector<CurveStretch>& stretches, double coil_lag)
      : map_(*network.map),
        tool_(tool),
        held_(std::move(held)),
        stretches_(stretches),
        stiffness_(stiffness),
        coil_lag_(coil_lag),
        brake_(damping) {
    is_one_sided_ = network.contact.has_value();
    share_ = assured_share(tool).convert_to<double>();
  }

  // At the worst place: S + curvature − the brake's damping; plus what a lag and an estimate cost.
  double lacking(double needed_behind, double cost_of_estimate) const {
    if (held_.is_stepwise) needed_behind = std::max(needed_behind, stiffness_ * tool_.longest_hold());
    const std::vector<double> bends = costs_of_bends();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < coil_times(coil_lag_).size(); ++i)
      least = std::min(least, lacking_with(needed_behind, i, bends));
    return (least + cost_of_lag() + cost_of_estimate) * margin;
  }

 private:
  // The cost of w′ changing within a hold, for each stretch [N·s/m].
  std::vector<double> costs_of_bends() const {
    const double hold = tool_.longest_hold(), reach = reach_of_hold(tool_);
    std::vector<double> all;
    for (const CurveStretch& one : stretches_)
      all.push_back(hold * cost_of_bend(std::max(one.from - reach, 0.0), one.to + reach, one.steepest,
                                        one.largest_curvature, reach));
    return all;
  }

  double lacking_with(double needed_behind, std::size_t time, const std::vector<double>& bends) const {
    const double settled = coil_lag_ > 0 ? std::pow(1 - std::exp(-coil_times(coil_lag_)[time]), 2) : 1;
    double most = 0;
    for (std::size_t i = 0; i < stretches_.size(); ++i) {
      const CurveStretch& one = stretches_[i];
      most = std::max(most, needed_behind * one.steepest * one.steepest + bends[i] -
                                share_ * settled * brake_ * one.flattest[time] * one.flattest[time]);
    }
    return most;
  }

  // The cost of holding forces while w′ changes, over Δu² [N/m].
  double cost_of_bend(double from, double to, double steepest, double curvature, double reach) const {
    if (!held_.is_stepwise) return (0.5 + tool_.delay_samples) * force(from, to) * curvature;
    const double w = map_.value_at(to), turn = curvature * reach / 2;
    double sum = cost_of_static_spring(w, from, to, curvature, steepest * reach) + held_.unsettled * steepest * turn +
                 held_.besides * curvature / 2;
    if (is_one_sided_) sum += cost_of_leaving(steepest, turn);
    for (const HeldForces::Relaxing& mode : held_.relaxing) {
      const double far_from_rest = std::min(mode.per_way * way_from_rest(from, to), mode.largest) * curvature / 2;
      const double while_relaxing = turn * (steepest * mode.turning + turn * mode.turned);
      sum += std::isfinite(mode.turned) ? std::min(far_from_rest, while_relaxing) : far_from_rest;
    }
    return sum;
  }

  // With tunables the static spring pulls no harder than at w = 0, so that a softening curve costs hardly anything. But
  // where the tool may pass the start of the curve, it curves the other way, and the full force counts.
  double cost_of_static_spring(double w, double from, double to, double curvature, double change) const {
    const double most = held_.of_static_spring(w, change), pull = held_.of_static_spring(0, change);
    if (!held_.is_tunable || from == 0) return most * curvature / 2;
    return std::max(most * largest_bend(from, to, 1), pull * largest_bend(from, to, -1)) / 2;
  }

  // The largest w″ or, with sign −1, −w″; not below 0. In each cell w″ is linear.
  double largest_bend(double from, double to, double sign) const {
    double most = 0;
    for (std::size_t i = 0; i < map_.cubics(); ++i) {
      const MapCell& cell = map_.cell[i];
      const double begins = double(i) * map_.width();
      const double first = std::max(from - begins, 0.0), last = std::min(to - begins, map_.width());
      if (first > last) continue;
      for (const double d : {first, last}) most = std::max(most, sign * (2 * cell.c + 6 * cell.e * d));
    }
    return most;
  }

  // The cost of a contact that ends within the step: the force held to the end of the step acts on the change of w′.
  double cost_of_leaving(double steepest, double turn) const {
    double sum = (held_.static_stiffness + held_.step_stiffness + held_.unsettled) * steepest * turn;
    for (const HeldForces::Relaxing& mode : held_.relaxing) sum += mode.leaving * turn * (steepest + turn / 2);
    return sum;
  }

  double cost_of_lag() const {
    if (tool_.amplifier_lag == 0 && tool_.write_latest == 0) return 0;
    const double steepest = map_.steepest();
    double most = 0;
    for (const CurveStretch& one : stretches_)
      most = std::max(most, force(one.from, one.to) * map_.largest_curvature(one.from, one.to));
    return (stiffness_ * steepest * steepest + most / 2) * time_of_lateness(tool_);
  }

  // Largest |M| over a stretch.
  double force(double from, double to) const {
    return held_.of_static_spring(map_.value_at(to), held_.static_slack) + held_.of_relaxing(way_from_rest(from, to)) +
           held_.besides;
  }

  // The largest distance in w between a place and any other in the tool's range, wherever that lies.
  double way_from_rest(double from, double to) const {
    if (is_one_sided_) return map_.value_at(to);
    const double across = map_.value_at(to) + map_.value_at(std::max(tool_.travel - from, 0.0));
    return std::max(across, map_.value_at(tool_.travel) - map_.value_at(from));
  }

  const MotionMap& map_;
  const SampledLoop& tool_;
  HeldForces held_;
  const std::vector<CurveStretch>& stretches_;
  double stiffness_;
  double coil_lag_;
  double brake_;  // b_w
  double share_;
  bool is_one_sided_;  // behind a contact
};

// The law sheds, since a motor that clips is not passive behind a map. Shedding needs no more damping, as reduced
// forces store less; late loops are not covered.
MotorLimits limits_behind_curve(const SampledLoop& tool, const Certificate& certificate) {
  MotorLimits limits;
  if (!tool.has_device || !(tool.max_force > 0 || tool.motor_slew > 0)) return limits;
  limits.rule = LimitRule::sheds;
  limits.unbounded = Unbounded::curve;
  limits.needed = certificate.bound.needed;
  if (!certificate.certified) limits.reason = "passivity is not proved below the limit either";
  else if (tool.is_late()) limits.reason = std::string("its forces lie behind a static curve, and ") + why_late(tool);
  limits.is_covered = limits.reason.empty();
  return limits;
}

// κ γ T_max/h w′²_most, with κ all that the motor makes of the estimate; empty if γ is not known.
std::optional<double> cost_of_estimate(double followed, const SampledLoop& tool, double steepest) {
  if (followed == 0) return 0;
  const std::optional<double> gain = estimate_gain(tool);
  if (!gain) return std::nullopt;
  return followed * *gain * tool.longest_hold() / tool.sample_period * steepest * steepest;
}

std::string hindrance_of_coil(double damping, const MotionMap& map, const PortDevice& at_tool,
                              const SampledLoop& tool) {
  const double quickest = std::sqrt(damping) * map.largest_curvature(0, map.reach) * tool.tool_speed;
  const bool follows = at_tool.coil_slew() == 0 || quickest <= at_tool.coil_slew();
  return follows ? "" : "the brake's coil does not follow the static curve at the largest speed";
}

// The whole bound: the damping that is lacking plus what the brake assures.
PassivityBound lacking_beside(double lacking, double damping, const Network& network, const SampledLoop& tool) {
  if (!std::isfinite(lacking)) return not_proved(at_once);
  const MotionMap& map = *network.map;
  const double least = map.least_tangent(0, map.reach);
  const Rational told = Rational(damping) * Rational(least) * Rational(least);
  PassivityBound bound;
  bound.needed = (Rational(lacking) + assured_share(tool) * told).convert_to<double>() * margin;
  bound.proof = Proof::hold;
  return network.contact ? of_a_free_tool(bound, tool) : bound;
}

// Lag and late writes are counted separately.
SampledLoop without_lag(SampledLoop behind) {
  behind.amplifier_lag = behind.write_earliest = behind.write_latest = 0;
  return behind;
}

std::string hindrance_of_tunables(const Network& network, const BoxHold& held, const SampledLoop& tool) {
  if (network.contact) return "a contact, and parameters that change";
  if (held.has_meshes)
    return "parameters change behind a static curve, and nothing bounds the forces of springs and dampers that lie "
           "neither beside each other nor in series of one spring and one damper";
  if (tool.amplifier_lag > 0 || tool.write_latest > 0)
    return "parameters change behind a static curve, and commands act late";
  if (tool.delay_samples > 0 && held.can_soften)
    return "a spring's stiffness changes behind a static curve, and the loop is delayed: the force of a softer spring "
           "jumps, and the old one is held for more than a sample";
  return "";
}

}  // namespace

std::vector<CurveStretch> curve_stretches(const MotionMap& map, const SampledLoop& tool, double coil_lag) {
  const double reach = reach_of_hold(tool), farthest = tool.travel + std::abs(map.start);
  std::vector<CurveStretch> all;
  const auto take = [&](double from, double to) {
    const double before = std::max(from - reach, 0.0), after = to + reach;
    all.push_back({from, to, map.largest_tangent(before, after), map.largest_curvature(before, after), {}});
    for (const double time : coil_times(coil_lag)) {
      const double brake_reach = reach + time * coil_lag * tool.tool_speed;
      all.back().flattest.push_back(flattest_within(map, from - brake_reach, to + brake_reach));
    }
  };
  const double width = map.width() / stretches_of_cell;
  for (std::size_t i = 0; i < map.cubics() * stretches_of_cell && double(i) * width <= farthest; ++i)
    take(double(i) * width, double(i + 1) * width);
  if (map.reach <= farthest) take(map.reach, map.reach);
  return all;
}

PassivityBound bound_behind_curve(MotorConstants motor, double damping, const Network& network,
                                  const std::optional<SlipMotor>& slips, const PortDevice& at_tool,
                                  const std::vector<CurveStretch>& stretches, SampledLoop behind) {
  const SampledLoop tool = sampled_loop(at_tool, behind.sample_period);
  if (const std::string why = hindrance(motor.estimate_drives_modes(), slips, tool); !why.empty())
    return not_proved(why);
  const MotionMap& map = *network.map;
  if (const std::string why = hindrance_of_coil(damping, map, at_tool, tool); !why.empty()) return not_proved(why);
  const double followed = std::abs(motor.velocity_gain) + (slips ? slips->compensation : 0);
  const std::optional<double> of_estimate = cost_of_estimate(followed, tool, map.steepest());
  if (!of_estimate) return not_proved(not_proved_for(tool));
  behind = without_lag(behind);
  behind.device_damping = std::numeric_limits<double>::max();  // the comparison is made at the tool instead
  motor.velocity_gain = 0;
  std::optional<SlipMotor> without_estimate = slips;
  if (slips) without_estimate->compensation = 0;
  const PassivityBound bound = slips ? with_slips(bound_beside_slips(motor, *slips, behind), *without_estimate, behind)
                                     : passivity_bound(motor, behind);
  if (bound.proof == Proof::none) return bound;
  // Behind a contact the motor's constants already have the springs of the cut.
  const double of_slips = slips && !network.contact ? slips->stiffness : 0;
  const double stiffness = hold_stiffness(motor).convert_to<double>() + of_slips;
  const CurveNeed need(held_forces(motor, network, slips, tool), stiffness, damping, network, tool, stretches,
                       at_tool.coil_lag());
  return lacking_beside(need.lacking(bound.needed, *of_estimate), damping, network, tool);
}

namespace {

// The same for all parameters in their ranges and all changes of them. Out: the law's least and largest b_w.
PassivityBound bound_over_box(UpdateLaw& law, const Network& network, const std::optional<SlipMotor>& slips,
                              const PortDevice& at_tool, const std::vector<CurveStretch>& stretches,
                              const SampledLoop& behind) {
  const SampledLoop tool = sampled_loop(at_tool, behind.sample_period);
  const MotionMap& map = *network.map;
  const BoxMotor box = box_motor(law, {Rational(behind.longest_hold()) / Rational(behind.sample_period),
                                       lateness(without_lag(behind)), estimate_gain(tool), assured_share(tool)});
  law.damping = box.least_brake;
  law.largest_damping = box.largest_brake;
  if (const std::string why = hindrance(false, slips, tool); !why.empty()) return not_proved(why);
  if (forces_behind_slips(network).reach_round)
    return not_proved(
        "parameters change behind a static curve, and springs or dampers reach ground round a slip, where "
        "nothing bounds what they hold");
  const BoxHold held = box_hold(law, tool.max_force > 0 || tool.motor_slew > 0);
  if (const std::string why = hindrance_of_tunables(network, held, tool); !why.empty()) return not_proved(why);
  if (!box.hindrance.empty()) return not_proved(box.hindrance);
  if (const std::string why = hindrance_of_coil(box.largest_brake, map, at_tool, tool); !why.empty())
    return not_proved(why);
  const std::optional<double> of_estimate = cost_of_estimate(box.largest_gain, tool, map.steepest());
  if (!of_estimate) return not_proved(not_proved_for(tool));
  const HeldForces forces = held_forces(held, tool, map.steepest());
  double stiffness = held.static_stiffness / 2;
  for (const HeldRelaxation& mode : held.relaxations) stiffness += mode.hold;
  const CurveNeed need(forces, stiffness, box.least_brake, network, tool, stretches, at_tool.coil_lag());
  const double needed = forces.is_stepwise ? 0 : box.needed;  // each step by itself needs less than all together
  PassivityBound bound = lacking_beside(need.lacking(needed, *of_estimate), box.least_brake, network, tool);
  bound.any_value = bound.over_changes = true;
  return bound;
}

}  // namespace

double lacking_behind_curve(const PassivityBound& bound, double damping, const MotionMap& map,
                            const SampledLoop& tool) {
  const double flattest = map.least_tangent(0, map.reach), steepest = map.steepest();
  const Rational assured = assured_damping(tool, Rational(damping) * Rational(flattest) * Rational(flattest));
  return Rational(Rational(bound.needed) - assured).convert_to<double>() / (steepest * steepest);
}

Certificate certify_behind_curve(UpdateLaw& law, const Network& network, const std::optional<SlipMotor>& slips,
                                 const PortDevice& behind, double sample_period) {
  const MotionMap& map = *network.map;
  const PortDevice at_tool = behind.at_tool();
  const SampledLoop tool = sampled_loop(at_tool, sample_period);
  if (!has_finite_numbers(law)) return beyond_numbers(tool);
  Certificate result;
  result.loop = tool;
  const SampledLoop loop_behind = sampled_loop(behind, sample_period);
  const std::vector<CurveStretch> stretches = curve_stretches(map, tool, at_tool.coil_lag());
  result.bound = law.tunable ? bound_over_box(law, network, slips, at_tool, stretches, loop_behind)
                             : bound_behind_curve(linear_motor_constants(law), law.damping, network, slips, at_tool,
                                                  stretches, loop_behind);
  result.bound.any_regime = slips.has_value();
  const double flattest = map.least_tangent(0, map.reach), rounding = 64 * unit_roundoff(law.scalar);
  const double least = law.damping * flattest * flattest * (1 - rounding);
  const double most = law.largest_damping * map.steepest() * map.steepest();
  if (result.bound.proof != Proof::none) {
    result.minimum_damping = missing_damping(result.bound, tool, least);
    const double added = result.minimum_damping + rounding * (most + result.minimum_damping);
    const bool fits = tool.has_device && !network.contact && most + added <= tool.max_damping;
    if (result.minimum_damping > 0 && fits) result.added_damping = rounded(Real(added), law.scalar);
  }
  compare_with_bound(result, assured_damping(tool, Rational(least) + Rational(result.added_damping * (1 - rounding))));
  result.limits = limits_behind_curve(tool, result);
  if (tool.encoder_step > 0) result.quantisation_stiffness = 2 * tool.coulomb_friction / tool.encoder_step;
  return result;
}

}  // namespace dashpot::compiler
