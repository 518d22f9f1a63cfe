#include "verify/certificate_file.hpp"

#include <dashpot/estimators/estimator_names.hpp>
#include <nlohmann/json.hpp>

#include "certify/storage_function.hpp"
#include "network/port_units.hpp"
#include "verify/network_json.hpp"

namespace dashpot::compiler {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const SampledLoop& loop) {
  const velocity_description& v = loop.velocity;
  return {{"sample_period", loop.sample_period},
          {"jitter", loop.jitter},
          {"delay_samples", loop.delay_samples},
          {"write_earliest", loop.write_earliest},
          {"write_latest", loop.write_latest},
          {"amplifier_lag", loop.amplifier_lag},
          {"brake_tolerance", loop.tolerance},
          {"largest_speed", loop.largest_speed},
          {"critical_speed", loop.critical_speed},
          {"max_damping", loop.max_damping},
          {"residual_damping", loop.residual_damping},
          {"device_damping", loop.device_damping},
          {"coulomb_friction", loop.coulomb_friction},
          {"encoder_step", loop.encoder_step},
          {"estimator", loop.has_device ? name_of(v.estimator) : "difference of two samples"},
          {"window", v.window},
          {"order", v.order},
          {"best_fit", v.best_fit},
          {"cutoff", v.cutoff},
          {"acceleration", v.acceleration},
          {"joint_encoder_step", loop.joint_encoder_step},
          {"estimator_coefficients", checked_device(loop).estimator_coefficients}};
}

Json json_of(const Certificate& c) {
  return {{"proof", name_of(c.bound.proof)},
          {"needed_damping", c.bound.needed},
          {"binding_frequency", c.bound.frequency},
          {"assured_damping", c.assured},
          {"minimum_damping", c.minimum_damping},
          {"certified", c.certified},
          {"grade", grade_of(c)},
          {"constant_period_only", c.bound.constant_period_only},
          {"any_regime", c.bound.any_regime},
          {"any_value", c.bound.any_value},
          {"reason", c.bound.reason},
          {"quantisation_stiffness", c.quantisation_stiffness},
          {"quantisation_gain", or_null(c.quantisation_gain)}};
}

// P of the storage function that proves the needed damping; null where the statement rests on something else.
Json json_of_storage(const PassivityBound& bound) {
  return bound.storage ? Json{{"matrix", *bound.storage}} : Json(nullptr);
}

Json json_of(const MotorLimits& limits, const SampledLoop& loop, const std::string& unit) {
  return {{"max_force", loop.max_force},
          {"slew", loop.motor_slew},
          {"rule", name_of(limits.rule)},
          {"covered", limits.is_covered},
          {"needed_damping", limits.needed},
          {"reason", why_not_covered(limits, unit)},
          {"largest_force", or_null(limits.largest_force)},
          {"slew_needed", or_null(limits.slew_needed)},
          {"largest_discontinuity", or_null(limits.largest_discontinuity)}};
}

Json json_of(const EnergyLemma& lemma) {
  return {{"applies", lemma.applies},
          {"holds", lemma.holds},
          {"over_box", lemma.over_box},
          {"with_slips", lemma.with_slips},
          {"storage", lemma.storage == EnergyStorage::emitted ? "stored_energy" : "weighted"},
          {"reweighted_modes", lemma.reweighted_modes},
          {"shortfall", lemma.shortfall},
          {"rounding_share", lemma.rounding_share}};
}

Json json_of_choices(const Compilation& c, const Choices& choices) {
  Json decomposition = c.decomposition.choice().name;
  if (const double* given = std::get_if<double>(&choices.decomposition)) decomposition = *given;
  Json told = {{"rate", c.rate},
               {"scheme", name_of(c.law.scheme)},
               {"scalar", name_of(c.law.scalar)},
               {"vector", name_of(choices.registers)},
               {"state_input", name_of(c.decomposition.choice().state_input)},
               {"state_input_asked", choices.state_input.has_value()},
               {"guards_each_sample", choices.guards_each_sample},
               {"decomposition", decomposition},
               {"damping", c.decomposition.choice().damping},
               {"brake_command", c.law.damping},
               {"added_damping", c.certificate.added_damping}};
  if (choices.tolerance != Choices().tolerance) told["tolerance"] = choices.tolerance;  // if the user asked for it
  return told;
}

// Each port on its share of the device; what is proved for all ports together is the sum.
Json json_of_ports(const Compilation& c) {
  Json ports = Json::array();
  for (const Compilation& port : c.ports)
    ports.push_back({{"name", port.network.name},
                     {"share_of_device", json_of(port.share)},
                     {"damping", port.decomposition.choice().damping},
                     {"state_input", name_of(port.decomposition.choice().state_input)},
                     {"elements", json_of_elements(port.network)},
                     {"canonical_form", json_of_form(port.form.linear)},
                     {"passivity", json_of(port.certificate)}});
  return ports;
}

}  // namespace

Choices CertificateFile::as_asked() const {
  Choices asked = choices;
  if (!asked_for_state_input) asked.state_input.reset();
  return asked;
}

std::string certificate_text(const Compilation& c, const Choices& choices, const std::string& network_text,
                             const std::optional<std::string>& device_text, const std::string& header) {
  const bool nodal = c.decomposition.choice().state_input == StateInput::nodal;
  Json all = {
      {"dashpot_certificate", 1},
      {"version", DASHPOT_VERSION},
      {"name", c.network.name},
      {"motion", name_of(c.network.port_motion)},
      {"law", json_of_choices(c, choices)},
      {"elements", json_of_elements(c.network)},
      {"canonical_form", json_of_form(nodal ? c.decomposition.realisation : c.form.linear)},
      {"constants", json_of_constants(header)},
      {"loop", json_of(c.certificate.loop)},
      {"passivity", json_of(c.certificate)},
      {"storage", json_of_storage(c.certificate.bound)},
      {"energy", json_of(c.certificate.energy)},
      {"motor_limits", json_of(c.certificate.limits, c.certificate.loop, port_units(c.network.port_motion).damping)},
      {"network_file", network_text},
      {"device_file", or_null(device_text)}};
  if (!c.ports.empty()) all["ports"] = json_of_ports(c);
  return all.dump(2) + "\n";
}

}  // namespace dashpot::compiler
