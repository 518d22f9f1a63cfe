#include "certify/curve_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "certify/box_motor.hpp"
#include "certify/estimator_factors.hpp"
#include "certify/hold_bound.hpp"
#include "certify/unproved.hpp"
#include "discretise/law_writer.hpp"
#include "discretise/rounding.hpp"

namespace dashpot::compiler {
namespace {

constexpr double margin = 1 + 1e-9;  // of sums in double, some thousand terms of them
constexpr int stretches_of_cell = 8;

double yield_forces(const Network& network) {
  double sum = 0;
  for (const Element& element : network.elements)
    if (const Slip* slip = std::get_if<Slip>(&element.law); slip && element.has_effect) sum += slip->yield_force;
  return sum;
}

std::string hindrance(const MotorConstants& motor, const std::optional<SlipMotor>& slips, const SampledLoop& tool) {
  if (motor.estimate_drives_modes() || (slips && slips->held_compensation > 0))
    return "the estimated velocity moves the law's states, and of that nothing is proved behind a static curve";
  if (tool.may_overtake()) return overtaken;
  if (slips && tool.amplifier_lag > 0) return "the amplifier lags, and slips or a contact lie behind a static curve";
  if (slips && tool.write_latest > 0)
    return "commands act later than their samples, and slips or a contact lie behind a static curve";
  if (tool.motor_slew > 0) return "the motor's slew is limited, and its force lies behind a static curve";
  if (!tool.has_device)
    return "a static curve's steepness changes while the tool moves, and no device states how fast that is";
  if (tool.tool_speed == 0) return "the device states no largest speed, and a static curve's steepness changes with it";
  if (tool.travel == 0)
    return "the device states no range of its encoder, and forces behind a static curve grow with it";
  return "";
}

class CurveNeed {
 public:
  CurveNeed(const MotorConstants& motor, double damping, const Network& network, const std::optional<SlipMotor>& slips,
            const SampledLoop& tool, double coil_lag)
      : map_(*network.map), tool_(tool), coil_lag_(coil_lag), motor_(motor), brake_(damping) {
    is_one_sided_ = network.contact.has_value();
    besides_ = slips ? yield_forces(network) : 0;
    const bool is_a_contact_of_springs = is_one_sided_ && besides_ == 0 && slips->springs_alone;
    is_stepwise_ = tool.delay_samples == 0 && (!slips || is_a_contact_of_springs);
    farthest_ = tool.travel + std::abs(map_.start);
    unsettled_ = motor_.step_stiffness;
    for (const MotorMode& mode : motor_.modes) {
      const double a = exact_decay(motor_, mode).convert_to<double>();
      modes_.push_back({a, a > 0 ? mode.position_drive / a : mode.position_drive});
      if (a > 0) unsettled_ -= modes_.back().stiffness;
    }
    unsettled_ = std::abs(unsettled_) * margin;
    static_stiffness_ = std::abs(motor_.static_stiffness);
    step_stiffness_ = std::abs(motor_.step_stiffness);
    share_ = assured_share(tool).convert_to<double>();
  }

  // S + curvature − what the brake has, at the worst place, and beside it what a lag and an estimate cost.
  double lacking(double needed_behind, double cost_of_estimate) const {
    if (is_stepwise_)
      needed_behind = std::max(needed_behind, hold_stiffness(motor_).convert_to<double>() * tool_.longest_hold());
    double least = std::numeric_limits<double>::infinity();
    for (const double constants : {0.0, 1.0, 2.0, 4.0, 8.0}) {
      if (coil_lag_ > 0 ? constants == 0 : constants > 0) continue;
      least = std::min(least, lacking_with(needed_behind, constants));
    }
    return (least + cost_of_lag() + cost_of_estimate) * margin;
  }

 private:
  double lacking_with(double needed_behind, double constants) const {
    const double hold = tool_.longest_hold();
    const double reach = tool_.tool_speed * hold * (1.0 + tool_.delay_samples);
    const double brake_reach = reach + constants * coil_lag_ * tool_.tool_speed;
    const double settled = coil_lag_ > 0 ? std::pow(1 - std::exp(-constants), 2) : 1;
    double most = 0;
    each_stretch([&](double from, double to) {
      const double before = std::max(from - reach, 0.0), after = to + reach;
      const double steepest = map_.largest_tangent(before, after);
      const double flattest = flattest_within(from - brake_reach, to + brake_reach);
      const double bend = hold * cost_of_bend(before, after, steepest, map_.largest_curvature(before, after), reach);
      most =
          std::max(most, needed_behind * steepest * steepest + bend - share_ * settled * brake_ * flattest * flattest);
    });
    return most;
  }

  // Of what is held while the map bends, over Δu² [N/m].
  double cost_of_bend(double from, double to, double steepest, double curvature, double reach) const {
    if (!is_stepwise_) return (0.5 + tool_.delay_samples) * force(from, to) * curvature;
    const double w = map_.value_at(to), turn = curvature * reach / 2;
    double sum = static_stiffness_ * w * curvature / 2 + unsettled_ * steepest * turn;
    if (is_one_sided_) sum += cost_of_leaving(steepest, turn);
    for (const Relaxing& mode : modes_) {
      const double far_from_rest = mode.stiffness * way_from_rest(from, to) * curvature / 2;
      const double while_relaxing =
          mode.stiffness * turn * (steepest + turn / (2 * (1 - mode.decay))) / (1 + mode.decay);
      sum += mode.decay < 1 ? std::min(far_from_rest, while_relaxing) : far_from_rest;
    }
    return sum;
  }

  // Of a contact that lets go within the step: what is held to the end of it, gq + Σ (1 − a) F, acts on e.
  double cost_of_leaving(double steepest, double turn) const {
    double sum = (static_stiffness_ + step_stiffness_ + unsettled_) * steepest * turn;
    for (const Relaxing& mode : modes_) {
      const double share = mode.stiffness * (1 - mode.decay) / (1 + mode.decay);
      sum += share * turn * (steepest + turn / 2);
    }
    return sum;
  }

  // On both sides of where the curve begins it is the same.
  double flattest_within(double from, double to) const {
    if (from < 0) return map_.least_tangent(0, std::max(to, -from));
    return map_.least_tangent(from, to);
  }

  double cost_of_lag() const {
    if (tool_.amplifier_lag == 0 && tool_.write_latest == 0) return 0;
    const double steepest = map_.steepest();
    double most = 0;
    each_stretch(
        [&](double from, double to) { most = std::max(most, force(from, to) * map_.largest_curvature(from, to)); });
    const double stiffness = hold_stiffness(motor_).convert_to<double>();
    return (stiffness * steepest * steepest + most / 2) * time_of_lateness(tool_);
  }

  // Largest |M| over a stretch.
  double force(double from, double to) const {
    return static_stiffness_ * map_.value_at(to) + step_stiffness_ * way_from_rest(from, to) + besides_;
  }

  // How far in w a place is from any other within the tool's range, which ends somewhere on either side of it.
  double way_from_rest(double from, double to) const {
    if (is_one_sided_) return map_.value_at(to);
    const double across = map_.value_at(to) + map_.value_at(std::max(tool_.travel - from, 0.0));
    return std::max(across, map_.value_at(tool_.travel) - map_.value_at(from));
  }

  template <class Take>
  void each_stretch(Take take) const {
    const double width = map_.width() / stretches_of_cell;
    for (std::size_t i = 0; i < map_.cubics() * stretches_of_cell && double(i) * width <= farthest_; ++i)
      take(double(i) * width, double(i + 1) * width);
    if (map_.reach <= farthest_) take(map_.reach, map_.reach);
  }

  struct Relaxing {
    double decay, stiffness;  // a, c [N/m]
  };

  const MotionMap& map_;
  const SampledLoop& tool_;
  std::vector<Relaxing> modes_;
  double coil_lag_;
  MotorConstants motor_;
  double brake_;  // b_w
  double static_stiffness_, step_stiffness_, besides_, share_;
  double unsettled_;   // of the step stiffness, what is no mode's
  double farthest_;    // that the tool goes from where the map begins
  bool is_one_sided_;  // behind a contact
  bool is_stepwise_;   // without delay, and linear but for a contact: each step obeys its own inequality
};

// The law sheds, since a motor that clips is not passive behind a map. Shed forces store less, and nothing that is late
// is on its way.
MotorLimits limits_behind_curve(const SampledLoop& tool, const Certificate& certificate) {
  MotorLimits limits;
  if (!tool.has_device || !(tool.max_force > 0 || tool.motor_slew > 0)) return limits;
  limits.rule = LimitRule::sheds;
  limits.unbounded = Unbounded::curve;
  limits.needed = certificate.bound.needed;
  if (!certificate.certified) limits.reason = "nothing is proved of it within the limit either";
  else if (tool.is_late()) limits.reason = "its forces lie behind a static curve, and the loop is late";
  limits.is_covered = limits.reason.empty();
  return limits;
}

// κ γ T_max/h w′²_most of all that the motor makes of the estimate; empty where nothing is known of the estimator.
std::optional<double> cost_of_estimate(const MotorConstants& motor, const std::optional<SlipMotor>& slips,
                                       const SampledLoop& tool, double steepest) {
  const double followed = std::abs(motor.velocity_gain) + (slips ? slips->compensation : 0);
  if (followed == 0) return 0;
  const std::optional<double> gain = estimate_gain(tool);
  if (!gain) return std::nullopt;
  return followed * *gain * tool.longest_hold() / tool.sample_period * steepest * steepest;
}

}  // namespace

PassivityBound bound_behind_curve(MotorConstants motor, double damping, const Network& network,
                                  const std::optional<SlipMotor>& slips, const PortDevice& at_tool,
                                  SampledLoop behind) {
  const SampledLoop tool = sampled_loop(at_tool, behind.sample_period);
  if (const std::string why = hindrance(motor, slips, tool); !why.empty()) return not_proved(why);
  const MotionMap& map = *network.map;
  const double quickest = std::sqrt(damping) * map.largest_curvature(0, map.reach) * tool.tool_speed;
  if (at_tool.coil_slew() > 0 && quickest > at_tool.coil_slew())
    return not_proved("the brake's coil does not follow the static curve at the largest speed");
  const std::optional<double> of_estimate = cost_of_estimate(motor, slips, tool, map.steepest());
  if (!of_estimate) return not_proved(not_proved_for(tool));
  behind.amplifier_lag = behind.write_earliest = behind.write_latest = 0;  // these are counted apart
  behind.device_damping = std::numeric_limits<double>::max();              // what is there is compared at the tool
  motor.velocity_gain = 0;
  std::optional<SlipMotor> without_estimate = slips;
  if (slips) without_estimate->compensation = 0;
  PassivityBound bound = slips ? with_slips(bound_beside_slips(motor, *slips, behind), *without_estimate, behind)
                               : passivity_bound(motor, behind);
  if (bound.proof == Proof::none) return bound;
  const double least = map.least_tangent(0, map.reach);
  const Rational told = Rational(damping) * Rational(least) * Rational(least);
  const double lacking =
      CurveNeed(motor, damping, network, slips, tool, at_tool.coil_lag()).lacking(bound.needed, *of_estimate);
  if (!std::isfinite(lacking)) return not_proved("the amplifier lags, and the jitter is a sample or more");
  bound.needed = (Rational(lacking) + assured_share(tool) * told).convert_to<double>() * margin;
  bound.proof = Proof::hold;
  bound.reason.clear();
  bound.storage.reset();
  bound.frequency = 0;
  bound.constant_period_only = false;
  return network.contact ? of_a_free_tool(bound, tool) : bound;
}

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
  Certificate result;
  result.loop = tool;
  if (law.tunable) {
    const BoxMotor box = box_motor(law, {1, 0, 1.0, assured_share(tool)});
    law.damping = box.least_brake;
    law.largest_damping = box.largest_brake;
    result.bound = not_proved(
        "parameters change behind a static curve, and nothing bounds the forces that springs keep over a change while "
        "the curve bends");
  } else {
    result.bound = bound_behind_curve(linear_motor_constants(law), law.damping, network, slips, at_tool,
                                      sampled_loop(behind, sample_period));
  }
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
  const Rational assured = assured_damping(tool, Rational(least) + Rational(result.added_damping * (1 - rounding)));
  result.assured = assured.convert_to<double>();
  result.certified = result.bound.proof != Proof::none && assured >= Rational(result.bound.needed);
  result.limits = limits_behind_curve(tool, result);
  if (tool.encoder_step > 0) result.quantisation_stiffness = 2 * tool.coulomb_friction / tool.encoder_step;
  return result;
}

}  // namespace dashpot::compiler
