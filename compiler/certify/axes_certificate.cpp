#include "certify/axes_certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

using axes::Pair;
using axes::Sloped;
using axes::Symmetric;

constexpr int places_a_side = 40;  // of the workspace, where shares are told

bool compensates(const UpdateLaw& law) {
  return std::any_of(law.coefficients.begin(), law.coefficients.end(), [](const Coefficient& c) {
    return c.role == ConstantRole::velocity_gain &&
           std::any_of(c.values.begin(), c.values.end(), [](double value) { return value != 0; });
  });
}

double sum_of_yields(const Network& network) {
  double sum = 0;
  for (const Element& element : network.elements)
    if (const auto* slip = std::get_if<Slip>(&element.law)) sum += slip->yield_force;
  return sum;
}

axes::PortLoad load_of(const CertifiedPort& port, double sample_period) {
  axes::PortLoad load;
  load.map = port.port->map;
  load.held = port.certificate->bound.needed / sample_period;
  load.grounded = to_double(port.form->linear.static_stiffness);
  for (const Mode& mode : port.form->linear.modes) load.relaxing += to_double(mode.stiffness);
  load.yields = sum_of_yields(port.port->network);
  load.unilateral = port.port->network.contact.has_value();
  return load;
}

// Both joints' fastest rates over a hold, and one more for each sample of delay.
axes::SampledLoop loop_of(const AxesDevice& device) {
  axes::SampledLoop loop;
  loop.longest_period = device.loop().sample_period + device.loop().jitter;
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

// At the fastest that the joints go.
double assured_share(const AlongBrake& brake, const AxesDevice& device) {
  double fastest = 0;
  for (std::size_t i = 0; i < 2; ++i) fastest += std::abs(brake.along[i]) * device.joints[i].encoder.max_speed;
  const double turn = brake.brake.critical_speed > 0 ? fastest / brake.brake.critical_speed : 0;
  return (1 - brake.brake.tolerance) / (1 + turn * turn);
}

// The damping that is wanted at the tip where all ports are pushed.
axes::TipDamping wanted_at_tip(const AxesNetwork& network, const std::vector<CertifiedPort>& ports) {
  return [&network, ports](const Pair<double>& tip) {
    const double mixed = (network.viscous[0][1] + network.viscous[1][0]) / 2;
    Symmetric<double> sum{network.viscous[0][0], mixed, network.viscous[1][1]};
    for (const CertifiedPort& port : ports)
      sum = sum + std::max(port.law->damping, port.law->largest_damping) *
                      axes::outer(axes::depth(port.port->map, tip).gradient);
    return sum;
  };
}

// What of the ports' damping the two brakes make over joint positions, each along its own direction: of ports without a
// contact, which damp everywhere.
Pair<Sloped> dampings_over(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                           const AxesDevice& device, const Pair<Sloped>& joints) {
  const axes::Pose<Sloped> pose = axes::pose(device.arm, joints);
  const double mixed = (network.viscous[0][1] + network.viscous[1][0]) / 2;
  Symmetric<Sloped> at_tip{Sloped(network.viscous[0][0]), Sloped(mixed), Sloped(network.viscous[1][1])};
  for (const CertifiedPort& port : ports)
    if (!port.port->network.contact)
      at_tip = at_tip + Sloped(port.law->damping) * axes::outer(axes::depth(port.port->map, pose.tip).gradient);
  const Symmetric<Sloped> along =
      axes::along_brakes(axes::dual(device.brakes[0].along, device.brakes[1].along), axes::at_joints(pose, at_tip));
  return {max(Sloped(0), along.xx), max(Sloped(0), along.yy)};
}

// What is there: the joints' own damping, and of the ports' damping what two brakes make of it by `diagonal`, if they
// follow their commands at once.
axes::GivenDamping given_by(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                            const AxesDevice& device, axes::BrakeRule rule) {
  Symmetric<double> own{device.mechanics.damping[0], 0, device.mechanics.damping[1]};
  for (const AlongBrake& brake : device.brakes) own = own + brake.brake.residual_damping * axes::outer(brake.along);
  const bool is_late = std::any_of(device.brakes.begin(), device.brakes.end(), [](const AlongBrake& brake) {
    return brake.brake.coil_lag > 0 || brake.brake.slew > 0;
  });
  const bool is_told = rule == axes::BrakeRule::diagonal && device.brakes.size() == 2 && !is_late;
  return [&network, &ports, &device, own, is_told](const Pair<Sloped>& joints) {
    Symmetric<Sloped> sum{Sloped(own.xx), Sloped(own.xy), Sloped(own.yy)};
    if (!is_told) return sum;
    const Pair<Sloped> dampings = dampings_over(network, ports, device, joints);
    for (std::size_t k = 0; k < 2; ++k) {
      const AlongBrake& brake = device.brakes[k];
      const Sloped damping =
          brake.brake.kind == brake_kind::none ? dampings[k] : min(dampings[k], Sloped(brake.brake.max_damping));
      sum = sum + Sloped(assured_share(brake, device) * (1 - 1e-12)) * damping *
                      axes::outer(axes::constant<Sloped>(brake.along));
    }
    return sum;
  };
}

// y with y Σ (1 − ε_k) a_k a_kᵀ ≥ x W, over all brakes alike.
std::vector<double> addition(const AxesDevice& device, const Pair<double>& weight, double x) {
  Symmetric<double> made{0, 0, 0};
  for (const AlongBrake& brake : device.brakes) made = made + assured_share(brake, device) * axes::outer(brake.along);
  const bool is_along_joints = made.xy == 0 && device.brakes.size() == 2;
  std::vector<double> added;
  const double alike = x * axes::eigenvalues(Symmetric<double>{weight[0], 0, weight[1]}, made)[1];
  for (const AlongBrake& brake : device.brakes) {
    const std::size_t joint = brake.along[0] != 0 ? 0 : 1;
    const double length = brake.along[joint] * brake.along[joint];
    const double own = is_along_joints ? x * weight[joint] / (assured_share(brake, device) * length) : alike;
    added.push_back(own * (1 + 1e-12));
  }
  return added;
}

// Empty where every port has a bound.
std::string unproved(const std::vector<CertifiedPort>& ports, const AxesDevice& device) {
  for (const device_description& joint : device.joints)
    if (joint.encoder.max_speed == 0)
      return "the encoders state no \"max_speed\", which bounds how far the joints go while a force is held";
  for (const CertifiedPort& port : ports) {
    // A contact is not proved on one axis where the brake leaves a free tool alone; here what is needed is always
    // there.
    if (port.certificate->bound.proof == Proof::none && !(port.certificate->bound.needed > 0))
      return fmt::format("port '{}': {}", port.port->name, port.certificate->bound.reason);
    if (compensates(*port.law))
      return fmt::format("port '{}': the motor follows the estimated velocity, which no bound covers yet",
                         port.port->name);
  }
  return "";
}

std::string what_is_uncovered(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                              const AxesDevice& device) {
  for (const device_description& joint : device.joints) {
    if (joint.motor.amplifier_lag > 0) return "the motors' amplifiers lag, which no bound of two axes covers yet";
    if (joint.motor.slew > 0) return "the motors' slew is limited, which no bound of two axes covers yet";
  }
  const bool damps = network.has_field() || std::any_of(ports.begin(), ports.end(), [](const CertifiedPort& port) {
                       return port.law->largest_damping > 0;
                     });
  return damps ? "what the brakes leave of the ports' damping the motors make from estimates, which no bound of two "
                 "axes covers yet between samples"
               : "";
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
  if (device.workspace[0].width() == 0) return std::nullopt;
  const std::vector<axes::Place> places = axes::places_in(device.arm, device.workspace, places_a_side);
  if (places.empty()) return std::nullopt;
  const axes::TipDamping wanted = wanted_at_tip(network, ports);
  double most = 0;
  for (const axes::Place& place : places) {
    const Symmetric<double> there = wanted(axes::pose(device.arm, place.joints).tip);
    most = std::max(most, there.xx + there.yy);
  }
  if (most == 0) return std::nullopt;
  // A share is told of what takes power in every direction; a single wall does so by this much.
  const double everywhere = 1e-9 * most;
  const axes::TipDamping definite = [&](const Pair<double>& tip) {
    return wanted(tip) + Symmetric<double>{everywhere, 0, everywhere};
  };
  return axes::share_map(device.arm, places, brakes_of(device), rule, definite);
}

AxesCertificate certify_axes(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                             const AxesDevice& device, axes::BrakeRule rule) {
  AxesCertificate c;
  c.added.assign(device.brakes.size(), 0);
  if (device.workspace[0].width() == 0) {
    c.reason = "no device is named, and so no workspace";
    return c;
  }
  c.share = share_of(network, ports, device, rule);
  c.weight = weight_of(device.arm);
  if (const std::string reason = unproved(ports, device); !reason.empty()) {
    c.reason = reason;
    return c;
  }
  std::vector<axes::PortLoad> loads;
  for (const CertifiedPort& port : ports) loads.push_back(load_of(port, device.loop().sample_period));
  const axes::SampledLoop loop = loop_of(device);
  const auto needed_beside = [&](const axes::GivenDamping& given) {
    return axes::needed_damping(device.arm, device.workspace, loads, loop, c.weight, given);
  };
  const axes::NeededDamping whole = needed_beside({}), rest = needed_beside(given_by(network, ports, device, rule));
  c.is_proved = std::isfinite(whole.proved);
  c.needed = whole.proved, c.missing = std::max(0.0, rest.proved);
  c.worst = axes::pose(device.arm, rest.joints).tip;
  if (!c.is_proved) {
    c.reason = "the workspace bounds no force of a port";
    return c;
  }
  if (c.missing > 0) c.added = addition(device, c.weight, c.missing);
  c.takes_lateness = !c.share || c.share->delay_proof > 1 - 1e-9;
  c.uncovered = what_is_uncovered(network, ports, device);
  c.certified = c.takes_lateness && c.uncovered.empty();
  for (std::size_t k = 0; k < device.brakes.size(); ++k) {
    const brake_description& brake = device.brakes[k].brake;
    const double most = std::max(0.0, brake.max_damping - brake.residual_damping);
    if (brake.kind == brake_kind::none) continue;
    c.certified = c.certified && c.added[k] <= most;
    c.added[k] = std::min(c.added[k], most);
  }
  return c;
}

std::string why_not_certified(const AxesCertificate& c, const AxesDevice& device) {
  if (!c.is_proved) return c.reason;
  if (!c.uncovered.empty()) return c.uncovered;
  if (!c.takes_lateness)
    return "the brakes make less than half of the ports' damping somewhere in the workspace, and the motors' part "
           "follows "
           "late estimates";
  return fmt::format("{:.4g} N s/m{} is missing, more than its brakes can give", c.missing,
                     device.arm.kind == axes::Kinematics::cartesian ? "" : " times the square of each joint's link");
}

std::vector<std::string> passivity_lines(const AxesCertificate& c, const AxesDevice& device) {
  if (!c.is_proved) return {"passivity: nothing is proved: " + c.reason};
  std::vector<std::string> lines;
  lines.push_back(fmt::format(
      "passivity: {}: the forces that are held from one sample to the next need {:.6g} N·s/m{}, {:.6g} "
      "beyond the device's own damping, most at ({:.4g}, {:.4g}) mm",
      c.certified ? "certified for any motion in the workspace, while the motors make their torques"
                  : "not certified, since " + why_not_certified(c, device),
      c.needed, device.arm.kind == axes::Kinematics::cartesian ? "" : " times the square of each joint's link",
      c.missing, 1e3 * c.worst[0], 1e3 * c.worst[1]));
  const std::string unit = port_units(device.joint_motion()).damping;
  std::string added;
  for (std::size_t k = 0; k < c.added.size(); ++k) added += fmt::format("{}{:.6g}", k == 0 ? "" : ", ", c.added[k]);
  if (c.share)
    lines.push_back(
        fmt::format("  what the motors make of the ports' damping, from estimates, takes any lateness that both joints "
                    "share in {:.3g} % "
                    "of the workspace",
                    100 * c.share->delay_proof));
  if (c.adds())
    lines.push_back(fmt::format("  added to the brakes' commands for it: {} {}{}", added, unit,
                                c.certified ? "" : ", all that they can give"));
  return lines;
}

}  // namespace dashpot::compiler
