#include "verify/certificate_file.hpp"

#include <dashpot/estimators/estimator_names.hpp>
#include <nlohmann/json.hpp>

#include <limits>

#include "network/rate_limits.hpp"
#include "verify/header_constants.hpp"

namespace dashpot::compiler {
namespace {

using Json = nlohmann::ordered_json;

Json digits(const Real& value) { return value.str(50, std::ios_base::scientific); }

Json json_of(const Network& network) {
  Json elements = Json::array();
  for (const Element& e : network.elements) {
    if (!e.has_effect) continue;
    Json element = {{"name", e.name}, {"nodes", {network.nodes[e.a], network.nodes[e.b]}}};
    if (const Spring* spring = std::get_if<Spring>(&e.law)) element["spring"] = spring->stiffness;
    if (const Damper* damper = std::get_if<Damper>(&e.law)) element["damper"] = damper->damping;
    if (const Slip* slip = std::get_if<Slip>(&e.law)) element["slip"] = slip->yield_force;
    elements.push_back(std::move(element));
  }
  return elements;
}

Json json_of(const LinearForm& form) {
  Json modes = Json::array();
  for (const Mode& mode : form.modes)
    modes.push_back({{"stiffness", digits(mode.stiffness)}, {"relaxation_rate", digits(mode.relaxation_rate)},
                     {"spring_share", digits(mode.spring_share)}});
  return {{"static_stiffness", digits(form.static_stiffness)},
          {"feedthrough_damping", digits(form.feedthrough_damping)},
          {"modes", modes}};
}

Json json_of(const SampledLoop& loop) {
  const velocity_description& v = loop.velocity;
  return {{"sample_period", loop.sample_period},
          {"jitter", loop.jitter},
          {"delay_samples", loop.delay_samples},
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
          {"cutoff", v.cutoff},
          {"acceleration", v.acceleration}};
}

Json json_of(const Certificate& c) {
  return {{"proof", name_of(c.bound.proof)},
          {"needed_damping", c.bound.needed},
          {"binding_frequency", c.bound.frequency},
          {"assured_damping", c.assured},
          {"minimum_damping", c.minimum_damping},
          {"certified", c.certified},
          {"any_regime", c.bound.any_regime},
          {"any_value", c.bound.any_value},
          {"reason", c.bound.reason},
          {"quantisation_stiffness", c.quantisation_stiffness},
          {"quantisation_gain", c.quantisation_gain ? Json(*c.quantisation_gain) : Json(nullptr)}};
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
  Json decomposition;
  std::visit([&](const auto& value) { decomposition = value; }, choices.decomposition);
  return {{"rate", c.rate},
          {"scheme", name_of(c.law.scheme)},
          {"scalar", name_of(c.law.scalar)},
          {"vector", name_of(choices.registers)},
          {"state_input", name_of(c.decomposition.choice().state_input)},
          {"decomposition", decomposition},
          {"damping", c.decomposition.choice().damping},
          {"brake_command", c.law.damping},
          {"added_damping", c.certificate.added_damping}};
}

// The value that is called so.
template <class Value, std::size_t count>
Value named(const Json& json, const char* key, const Value (&values)[count]) {
  const std::string name = json.at(key);
  for (const Value value : values)
    if (name_of(value) == name) return value;
  throw std::invalid_argument(key);
}

// A damping, or the rate, in its range.
double number_within(const Json& json, const char* key, double low, double high) {
  const double value = json.at(key).get<double>();
  if (!(value >= low && value <= high)) throw std::invalid_argument(key);
  return value;
}

constexpr double largest = std::numeric_limits<double>::max();

Choices choices_of(const Json& json) {
  Choices choices;
  choices.rate = number_within(json, "rate", lowest_rate, highest_rate);
  choices.scheme = named(json, "scheme", {Scheme::exact, Scheme::backward_euler});
  choices.scalar = named(json, "scalar", {ScalarType::float64, ScalarType::float32});
  if (json.contains("vector"))
    choices.registers = named(json, "vector", {VectorRegisters::none, VectorRegisters::sse2, VectorRegisters::avx2, VectorRegisters::avx512, VectorRegisters::neon});
  choices.state_input = named(json, "state_input", {StateInput::position, StateInput::velocity, StateInput::nodal});
  if (json.at("decomposition").is_number()) choices.decomposition = number_within(json, "decomposition", 0, largest);
  else choices.decomposition = json.at("decomposition").get<std::string>();
  return choices;
}

CertificateFile file_of(const Json& json) {
  CertificateFile file;
  if (json.at("dashpot_certificate") != 1) throw std::invalid_argument("format 1 is expected");
  file.network_text = json.at("network_file").get<std::string>();
  if (!json.at("device_file").is_null()) file.device_text = json.at("device_file").get<std::string>();
  const Json& law = json.at("law");
  file.choices = choices_of(law);
  file.damping = number_within(law, "damping", 0, largest);
  file.brake_command = number_within(law, "brake_command", 0, largest);
  file.added_damping = number_within(law, "added_damping", 0, largest);
  const Json& passivity = json.at("passivity");
  file.proof = passivity.at("proof").get<std::string>();
  file.needed_damping = passivity.at("needed_damping").get<double>();
  file.assured_damping = passivity.at("assured_damping").get<double>();
  file.certified = passivity.at("certified").get<bool>();
  if (const Json& gain = passivity.at("quantisation_gain"); !gain.is_null()) file.quantisation_gain = gain.get<double>();
  for (const auto& [name, values] : json.at("constants").items()) file.constants[name] = values.get<std::vector<double>>();
  return file;
}

}  // namespace

std::string certificate_text(const Compilation& c, const Choices& choices, const std::string& network_text,
                             const std::optional<std::string>& device_text, const std::string& header) {
  const bool nodal = c.decomposition.choice().state_input == StateInput::nodal;
  Json constants = Json::object();
  if (const auto found = header_constants(header))
    for (const HeaderConstant& constant : found->all) constants[constant.name] = constant.values;
  const Json all = {{"dashpot_certificate", 1},
                    {"version", DASHPOT_VERSION},
                    {"name", c.network.name},
                    {"motion", c.network.port_motion == motion::rotation ? "rotation" : "translation"},
                    {"law", json_of_choices(c, choices)},
                    {"elements", json_of(c.network)},
                    {"canonical_form", json_of(nodal ? c.decomposition.realisation : c.form.linear)},
                    {"constants", constants},
                    {"loop", json_of(c.certificate.loop)},
                    {"passivity", json_of(c.certificate)},
                    {"energy", json_of(c.certificate.energy)},
                    {"network_file", network_text},
                    {"device_file", device_text ? Json(*device_text) : Json(nullptr)}};
  return all.dump(2) + "\n";
}

std::optional<CertificateFile> read_certificate(const SourceFile& file, Diagnostics& diagnostics) {
  try {
    return file_of(Json::parse(file.text()));
  } catch (const std::exception& fault) {
    diagnostics.report<DiagnosticCode::no_certificate>({}, file.path(), fault.what());
    return std::nullopt;
  }
}

}  // namespace dashpot::compiler
