#include "verify/verify_header.hpp"

#include <algorithm>

#include "certify/proved_bound.hpp"
#include "certify/quantisation.hpp"
#include "network/law.hpp"
#include "network/stuck_and_open_slips.hpp"
#include "verify/law_constants.hpp"
#include "verify/port_constants.hpp"
#include "verify/realised_network.hpp"
#include "verify/recompiled.hpp"
#include "verify/reference_constants.hpp"
#include "verify/reference_gain.hpp"
#include "verify/reference_map.hpp"
#include "verify/verify_slips.hpp"
#include "verify/verify_tunables.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::string_view kinds_of_modes[] = {"velocity_drive", "energy_weight", "decay", "gain", "loss"};

// What the motor can make, and shares of it: lower/shed.hpp.
bool is_of_motor_reach(const std::string& kind) {
  return kind == "motor_limit" || kind == "motor_step" || kind == "all_kept" || kind == "none_kept" ||
         kind == "no_shift";
}

// A number of a constant in the header.
struct Place {
  const HeaderConstant* constant;
  std::size_t place;

  double value() const { return constant->values[place]; }
};
using Groups = std::map<std::string, std::vector<Place>>;

// The constants of all modes under the name of their kind, in the order of the header; others under their own.
std::string kind_of(const std::string& name) {
  if (name == "velocity_gain") return name;
  for (const std::string_view kind : kinds_of_modes)
    if (name.size() > kind.size() && name.ends_with(kind) && name[name.size() - kind.size() - 1] == '_')
      return std::string(kind);
  return name;
}

Groups grouped(const HeaderConstants& header) {
  Groups groups;
  for (const HeaderConstant& constant : header.all) {
    std::vector<Place>& places = groups[kind_of(constant.name)];
    for (std::size_t i = 0; i < constant.values.size(); ++i) places.push_back({&constant, i});
  }
  return groups;
}

double value_of(const Groups& groups, const std::string& kind) {
  const auto found = groups.find(kind);
  return found == groups.end() ? 0 : found->second.front().value();
}

MotorConstants motor_of(const Groups& groups) {
  MotorConstants motor;
  motor.static_stiffness = value_of(groups, "static_stiffness");
  motor.half_static_stiffness = value_of(groups, "half_static_stiffness");
  motor.step_stiffness = value_of(groups, "step_stiffness");
  motor.velocity_gain = value_of(groups, "velocity_gain");
  motor.loss_is_emitted = groups.count("loss") > 0;
  const auto take = [&](const char* kind, double MotorMode::*member) {
    const auto found = groups.find(kind);
    if (found == groups.end()) return;
    motor.modes.resize(std::max(motor.modes.size(), found->second.size()));
    for (std::size_t i = 0; i < found->second.size(); ++i) motor.modes[i].*member = found->second[i].value();
  };
  take("decay", &MotorMode::decay);
  take("loss", &MotorMode::loss);
  take("gain", &MotorMode::position_drive);
  take("velocity_drive", &MotorMode::velocity_drive);
  take("energy_weight", &MotorMode::energy_weight);
  for (MotorMode& mode : motor.modes)
    if (motor.loss_is_emitted) mode.decay = 1 - mode.loss;
    else mode.loss = 1 - mode.decay;
  return motor;
}

class Verification {
 public:
  Verification(const CertificateFile& certificate, const HeaderConstants& header, Diagnostics& diagnostics)
      : certificate_(certificate), header_(header), groups_(grouped(header)), diagnostics_(diagnostics) {}

  void compare_with_certificate() { compare_constants(certificate_.constants, header_, diagnostics_); }

  void recompute_constants(const Network& network) {
    const auto expected = reference_constants(reference_form(network), facts_of(certificate_));
    for (const auto& [kind, places] : groups_) {
      if (kind == "damping" || kind == "added_damping") continue;  // of the bounds
      if (is_of_motor_reach(kind)) continue;                       // of the device, with the code around them
      const auto exact = expected.find(kind);
      if (exact == expected.end() || exact->second.size() != places.size()) {
        diagnostics_.report<DiagnosticCode::unknown_constant>({}, places.front().constant->written);
        continue;
      }
      for (std::size_t i = 0; i < places.size(); ++i)
        compare(*places[i].constant, places[i].place, exact->second[i], header_.scalar, diagnostics_);
    }
    for (const char* kind : {"static_stiffness", "step_stiffness", "velocity_gain"})
      if (groups_.count(kind) == 0 && !is_correctly_rounded(0, expected.at(kind).front(), header_.scalar))
        diagnostics_.report<DiagnosticCode::constant_missing>({}, kind);
    if (expected.count("decay") > 0 && groups_.count("decay") + groups_.count("loss") == 0)
      diagnostics_.report<DiagnosticCode::constant_missing>({}, "decay");
  }

  void recompute_bounds(const PortDevice& device) {
    const SampledLoop loop = sampled_loop(device, 1 / *certificate_.choices.rate);
    const double brake = value_of(groups_, "damping"), added = value_of(groups_, "added_damping");
    const bool is_too_small = is_correctly_rounded(0, Reference(certificate_.damping), header_.scalar);
    const double damping = is_too_small ? 0 : certificate_.damping;
    const double alone = brake_command({}, loop, damping, header_.scalar);
    const MotorConstants motor = motor_of(groups_);
    const PassivityBound bound = stated_bound(motor, loop, assured_damping(loop, alone));
    const double expected = brake_command(bound, loop, damping, header_.scalar);
    expect("brake command", brake, expected);
    const double of_it = header_.scalar == ScalarType::float64 ? expected - alone : double(float(expected - alone));
    expect("added damping", added, of_it);
    const Rational assured = assured_damping(loop, brake);
    expect("assured damping", certificate_.assured_damping, assured.convert_to<double>());
    if (bound.proof != Proof::none) expect("needed damping", certificate_.needed_damping, bound.needed);
    const bool certified = bound.proof != Proof::none && assured >= Rational(bound.needed);
    if (certificate_.proof != name_of(bound.proof) || certificate_.certified != certified)
      diagnostics_.report<DiagnosticCode::certificate_disagrees>({}, "certificate", "recomputed bound", "proof");
    expect("brake command", certificate_.brake_command, expected);
    expect("added damping", certificate_.added_damping, of_it);
    if (!agrees(certificate_.quantisation_gain, quantisation_gain(motor, loop), reference_gain(motor, loop),
                header_.scalar))
      diagnostics_.report<DiagnosticCode::certificate_disagrees>({}, "certificate", "recomputed gain", "quantisation");
  }

  std::size_t constants() const {
    std::size_t count = 0;
    for (const auto& [kind, places] : groups_) count += places.size();
    return count;
  }

 private:
  void expect(const char* what, double stated, double found) { expect_bound(what, stated, found, diagnostics_); }

  const CertificateFile& certificate_;
  const HeaderConstants& header_;
  Groups groups_;
  Diagnostics& diagnostics_;
};

// The tables of a static curve's map.
void recompute_map(const HeaderConstants& header, const Compilation& compiled, Diagnostics& diagnostics) {
  const MotionMap& map = *compiled.network.map;
  const Network& network = compiled.network;
  const Network linear =
      network.static_curve->is_instantaneous ? with_stuck_slips(network) : linear_part(network, compiled.form);
  const ReferenceMap exact = reference_map(network, reference_form(linear), map.cubics());
  for (const auto& [name, expected] :
       {std::pair("cell_begins", &exact.begins), std::pair("map_a", &exact.a), std::pair("map_b", &exact.b),
        std::pair("map_c", &exact.c), std::pair("map_e", &exact.e)}) {
    const auto found = std::find_if(header.all.begin(), header.all.end(),
                                    [&](const HeaderConstant& constant) { return constant.name == name; });
    if (found == header.all.end()) diagnostics.report<DiagnosticCode::constant_missing>({}, name);
    else compare(*found, *expected, header.scalar, diagnostics);
  }
}

// Of what belongs to no port: how the brake's commands are added up, and the facts of the loop.
void look_at_sum(const HeaderConstant& constant, const Compilation& compiled, const LawFacts& facts,
                 Diagnostics& diagnostics) {
  if (constant.name == literals_in_code) look_at_literals(constant, compiled.law, {}, diagnostics);
  else if (const auto known = constant_called(constant.name, constant.values.size(), compiled.law))
    compare_with_compiled(constant, *known, diagnostics);
  else compare_with_facts(constant, compiled, facts, diagnostics);
}

// What is found again of all ports together: sums, of which nothing is computed another way.
void compare_sum(const CertificateFile& certificate, const Compilation& compiled, ScalarType scalar,
                 Diagnostics& diagnostics) {
  const std::optional<double>& gain = compiled.certificate.quantisation_gain;
  compare_with_recompiled(certificate, compiled, gain ? std::optional(ReferenceGain{*gain, *gain}) : std::nullopt,
                          scalar, diagnostics);
}

// Port by port, as those of a law by itself on its share of the device.
void recompute_ports(const CertificateFile& certificate, const HeaderConstants& header, const Compilation& compiled,
                     Diagnostics& diagnostics) {
  std::vector<VerifiedPort> ports;
  for (const Compilation& port : compiled.ports) {
    Choices choices = certificate.choices;
    choices.state_input = port.decomposition.choice().state_input;
    ports.push_back({port.network.name, &port, &port.law, choices});
  }
  const LawFacts facts = {*certificate.choices.rate, certificate.choices.scheme, certificate.choices.scalar,
                          StateInput::position, 0};
  for (const HeaderConstant& constant : header.all) {
    if (!give_to_port(constant, compiled.law, ports)) look_at_sum(constant, compiled, facts, diagnostics);
  }
  for (const VerifiedPort& port : ports) recompute_port(port, header.scalar, diagnostics);
}

}  // namespace

void compare_constants(const std::map<std::string, std::vector<double>>& stated, const HeaderConstants& header,
                       Diagnostics& diagnostics) {
  std::map<std::string, std::vector<double>> found;
  for (const HeaderConstant& constant : header.all) found[constant.name] = constant.values;
  for (const auto& [name, values] : stated)
    if (found[name] != values)
      diagnostics.report<DiagnosticCode::certificate_disagrees>({}, "certificate", "header", name);
  for (const HeaderConstant& constant : header.all)
    if (stated.count(constant.name) == 0) diagnostics.report<DiagnosticCode::unknown_constant>({}, constant.written);
}

std::size_t verify_linear_constants(const CertificateFile& certificate, const Network& network,
                                    const PortDevice& device, const HeaderConstants& header, Diagnostics& diagnostics) {
  Verification verification(certificate, header, diagnostics);
  verification.compare_with_certificate();
  verification.recompute_constants(realised(network, certificate, device));
  return verification.constants();
}

std::size_t verify_constants(const CertificateFile& certificate, const PortDevice& device,
                             const HeaderConstants& header, const Compilation& compiled, Diagnostics& diagnostics) {
  Verification verification(certificate, header, diagnostics);
  verification.compare_with_certificate();
  if (!compiled.ports.empty()) recompute_ports(certificate, header, compiled, diagnostics);
  else if (compiled.law.tunable) TunableVerification(certificate, header, compiled, diagnostics).recompute_constants();
  else SlipVerification(certificate, header, device, compiled, diagnostics).recompute_constants();
  if (compiled.network.map) recompute_map(header, compiled, diagnostics);
  return verification.constants();
}

void verify_bounds(const CertificateFile& certificate, const PortDevice& device, const HeaderConstants& header,
                   const Compilation& compiled, Diagnostics& diagnostics) {
  if (!compiled.beyond_linear()) Verification(certificate, header, diagnostics).recompute_bounds(device);
  else if (!compiled.ports.empty()) compare_sum(certificate, compiled, header.scalar, diagnostics);
  else if (compiled.network.map)
    compare_with_recompiled(certificate, compiled, std::nullopt, header.scalar, diagnostics);
  else if (compiled.law.tunable) TunableVerification(certificate, header, compiled, diagnostics).recompute_bounds();
  else SlipVerification(certificate, header, device, compiled, diagnostics).recompute_bounds();
}

}  // namespace dashpot::compiler
