#include "compile_ports.hpp"

#include <algorithm>
#include <cmath>

#include "certify/forces_behind_slips.hpp"
#include "certify/hold_bound.hpp"
#include "certify/unproved.hpp"
#include "compile.hpp"
#include "discretise/element_names.hpp"
#include "discretise/law_writer.hpp"
#include "discretise/rounding.hpp"
#include "law/representable.hpp"
#include "lower/drop_unread.hpp"
#include "lower/parallel_law.hpp"
#include "lower/begun_at_rest.hpp"
#include "stage_times.hpp"

namespace dashpot::compiler {
namespace {

// What is shared out alike, so that no port is left without any: of the motor's force, and of dampings.
constexpr double evenly = 0.1, hardly = 0.02;

// As large as the weights, or alike where there are none; `least` of the whole is shared out alike.
std::vector<double> shares_by(const std::vector<double>& weights, double least) {
  double sum = 0;
  for (const double weight : weights) sum += weight;
  std::vector<double> shares;
  const double alike = 1.0 / double(weights.size());
  for (const double weight : weights)
    shares.push_back(sum > 0 && std::isfinite(sum) ? (1 - least) * weight / sum + least * alike : alike);
  return shares;
}

// What a port alone lacks beside its brake [N·s/m].
double lacking_beside_brake(const Compilation& port) {
  const Certificate& certificate = port.certificate;
  const double told = port.law.damping - certificate.added_damping;
  return std::max(certificate.bound.needed - assured_share(certificate.loop).convert_to<double>() * told, 0.0);
}

// What a port makes of a step as far in as the tool goes, with what its slips hold, and its damper at the largest speed
// [N]. Where the device states no range, the one that the file or the curve is for.
double largest_force(const Compilation& port) {
  const Network& network = port.network;
  const LinearForm& linear = port.form.linear;
  const SampledLoop& loop = port.certificate.loop;
  double travel = loop.travel;
  if (travel == 0 && network.static_curve) travel = network.static_curve->point.displacement;
  if (travel == 0 && network.valid.displacement) travel = network.valid.displacement->high;
  travel = network.pushed_in(travel);
  const ForcesBehindSlips behind = forces_behind_slips(network);
  double stiffness = to_double(linear.static_stiffness) + behind.stiffness, steepest = 1;
  for (const Mode& mode : linear.modes) stiffness += to_double(mode.stiffness);
  double way = travel;
  if (network.map) steepest = network.map->largest_tangent(0, travel), way = network.map->value_at(travel);
  const double of_damper = to_double(linear.feedthrough_damping) * steepest * loop.tool_speed;
  return steepest * (stiffness * way + of_damper + behind.yields);
}

std::vector<DeviceShare> shares_of(const std::vector<Compilation>& alone) {
  std::vector<double> brake, own, motor;
  for (const Compilation& port : alone) {
    brake.push_back(port.law.largest_damping);
    own.push_back(lacking_beside_brake(port));
    motor.push_back(largest_force(port));
  }
  brake = shares_by(brake, hardly), own = shares_by(own, hardly), motor = shares_by(motor, evenly);
  std::vector<DeviceShare> shares;
  for (std::size_t i = 0; i < alone.size(); ++i) shares.push_back({brake[i], own[i], motor[i]});
  return shares;
}

// Dampings and forces add. So do the squares of the rates at which the root of a damping changes.
Device shared(Device device, const DeviceShare& share) {
  device_description& d = device.description;
  d.brake.max_damping *= share.brake;
  d.brake.slew *= std::sqrt(share.brake);
  d.brake.residual_damping *= share.own_damping;
  d.mechanics.damping *= share.own_damping;
  d.mechanics.coulomb_friction *= share.own_damping;
  d.motor.max_torque *= share.motor;
  d.motor.slew *= share.motor;
  return device;
}

// What has been found of a port once is kept in `network`: the map of its curve.
std::optional<std::vector<Compilation>> each_port(Network& network, const Choices& choices,
                                                  const std::optional<Device>& device,
                                                  const std::vector<DeviceShare>& shares, Diagnostics& diagnostics,
                                                  StageTimes& times) {
  std::vector<Compilation> ports;
  for (std::size_t i = 0; i < network.ports.size(); ++i) {
    const std::optional<Device> own = device ? std::optional(shared(*device, shares[i])) : std::nullopt;
    std::optional<Compilation> port = compile(network.ports[i], choices, own, diagnostics, times);
    if (!port) return std::nullopt;
    network.ports[i].map = port->network.map;
    port->share = shares[i];
    ports.push_back(std::move(*port));
  }
  return ports;
}

// Each on the whole device first, to see what it would take of it.
std::optional<std::vector<Compilation>> ports_on(Network& network, const Choices& choices,
                                                 const std::optional<Device>& device, Diagnostics& diagnostics,
                                                 StageTimes& times) {
  const std::vector<DeviceShare> whole(network.ports.size());
  if (!device) return each_port(network, choices, device, whole, diagnostics, times);
  Diagnostics of_trial;  // what is wrong on the whole device is wrong on a share of it, and reported there
  Choices quickly = choices;
  quickly.compared = Compared::nothing;
  const auto alone = each_port(network, quickly, device, whole, of_trial, times);
  return each_port(network, choices, device, alone ? shares_of(*alone) : whole, diagnostics, times);
}

// Of a law that clips, as the device would clip it alone: its share of the motor's force.
std::optional<double> clamp_of(const Compilation& port) {
  const MotorLimits& limits = port.certificate.limits;
  if (limits.rule != LimitRule::clamps || port.law.sheds()) return std::nullopt;
  return port.certificate.loop.max_force * (1 - 8 * unit_roundoff(port.law.scalar));
}

// The ports' needs add up, whatever proves each of them: with so much damping no port gives energy, in any motion.
PassivityBound sum_of_bounds(const std::vector<Compilation>& ports) {
  PassivityBound sum;
  sum.proof = Proof::hold;
  Rational needed = 0;
  for (const Compilation& port : ports) {
    const PassivityBound& bound = port.certificate.bound;
    if (bound.proof == Proof::none)
      return not_proved("port '" + port.network.name +
                        "': " + why_not_certified(port.certificate, port.network.port_motion));
    if (sum.reason.empty() && !bound.reason.empty()) sum.reason = "port '" + port.network.name + "': " + bound.reason;
    needed += Rational(bound.needed);
    if (bound.proof == Proof::sampled) sum.proof = Proof::sampled;
    sum.any_regime |= bound.any_regime;
    sum.any_value |= bound.any_value;
    sum.constant_period_only |= bound.constant_period_only;
  }
  sum.needed = ceiling(needed);
  return sum;
}

EnergyLemma sum_of_lemmas(const std::vector<Compilation>& ports, ScalarType scalar) {
  EnergyLemma all = ports.front().certificate.energy;
  for (const Compilation& port : ports) {
    const EnergyLemma& one = port.certificate.energy;
    all.applies &= one.applies;
    all.holds &= one.holds;
    all.over_box |= one.over_box;
    all.with_slips |= one.with_slips;
    if (one.storage == EnergyStorage::weighted) all.storage = one.storage;
    if (&port != &ports.front()) {
      all.reweighted_modes += one.reweighted_modes;
      all.shortfall += one.shortfall;
    }
    all.rounding_share = std::max(all.rounding_share, one.rounding_share);
  }
  all.rounding_share += double(ports.size()) * unit_roundoff(scalar);
  return all;
}

// None where it is not known of one.
std::optional<double> sum_of(const std::vector<Compilation>& ports, std::optional<double> MotorLimits::*number) {
  double sum = 0;
  for (const Compilation& port : ports) {
    const std::optional<double>& one = port.certificate.limits.*number;
    if (!one) return std::nullopt;
    sum += *one;
  }
  return sum;
}

// Each port keeps to its share of the motor, so that no other has to know of it.
MotorLimits sum_of_limits(const std::vector<Compilation>& ports) {
  MotorLimits all;
  for (const Compilation& port : ports) {
    const MotorLimits& one = port.certificate.limits;
    all.rule = std::max(all.rule, one.rule);
    all.needed += one.needed > 0 ? one.needed : port.certificate.bound.needed;
    if (one.unbounded != Unbounded::nothing) all.unbounded = one.unbounded;
    if (one.is_covered || !all.is_covered) continue;
    all.is_covered = false;
    all.reason =
        "port '" + port.network.name + "': " + why_not_covered(one, port_units(port.network.port_motion).damping);
  }
  all.largest_force = sum_of(ports, &MotorLimits::largest_force);
  all.slew_needed = sum_of(ports, &MotorLimits::slew_needed);
  return all;
}

// A sum of commands, each of them rounded.
double surely_told(double damping, ScalarType scalar) { return damping * (1 - 16 * unit_roundoff(scalar)); }

// What the sum lacks, though it may be that no port lacks anything on its share: as far as the brake reaches. Where all
// ports are contacts the brake leaves a free tool alone, and nothing would help.
double added_for_all(const std::vector<Compilation>& ports, const PassivityBound& bound, const SampledLoop& loop,
                     ScalarType scalar) {
  double least = 0, most = 0;
  bool all_in_contact = true;
  for (const Compilation& port : ports) {
    least += port.law.damping, most += port.law.largest_damping;
    all_in_contact &= port.network.contact.has_value();
  }
  if (bound.proof == Proof::none || !loop.has_device || all_in_contact) return 0;
  const double missing = missing_damping(bound, loop, surely_told(least, scalar));
  if (missing == 0 || !std::isfinite(missing)) return 0;
  const double added = rounded(Real(missing + 64 * unit_roundoff(scalar) * (most + missing)), scalar);
  return most + added <= loop.max_damping ? added : 0;
}

Certificate certificate_of_all(const std::vector<Compilation>& ports, PassivityBound bound, const UpdateLaw& law,
                               double added, const SampledLoop& loop) {
  Certificate all;
  all.loop = loop;
  all.bound = std::move(bound);
  all.added_damping = added;
  double gain = 0;
  bool is_gain_known = true;
  for (const Compilation& port : ports) {
    all.added_damping += port.certificate.added_damping;
    is_gain_known &= port.certificate.quantisation_gain.has_value();
    gain += port.certificate.quantisation_gain.value_or(0);
  }
  all.added_damping = rounded(Real(all.added_damping), law.scalar);
  const double told = surely_told(law.damping, law.scalar);
  if (all.bound.proof != Proof::none)
    all.minimum_damping = missing_damping(all.bound, loop, std::max(told - all.added_damping, 0.0));
  compare_with_bound(all, assured_damping(loop, told));
  all.energy = sum_of_lemmas(ports, law.scalar);
  all.limits = sum_of_limits(ports);
  if (loop.encoder_step > 0) all.quantisation_stiffness = 2 * loop.coulomb_friction / loop.encoder_step;
  if (is_gain_known) all.quantisation_gain = gain;
  return all;
}

std::optional<double> plus(const std::optional<double>& sum, const std::optional<double>& more) {
  return sum && more ? std::optional(*sum + *more) : std::nullopt;
}

// What is chosen of all ports together: sums, and the largest of the errors, which are relative to each port's force.
Decomposition choice_of_all(const std::vector<Compilation>& ports, const Choices& choices, const Certificate& all) {
  Candidate sum = ports.front().decomposition.choice();
  Decomposition decomposition;
  decomposition.chosen = 0;
  for (std::size_t i = 1; i < ports.size(); ++i) {
    const Candidate& one = ports[i].decomposition.choice();
    sum.damping += one.damping;
    sum.wanted_damping += one.wanted_damping;
    sum.velocity_gain += one.velocity_gain;
    sum.motor_noise = plus(sum.motor_noise, one.motor_noise);
    sum.extra_damping_any_delay = plus(sum.extra_damping_any_delay, one.extra_damping_any_delay);
  }
  for (const Compilation& port : ports) {
    sum.largest_error = std::max(sum.largest_error, port.decomposition.choice().largest_error);
    const SlipDecomposition& slips = port.decomposition.slips;
    if (!(slips.error > decomposition.slips.error)) continue;
    decomposition.slips.error = slips.error;
    decomposition.slips.merits = slips.merits;
    decomposition.slips.runs = slips.runs;
  }
  if (const auto* name = std::get_if<std::string>(&choices.decomposition)) sum.name = *name;
  sum.state_input = choices.state_input.value_or(StateInput::position);
  sum.state_inputs.clear();
  sum.faithful.reset();
  sum.reason = "each port by this rule, on its share of the device";
  sum.minimum_damping = all.bound.proof != Proof::none ? std::optional(all.minimum_damping) : std::nullopt;
  sum.certified = all.bound.proof != Proof::none ? std::optional(all.certified) : std::nullopt;
  decomposition.candidates.push_back(std::move(sum));
  decomposition.tolerance = choices.tolerance;
  decomposition.reason = "each port keeps its own";
  return decomposition;
}

}  // namespace

std::optional<Compilation> compile_ports(Network network, const Choices& asked, const std::optional<Device>& device,
                                         Diagnostics& diagnostics, StageTimes& times) {
  if (const auto* damping = std::get_if<double>(&asked.decomposition)) {
    diagnostics.report<DiagnosticCode::damping_for_ports>({}, *damping);
    return std::nullopt;
  }
  Compilation c;
  std::optional<PortDevice> whole =
      device ? PortDevice::of(*device, network, diagnostics) : std::optional(PortDevice::ideal());
  if (!whole) return std::nullopt;
  c.port = std::move(*whole);
  c.device = device;
  c.registers = asked.registers;
  c.rate = asked.rate.value_or(device ? 1 / device->description.loop.sample_period : default_rate);
  // One rule for all, with slips in some of them or not.
  const Choices choices =
      with_names(asked, device || std::any_of(network.ports.begin(), network.ports.end(), has_slips));
  std::optional<std::vector<Compilation>> ports = ports_on(network, choices, device, diagnostics, times);
  if (!ports) return std::nullopt;
  std::vector<ParallelPort> laws;
  for (const Compilation& port : *ports) laws.push_back({port.network.name, port.law, clamp_of(port)});
  const SampledLoop loop = sampled_loop(c.port, 1 / c.rate);
  PassivityBound bound = sum_of_bounds(*ports);
  const double added = added_for_all(*ports, bound, loop, asked.scalar);
  c.law = begun_at_rest(without_unread_locals(parallel_law(laws, added, network.port_motion)));
  c.certificate = certificate_of_all(*ports, std::move(bound), c.law, added, loop);
  c.decomposition = choice_of_all(*ports, choices, c.certificate);
  c.network = std::move(network);
  c.ports = std::move(*ports);
  if (!is_representable(c.law, c.network, diagnostics) || !class_differs_from_members(c.law, c.network, diagnostics))
    return std::nullopt;
  return c;
}

}  // namespace dashpot::compiler
