#include "certify/choice_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "certify/assumed_values.hpp"

namespace dashpot::compiler {
namespace {

constexpr double next_to_nothing = 0.01;  // of what the brake can give
constexpr const char* in_runs =
    " This damping was chosen together with the law behind the slips, by runs around yield as well as over the band, "
    "because with the damping that is best over the band alone the error where slips give way is beyond the tolerance.";
constexpr double same = 1e-6;  // relative: one damping

bool is_same(double x, double y) { return std::abs(x - y) <= same * std::max(std::abs(x), std::abs(y)); }

const Candidate* named(const Decomposition& decomposition, const char* name) {
  for (const Candidate& candidate : decomposition.candidates)
    if (candidate.name == name) return &candidate;
  return nullptr;
}

std::string allowance(const FaithfulChoice& choice, double tolerance) {
  if (choice.allowed_error <= tolerance * (1 + 1e-9)) return fmt::format("{} % are allowed", in_percent(tolerance));
  return fmt::format("no damping brings less than {} %{}, and up to {} % are taken", in_percent(choice.least_error),
                     choice.in_runs ? ", there and in runs in which slips give way" : "",
                     in_percent(choice.allowed_error));
}

// What is gained and what it costs.
std::string against_paper(const Candidate& choice, const Candidate& paper, const PortUnits& units) {
  if (is_same(choice.damping, paper.damping) && choice.state_input == paper.state_input)
    return "The paper's rule chooses the same.";
  std::string text = fmt::format("With the paper's rule, b = {:.4g} {}, it errs by {} %", paper.damping, units.damping,
                                 in_percent(paper.largest_error));
  if (choice.minimum_damping && paper.minimum_damping && std::max(*choice.minimum_damping, *paper.minimum_damping) > 0)
    text += fmt::format(", {:.3g} {} have to be added for passivity where here it is {:.3g}", *paper.minimum_damping,
                        units.damping, *choice.minimum_damping);
  if (choice.motor_noise && paper.motor_noise && std::max(*choice.motor_noise, *paper.motor_noise) > 0)
    text += fmt::format(", and the motor's noise is {:.3g} {} where here it is {:.3g}", *paper.motor_noise, units.force,
                        *choice.motor_noise);
  const double difference = paper.damping - choice.damping;
  if (!is_same(choice.damping, paper.damping))
    text += fmt::format("; its brake makes {:.3g} {} {}", std::abs(difference), units.damping,
                        difference > 0 ? "of damping that the motor makes here" : "less");
  return text + ".";
}

// Why hardly anything is left to the brake; empty where it has something to do.
std::string idle_brake(const Candidate& choice, const PortUnits& units, double reach, double viscosity,
                       double feedthrough, Beside beside) {
  if (beside == Beside::nothing) return "";
  if (reach == 0) return "The device has no brake.";
  if (choice.damping + choice.minimum_damping.value_or(0) >= next_to_nothing * reach) return "";
  if (viscosity < next_to_nothing * reach)
    return fmt::format("The brake has next to nothing to do, because {} damps by no more than {:.3g} {}.",
                       beside == Beside::linear ? "what is beside the slips" : "the whole network", viscosity,
                       units.damping);
  return fmt::format(
      "The brake has next to nothing to do: of the network's damping only {:.3g} {} act at once, the rest is behind "
      "springs; a brake acts at once, and what it makes too much the motor takes back a sample too late.",
      feedthrough, units.damping);
}

}  // namespace

std::string in_percent(double share) {
  const double percent = 100 * share;
  return percent >= 100 && percent < 1e9 ? fmt::format("{:.0f}", percent) : fmt::format("{:.3g}", percent);
}

std::string reason_for_faithful(const Candidate& chosen, const Choices& choices) {
  if (choices.state_input) return fmt::format("{} driven as asked", name_of(chosen.state_input));
  if (chosen.state_inputs.size() == 1) return fmt::format("{} driven by definition", name_of(chosen.state_input));
  return fmt::format("{} driven: of all pairs of damping and state input the one to be taken",
                     name_of(chosen.state_input));
}

std::string choice_in_words(const Decomposition& decomposition, const PortUnits& units, double reach,
                            bool is_behind_curve, double zero_frequency_damping, double feedthrough_damping,
                            Beside beside) {
  const Candidate& choice = decomposition.choice();
  if (!choice.faithful) return "";
  const std::string taken =
      fmt::format("'faithful' takes b = {:.4g} of the brake's {:.4g} {}", choice.damping, reach, units.damping) +
      (is_behind_curve ? ", which is what it is worth behind the curve where that is steepest," : "");
  if (beside == Beside::nothing)
    return fmt::format(
        "All of the network is behind slips: {} beside them.{} What is felt of the slips depends on the motion: "
        "'dashpot "
        "run --motion' measures it.",
        taken, choice.faithful->in_runs ? in_runs : "");
  std::string text =
      fmt::format("{} and the felt force{} errs by up to {} % in the band ({}){}.",
                  is_behind_curve ? taken : taken + ",", beside == Beside::linear ? " of what is beside the slips" : "",
                  in_percent(choice.largest_error), allowance(*choice.faithful, decomposition.tolerance),
                  choice.faithful->certified ? "" : "; nothing that errs so little is certified");
  if (choice.faithful->in_runs) text += in_runs;
  if (const Candidate* paper = named(decomposition, "paper")) text += " " + against_paper(choice, *paper, units);
  if (const auto& moves = decomposition.moves) {
    text +=
        fmt::format(" If each value that the device file assumes is off by up to {:.0f} %, b ", 100 * assumed_spread);
    text += is_same(moves->least, moves->most)
                ? "stays as it is."
                : fmt::format("is {:.4g} to {:.4g} {}{}.", moves->least, moves->most, units.damping,
                              moves->by.empty() ? "" : ", mostly because of " + moves->by);
  }
  if (zero_frequency_damping > 0 && choice.damping > zero_frequency_damping * (1 + same))
    text += fmt::format(" That is {:.3g} % more than the network damps in steady motion; the motor pushes it back.",
                        100 * (choice.damping / zero_frequency_damping - 1));
  const std::string idle = idle_brake(choice, units, reach, zero_frequency_damping, feedthrough_damping, beside);
  return idle.empty() ? text : text + " " + idle;
}

}  // namespace dashpot::compiler
