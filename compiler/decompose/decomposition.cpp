#include "decompose/decomposition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "decompose/observer.hpp"
#include "decompose/spectrum.hpp"
#include "network/port_units.hpp"
#include "network/tree.hpp"

namespace dashpot::compiler {
namespace {

// A split before the brake's reach and the state input are decided.
struct Split {
  std::string name;
  double damping;
  std::string reason;
  std::optional<StateInput> fixed_input;  // where the name implies one
};

class Decomposer {
 public:
  Decomposer(const Network& network, const LinearForm& form, const Choices& choices, const PortDevice& device)
      : network_(network), form_(form), choices_(choices), device_(device), tree_(series_parallel_tree(network)) {}

  std::vector<Split> splits() const {
    const double feedthrough = to_double(form_.feedthrough_damping);
    const double viscosity = to_double(zero_frequency_damping(form_));
    const double half = to_double(zero_frequency_damping(form_) / 2);
    const bool needs_no_estimate = half <= feedthrough;
    std::vector<Split> list;
    if (lists_faithful()) list.push_back(faithful());
    list.push_back(observed("paper", ObserverRule::most_dissipative));
    list.push_back({"zero-frequency", viscosity, "the network's zero-frequency damping", {}});
    list.push_back({"quietest-passive", std::max(half, feedthrough),
                    "half the zero-frequency damping, but no less than the feedthrough damping",
                    needs_no_estimate ? StateInput::position : StateInput::velocity});
    list.push_back({"velocity-free", feedthrough, "the feedthrough damping: no velocity estimate in the motor",
                    StateInput::position});
    list.push_back(observed("largest-observer", ObserverRule::largest));
    if (has_slips(network_)) {
      for (const char* slip_law : {"steady", "ramped", "gated"})
        list.push_back(observed(slip_law, ObserverRule::most_dissipative));
    }
    list.push_back({"virtual", 0, "no brake: everything computed", {}});
    if (const double* given = std::get_if<double>(&choices_.decomposition))
      list.push_back({fmt::format("{}", *given), *given, "given", {}});
    return list;
  }

  // The canonical form with the spring shares of the realisation whose observer is next to the tool.
  LinearForm realisation() const {
    if (!tree_) return form_;
    const ObserverRule rule =
        is_named(choices_, "largest-observer") ? ObserverRule::largest : ObserverRule::most_dissipative;
    return linear_form(observe(*tree_, network_, rule, device_.reference_frequency()).realisation);
  }

  Candidate weigh(const Split& split, const LinearForm& realisation) const {
    Candidate candidate;
    candidate.name = split.name;
    candidate.reason = split.reason;
    candidate.wanted_damping = split.damping;
    candidate.damping = std::min(split.damping, device_.max_damping().value_or(split.damping));
    if (network_.contact) leave_nothing_to_compensate(candidate);
    for (StateInput input : inputs_to_compare(split))
      candidate.state_inputs.push_back(merit(candidate, input, realisation));
    const StateInputMerit& best = best_of(candidate.state_inputs);
    candidate.state_input = best.state_input;
    candidate.largest_error = best.largest_error;
    candidate.extra_damping_any_delay = best.extra_damping_any_delay;
    if (split.name == "quietest-passive" &&
        best.extra_damping_any_delay <= 1e-9 * candidate.damping)  // apart from rounding
      candidate.reason += "; passive under any delay";
    candidate.velocity_gain = std::abs(to_double(form_.feedthrough_damping) - candidate.damping);
    if (const std::optional<double> noise = device_.velocity_noise())
      candidate.motor_noise = candidate.velocity_gain * *noise;
    return candidate;
  }

 private:
  // More than b∞ would be taken back by the motor through the estimate, also in the samples in which the tool touches
  // or leaves: that can inject energy.
  void leave_nothing_to_compensate(Candidate& candidate) const {
    const double feedthrough = to_double(form_.feedthrough_damping);
    if (candidate.damping <= feedthrough) return;
    candidate.damping = candidate.wanted_damping = feedthrough;
    candidate.reason +=
        "; with the contact no more than the feedthrough damping, so that the motor compensates nothing";
  }

  bool lists_faithful() const { return !device_.is_ideal() || is_named(choices_, "faithful"); }

  // On a device the damping is found where what is felt is known (certify/settle.hpp); until then it is b∞.
  Split faithful() const {
    if (device_.is_ideal()) {
      Split split = observed("paper", ObserverRule::most_dissipative);
      split.name = "faithful";
      split.reason = "without a device 'faithful' is the paper's rule: " + split.reason;
      return split;
    }
    const double feedthrough = to_double(form_.feedthrough_damping);
    return {"faithful",
            feedthrough,
            "the largest b whose felt error is within the tolerance or, if none is, within 1.05 times the least",
            {}};
  }

  Split observed(const char* name, ObserverRule rule) const {
    if (!tree_)
      return {name,
              to_double(zero_frequency_damping(form_)),
              "not a series-parallel tree, so b is the zero-frequency damping",
              {}};
    const Observation observation = observe(*tree_, network_, rule, device_.reference_frequency());
    return {name, to_double(observation.damping), observation.reason, {}};
  }

  // `position` first: it is preferred where nothing else tells the inputs apart.
  std::vector<StateInput> inputs_to_compare(const Split& split) const {
    if (choices_.state_input) return {*choices_.state_input};
    if (network_.contact || network_.map) return {StateInput::position};
    const bool velocity_may_drive = device_.estimate_sums_to_displacement();
    if (split.fixed_input && (velocity_may_drive || *split.fixed_input == StateInput::position))
      return {*split.fixed_input};
    std::vector<StateInput> inputs = {StateInput::position};
    if (velocity_may_drive) inputs.push_back(StateInput::velocity);
    if (velocity_may_drive && choices_.scheme == Scheme::backward_euler) inputs.push_back(StateInput::nodal);
    return inputs;
  }

  StateInputMerit merit(const Candidate& candidate, StateInput input, const LinearForm& realisation) const {
    const LinearForm& form = input == StateInput::nodal ? realisation : form_;
    return {input, largest_error(form, candidate.damping, input, device_),
            extra_damping_any_delay(form, candidate.damping, input, device_.tolerance())};
  }

  static const StateInputMerit& best_of(const std::vector<StateInputMerit>& merits) {
    constexpr double noticeable = 1 - 1e-9;  // beyond rounding
    const StateInputMerit* best = &merits.front();
    for (const StateInputMerit& merit : merits)
      if (merit.largest_error < best->largest_error * noticeable) best = &merit;
    return *best;
  }

  const Network& network_;
  const LinearForm& form_;
  const Choices& choices_;
  const PortDevice& device_;
  std::optional<Tree> tree_;
};

bool refuse_impossible_choices(const Network& network, const Choices& choices, const PortDevice& device,
                               Diagnostics& diagnostics) {
  bool refused = contradicts_itself(choices, diagnostics);
  if (network.contact && choices.state_input.value_or(StateInput::position) != StateInput::position) {
    diagnostics.report<DiagnosticCode::contact_needs_position>(network.contact->span, name_of(*choices.state_input));
    refused = true;
  }
  if (choices.state_input && *choices.state_input != StateInput::position && !device.estimate_sums_to_displacement()) {
    diagnostics.report<DiagnosticCode::velocity_input_drifts>(network.name_span, name_of(*choices.state_input),
                                                              network.name);
    refused = true;
  }
  return refused;
}

constexpr double overwhelming = 1e4;  // an error of 1 % in the brake is then a hundred times the network's force

void warn_about_share(const Candidate& chosen, const Network& network, const LinearForm& form, const PortDevice& device,
                      Diagnostics& diagnostics) {
  const double share = largest_brake_share(form, chosen.damping, device);
  if (share <= overwhelming) return;
  constexpr double two_pi = 6.28318530717958647692;
  diagnostics.report<DiagnosticCode::brake_dwarfs_network>(network.name_span, chosen.name, share,
                                                           device.band_low() / two_pi, device.band_high() / two_pi);
  diagnostics.note<DiagnosticCode::take_velocity_free>({});
}

}  // namespace

void warn_about_choice(const Decomposition& all, const Network& network, const LinearForm& form,
                       Diagnostics& diagnostics) {
  const Candidate& chosen = all.choice();
  if (chosen.capped())
    diagnostics.report<DiagnosticCode::damping_capped>(network.name_span, chosen.name, chosen.wanted_damping,
                                                       chosen.damping);
  const double viscosity = to_double(zero_frequency_damping(form));
  // For `faithful` this is explained with the choice.
  if (chosen.name != "faithful" && chosen.damping > viscosity * (1 + 1e-12)) {
    diagnostics.report<DiagnosticCode::injects_power>(network.name_span, chosen.name, chosen.damping, viscosity);
    diagnostics.note<DiagnosticCode::injects_power_remedy>({});
  }
}

std::string reason_for_only_input(const Candidate& chosen, const Network& network) {
  const auto always = [&](const std::string& who) {
    return fmt::format("{} driven, as {} always is", name_of(chosen.state_input), who);
  };
  if (network.contact) return always("a network with a contact");
  if (network.map) return always("a network with a static curve");
  if (chosen.name == "quietest-passive" || chosen.name == "velocity-free") return always("'" + chosen.name + "'");
  return fmt::format("{} driven, because adding up this estimator's velocities does not give back the position",
                     name_of(chosen.state_input));
}

std::string reason_for_input(const Candidate& chosen, const Network& network, const Choices& choices,
                             bool device_is_ideal) {
  if (choices.state_input) return fmt::format("{} driven as asked", name_of(chosen.state_input));
  if (chosen.state_inputs.size() == 1) return reason_for_only_input(chosen, network);
  if (device_is_ideal) return "position driven: on an ideal device position and velocity do equally well";
  const std::string damping_unit = port_units(network.port_motion).damping;
  std::string text =
      fmt::format("{} driven; minimum damping and largest error in the band:", name_of(chosen.state_input));
  for (const StateInputMerit& merit : chosen.state_inputs)
    text += fmt::format(
        "{} {} {}, {:.4g} %", &merit == &chosen.state_inputs.front() ? "" : ";", name_of(merit.state_input),
        merit.minimum_damping ? fmt::format("{:.4g} {}", *merit.minimum_damping, damping_unit) : "not proved",
        100 * merit.largest_error);
  return text;
}

bool contradicts_itself(const Choices& choices, Diagnostics& diagnostics) {
  if (choices.state_input != StateInput::nodal || choices.scheme != Scheme::exact) return false;
  diagnostics.report<DiagnosticCode::nodal_needs_backward_euler>({});
  diagnostics.note<DiagnosticCode::nodal_remedy>({});
  return true;
}

std::optional<Decomposition> decompose(const Network& network, const LinearForm& form, const Choices& choices,
                                       const PortDevice& device, Diagnostics& diagnostics) {
  if (refuse_impossible_choices(network, choices, device, diagnostics)) return std::nullopt;
  const Decomposer decomposer(network, form, choices, device);
  Decomposition result;
  if (choices.scheme == Scheme::backward_euler) result.realisation = decomposer.realisation();
  for (const Split& split : decomposer.splits())
    result.candidates.push_back(decomposer.weigh(split, result.realisation));
  const auto* name = std::get_if<std::string>(&choices.decomposition);
  const auto chosen = std::find_if(result.candidates.begin(), result.candidates.end(),
                                   [&](const Candidate& candidate) { return name && candidate.name == *name; });
  result.chosen = name ? static_cast<std::size_t>(chosen - result.candidates.begin()) : result.candidates.size() - 1;
  if (result.chosen == result.candidates.size()) {
    const bool needs_slips = *name == "steady" || *name == "ramped" || *name == "gated";
    if (needs_slips)
      diagnostics.report<DiagnosticCode::no_such_slip_law>(network.name_span, *name, network.name,
                                                           "it is a law for slips, and this network has none");
    else if (*name == "diagonal")
      diagnostics.report<DiagnosticCode::no_such_slip_law>(network.name_span, *name, network.name,
                                                           "it is a rule for several axes, and this network has one");
    else diagnostics.report<DiagnosticCode::unknown_decomposition>(network.name_span, *name);
    return std::nullopt;
  }
  result.encoder_step = device.encoder_step();
  result.tolerance = choices.tolerance;
  result.reason = reason_for_input(result.choice(), network, choices, device.is_ideal());
  warn_about_share(result.choice(), network, form, device, diagnostics);
  return result;
}

namespace {

bool is_same(const Candidate& one, const Candidate& other) {
  return one.damping == other.damping && one.state_input == other.state_input;
}

// `mark` follows the name.
std::string candidate_row(const Candidate& c, const char* mark) {
  const auto number = [](double value) { return fmt::format("{:.5g}", value); };
  const auto or_dash = [&](const std::optional<double>& value) { return value ? number(*value) : "-"; };
  // A damping that the user gave is shown as it was written.
  const bool is_given = c.name == fmt::format("{}", c.damping) && c.name.size() < 12;
  return fmt::format("{:<17}{:>12}  {:<9}{:>12}{:>12}{:>12}{:>12}{:>12}\n", c.name + mark,
                     is_given ? c.name : number(c.damping), name_of(c.state_input), number(c.velocity_gain),
                     number(c.extra_damping_any_delay.value_or(0)), or_dash(c.minimum_damping), or_dash(c.motor_noise),
                     fmt::format("{:.4g}", 100 * c.largest_error));
}

std::string reason_line(const Candidate& c) {
  return fmt::format("  {:<20}{}{}\n", c.name,
                     c.capped()
                         ? fmt::format("lowered from {:.5g} to what the brake can give beside the damping that must be "
                                       "added: ",
                                       c.wanted_damping)
                         : "",
                     c.why());
}

}  // namespace

std::string Candidate::why() const {
  const bool follows_estimate = name == "velocity-free" && velocity_gain > 0;
  return follows_estimate ? "the feedthrough damping; what the brake does not give of it the motor makes from the "
                            "velocity estimate"
                          : reason;
}

std::string_view meaning_of_marks() {
  return "hold for the values of the file; only in the row that was chosen do minimum damping and error hold for every "
         "value in the ranges";
}

std::string candidates_text(const Decomposition& decomposition, const Network& network) {
  const PortUnits units = port_units(network.port_motion);
  const auto heading = [](const auto&... cells) {
    return fmt::format("{:<17}{:>12}  {:<9}{:>12}{:>12}{:>12}{:>12}{:>12}\n", cells...);
  };
  std::string text = heading("candidate", "b", "states", "velocity", "any-delay", "minimum", "noise", "error") +
                     heading("", "", "driven by", "gain", "extra", "damping", "", "") +
                     heading("", units.damping, "", units.damping, units.damping, units.damping, units.force, "%");
  const bool is_tunable = has_tunables(network);
  const Candidate& choice = decomposition.choice();
  std::string reasons, equals;
  bool has_marks = false;
  for (const Candidate& c : decomposition.candidates) {
    const Candidate& first =
        *std::find_if(decomposition.candidates.begin(), decomposition.candidates.end(), [&](const Candidate& other) {
          const bool is_left_out = is_tunable && is_same(choice, c) && &other != &choice;
          return is_same(other, c) && !is_left_out;
        });
    reasons += reason_line(c);
    if (&first != &c) {
      equals += fmt::format("{}{} as {}", equals.empty() ? "" : ", ", c.name, first.name);
      continue;
    }
    const bool is_marked = is_tunable && &c != &choice;
    text += candidate_row(c, is_marked ? "*" : "");
    has_marks |= is_marked;
  }
  if (!equals.empty()) text += fmt::format("the same              {}\n", equals);
  if (has_marks) text += fmt::format("rows with *           {}\n", meaning_of_marks());
  return text + "reasons\n" + reasons;
}

std::string chosen_text(const Decomposition& decomposition) {
  std::string text = fmt::format("chosen                {}: {}\n", decomposition.choice().name, decomposition.reason);
  if (!decomposition.in_words.empty()) text += "in words              " + decomposition.in_words + "\n";
  return text;
}

std::string legend(bool has_device) {
  const std::string error = has_device ? "the largest error of the felt force in the device's band: hold, estimator, "
                                         "delay, amplifier lag, brake tolerance and added damping included"
                                       : "of the felt force; 0 on an ideal device";
  const std::pair<const char*, std::string> columns[] = {
      {"b", "the network's damping that the brake makes; what is added for passivity is not in it"},
      {"states driven by",
       "what moves the motor's states: the measured position, the velocity estimate, or both as the network's nodes "
       "have it (nodal)"},
      {"velocity gain", "how much force the motor makes of the velocity estimate, |b∞ − b|; 0: it needs none"},
      {"any-delay extra",
       "the damping to add so that the law is passive with an exact brake, however late the estimate is"},
      {"minimum damping",
       "what must be added to b so that the law is certified; -: nothing is proved. It is felt too, and may make up "
       "for "
       "damping that a late motor takes away"},
      {"noise", "the rms force of the motor that comes from the encoder's steps alone; -: not known"},
      {"error", error}};
  std::string text;
  for (const auto& [column, meaning] : columns) text += fmt::format("{:<22}{}\n", column, meaning);
  return text;
}

namespace {

// The gap at the tool that corresponds to a gap in w; 0 if the map does not reach so far.
double gap_at_tool(const MotionMap& map, double gap) {
  double inside = 0, beyond = map.reach;
  if (map.value_at(beyond) < gap) return 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (inside + beyond) / 2;
    (map.value_at(middle) < gap ? inside : beyond) = middle;
  }
  return beyond;
}

}  // namespace

std::string contact_text(const Decomposition& decomposition, const Network& network) {
  if (!network.contact) return "";
  const std::string unit = port_units(network.port_motion).position;
  std::string text = fmt::format("at {} {}; brake and motor 0 while the tool is free", network.contact->at, unit);
  const double step = decomposition.encoder_step;
  const double gap = network.map && step > 0 ? gap_at_tool(*network.map, step) : step;
  if (gap > 0)
    text += fmt::format(
        ", from a gap of {:.6g} {} on, {}, or as soon as they would pull", gap, unit,
        network.map ? "as far along the stretched position as one step of the encoder where the curve is steepest"
                    : "one step of the encoder");
  return text;
}

}  // namespace dashpot::compiler
