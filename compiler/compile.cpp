#include "compile.hpp"

#include <algorithm>
#include <cmath>

#include "certify/assumed_values.hpp"
#include "certify/choice_text.hpp"
#include "certify/curve_bound.hpp"
#include "certify/settle.hpp"
#include "certify/tunable_choice.hpp"
#include "compile_ports.hpp"
#include "decompose/slip_laws.hpp"
#include "discretise/element_names.hpp"
#include "discretise/discretise.hpp"
#include "discretise/rounding.hpp"
#include "law/representable.hpp"
#include "linear/motion_map.hpp"
#include "linear/reach.hpp"
#include "linear/validity.hpp"
#include "lower/begun_at_rest.hpp"
#include "lower/behind_map.hpp"
#include "lower/drop_unread.hpp"
#include "lower/roll.hpp"
#include "lower/shed.hpp"
#include "network/effect.hpp"
#include "network/port_units.hpp"
#include "slip_choice.hpp"
#include "syntax/parse_network.hpp"

namespace dashpot::compiler {
namespace {

// Candidates that the choice is compared with in its text.
bool is_compared(const Candidate& candidate) {
  return candidate.name == "paper" || candidate.name == "velocity-free" || candidate.name == "virtual";
}

bool is_faithful(const Compilation& c) { return c.decomposition.choice().name == "faithful"; }

// How `faithful` moves while the values that the device file assumes are varied; `gap` of jitter as found for the
// choice.
std::optional<ChoiceMoves> moves_of(const Compilation& c, const SlipDecomposer& behind_slips, const Choices& choices,
                                    double gap) {
  const Candidate& choice = c.decomposition.choice();
  ChoiceMoves moves{choice.damping, choice.damping, ""};
  double furthest = 1e-6 * choice.damping;
  const auto chosen_on = [&](const PortDevice& port, const Device& device) {
    Compilation again = c;
    again.device = device;
    again.port = port;
    Candidate& candidate = again.decomposition.choice();
    CandidateSettler settler(c.present, c.form, c.decomposition, choices, port, c.rate);
    settler.assume_jitter_gap(gap);
    settler.settle(candidate);
    choose_over_box(c.network, c.present, c.form, again.decomposition, choices, port, c.rate);
    return c.form.has_slips() ? damping_on_another_device(again, behind_slips, choices) : candidate.damping;
  };
  const std::vector<VariedDevice> devices = with_assumed_varied(*c.device);
  for (const VariedDevice& varied : devices) {
    Diagnostics of_varied;  // a device that would be refused moves nothing
    const std::optional<PortDevice> port = PortDevice::of(varied.device, c.present, of_varied);
    if (!port) continue;
    const double again = chosen_on(*port, varied.device);
    moves.least = std::min(moves.least, again);
    moves.most = std::max(moves.most, again);
    if (const double distance = std::abs(again - choice.damping); distance > furthest)
      furthest = distance, moves.by = varied.key;
  }
  return devices.empty() ? std::nullopt : std::optional(moves);
}

// Without a device nothing tells the state inputs apart, and nothing is added: the certificate comes with the law. Out:
// the gap of jitter at what is chosen.
double settle_choice(Compilation& c, const Choices& choices) {
  if (c.port.is_ideal()) return 1;
  CandidateSettler settler(c.present, c.form, c.decomposition, choices, c.port, c.rate);
  settler.settle(c.decomposition.choice());
  if (is_faithful(c)) {
    choose_over_box(c.network, c.present, c.form, c.decomposition, choices, c.port, c.rate);
    c.decomposition.reason = reason_for_faithful(c.decomposition.choice(), c.network, choices);
  }
  return settler.last_jitter_gap();
}

// What is compared with the choice, with what is chosen behind the slips.
void settle_compared(Compilation& c, const Choices& choices) {
  if (c.port.is_ideal()) return;
  CandidateSettler settler(c.present, c.form, c.decomposition, choices, c.port, c.rate);
  for (Candidate& candidate : c.decomposition.candidates)
    if (&candidate != &c.decomposition.choice() && is_compared(candidate)) settler.settle(candidate);
  if (is_faithful(c)) return;
  Candidate choice = c.decomposition.choice();
  if (c.form.has_slips()) settler.settle(choice);
  choice.state_input = c.decomposition.choice().state_input;
  c.decomposition.reason = reason_for_input(choice, c.network, choices, false);
}

// Everything about the choice that the loop decides. With tunable parameters it stays as it was split, and nothing has
// to be run, but where `faithful` looks for it.
void settle(Compilation& c, const SlipDecomposer& behind_slips, const Choices& choices) {
  if (has_tunables(c.network) && !is_faithful(c)) return;
  const double gap = settle_choice(c, choices);
  if (c.form.has_slips()) choose_slip_law(c, behind_slips, choices);
  if (choices.compared != Compared::nothing) settle_compared(c, choices);
  if (c.decomposition.choice().faithful && choices.compared == Compared::variations)
    c.decomposition.moves = moves_of(c, behind_slips, choices, gap);
}

Beside what_is_beside_slips(const NormalForm& form) {
  if (!form.has_slips()) return Beside::no_slips;
  return form.is_all_behind_slips() ? Beside::nothing : Beside::linear;
}

// What the certificate has added to the brake.
double added_behind_curve(const Compilation& c) { return c.port.behind_curve(c.certificate.added_damping); }

// The error of the law as it is.
void tell_what_is_felt(Compilation& c, const Choices& choices) {
  if (c.port.is_ideal()) return;
  Candidate& choice = c.decomposition.choice();
  CandidateSettler settler(c.present, c.form, c.decomposition, choices, c.port, c.rate);
  choice.largest_error = settler.largest_error(choice, added_behind_curve(c));
  if (choices.compared == Compared::nothing) return;
  c.decomposition.in_words = choice_in_words(
      c.decomposition, {port_units(c.network.port_motion), c.port.max_damping().value_or(0), c.port.steepest(),
                        has_tunables(c.network), to_double(zero_frequency_damping(c.form.linear)),
                        to_double(c.form.linear.feedthrough_damping), what_is_beside_slips(c.form)});
}

// The encoder's range at the tool, against where the surface lies, or the rest where there is none.
void warn_of_reach(const Compilation& c, Diagnostics& diagnostics) {
  const encoder_description& encoder = c.device->description.encoder;
  if (encoder.range_low == encoder.range_high) return;  // unlimited
  const double scale = c.port.at_tool().position_scale(), low = scale * encoder.range_low,
               high = scale * encoder.range_high;
  const std::string unit = port_units(c.network.port_motion).position;
  if (!c.network.contact) {
    if (low <= 0 && 0 <= high) return;
    diagnostics.report<DiagnosticCode::rest_out_of_reach>(c.network.name_span, c.network.name, c.device->name, low,
                                                          high, unit);
    return diagnostics.note<DiagnosticCode::rest_reach_remedy>({});
  }
  const Contact& contact = *c.network.contact;
  // The tissue lies beyond the surface, to the positive side.
  if (contact.at < high) return;
  const bool has_arm = c.device->description.motion != c.network.port_motion;
  diagnostics.report<DiagnosticCode::surface_out_of_reach>(contact.span, contact.at, unit, c.device->name, low, high,
                                                           unit);
  diagnostics.note<DiagnosticCode::surface_reach_remedy>({}, has_arm ? " or its \"arm_radius\"" : "");
}

// Of a network that is not linear: what the chosen candidate needs is known when the whole law is.
void tell_of_certificate(Compilation& c) {
  Candidate& choice = c.decomposition.choice();
  const bool is_proved = c.certificate.bound.proof != Proof::none;
  choice.minimum_damping = is_proved ? std::optional(c.certificate.minimum_damping) : std::nullopt;
  choice.certified = is_proved ? std::optional(c.certificate.certified) : std::nullopt;
  if (choice.faithful) choice.faithful->certified = c.certificate.certified;
}

// Rounded down to the scalar type, so that the device clips nothing that is due to rounding.
MotorReach reach_of(const SampledLoop& loop, ScalarType scalar) {
  const double below = 1 - 8 * unit_roundoff(scalar);
  return {loop.max_force * below, largest_change(loop) * below};
}

// False, with a diagnostic, where states follow an estimate beside tunable parameters: only if they follow the position
// does set() inject no energy.
bool settle_tunables(const Network& network, Choices& choices, Diagnostics& diagnostics) {
  if (!has_tunables(network)) return true;
  const StateInput asked = choices.state_input.value_or(StateInput::position);
  if (asked != StateInput::position)
    diagnostics.report<DiagnosticCode::tunable_needs_position>(network.name_span, name_of(asked));
  choices.state_input = StateInput::position;
  return asked == StateInput::position;
}

// False, with a diagnostic, where there is a static curve that cannot be had. A network that is compiled once more, for
// another device, has its map.
bool put_behind_curve(Network& network, Network& present, const NormalForm& form, Diagnostics& diagnostics) {
  if (!network.static_curve) return true;
  if (!network.map) network.map = motion_map(present, form.linear, diagnostics);
  present.map = network.map;
  return network.map.has_value();
}

// Certifies the law and lowers it to what is emitted.
void certify_law(Compilation& c, const Choices& choices) {
  const SampledLoop loop = sampled_loop(c.port, 1 / c.rate);
  const std::optional<SlipMotor> slips = slip_motor(c.network, c.form, c.decomposition, choices, loop);
  c.certificate =
      c.network.map ? certify_behind_curve(c.law, c.network, slips, c.port, 1 / c.rate) : certify(c.law, loop, slips);
  const bool sheds = c.certificate.limits.rule == LimitRule::sheds;
  const MotorReach reach = reach_of(c.certificate.loop, choices.scalar);
  if (sheds) c.law = told_of_motor(std::move(c.law), reach);
  if (c.network.map)
    c.law = without_unread_locals(
        behind_map(std::move(c.law), *c.network.map, c.certificate.added_damping, c.network.port_motion));
  if (sheds) c.law = with_shedding(std::move(c.law), reach, c.network.port_motion);
  c.law = begun_at_rest(std::move(c.law));
}

}  // namespace

std::optional<Network> check(const SourceFile& source, Diagnostics& diagnostics, const std::optional<Device>& device) {
  const std::optional<NetworkDecl> decl = parse_network(source, diagnostics);
  if (!decl) return std::nullopt;
  if (!device) return build_network(*decl, diagnostics);
  const auto& loop = device->description.loop;
  return build_network(*decl, diagnostics, Range{loop.band_low, loop.band_high});
}

std::optional<Compilation> compile(const SourceFile& source, const Choices& choices,
                                   const std::optional<Device>& device, Diagnostics& diagnostics) {
  StageTimes unseen;
  return compile(source, choices, device, diagnostics, unseen);
}

std::optional<Compilation> compile(const SourceFile& source, const Choices& asked, const std::optional<Device>& device,
                                   Diagnostics& diagnostics, StageTimes& times) {
  times.enter("front end");
  std::optional<Network> network = check(source, diagnostics, device);
  return network ? compile(std::move(*network), asked, device, diagnostics, times) : std::nullopt;
}

std::optional<Compilation> compile(Network network, const Choices& asked, const std::optional<Device>& device,
                                   Diagnostics& diagnostics, StageTimes& times) {
  if (!network.ports.empty()) return compile_ports(std::move(network), asked, device, diagnostics, times);
  Choices choices = with_names(asked, device || has_slips(network));
  if (!settle_tunables(network, choices, diagnostics)) return std::nullopt;
  Network present = at_default(network);
  if (!is_within_reach(present, diagnostics)) return std::nullopt;
  times.enter("normal form");
  std::optional<NormalForm> form = closed_normal_form(present, diagnostics);
  if (!form || !put_behind_curve(network, present, *form, diagnostics)) return std::nullopt;
  Compilation result;
  result.network = std::move(network);
  result.present = std::move(present);
  result.device = device;
  result.registers = choices.registers;
  result.rate = choices.rate.value_or(device ? 1 / device->description.loop.sample_period : default_rate);
  result.form = std::move(*form);
  warn_about_validity(result.form.linear, result.network, diagnostics);
  std::optional<PortDevice> port = device ? PortDevice::of(*device, result.network, diagnostics) : PortDevice::ideal();
  if (!port) return std::nullopt;
  result.port = std::move(*port);
  if (device) warn_of_reach(result, diagnostics);
  times.enter("decomposition");
  const SlipDecomposer behind_slips(result.present, result.form, result.port.reference_frequency());
  std::optional<Decomposition> decomposition =
      decompose(result.present, result.form, behind_slips, choices, result.port, diagnostics);
  if (!decomposition) return std::nullopt;
  result.decomposition = std::move(*decomposition);
  settle(result, behind_slips, choices);
  warn_about_choice(result.decomposition, result.network, result.form.linear, diagnostics);
  times.enter("discretisation");
  warn_about_rate_and_scalar(result.network, result.form, result.decomposition, choices, result.rate, diagnostics);
  if (has_tunables(result.network)) {
    result.decomposition.reason = "position driven, so that a change of parameters injects no energy";
    std::optional<UpdateLaw> law = discretise_tunable(result.network, result.present, result.form, result.decomposition,
                                                      choices, result.rate, result.port, diagnostics);
    if (!law) return std::nullopt;
    result.law = without_unread_locals(std::move(*law));
  } else {
    result.law = rolled(
        without_unread_locals(discretise(result.network, result.form, result.decomposition, choices, result.rate)),
        choices.registers, choices.guards_each_sample);
  }
  if (!is_representable(result.law, result.network, diagnostics)) return std::nullopt;
  times.enter("certificate");
  certify_law(result, choices);
  if (!is_representable(result.law, result.network, diagnostics)) return std::nullopt;
  if (!result.port.is_ideal() && result.beyond_linear()) tell_of_certificate(result);
  tell_what_is_felt(result, choices);
  if (!class_differs_from_members(result.law, result.network, diagnostics)) return std::nullopt;
  return result;
}

void weigh_all_candidates(Compilation& c, const Choices& asked) {
  for (Compilation& port : c.ports) weigh_all_candidates(port, asked);
  if (!c.ports.empty()) return;
  const Choices choices = with_names(asked, c.device || c.form.has_slips());
  CandidateSettler settler(c.network, c.form, c.decomposition, choices, c.port, c.rate);
  for (std::size_t i = 0; i < c.decomposition.candidates.size(); ++i) {
    Candidate& candidate = c.decomposition.candidates[i];
    const bool is_made = i == c.decomposition.chosen && !c.port.is_ideal();
    if (!is_made) settler.settle(candidate);
    CandidateSettler::ErrorOverBand errors =
        settler.error_over_band(candidate, is_made ? std::optional(added_behind_curve(c)) : std::nullopt);
    candidate.error_over_band = std::move(errors.errors);
    if (!errors.frequencies.empty()) c.decomposition.error_frequencies = std::move(errors.frequencies);
  }
  if (c.port.is_ideal() && c.beyond_linear()) tell_of_certificate(c);
}

}  // namespace dashpot::compiler
