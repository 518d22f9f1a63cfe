#include "commands/axes_commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compile_axes.hpp"
#include "law/cost.hpp"
#include "law/law_text.hpp"
#include "network/port_units.hpp"
#include "source/wrapped_text.hpp"
#include "syntax/parse_axes.hpp"

namespace dashpot::compiler {
namespace {

using Json = nlohmann::ordered_json;

// Options that only laws of one axis know.
const char* option_of_one_axis(const Options& options) {
  if (options.emission.constant_time) return "--constant-time";
  if (options.emission.batch) return "--batch";
  if (options.emission.with_test && !options.target->tests_axes) return "--with-test";
  if (options.proof) return "--proof";
  return nullptr;
}

std::size_t operations(const UpdateLaw& law, const std::vector<Statement>& program) {
  const Cost cost = cost_of(law, program);
  return cost.additions + cost.multiplications + cost.selections + cost.guards + cost.coupled;
}

std::string ports_text(const AxesCompilation& c) {
  std::string text = fmt::format("{:<16} {:<8} {:>12} {:>12} {:>12} {:>6}  {}\n", "port", "map", "b [N s/m]",
                                 "k0 [N/m]", "b∞ [N s/m]", "modes", "rule");
  for (std::size_t i = 0; i < c.ports.size(); ++i) {
    const Compilation& port = c.ports[i];
    text += fmt::format("{:<16} {:<8} {:>12.6g} {:>12.6g} {:>12.6g} {:>6}  {}{}\n", c.network.ports[i].name,
                        c.network.ports[i].map_kind, port.decomposition.choice().damping,
                        to_double(port.form.linear.static_stiffness), to_double(port.form.linear.feedthrough_damping),
                        port.form.linear.modes.size(), port.decomposition.choice().name,
                        port.network.contact ? ", contact" : "");
  }
  if (c.network.has_field()) text += to_text(c.network.field) + '\n';
  return text;
}

// In thousandths, without the sign of a zero.
double rounded_share(double share) { return std::round(share * 1e3) / 1e3 + 0.0; }

std::string share_row(std::string_view name, const axes::ShareMap& share, bool is_chosen) {
  const std::string place = fmt::format("({:.3g}, {:.3g})", 1e3 * share.worst_at[0], 1e3 * share.worst_at[1]);
  return fmt::format("{:<14} {:>6.3f} {:>6.3f} {:>6.3f} {:>14} {:>8.3f} {:>8.3f} {:>12.0f}{}\n", name,
                     rounded_share(share.mean), rounded_share(share.median), rounded_share(share.worst), place,
                     rounded_share(share.worst_direction_median), rounded_share(share.worst_direction_worst),
                     100 * share.delay_proof, is_chosen ? "  chosen" : "");
}

// Brakes like the first of two, on what couples the joints, along directions that have none; none for a device that has
// more than two, or no brakes.
struct MoreBrakes {
  std::string name;
  std::vector<AlongBrake> brakes;
};
std::vector<MoreBrakes> more_brakes(const AxesDevice& device) {
  if (device.brakes.size() != 2 || device.brakes[0].brake.kind == brake_kind::none) return {};
  const std::pair<const char*, axes::Pair<double>> directions[] = {
      {"one on q1 - q2", {1, -1}}, {"one on q1 + q2", {1, 1}}, {"one on q1", {1, 0}}, {"one on q2", {0, 1}}};
  std::vector<MoreBrakes> all;
  for (const auto& [name, along] : directions) {
    const axes::Pair<double> across = axes::turned(along);
    const auto is_parallel = [&](const AlongBrake& brake) { return axes::dot(across, brake.along) == 0; };
    if (all.size() < 2 && std::none_of(device.brakes.begin(), device.brakes.end(), is_parallel))
      all.push_back({name, {{along, device.brakes[0].brake}}});
  }
  if (all.size() == 2) all.push_back({"both", {all[0].brakes[0], all[1].brakes[0]}});
  return all;
}

// Whether the tip's polar coordinates turn with the sum of the joints' angles and with their difference.
bool is_polar(const axes::Arm& arm) {
  if (arm.kind == axes::Kinematics::parallelogram) return arm.proximal == arm.distal;
  return arm.kind == axes::Kinematics::five_bar && arm.base == 0;
}

// Nothing where there is none.
const RuleShare* share_of(axes::BrakeRule rule, const std::vector<RuleShare>& shares) {
  const auto by = std::find_if(shares.begin(), shares.end(), [&](const RuleShare& one) { return one.rule == rule; });
  return by != shares.end() ? &*by : nullptr;
}

std::string more_brakes_text(const AxesCompilation& c, const std::vector<CertifiedPort>& ports,
                             const std::vector<RuleShare>& candidates) {
  const axes::BrakeRule rule = axes::BrakeRule::non_injecting;
  const RuleShare* const as_it_is = share_of(rule, candidates);
  const std::vector<MoreBrakes> all = more_brakes(c.device);
  if (as_it_is == nullptr || all.empty()) return "";
  std::string text = "\nwhat more brakes like brake 1 would make without the motors bringing energy in\n" +
                     share_row("as it is", as_it_is->share, false);
  for (const MoreBrakes& more : all)
    if (const auto share = share_with(c, ports, rule, more.brakes)) text += share_row(more.name, *share, false);
  if (is_polar(c.device.arm))
    text += "on this arm two brakes, on q1 - q2 and on q1 + q2, make every damping that is alike in all directions\n";
  return text;
}

std::string shares_text(const AxesCompilation& c) {
  const std::vector<CertifiedPort> ports = certified_ports(c);
  const std::vector<RuleShare> candidates = shares_by_rule(c, ports);
  std::string text = fmt::format(
      "how much of the ports' damping the brakes make, over the workspace\n"
      "{:<14} {:>20} {:>14} {:>17} {:>12}\n"
      "{:<14} {:>6} {:>6} {:>6} {:>14} {:>8} {:>8} {:>12}\n",
      "", "in all directions", "", "in the worst one", "delay-proof", "candidate", "mean", "median", "least", "at [mm]",
      "median", "least", "[%]");
  for (const axes::BrakeRule rule : axes::all_brake_rules) {
    const RuleShare* const by = share_of(rule, candidates);
    text += by ? share_row(name_of(rule), by->share, rule == c.rule)
               : fmt::format("{:<14} more damping is wanted than can be computed\n", name_of(rule));
  }
  return text + more_brakes_text(c, ports, candidates);
}

std::string legend(const AxesCompilation& c) {
  const std::pair<const char*, const char*> of_all[] = {
      {"map", "what the port's network feels of the tip: its way along a direction, or its distance from something"},
      {"b", "the damping that the brakes are asked to make along the port"},
      {"k0", "of the port's spring that is left when everything has relaxed"},
      {"b∞", "of the port's damper that is felt at once"},
      {"modes", "springs and dampers in series that relax by themselves"},
      {"rule",
       "the decomposition of the port's network that gave b; '--decomposition faithful' "
       "takes b∞, so that no velocity estimate moves the port's springs. 'contact': the port pushes and never "
       "pulls, and b is no more than b∞"}};
  const std::pair<const char*, const char*> of_shares[] = {
      {"diagonal", "each brake makes what its joint is to feel; what couples the joints is left to the motors"},
      {"non-injecting", "as much as the brakes can make without the motors bringing energy in"},
      {"virtual", "no brakes: the motors make all damping, from estimated velocities"},
      {"in all directions",
       "1 where brakes turn as much into heat as is wanted, on average over the directions of a "
       "motion; above 1 they make more, and the motors take that back"},
      {"in the worst one", "the same in the direction in which it is least"},
      {"at", "where in the workspace the least is, x and y of the tip"},
      {"delay-proof",
       "the part of the workspace where what the motors make of the damping stays passive, however late "
       "the estimated velocities are"}};
  std::string text;
  const auto add = [&text](const auto& lines) {
    for (const auto& [name, meaning] : lines)
      for (const std::string& line : wrapped_text(fmt::format("{:<22}{}", name, meaning), 98, 22)) text += line + "\n";
  };
  add(of_all);
  if (c.certificate.share) add(of_shares);
  return text;
}

Json json_of(const axes::ShareMap& share) {
  return {{"mean", share.mean},
          {"median", share.median},
          {"worst", share.worst},
          {"worst_at", share.worst_at},
          {"worst_direction_median", share.worst_direction_median},
          {"worst_direction_worst", share.worst_direction_worst},
          {"delay_proof", share.delay_proof}};
}

// As a file has it: by rows, or over knots.
Json json_of(const axes::ViscousField& field) {
  if (field.is_uniform()) return field.at_knot.front();
  Json along[2];
  for (std::size_t axis = 0; axis < 2; ++axis)
    for (std::size_t i = 0; i < field.knots[axis]; ++i)
      along[axis].push_back(field.start[axis] + double(i) * field.spacing[axis]);
  Json rows;
  for (std::size_t i = 0; i < field.at_knot.size(); ++i) rows[i / field.knots[0]].push_back(field.at_knot[i]);
  return {{"x", along[0]}, {"y", along[1]}, {"viscous", rows}};
}

// What of the field passes; null where there is no gate.
Json json_of_gate(const AxesCertificate& c) {
  if (!c.gate) return nullptr;
  return {{"mean", c.passage->mean}, {"least", c.passage->least}, {"least_at", c.passage->least_at}};
}

std::string explain_json(const AxesCompilation& c) {
  Json ports = Json::array(), candidates = Json::array();
  for (std::size_t i = 0; i < c.ports.size(); ++i) {
    const LinearForm& form = c.ports[i].form.linear;
    Json modes = Json::array();
    for (const Mode& mode : form.modes)
      modes.push_back({{"stiffness", to_double(mode.stiffness)}, {"relaxation_rate", to_double(mode.relaxation_rate)}});
    ports.push_back({{"name", c.network.ports[i].name},
                     {"map", c.network.ports[i].map_kind},
                     {"contact", c.ports[i].network.contact.has_value()},
                     {"static_stiffness", to_double(form.static_stiffness)},
                     {"feedthrough_damping", to_double(form.feedthrough_damping)},
                     {"modes", modes},
                     {"damping", c.ports[i].decomposition.choice().damping}});
  }
  const std::vector<CertifiedPort> certified = certified_ports(c);
  const std::vector<RuleShare> shares = shares_by_rule(c, certified);
  for (const axes::BrakeRule rule : axes::all_brake_rules) {
    const RuleShare* const by = share_of(rule, shares);
    candidates.push_back({{"name", name_of(rule)}, {"share", by ? json_of(by->share) : Json(nullptr)}});
  }
  Json with_more = Json::array();
  for (const MoreBrakes& more : more_brakes(c.device)) {
    Json along = Json::array();
    for (const AlongBrake& brake : more.brakes) along.push_back(brake.along);
    if (const auto share = share_with(c, certified, axes::BrakeRule::non_injecting, more.brakes))
      with_more.push_back({{"along", along}, {"share", json_of(*share)}});
  }
  const AxesCertificate& certificate = c.certificate;
  const bool is_proved = certificate.is_proved;
  const Json json = {
      {"name", c.network.name},
      {"axes", most_axes},
      {"device", c.has_device ? Json(c.device.name) : Json(nullptr)},
      {"kinematics", name_of(c.device.arm.kind)},
      {"viscous", json_of(c.network.field)},
      {"ports", ports},
      {"candidates", candidates},
      {"more_brakes", with_more},
      {"chosen", name_of(c.rule)},
      {"needed_damping", is_proved ? Json(certificate.needed) : Json(nullptr)},
      {"damping_for_estimates", is_proved ? Json(certificate.for_estimates) : Json(nullptr)},
      {"damping_for_lag", is_proved ? Json(certificate.for_lag) : Json(nullptr)},
      {"missing_damping", is_proved ? Json(certificate.missing) : Json(nullptr)},
      {"worst_at", is_proved ? Json(certificate.worst) : Json(nullptr)},
      {"added_damping", certificate.added},
      {"torque_of_steps", certificate.torque_of_steps ? Json(*certificate.torque_of_steps) : Json(nullptr)},
      {"gate", json_of_gate(certificate)},
      {"certified", certificate.certified},
      {"operations", {{"output", operations(c.law, c.law.output)}, {"update", operations(c.law, c.law.update)}}}};
  return json.dump(2) + "\n";
}

std::string explain_text(const AxesCompilation& c, bool with_legend) {
  std::string text =
      fmt::format("{}: two axes, {}\n", c.network.name,
                  c.has_device ? fmt::format("device '{}', {}", c.device.name, name_of(c.device.arm.kind))
                               : "no device: the joints are the tool's own axes");
  text += "\n" + ports_text(c);
  if (c.certificate.share) text += "\n" + shares_text(c);
  if (with_legend) text += "\n" + legend(c);
  text += "\n";
  for (const std::string& fact : explained_lines(c.certificate, c.device))
    for (const std::string& line : wrapped_text(fact, 98, 2)) text += line + "\n";
  return text + fmt::format("a step takes {} operations before the command leaves and {} after it\n",
                            operations(c.law, c.law.output), operations(c.law, c.law.update));
}

void note_what_would_do(const AxesCompilation& c, Diagnostics& diagnostics) {
  const std::string unit = port_units(c.device.joint_motion()).damping;
  if (const auto limits = brakes_that_would_do(c)) {
    std::vector<double> there;
    for (const AlongBrake& brake : c.device.brakes) there.push_back(brake.brake.max_damping);
    diagnostics.note<DiagnosticCode::brakes_that_would_do>({}, fmt::format("{:.4g}", fmt::join(*limits, " and ")), unit,
                                                           fmt::format("{:.4g}", fmt::join(there, " and ")));
  }
  const auto own = own_damping_that_would_do(c);
  if (!own) return;
  const auto& there = c.device.mechanics.damping;
  diagnostics.note<DiagnosticCode::joints_that_would_do>({}, (*own)[0], (*own)[1], unit, there[0], there[1], (*own)[0],
                                                         unit, (*own)[1], unit);
  diagnostics.note<DiagnosticCode::softer_ports_remedy>({});
}

}  // namespace

bool has_two_axes(const SourceFile& network) { return axes_of(network) == most_axes; }

bool as_many_axes(const SourceFile& network, const DeviceChoice& device, Diagnostics& diagnostics) {
  const bool is_of_two = has_two_axes(network);
  if ((!device.device && !device.axes_device) || device.axes_device.has_value() == is_of_two) return true;
  diagnostics.report<DiagnosticCode::axes_differ>(
      {}, is_of_two ? 2 : 1, is_of_two ? device.device->name : device.axes_device->name, is_of_two ? 1 : 2);
  return false;
}

std::optional<AxesCompilation> compile_axes(const SourceFile& network, const Options& options,
                                            const DeviceChoice& device, Diagnostics& diagnostics) {
  StageTimes unseen;
  return compile_axes(network, options, device, diagnostics, unseen);
}

std::optional<AxesCompilation> compile_axes(const SourceFile& network, const Options& options,
                                            const DeviceChoice& device, Diagnostics& diagnostics, StageTimes& times) {
  if (!as_many_axes(network, device, diagnostics)) return std::nullopt;
  return compile_axes(network, options.choices, device.axes_device, diagnostics, times);
}

std::string explain_axes(const AxesCompilation& compilation, bool as_json, bool with_legend) {
  return as_json ? explain_json(compilation) : explain_text(compilation, with_legend);
}

std::string axes_stage_text(const AxesCompilation& c, const std::string& stage) {
  if (stage == "network") return to_text(c.network);
  if (stage == "law") {
    Network whole;
    whole.name = c.network.name, whole.port_motion = c.device.joint_motion();
    return to_text(c.law, whole);
  }
  if (stage == "certificate") {
    std::string text = "certificate of " + c.network.name + "\n";
    for (const std::string& line : explained_lines(c.certificate, c.device)) text += line + "\n";
    return text;
  }
  std::string text;
  for (std::size_t i = 0; i < c.ports.size(); ++i) {
    const Compilation& port = c.ports[i];
    text += "port " + c.network.ports[i].name + "\n";
    text += stage == "linear" ? to_text(port.form.linear, port.network)
                              : candidates_text(port.decomposition, port.network) + chosen_text(port.decomposition);
  }
  return text;
}

namespace {

std::string device_of(const AxesCompilation& c) {
  return c.has_device ? fmt::format("device '{}'", c.device.name) : "an ideal device";
}

}  // namespace

void warn_of_uncertified(const AxesCompilation& c, Diagnostics& diagnostics) {
  const std::string why = why_not_certified(c.certificate, c.device);
  if (c.certificate.lacks_only_damping())
    return diagnostics.report<DiagnosticCode::lacks_damping>(c.network.name_span, c.network.name, device_of(c), why);
  diagnostics.report<DiagnosticCode::nothing_proved>(c.network.name_span, c.network.name, device_of(c), why);
  if (c.certificate.lies_in_port) diagnostics.note<DiagnosticCode::ports_that_can_be_certified>({});
}

bool insist_on_certificate(const AxesCompilation& c, const Options& options, Diagnostics& diagnostics) {
  if (c.certificate.certified) return true;
  const bool is_refused = c.certificate.lacks_only_damping() && !options.uncertified;
  if (is_refused)
    diagnostics.report<DiagnosticCode::axes_not_certified>(c.network.name_span, c.network.name, device_of(c),
                                                           why_not_certified(c.certificate, c.device));
  else warn_of_uncertified(c, diagnostics);
  if (!c.certificate.lacks_only_damping()) return true;
  if (diagnostics.wants_advice()) note_what_would_do(c, diagnostics);
  if (!options.uncertified) diagnostics.note<DiagnosticCode::compile_uncertified>({});
  return options.uncertified;
}

namespace {

std::string targets_of_two_axes() {
  std::string names;
  for (const Target& target : targets())
    if (target.emit_axes) names += fmt::format("{}--target {}", names.empty() ? "" : " and ", target.name);
  return names;
}

}  // namespace

std::optional<std::vector<OutputFile>> emit_axes(const AxesCompilation& c, const Options& options,
                                                 Diagnostics& diagnostics) {
  const Target& target = *options.target;
  const char* const option = option_of_one_axis(options);
  if (!target.emit_axes)
    diagnostics.report<DiagnosticCode::target_on_two_axes>(c.network.name_span, std::string(target.name),
                                                           targets_of_two_axes());
  if (option != nullptr) diagnostics.report<DiagnosticCode::option_on_two_axes>(c.network.name_span, option);
  if (!target.emit_axes || option != nullptr) return std::nullopt;
  return insist_on_certificate(c, options, diagnostics) ? target.emit_axes(c, options.emission, diagnostics)
                                                        : std::nullopt;
}

}  // namespace dashpot::compiler
