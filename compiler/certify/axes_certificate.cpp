#include "certify/axes_certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "axes/motor_norms.hpp"
#include "axes/weighed.hpp"
#include "certify/estimator_factors.hpp"
#include "certify/forces_behind_slips.hpp"
#include "certify/motor_limits.hpp"
#include "certify/quantisation.hpp"
#include "certify/unproved.hpp"
#include "network/law.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

using axes::Pair;
using axes::Sloped;
using axes::Symmetric;

constexpr int places_a_side = 40;  // parts of the workspace along each side, for the brakes' share in reports

bool compensates(const UpdateLaw& law) {
  return std::any_of(law.coefficients.begin(), law.coefficients.end(), [](const Coefficient& c) {
    return c.role == ConstantRole::velocity_gain &&
           std::any_of(c.values.begin(), c.values.end(), [](double value) { return value != 0; });
  });
}

// Gain of the velocity estimate g·v̂ that decides when a contact with damping ends [N·s/m].
double follows(const CertifiedPort& port) { return port.slips ? port.slips->compensation : 0; }

axes::PortLoad load_of(const CertifiedPort& port, double sample_period) {
  axes::PortLoad load;
  load.map = port.port->map;
  // The certificate is for an ideal device, on which the estimate has a gain of 1.
  load.held = std::max(port.certificate->bound.needed - follows(port), 0.0) / sample_period * (1 + 1e-12);
  load.grounded = to_double(port.form->linear.static_stiffness);
  for (const Mode& mode : port.form->linear.modes) load.relaxing += to_double(mode.stiffness);
  const ForcesBehindSlips behind = forces_behind_slips(port.port->network);
  load.relaxing += behind.stiffness;  // springs that reach ground round slips are at rest wherever the tool began
  load.yields = behind.yields;
  load.unilateral = port.port->network.contact.has_value();
  if (load.unilateral) load.surface = port.port->network.contact->at;
  return load;
}

// Sets how far both joints move at their largest speed during a hold, and during one more for each sample of delay.
axes::SampledLoop loop_of(const AxesDevice& device) {
  axes::SampledLoop loop;
  loop.longest_period = loop_of_joint(device.joints[0]).longest_hold();
  loop.delay = static_cast<int>(device.loop().delay_samples);
  for (std::size_t i = 0; i < 2; ++i)
    loop.reach[i] = device.joints[i].encoder.max_speed * loop.longest_period * (1 + loop.delay);
  return loop;
}

Pair<double> weight_of(const axes::Arm& arm) {
  if (arm.kind == axes::Kinematics::cartesian) return {1, 1};
  const double near = arm.proximal * arm.proximal, far = arm.distal * arm.distal;
  return arm.kind == axes::Kinematics::five_bar ? Pair<double>{near, near} : Pair<double>{near, far};
}

double largest_damping(const CertifiedPort& port) { return std::max(port.law->damping, port.law->largest_damping); }

// The damping that is wanted at the tip where all ports are pushed.
axes::TipDamping wanted_at_tip(const AxesNetwork& network, const std::vector<CertifiedPort>& ports) {
  return [&network, ports](const Pair<double>& tip) {
    Symmetric<double> sum = axes::symmetric_part(axes::field_at(network.field, tip));
    for (const CertifiedPort& port : ports)
      sum = sum + largest_damping(port) * axes::outer(axes::depth(port.port->map, tip).gradient);
    return sum;
  };
}

// Places spread over the workspace; none if the device has no workspace.
std::vector<axes::Place> places_of(const AxesDevice& device, int side) {
  if (device.workspace[0].width() == 0) return {};
  return axes::places_in(device.arm, device.workspace, side);
}

// A single wall damps in one direction only, but a share is defined only for a damping that takes power in every
// direction: so 1e-9 of the largest wanted damping is added in all directions. Empty if no damping is wanted.
std::optional<axes::TipDamping> definite_at_tip(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                                                const AxesDevice& device, const std::vector<axes::Place>& places) {
  const axes::TipDamping wanted = wanted_at_tip(network, ports);
  double most = 0;
  for (const axes::Place& place : places) {
    const Symmetric<double> there = wanted(axes::pose(device.arm, place.joints).tip);
    most = std::max(most, there.xx + there.yy);
  }
  if (most == 0) return std::nullopt;
  const double everywhere = 1e-9 * most;
  return [wanted, everywhere](const Pair<double>& tip) {
    return wanted(tip) + Symmetric<double>{everywhere, 0, everywhere};
  };
}

// The damping that the ports ask of the two brakes over joint positions, each along its own direction. Only ports
// without a contact count: they damp everywhere.
Pair<Sloped> dampings_over(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                           const AxesDevice& device, const Pair<Sloped>& joints) {
  const axes::Pose<Sloped> pose = axes::pose(device.arm, joints);
  Symmetric<Sloped> at_tip = axes::symmetric_part(axes::field_at(network.field, pose.tip));
  for (const CertifiedPort& port : ports)
    if (!port.port->network.contact)
      at_tip = at_tip + Sloped(port.law->damping) * axes::outer(axes::depth(port.port->map, pose.tip).gradient);
  const Symmetric<Sloped> along =
      axes::along_brakes(axes::dual(device.brakes[0].along, device.brakes[1].along), axes::at_joints(pose, at_tip));
  return {max(Sloped(0), along.xx), max(Sloped(0), along.yy)};
}

// Whether it is known what the brakes make of the ports' damping: only for two brakes by `diagonal` without a lag.
bool is_brakes_part_known(const AxesDevice& device, axes::BrakeRule rule) {
  const bool are_prompt = std::all_of(device.brakes.begin(), device.brakes.end(),
                                      [](const AlongBrake& brake) { return brake.brake.follows_at_once(); });
  return rule == axes::BrakeRule::diagonal && device.brakes.size() == 2 && are_prompt;
}

// The damping that is there: the joints' own, plus what the brakes are known to make of the ports' damping with the
// range that `added` leaves them. With a gate the latter does not count, since the gate uses it for the coupling.
axes::GivenDamping given_by(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                            const AxesDevice& device, axes::BrakeRule rule, bool is_gated,
                            const std::vector<double>& added) {
  Symmetric<double> own{device.mechanics.damping[0], 0, device.mechanics.damping[1]};
  for (const AlongBrake& brake : device.brakes)
    own = own + share_at_speed(brake, device) * brake.brake.residual_damping * axes::outer(brake.along);
  const bool is_told = !is_gated && is_brakes_part_known(device, rule);
  return [&network, &ports, &device, own, is_told, added](const Pair<Sloped>& joints) {
    Symmetric<Sloped> sum{Sloped(own.xx), Sloped(own.xy), Sloped(own.yy)};
    if (!is_told) return sum;
    const Pair<Sloped> dampings = dampings_over(network, ports, device, joints);
    for (std::size_t k = 0; k < 2; ++k) {
      const AlongBrake& brake = device.brakes[k];
      sum = sum + Sloped(assured_share(brake, device) * (1 - 1e-12)) *
                      within_brake(dampings[k], brake.brake, added[k]) *
                      axes::outer(axes::constant<Sloped>(brake.along));
    }
    return sum;
  };
}

// y with y Σ (1 − ε_k) a_k a_kᵀ ≥ x W, over all brakes alike.
std::vector<double> addition(const AxesDevice& device, const Pair<double>& weight, double x) {
  Symmetric<double> made{0, 0, 0};
  for (const AlongBrake& brake : device.brakes) made = made + assured_share(brake, device) * axes::outer(brake.along);
  const bool is_one_a_joint = device.brakes.size() == 2 && are_along_joints(device) && made.xx > 0 && made.yy > 0;
  std::vector<double> added;
  const double alike = x * axes::eigenvalues(Symmetric<double>{weight[0], 0, weight[1]}, made)[1];
  for (const AlongBrake& brake : device.brakes) {
    const std::size_t joint = brake.along[0] != 0 ? 0 : 1;
    const double length = brake.along[joint] * brake.along[joint];
    const double own = is_one_a_joint ? x * weight[joint] / (assured_share(brake, device) * length) : alike;
    added.push_back(own * (1 + 1e-12));
  }
  return added;
}

// The largest damping at the tip: vᵀ J⁻ᵀ B J⁻¹ v with the brakes' matrix B, over all unit vectors v and the workspace.
double largest_at_tip(const std::vector<double>& dampings, const AxesDevice& device) {
  double largest = 0;
  for (const axes::Place& place : axes::places_in(device.arm, device.workspace, places_a_side)) {
    const auto [first, second] = axes::pose(device.arm, place.joints).column;
    const double determinant = first[0] * second[1] - first[1] * second[0];
    Symmetric<double> there{0, 0, 0};
    for (std::size_t k = 0; k < dampings.size(); ++k) {
      if (device.brakes[k].brake.kind == brake_kind::none) continue;
      const Pair<double>& along = device.brakes[k].along;
      const Pair<double> turn = {(along[0] * second[1] - along[1] * first[1]) / determinant,
                                 (along[1] * first[0] - along[0] * second[0]) / determinant};
      there = there + dampings[k] * axes::outer(turn);
    }
    largest = std::max(largest, axes::eigenvalues(there, Symmetric<double>{1, 0, 1})[1]);
  }
  return largest;
}

// x W as a number for each joint.
std::string at_joints(double x, const AxesCertificate& c, const AxesDevice& device) {
  if (device.arm.kind == axes::Kinematics::cartesian) return fmt::format("{:.6g} N·s/m", x);
  return fmt::format("{:.6g} and {:.6g} N·m·s/rad", x * c.weight[0], x * c.weight[1]);
}

// A coordinate in millimetres; less than a nanometre counts as 0.
double in_millimetres(double place) { return 1e3 * (std::abs(place) < 1e-9 ? 0 : place); }

// Why it is not known how far the joints move while a force is held; empty if it is known.
std::string unknown_travel(const AxesDevice& device) {
  for (const device_description& joint : device.joints)
    if (joint.encoder.max_speed == 0)
      return "the encoders state no \"max_speed\", which bounds how far the joints go while a force is held";
  return "";
}

// Empty where every port has a bound.
std::string unproved(const std::vector<CertifiedPort>& ports) {
  for (const CertifiedPort& port : ports) {
    // On one axis a contact is not proved if the brake is off while the tool is free. Here the needed damping is added
    // at all times, so that the bound counts.
    if (port.certificate->bound.proof == Proof::none && !(port.certificate->bound.needed > 0))
      return fmt::format("port '{}': {}", port.port->name, port.certificate->bound.reason);
    if (compensates(*port.law))
      return fmt::format("port '{}': the motor follows the estimated velocity, which no bound covers yet",
                         port.port->name);
  }
  return "";
}

bool damps(const CertifiedPort& port) { return largest_damping(port) > 0; }

// Whether the port's damping takes values between its least and its largest: bounds of R at the two ends do not then
// cover it.
bool varies(const CertifiedPort& port) { return port.law->brake_changes() && port.form->has_slips(); }

// The loop of a joint whose commands come late, if there is one.
std::optional<SampledLoop> late_loop(const AxesDevice& device) {
  for (const device_description& joint : device.joints)
    if (const SampledLoop loop = loop_of_joint(joint); loop.is_late()) return loop;
  return std::nullopt;
}

std::string uncovered_in_device(const AxesDevice& device) {
  for (const device_description& joint : device.joints)
    if (joint.motor.slew > 0) return "the motors' slew is limited, which no bound of two axes covers yet";
  if (loop_of_joint(device.joints[0]).may_overtake()) return overtaken;
  for (const device_description& joint : device.joints)
    if (!std::isfinite(time_of_lateness(loop_of_joint(joint))))
      return "the motors' amplifiers lag, and the jitter is a sample or more";
  return "";
}

std::string uncovered_in_ports(const std::vector<CertifiedPort>& ports, const AxesDevice& device) {
  const std::optional<SampledLoop> late = late_loop(device);
  for (const CertifiedPort& port : ports) {
    const std::string of_port = fmt::format("port '{}': ", port.port->name);
    if (varies(port)) return of_port + "its damping changes with its slips, which no bound of two axes covers yet";
    if (!port.slips || !late) continue;
    if (const std::string why = uncovered_when_late(*port.slips, *late); !why.empty()) return of_port + why;
  }
  return "";
}

// γ with ‖v̂‖ ≤ γ ‖Δq/h‖ for both joints; 0 if the motors follow no estimate. Empty if it is not known.
std::optional<double> gain_of_estimates(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                                        const AxesDevice& device) {
  if (!network.has_field() && std::none_of(ports.begin(), ports.end(), damps)) return 0;
  double most = 0;
  for (const device_description& joint : device.joints) {
    const std::optional<double> gain = estimate_gain(loop_of_joint(joint));
    if (!gain) return std::nullopt;
    most = std::max(most, *gain);
  }
  return most;
}

// What a network asks for on all devices that differ only in the brakes' limits and the joints' own damping.
struct Asked {
  const AxesNetwork& network;
  const std::vector<CertifiedPort>& ports;
  axes::BrakeRule rule;
  Pair<double> weight;
  double for_each = 0;  // damping needed for each unit of damping that motors make from estimates [1]
  double contacts = 0;  // Σ κ ‖g gᵀ‖ of contacts that end by an estimate κ g·v̂ [N·s/m]
  double for_lag = 0;   // [N·s/m]
};

std::vector<axes::PortLoad> loads_of(const Asked& asked, const AxesDevice& device) {
  std::vector<axes::PortLoad> loads;
  for (const CertifiedPort& port : asked.ports) loads.push_back(load_of(port, device.loop().sample_period));
  return loads;
}

// The damping that held forces need beyond `given`.
axes::NeededDamping needed_beside(const axes::GivenDamping& given, const Asked& asked, const AxesDevice& device,
                                  int parts = axes::most_boxes) {
  return axes::needed_damping(device.arm, device.workspace, loads_of(asked, device), loop_of(device), asked.weight,
                              given, axes::bound_tolerance, parts);
}

// γ T/h, with γ = 1 if it is not known.
double for_each_estimate(const AxesDevice& device, const std::optional<double>& gain) {
  return gain.value_or(1) * loop_of(device).longest_period / device.loop().sample_period * (1 + 1e-12);
}

// The part of the ports' and the field's damping that the motors make from estimates, if `added` of the brakes' range
// is used up. With a gate, the coupling of the brakes is left out.
axes::Size remainder_beside(const std::vector<double>& added, const Asked& asked, const AxesDevice& device,
                            bool is_gated, int parts) {
  std::vector<axes::PortDamping> dampings;
  for (const CertifiedPort& port : asked.ports)
    if (damps(port))
      dampings.push_back({port.port->map, largest_damping(port), port.port->network.contact.has_value()});
  std::vector<axes::Brake> brakes = brakes_of(device);
  for (std::size_t k = 0; k < brakes.size(); ++k)
    if (brakes[k].most < axes::unlimited) brakes[k].most = std::max(brakes[k].most - added[k], 0.0);
  const axes::ViscousField& field = asked.network.field;
  if (is_gated)
    return axes::largest_uncoupled_remainder(device.arm, device.workspace, dampings, field, {brakes[0], brakes[1]},
                                             asked.weight, parts);
  const axes::Size turning = field.is_symmetric()
                                 ? axes::Size{0, 0}
                                 : axes::largest_curl(device.arm, device.workspace, field, asked.weight, parts);
  const axes::Size rest =
      axes::largest_remainder(device.arm, device.workspace, dampings, field, brakes, asked.rule, asked.weight, parts);
  return {turning.most + rest.most, turning.attained + rest.attained};
}

// Why the damping that the ports' forces need is not bounded.
std::string why_unbounded(const Asked& asked, const AxesDevice& device) {
  axes::SampledLoop still = loop_of(device);
  still.reach = {0, 0};
  const axes::NeededDamping needed =
      axes::needed_damping(device.arm, device.workspace, loads_of(asked, device), still, asked.weight, {});
  if (!std::isfinite(needed.proved)) return "the workspace bounds no force of a port";
  return "while a torque is held the joints may go on, at the encoders' \"max_speed\", to where the arm does not reach "
         "or is singular";
}

// Bounds for a port over the workspace.
struct PortSize {
  double gradient = 0;  // ‖g gᵀ‖ [1]
  double turning = 0;   // ‖M H‖ [N/m]
};

constexpr int rough_parts = 500;  // parts of the workspace, for bounds that no added damping depends on

std::vector<PortSize> sizes_of(const Asked& asked, const AxesDevice& device, bool is_late) {
  const std::vector<axes::PortLoad> loads = loads_of(asked, device);
  std::vector<PortSize> sizes;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const int parts = is_late || follows(asked.ports[i]) > 0 ? axes::most_boxes : rough_parts;
    sizes.push_back(
        {axes::largest_gradient(device.arm, device.workspace, loads[i].map, asked.weight, parts).most,
         axes::largest_turning(device.arm, device.workspace, loads[i], asked.weight, is_late ? parts : rough_parts)
             .most});
  }
  return sizes;
}

// K of a port: the error of its force is at most K times the error of its depth [N/m]. With slips this holds only if an
// encoder step alone makes none of them give way, which is not checked here.
std::optional<double> gain_of_steps(const CertifiedPort& port, const AxesDevice& device) {
  if (port.form->has_slips()) return std::nullopt;
  if (!port.slips) return port.certificate->quantisation_gain;
  double most = 0;
  for (const device_description& joint : device.joints) {
    const auto gain = quantisation_gain(linear_motor_constants(*port.law), *port.slips, loop_of_joint(joint));
    if (!gain) return std::nullopt;
    most = std::max(most, *gain);
  }
  return most;
}

// At each joint ½ √W_j √(Σ W_l Δ_l²) (Σ K ‖g gᵀ‖ + ‖M H‖ + ‖R‖ P), with encoder steps Δ and the estimators' largest
// response P to a step; empty if that is not bounded.
std::optional<Pair<double>> torque_of_steps(const std::vector<double>& added, const std::vector<PortSize>& sizes,
                                            const Asked& asked, const AxesDevice& device) {
  double stiffness = 0, pulse = 0, step = 0;
  for (std::size_t i = 0; i < asked.ports.size(); ++i) {
    const std::optional<double> gain = gain_of_steps(asked.ports[i], device);
    if (!gain) return std::nullopt;
    stiffness += *gain * sizes[i].gradient + sizes[i].turning;
  }
  for (std::size_t j = 0; j < 2; ++j) {
    const device_description& joint = device.joints[j];
    const std::optional<double> of_joint = asked.for_each > 0 ? estimate_pulse(loop_of_joint(joint)) : 0;
    if (!of_joint) return std::nullopt;
    pulse = std::max(pulse, *of_joint);
    step = std::hypot(step, std::sqrt(asked.weight[j]) * joint.encoder.step);
  }
  if (pulse > 0) stiffness += pulse * remainder_beside(added, asked, device, false, rough_parts).most;
  if (!std::isfinite(stiffness)) return std::nullopt;
  const double alike = stiffness * step / 2 * (1 + 1e-12);
  return Pair<double>{std::sqrt(asked.weight[0]) * alike, std::sqrt(asked.weight[1]) * alike};
}

// The damping that held forces need beyond what is there before anything is added.
axes::NeededDamping rest_beside(bool is_gated, const Asked& asked, const AxesDevice& device,
                                int parts = axes::most_boxes) {
  const std::vector<double> none(device.brakes.size(), 0);
  return needed_beside(given_by(asked.network, asked.ports, device, asked.rule, is_gated, none), asked, device, parts);
}

// The largest addition that a brake can be told to make.
double most_added(const brake_description& brake) {
  return brake.kind == brake_kind::none ? axes::infinity : std::max(0.0, brake.max_damping - brake.residual_damping);
}

// Whether the brakes can give an addition at all.
bool is_within_reach(const std::vector<double>& added, const AxesDevice& device) {
  for (std::size_t k = 0; k < device.brakes.size(); ++k)
    if (added[k] > most_added(device.brakes[k].brake)) return false;
  return true;
}

// Which end of a bound to use: the proved upper end, or the lower end that some place of the workspace attains.
enum class End { proved, attained };

struct Added {
  std::vector<double> to_brakes;  // as far as they reach [N·m·s/rad] or [N·s/m]
  double for_estimates = 0;       // [N·s/m]
  double missing = 0;             // [N·s/m]
  bool is_enough = false;
};

constexpr int most_rounds = 12;

// An addition leaves the brakes less range for the ports' damping, so that the motors have more to do and more must be
// added. A few rounds find the balance, or there is none.
Added added_for(double rest, const Asked& asked, const AxesDevice& device, bool is_gated, End end = End::proved,
                int parts = axes::most_boxes) {
  Added result;
  std::vector<double>& added = result.to_brakes;
  added.assign(device.brakes.size(), 0);
  for (int round = 0; round < most_rounds && !result.is_enough; ++round) {
    axes::Size remainder{0, 0};
    if (asked.for_each > 0) remainder = remainder_beside(added, asked, device, is_gated, parts);
    result.for_estimates =
        asked.for_each * ((end == End::proved ? remainder.most : remainder.attained) + asked.contacts);
    result.missing = std::max(0.0, rest + result.for_estimates + asked.for_lag);
    const std::vector<double> wanted = result.missing > 0 ? addition(device, asked.weight, result.missing) : added;
    result.is_enough = std::equal(wanted.begin(), wanted.end(), added.begin(), std::less_equal<>());
    if (result.is_enough) break;
    added = wanted;
    if (!is_within_reach(added, device)) break;
    // A little more than is asked for, so that the rounds come to an end.
    for (double& damping : added) damping *= 1 + 1e-3;
  }
  result.is_enough = result.is_enough && std::isfinite(result.missing) && is_within_reach(added, device);
  for (std::size_t k = 0; k < added.size(); ++k) added[k] = std::min(added[k], most_added(device.brakes[k].brake));
  return result;
}

}  // namespace

bool AxesCertificate::adds() const {
  return std::any_of(added.begin(), added.end(), [](double damping) { return damping > 0; });
}

std::vector<axes::Brake> brakes_of(const AxesDevice& device) {
  std::vector<axes::Brake> brakes;
  for (const AlongBrake& brake : device.brakes) {
    brakes.push_back({brake.along});
    if (brake.brake.kind != brake_kind::none) brakes.back().most = brake.brake.max_damping;
  }
  return brakes;
}

std::optional<axes::ShareMap> share_of(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                                       const AxesDevice& device, axes::BrakeRule rule) {
  const std::vector<axes::Place> places = places_of(device, places_a_side);
  const std::optional<axes::TipDamping> wanted = definite_at_tip(network, ports, device, places);
  if (!wanted) return std::nullopt;
  const axes::ShareMap share = axes::share_map(device.arm, places, brakes_of(device), rule, *wanted);
  return std::isfinite(share.mean) ? std::optional(share) : std::nullopt;
}

std::vector<PlacedShare> shares_over(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                                     const AxesDevice& device, axes::BrakeRule rule, int side) {
  const std::vector<axes::Place> places = places_of(device, side);
  const std::optional<axes::TipDamping> wanted = definite_at_tip(network, ports, device, places);
  if (!wanted) return {};
  const std::vector<axes::Brake> brakes = brakes_of(device);
  std::vector<PlacedShare> shares;
  for (const axes::Place& place : places)
    shares.push_back(
        {axes::pose(device.arm, place.joints).tip, axes::share_at(device.arm, place.joints, brakes, rule, *wanted)});
  return shares;
}

namespace {

AxesCertificate certified_with(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                               const AxesDevice& device, axes::BrakeRule rule, bool is_gated) {
  AxesCertificate c;
  c.added.assign(device.brakes.size(), 0);
  if (device.workspace[0].width() == 0) {
    c.reason = "no device is named, and so no workspace";
    return c;
  }
  c.share = share_of(network, ports, device, rule);
  c.weight = weight_of(device.arm);
  c.reason = unknown_travel(device);
  if (c.reason.empty()) {
    c.reason = unproved(ports);
    c.lies_in_port = !c.reason.empty();
  }
  if (!c.reason.empty()) return c;
  const std::optional<double> gain = gain_of_estimates(network, ports, device);
  Asked asked{network, ports, rule, c.weight, for_each_estimate(device, gain)};
  const axes::NeededDamping whole = needed_beside({}, asked, device);
  c.is_proved = std::isfinite(whole.proved);
  if (!c.is_proved) {
    c.reason = why_unbounded(asked, device);
    return c;
  }
  double lag = 0, springs = 0;  // Σ S ‖g gᵀ‖ + ½ ‖M H‖
  for (const device_description& joint : device.joints) lag = std::max(lag, time_of_lateness(loop_of_joint(joint)));
  const std::vector<PortSize> sizes = sizes_of(asked, device, lag > 0);
  const std::vector<axes::PortLoad> loads = loads_of(asked, device);
  for (std::size_t i = 0; i < ports.size(); ++i) {
    c.contacts += follows(ports[i]) * sizes[i].gradient;
    springs += loads[i].held * sizes[i].gradient + sizes[i].turning / 2;
  }
  if (lag > 0) c.for_lag = lag * springs;
  asked.contacts = c.contacts, asked.for_lag = c.for_lag;
  const axes::NeededDamping rest = rest_beside(is_gated, asked, device);
  c.least_rest = rest.attained;
  const Added found = added_for(rest.proved, asked, device, is_gated);
  c.added = found.to_brakes;
  c.for_estimates = found.for_estimates;
  c.missing = found.missing;
  c.needed = whole.proved + c.for_estimates + c.for_lag;
  c.worst = axes::pose(device.arm, rest.joints).tip;
  c.torque_of_steps = torque_of_steps(c.added, sizes, asked, device);
  c.uncovered = uncovered_in_device(device);
  if (c.uncovered.empty()) {
    c.uncovered = uncovered_in_ports(ports, device);
    c.lies_in_port = !c.uncovered.empty();
  }
  if (c.uncovered.empty() && !gain)
    c.uncovered = "nothing is known of the gain of the velocity estimator, which the motors follow";
  c.certified = found.is_enough && c.uncovered.empty();
  if (c.adds()) c.added_at_tip = largest_at_tip(c.added, device);
  return c;
}

}  // namespace

AxesCertificate certify_axes(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                             const AxesDevice& device, axes::BrakeRule rule) {
  if (network.field.is_symmetric()) return certified_with(network, ports, device, rule, false);
  std::string why = why_no_gate(device, rule);
  if (why.empty()) {
    AxesCertificate gated = certified_with(network, ports, device, rule, true);
    gated.gate = curl_gate(device, gated.added, network.field);
    if (gated.gate) {
      gated.passage = gate_passage(*gated.gate, device, gated.added, network.field);
      return gated;
    }
    why = "somewhere in the workspace a brake makes nothing of the field";
  }
  AxesCertificate ungated = certified_with(network, ports, device, rule, false);
  ungated.why_no_gate = why;
  return ungated;
}

namespace {

Asked asked_like(const AxesCertificate& like, const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                 const AxesDevice& device, axes::BrakeRule rule) {
  const double for_each = for_each_estimate(device, gain_of_estimates(network, ports, device));
  return {network, ports, rule, like.weight, for_each, like.contacts, like.for_lag};
}

// Uses a gate where certify_axes() would.
template <class AddedWith>
Added settled(const Asked& asked, const AxesDevice& device, const AddedWith& added_with) {
  const axes::ViscousField& field = asked.network.field;
  if (!field.is_symmetric() && why_no_gate(device, asked.rule).empty()) {
    const Added gated = added_with(true);
    if (curl_gate(device, gated.to_brakes, field)) return gated;
  }
  return added_with(false);
}

// A lower bound of what held forces need, on a device that differs in the joints' own damping only, or also in the
// brakes' limits if the damping that is there does not depend on them.
std::optional<double> least_rest(const AxesDevice& device, const AxesDevice& was, const AxesCertificate& like,
                                 bool is_gated, axes::BrakeRule rule) {
  bool is_alike = like.gate.has_value() == is_gated;
  if (!is_gated && is_brakes_part_known(device, rule))
    for (std::size_t k = 0; k < device.brakes.size(); ++k)
      is_alike = is_alike && device.brakes[k].brake.max_damping == was.brakes[k].brake.max_damping;
  if (!is_alike) return std::nullopt;
  double more = 0;
  for (std::size_t j = 0; j < 2; ++j)
    more = std::max(more, (device.mechanics.damping[j] - was.mechanics.damping[j]) / like.weight[j]);
  return like.least_rest - more;
}

}  // namespace

bool may_be_certified(const AxesNetwork& network, const std::vector<CertifiedPort>& ports, const AxesDevice& device,
                      axes::BrakeRule rule, const AxesCertificate& like, const AxesDevice& was) {
  constexpr int some_parts = 250, some_of_motors = 60;
  const Asked asked = asked_like(like, network, ports, device, rule);
  const auto added_with = [&](bool is_gated) {
    const std::optional<double> known = least_rest(device, was, like, is_gated, rule);
    const double rest = known ? *known : rest_beside(is_gated, asked, device, some_parts).attained;
    return added_for(rest, asked, device, is_gated, End::attained, some_of_motors);
  };
  return settled(asked, device, added_with).is_enough;
}

bool would_be_certified(const AxesNetwork& network, const std::vector<CertifiedPort>& ports, const AxesDevice& device,
                        axes::BrakeRule rule, const AxesCertificate& like) {
  const Asked asked = asked_like(like, network, ports, device, rule);
  const auto added_with = [&](bool is_gated) {
    return added_for(rest_beside(is_gated, asked, device).proved, asked, device, is_gated);
  };
  return settled(asked, device, added_with).is_enough;
}

std::string why_not_certified(const AxesCertificate& c, const AxesDevice& device) {
  if (!c.is_proved) return c.reason;
  if (!c.uncovered.empty()) return c.uncovered;
  if (!std::isfinite(c.missing)) return "it needs more damping at the joints than can be computed";
  return at_joints(c.missing, c, device) + " of damping are missing at the joints, more than its brakes have left";
}

namespace {

// Says how a field with an antisymmetric part is kept passive; empty for other fields.
std::vector<std::string> curl_lines(const AxesCertificate& c, const AxesDevice& device) {
  if (c.gate) {
    const GatePassage& passage = *c.passage;
    const std::string least =
        passage.least == 1 || passage.least == passage.mean
            ? ""
            : fmt::format(", {:.3g} % at least, at ({:.4g}, {:.4g}) mm", 100 * passage.least,
                          in_millimetres(passage.least_at[0]), in_millimetres(passage.least_at[1]));
    return {fmt::format(
        "  the field pushes across the motion: the motors make that part, and a torque limiter (gate) keeps it to "
        "what the brakes' own share of the field dissipates: {:.3g} % of it on average over the {}{}, while "
        "the tool moves slowly",
        100 * passage.mean, device.workspace[0].width() > 0 ? "workspace" : "field", least)};
  }
  if (c.why_no_gate.empty()) return {};
  return {fmt::format(
      "  the field pushes across the motion: the motors make that part in full, and damping that is added for "
      "estimated velocities pays for it; no torque limiter (gate) keeps it to what the brakes dissipate, "
      "because {}",
      c.why_no_gate)};
}

// Empty where no motor has a limit.
std::string limits_of_motors(const AxesDevice& device) {
  std::string text;
  for (const device_description& joint : device.joints)
    if (joint.motor.max_torque > 0)
      text += fmt::format("{}{:.4g}", text.empty() ? "" : " and ", joint.motor.max_torque);
  return text.empty() ? text : text + " " + port_units(device.joint_motion()).force;
}

}  // namespace

std::vector<std::string> passivity_lines(const AxesCertificate& c, const AxesDevice& device) {
  if (!c.is_proved) {
    std::vector<std::string> lines = curl_lines(c, device);
    lines.insert(lines.begin(), "passivity: nothing is proved: " + c.reason);
    return lines;
  }
  if (!std::isfinite(c.missing)) return {"passivity: not certified, since " + why_not_certified(c, device)};
  std::vector<std::string> lines;
  lines.push_back(fmt::format(
      "passivity: {}: the torques that the motors hold from one sample to the next need {} of damping at "
      "the joints; after the joints' own damping{}, {} of it are still missing, most at ({:.4g}, {:.4g}) mm",
      c.certified ? "certified for any motion in the workspace, as long as no motor is at its limit"
                  : "not certified, since " + why_not_certified(c, device),
      at_joints(c.needed, c, device), c.gate ? "" : " and the brakes' share of the network's",
      at_joints(c.missing, c, device), in_millimetres(c.worst[0]), in_millimetres(c.worst[1])));
  if (const std::string limits = limits_of_motors(device); !limits.empty())
    lines.push_back(
        "  the motors make up to " + limits +
        "; where the law asks for more, each makes what it can, nothing is proved, and the hand may get energy: "
        "'dashpot run' says in how many samples");
  if (c.for_estimates > 0)
    lines.push_back(fmt::format(
        "  {} of the needed damping are for torques computed from estimated velocities, however late these are",
        at_joints(c.for_estimates, c, device)));
  if (c.for_lag > 0)
    lines.push_back(fmt::format("  {} of the needed damping are for {}", at_joints(c.for_lag, c, device),
                                device.loop().write_latest > 0 ? "torques that come after their samples"
                                                               : "the lag of the motors' amplifiers"));
  const std::vector<std::string> of_curl = curl_lines(c, device);
  lines.insert(lines.end(), of_curl.begin(), of_curl.end());
  const std::string unit = port_units(device.joint_motion()).damping;
  std::string added;
  for (std::size_t k = 0; k < c.added.size(); ++k) added += fmt::format("{}{:.6g}", k == 0 ? "" : ", ", c.added[k]);
  if (c.share)
    lines.push_back(
        fmt::format("  in {:.3g} % of the workspace, the damping that the motors make from velocity estimates stays "
                    "passive for any delay that both joints share",
                    100 * c.share->delay_proof));
  if (c.adds())
    lines.push_back(fmt::format("  added to the brakes' commands: {} {}{}; felt at the tip as up to {:.3g} N s/m more",
                                added, unit, c.certified ? "" : ", all that they can give", c.added_at_tip));
  return lines;
}

namespace {

// Says how much of the energy that the encoders' steps bring in is taken by friction; empty if the encoders have no
// steps or nothing is proved.
std::string steps_line(const AxesCertificate& c, const AxesDevice& device) {
  const auto has_steps = [](const device_description& joint) { return joint.encoder.step > 0; };
  if (!c.is_proved || std::none_of(device.joints.begin(), device.joints.end(), has_steps)) return "";
  if (!c.torque_of_steps)
    return "encoder steps: the energy that they bring in by the motors is not bounded, and not counted";
  const Pair<double>&most = *c.torque_of_steps, &friction = device.mechanics.coulomb_friction;
  const PortUnits units = port_units(device.joint_motion());
  std::string text = fmt::format(
      "encoder steps: in what the motors make they come to no more than {:.3g} and {:.3g} {} at the joints; ", most[0],
      most[1], units.force);
  if (friction[0] > 0 || friction[1] > 0)
    text += fmt::format("friction of {:.3g} and {:.3g} {} there takes what that gives, a brake none of it", friction[0],
                        friction[1], units.force);
  else text += "the device file states no Coulomb friction, which would take what that gives; a brake does not";
  const Pair<double> beyond{std::max(most[0] - friction[0], 0.0), std::max(most[1] - friction[1], 0.0)};
  if (beyond[0] > 0 || beyond[1] > 0)
    text += fmt::format("; what is beyond can give the hand {:.3g} and {:.3g} J per {} of a joint's travel", beyond[0],
                        beyond[1], units.position);
  return text;
}

}  // namespace

std::vector<std::string> explained_lines(const AxesCertificate& certificate, const AxesDevice& device) {
  std::vector<std::string> lines = passivity_lines(certificate, device);
  const std::string steps = steps_line(certificate, device);
  if (!steps.empty()) lines.push_back(steps);
  return lines;
}

}  // namespace dashpot::compiler
