#include <algorithm>
#include <nlohmann/json.hpp>

#include "certify/notes.hpp"
#include "certify/proved_bound.hpp"
#include "commands/explain.hpp"
#include "decompose/slip_laws.hpp"
#include "linear/quasi_linear.hpp"
#include "network/port_units.hpp"
#include "law/cost.hpp"
#include "verify/network_json.hpp"

namespace dashpot::compiler {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Candidate& c) {
  Json inputs = Json::array();
  for (const StateInputMerit& merit : c.state_inputs)
    inputs.push_back({{"state_input", name_of(merit.state_input)},
                      {"largest_error", merit.largest_error},
                      {"extra_damping_any_delay", or_null(merit.extra_damping_any_delay)},
                      {"minimum_damping", or_null(merit.minimum_damping)},
                      {"proof", merit.proof},
                      {"binding_frequency", merit.binding_frequency}});
  return {{"name", c.name},
          {"damping", c.damping},
          {"wanted_damping", c.wanted_damping},
          {"state_input", name_of(c.state_input)},
          {"velocity_gain", c.velocity_gain},
          {"motor_noise", or_null(c.motor_noise)},
          {"largest_error", c.largest_error},
          {"extra_damping_any_delay", or_null(c.extra_damping_any_delay)},
          {"minimum_damping", or_null(c.minimum_damping)},
          {"certified", or_null(c.certified)},
          {"reason", c.reason},
          {"state_inputs", inputs}};
}

Json json_of(const std::vector<Mode>& modes) {
  Json list = Json::array();
  for (const Mode& mode : modes)
    list.push_back({{"stiffness", to_double(mode.stiffness)}, {"relaxation_rate", to_double(mode.relaxation_rate)}});
  return list;
}

const SlipLawMerit* merit_of(const SlipDecomposition& slips, SlipLaw law) {
  for (const SlipLawMerit& merit : slips.merits)
    if (merit.law == law) return &merit;
  return nullptr;
}

// The keys of a candidate, where they make sense; the error is that of what slides.
Json json_of(const SlipDecomposition& slips, const ComponentSplit& split, std::size_t i, const Network& network) {
  const Regime& regime = split.regimes.regimes[i];
  const BrakeShare& share = split.shares[i];
  const SlipLawMerit* merit = merit_of(slips, split.law);
  const bool slides = std::find(regime.slides.begin(), regime.slides.end(), true) != regime.slides.end();
  const bool is_exact = !slides || merit == nullptr;
  return {{"component", name_of(split, network)},
          {"stuck", slip_names(split.regimes, regime, false, network)},
          {"sliding", slip_names(split.regimes, regime, true, network)},
          {"name", name_of(split.law)},
          {"damping", share.damping},
          {"wanted_damping", to_double(regime.damping)},
          {"feedthrough_damping", to_double(regime.feedthrough())},
          {"zero_frequency_damping", to_double(zero_frequency_damping(regime.form))},
          {"static_stiffness", to_double(regime.form.static_stiffness)},
          {"modes", json_of(regime.form.modes)},
          {"state_input", name_of(StateInput::position)},
          {"velocity_gain", share.compensation},
          {"motor_noise", is_exact ? Json(0.0) : or_null(merit->motor_noise)},
          {"largest_error", is_exact ? 0.0 : merit->error()},
          {"extra_damping_any_delay", share.compensation > 0 ? Json(nullptr) : Json(0.0)},
          {"minimum_damping", nullptr},
          {"certified", nullptr},
          {"reason", regime.reason}};
}

// The keys of a candidate for what reaches ground without a slip, while the tool touches, and for a tool that is free.
Json json_of_curve(const Compilation& c) {
  if (!c.network.map) return nullptr;
  const MotionMap& map = *c.network.map;
  const double least = map.least_tangent(0, map.reach), most = map.steepest();
  Json told = {{"curve", to_text(*c.network.static_curve, c.network.port_motion)},
               {"stiffness", map.stiffness},
               {"begins", map.start},
               {"reach", map.reach},
               {"cubics", map.cubics()},
               {"largest_error", map.static_error},
               {"slope_error", map.slope_error},
               {"slope_unsure_until", map.unsure_until},
               {"least_scale", least * least},
               {"largest_scale", most * most},
               {"quasi_linear_difference", nullptr}};
  if (c.network.valid.rate && c.network.valid.rate->high > 0)
    told["quasi_linear_difference"] = distance_from_quasi_linear(c.network, c.form.linear, c.network.valid.rate->high);
  return told;
}

Json json_of_contact(const Compilation& c, bool touches) {
  const Candidate& choice = c.decomposition.choice();
  const LinearForm& form = c.form.linear;
  const auto in_touch = [=](double value) { return touches ? value : 0.0; };
  return {{"component", "contact"},
          {"stuck", Json::array()},
          {"sliding", Json::array()},
          {"name", touches ? "touching" : "free"},
          {"damping", in_touch(choice.damping)},
          {"wanted_damping", in_touch(choice.wanted_damping)},
          {"feedthrough_damping", in_touch(to_double(form.feedthrough_damping))},
          {"zero_frequency_damping", in_touch(to_double(zero_frequency_damping(form)))},
          {"static_stiffness", in_touch(to_double(form.static_stiffness))},
          {"modes", touches ? json_of(form.modes) : Json::array()},
          {"state_input", name_of(StateInput::position)},
          {"velocity_gain", in_touch(choice.velocity_gain)},
          {"motor_noise", touches ? or_null(choice.motor_noise) : Json(0.0)},
          {"largest_error", in_touch(choice.largest_error)},
          {"extra_damping_any_delay", touches ? or_null(choice.extra_damping_any_delay) : Json(0.0)},
          {"minimum_damping", nullptr},
          {"certified", nullptr},
          {"reason", touches ? choice.reason : "a surface cannot pull the tool"}};
}

Json regimes_of(const Compilation& c) {
  Json regimes = Json::array();
  for (const ComponentSplit* split : c.decomposition.slips.all())
    for (std::size_t i = 0; i < split->regimes.regimes.size(); ++i)
      regimes.push_back(json_of(c.decomposition.slips, *split, i, c.network));
  if (c.network.contact)
    for (const bool touches : {true, false}) regimes.push_back(json_of_contact(c, touches));
  return regimes;
}

// What each law costs in a run of the whole network, why a part cannot have it, and which is taken.
Json slip_laws_of(const Compilation& c) {
  Json components = Json::array();
  for (const ComponentSplit* split : c.decomposition.slips.all()) {
    Json laws = Json::array();
    for (const SlipLawOffer& offer : split->offers) {
      const SlipLawMerit* merit = offer.refusal.empty() ? merit_of(c.decomposition.slips, offer.law) : nullptr;
      laws.push_back({{"name", name_of(offer.law)},
                      {"largest_error", merit ? Json(merit->error()) : Json(nullptr)},
                      {"peak_error", merit ? Json(merit->peak_error) : Json(nullptr)},
                      {"rms_error", merit ? Json(merit->rms_error) : Json(nullptr)},
                      {"mean_damping", merit ? Json(merit->mean_damping) : Json(nullptr)},
                      {"minimum_damping", merit ? or_null(merit->minimum_damping) : Json(nullptr)},
                      {"motor_noise", merit ? or_null(merit->motor_noise) : Json(nullptr)},
                      {"refusal", offer.refusal.empty() ? Json(nullptr) : Json(offer.refusal)}});
    }
    components.push_back({{"component", name_of(*split, c.network)},
                          {"regimes", split->regimes.count},
                          {"laws", laws},
                          {"chosen", name_of(split->law)},
                          {"reason", split->reason}});
  }
  return components;
}

Json json_of(const TunableTables& tables) {
  Json list = Json::array();
  for (const Tunable& t : tables.tunables)
    list.push_back(
        {{"name", t.name}, {"unit", t.unit}, {"value", t.range.value}, {"min", t.range.min}, {"max", t.range.max}});
  return list;
}

// Of every key by how it ends; what is no such quantity is a share of something.
Json json_of(const PortUnits& units) {
  return {{"stiffness", units.stiffness},
          {"damping", units.damping},
          {"compliance", units.compliance},
          {"fluidity", units.fluidity},
          {"rate", "1/s"},
          {"frequency", "Hz"},
          {"velocity_gain", units.damping},
          {"motor_noise", units.force},
          {"extra_damping_any_delay", units.damping},
          {"stiffest_spring", units.stiffness},
          {"quantisation_gain", units.stiffness},
          {"unpaid_force", units.force},
          {"max_force", units.force},
          {"largest_force", units.force},
          {"largest_discontinuity", units.force},
          {"slew", units.force + "/s"},
          {"slew_needed", units.force + "/s"},
          {"hysteresis", units.position},
          {"at", units.position},
          {"displacement", units.position},
          {"valid.rate", units.velocity}};
}

Json json_of(const Certificate& c) {
  return {{"proof", name_of(c.bound.proof)},
          {"certified", c.certified},
          {"grade", grade_of(c)},
          {"constant_period_only", c.bound.constant_period_only},
          {"needed_damping", c.bound.proof == Proof::none ? Json(nullptr) : Json(c.bound.needed)},
          {"binding_frequency", c.bound.frequency},
          {"assured_damping", c.assured},
          {"minimum_damping", c.bound.proof == Proof::none ? Json(nullptr) : Json(c.minimum_damping)},
          {"added_damping", c.added_damping},
          {"reason", c.bound.reason},
          {"stiffest_spring", or_null(stiffest_spring(c.loop))},
          {"quantisation_stiffness", c.quantisation_stiffness > 0 ? Json(c.quantisation_stiffness) : Json(nullptr)},
          {"quantisation_gain", or_null(c.quantisation_gain)},
          {"unpaid_force", c.loop.encoder_step > 0 && c.quantisation_gain ? Json(unpaid_force(c)) : Json(nullptr)}};
}

// null: unlimited, or not bounded beforehand.
Json json_of(const MotorLimits& limits, const SampledLoop& loop, const std::string& unit) {
  return {{"max_force", loop.max_force > 0 ? Json(loop.max_force) : Json(nullptr)},
          {"slew", loop.motor_slew > 0 ? Json(loop.motor_slew) : Json(nullptr)},
          {"rule", name_of(limits.rule)},
          {"covered", limits.is_covered},
          {"needed_damping", limits.needed > 0 ? Json(limits.needed) : Json(nullptr)},
          {"reason", why_not_covered(limits, unit)},
          {"largest_force", or_null(limits.largest_force)},
          {"slew_needed", or_null(limits.slew_needed)},
          {"largest_discontinuity", or_null(limits.largest_discontinuity)}};
}

// What `faithful` was chosen by; null for another choice, and without a device.
Json json_of_choice(const Decomposition& d) {
  const std::optional<FaithfulChoice>& choice = d.choice().faithful;
  if (!choice) return nullptr;
  const auto moves = [&](const ChoiceMoves& m) {
    return Json(
        {{"least_damping", m.least}, {"most_damping", m.most}, {"by", m.by.empty() ? Json(nullptr) : Json(m.by)}});
  };
  return {{"tolerance", d.tolerance},
          {"allowed_error", choice->allowed_error},
          {"least_error", choice->least_error},
          {"least_added_damping", choice->least_added},
          {"certified", choice->certified},
          {"over_assumed", d.moves ? moves(*d.moves) : Json(nullptr)},
          {"in_words", d.in_words}};
}

Json json_of(const Validity& valid) {
  const auto ends = [](const std::optional<Range>& range) {
    return range ? Json({range->low, range->high}) : Json(nullptr);
  };
  return {{"frequency", ends(valid.frequency)}, {"rate", ends(valid.rate)}, {"displacement", ends(valid.displacement)}};
}

Json explained(const Compilation& c) {
  Json kelvin = Json::array(), candidates = Json::array();
  const KelvinForm creep = kelvin_form(c.form.linear);
  for (const KelvinElement& element : creep.elements)
    kelvin.push_back({{"stiffness", to_double(element.stiffness)}, {"damping", to_double(element.damping)}});
  for (const Candidate& candidate : c.decomposition.candidates) candidates.push_back(json_of(candidate));
  const Candidate& choice = c.decomposition.choice();
  Json all = {{"name", c.network.name},
              {"motion", name_of(c.network.port_motion)},
              {"units", json_of(port_units(c.network.port_motion))},
              {"static_stiffness", to_double(c.form.linear.static_stiffness)},
              {"feedthrough_damping", to_double(c.form.linear.feedthrough_damping)},
              {"modes", json_of(c.form.linear.modes)},
              {"zero_frequency_damping", to_double(zero_frequency_damping(c.form.linear))},
              {"kelvin",
               {{"glass_compliance", to_double(creep.glass_compliance)},
                {"fluidity", to_double(creep.fluidity)},
                {"elements", kelvin}}},
              {"contact", c.network.contact
                              ? Json({{"at", c.network.contact->at}, {"hysteresis", c.decomposition.encoder_step}})
                              : Json(nullptr)},
              {"static", json_of_curve(c)},
              {"scheme", name_of(c.law.scheme)},
              {"rate", c.rate},
              {"fastest_relaxation_rate", fastest_rate(c)},
              {"valid", json_of(c.network.valid)},
              {"device", c.device ? Json(c.device->name) : Json(nullptr)},
              {"coupled_operations", cost_of(c.law, c.law.output).coupled},
              {"candidates", candidates},
              {"regimes", regimes_of(c)},
              {"slip_laws", slip_laws_of(c)},
              {"certificate", json_of(c.certificate)},
              {"motor_limits",
               c.device ? json_of(c.certificate.limits, c.certificate.loop, port_units(c.network.port_motion).damping)
                        : Json(nullptr)},
              {"notes", notes_on_choice(c.decomposition, c.network)},
              {"chosen", choice.name},
              {"choice", json_of_choice(c.decomposition)},
              {"state_input", name_of(choice.state_input)},
              {"reason", choice.reason + "; " + c.decomposition.reason}};
  if (c.law.tunable) all["tunables"] = json_of(*c.law.tunable);
  return all;
}

// The ports, each explained on its share of the device, and what is true of all together.
Json explained_ports(const Compilation& c) {
  Json ports = Json::array();
  for (const Compilation& port : c.ports) {
    Json one = {{"share_of_device", c.device ? json_of(port.share) : Json(nullptr)}};
    one.update(explained(port));
    ports.push_back(std::move(one));
  }
  Json all;
  const Json whole = explained(c);
  for (const char* key : {"name", "motion", "units", "rate", "valid", "device"}) all[key] = whole[key];
  all["ports"] = ports;
  for (const char* key : {"certificate", "motor_limits", "coupled_operations", "chosen", "reason"})
    all[key] = whole[key];
  all["damping"] = c.law.damping;
  all["largest_damping"] = c.law.largest_damping;
  return all;
}

}  // namespace

std::string explain_json(const Compilation& c) {
  return (c.ports.empty() ? explained(c) : explained_ports(c)).dump(2) + "\n";
}

}  // namespace dashpot::compiler
