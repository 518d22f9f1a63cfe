#include "certify/choice_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "certify/assumed_values.hpp"

namespace dashpot::compiler {
namespace {

constexpr double little = 0.1;  // share of the brake's largest damping
constexpr double same = 1e-6;   // relative: two dampings that differ by less are one

bool is_same(double x, double y) { return std::abs(x - y) <= same * std::max(std::abs(x), std::abs(y)); }

const Candidate* named(const Decomposition& decomposition, const char* name) {
  for (const Candidate& candidate : decomposition.candidates)
    if (candidate.name == name) return &candidate;
  return nullptr;
}

std::string allowance(const FaithfulChoice& choice, double tolerance, bool is_tunable) {
  if (choice.allowed_error <= tolerance * (1 + 1e-9)) return fmt::format("{} % are allowed", in_percent(tolerance));
  return fmt::format("no b{} gets below {} %, so that up to about {} %, {} times as much, is accepted",
                     is_tunable ? " that was tried" : "", in_percent(choice.least_error),
                     in_percent(choice.allowed_error), leeway);
}

// For a damping that was chosen together with the law behind the slips.
std::string chosen_in_runs(const FaithfulChoice& choice, double error_in_runs, bool is_tunable) {
  return fmt::format(
      " In test motions that make the slips yield{} it deviates by up to {} %. b was chosen by the larger of both "
      "errors: it is the largest b with an error of up to {} %, where no b gets below {} %.",
      is_tunable ? ", with the parameters' values in the file," : "", in_percent(error_in_runs),
      in_percent(choice.allowed_error), in_percent(choice.least_error));
}

// What the choice gains and costs against the paper's rule.
std::string against_paper(const Candidate& choice, const Candidate& paper, const PortUnits& units) {
  if (is_same(choice.damping, paper.damping) && choice.state_input == paper.state_input)
    return "The paper's rule chooses the same.";
  std::string text = fmt::format("With the paper's rule, b = {:.4g} {}, the felt error is {} %", paper.damping,
                                 units.damping, in_percent(paper.largest_error));
  if (choice.minimum_damping && paper.minimum_damping && std::max(*choice.minimum_damping, *paper.minimum_damping) > 0)
    text += fmt::format(", {:.3g} {} have to be added for passivity instead of {:.3g}", *paper.minimum_damping,
                        units.damping, *choice.minimum_damping);
  if (choice.motor_noise && paper.motor_noise && std::max(*choice.motor_noise, *paper.motor_noise) > 0)
    text += fmt::format(", and the motor's noise is {:.3g} {} instead of {:.3g}", *paper.motor_noise, units.force,
                        *choice.motor_noise);
  const double difference = paper.damping - choice.damping;
  if (!is_same(choice.damping, paper.damping))
    text += fmt::format("; its brake makes {:.3g} {} {}", std::abs(difference), units.damping,
                        difference > 0 ? "more" : "less");
  return text + ".";
}

// Why little is left to the brake; empty where it has something to do.
std::string idle_brake(const Candidate& choice, const ChosenFor& what) {
  if (what.beside == Beside::nothing) return "";
  if (what.reach == 0) return "The device has no brake.";
  if (choice.damping >= little * what.reach) return "";
  if (what.zero_frequency_damping < little * what.reach)
    return fmt::format("The brake has little to do, because {} damps by no more than {:.3g} {}.",
                       what.beside == Beside::linear ? "what is in parallel with the slips" : "the whole network",
                       what.zero_frequency_damping, what.units.damping);
  std::string text = fmt::format(
      "The brake has little to do: only {:.3g} {} of the network's damping act at the tool without a spring in series. "
      "A brake acts at once, and damping beyond that the motor has to cancel, one sample late.",
      what.feedthrough_damping, what.units.damping);
  if (choice.damping < what.feedthrough_damping * (1 - same))
    text +=
        " It does not make all of that, because on this device a larger b has a larger error or needs more added "
        "damping.";
  return text;
}

}  // namespace

std::string at_any_delay(const Candidate& choice, const std::string& unit) {
  const double extra = choice.extra_damping_any_delay.value_or(0);
  const std::string more = extra > 0 ? fmt::format(" and {:.6g} {} of extra damping", extra, unit) : "";
  return "with an exact brake" + more +
         " the law is passive at any delay of the velocity estimate, sampling aside, which 'passivity' covers";
}

std::string in_percent(double share) {
  const double percent = 100 * share;
  return percent >= 100 && percent < 1e9 ? fmt::format("{:.0f}", percent) : fmt::format("{:.3g}", percent);
}

std::string reason_for_faithful(const Candidate& chosen, const Network& network, const Choices& choices) {
  if (choices.state_input) return fmt::format("{} driven as asked", name_of(chosen.state_input));
  if (chosen.state_inputs.size() == 1) return reason_for_only_input(chosen, network);
  return fmt::format("{} driven, chosen together with b", name_of(chosen.state_input));
}

std::string choice_in_words(const Decomposition& decomposition, const ChosenFor& what) {
  const Candidate& choice = decomposition.choice();
  if (!choice.faithful) return "";
  const FaithfulChoice& by = *choice.faithful;
  const PortUnits& units = what.units;
  const bool is_behind_curve = what.steepest != 1;
  const double weaker = what.steepest * what.steepest;
  const std::string taken =
      is_behind_curve
          ? fmt::format(
                "'faithful' takes b = {:.4g} of {:.4g} {}: the brake's {:.4g} divided by {:.4g}, the square of "
                "the steepest slope of the curve's map;",
                choice.damping, what.reach, units.damping, what.reach * weaker, weaker)
          : fmt::format("'faithful' takes b = {:.4g} of the brake's {:.4g} {}", choice.damping, what.reach,
                        units.damping);
  const std::string by_runs = by.in_runs ? chosen_in_runs(by, decomposition.slips.error, what.is_tunable) : "";
  if (what.beside == Beside::nothing)
    return fmt::format(
        "All of the network is in parts with slips, and {} in parallel with them.{} What is felt of the slips depends "
        "on the motion: 'dashpot run --motion' measures it.",
        taken, by_runs);
  std::string text = fmt::format(
      "{} and the felt force{} deviates by up to {} % in the band{}.", is_behind_curve ? taken : taken + ",",
      what.beside == Beside::linear ? " of what is in parallel with the slips" : "", in_percent(choice.largest_error),
      by.in_runs ? "" : fmt::format(" ({})", allowance(by, decomposition.tolerance, what.is_tunable)));
  text += by_runs;
  if (what.is_tunable && !is_within(choice.largest_error, by.allowed_error))
    text +=
        " In the band it deviates by more than that, because more damping is added for passivity over the ranges of "
        "the parameters.";
  if (!by.certified) text += " No choice with an error as small as that is certified on this device.";
  // With tunables the two are not comparable: the paper's row is for the file's values, the choice for all in their
  // ranges.
  const Candidate* paper = what.is_tunable ? nullptr : named(decomposition, "paper");
  if (paper) text += " " + against_paper(choice, *paper, units);
  if (const auto& moves = decomposition.moves) {
    text +=
        fmt::format(" If each value that the device file assumes is off by up to {:.0f} %, b ", 100 * assumed_spread);
    text += is_same(moves->least, moves->most)
                ? "stays as it is."
                : fmt::format("is {:.4g} to {:.4g} {}{}.", moves->least, moves->most, units.damping,
                              moves->by.empty() ? "" : ", mostly because of " + moves->by);
  }
  if (what.zero_frequency_damping > 0 && choice.damping > what.zero_frequency_damping * (1 + same))
    text +=
        fmt::format(" b is {:.3g} % more than the network's zero-frequency damping; the motor cancels the difference.",
                    100 * (choice.damping / what.zero_frequency_damping - 1));
  const std::string idle = idle_brake(choice, what);
  return idle.empty() ? text : text + " " + idle;
}

}  // namespace dashpot::compiler
