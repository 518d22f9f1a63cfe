#include "decompose/brake_rule.hpp"

#include <algorithm>
#include <cmath>

#include "decompose/observer.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

bool is_at_tool(const Element& element) { return element.a == tool || element.b == tool; }

// The dampers that are next to the tool when every observed child is placed there.
std::vector<std::size_t> dampers_at_tool(const Network& realisation) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < realisation.elements.size(); ++i) {
    const Element& element = realisation.elements[i];
    if (element.has_effect && is_damper(element.law) && is_at_tool(element)) found.push_back(i);
  }
  return found;
}

double sum_of(const std::vector<std::size_t>& dampers, const Network& network) {
  double sum = 0;
  for (std::size_t i : dampers) sum += damping_of(network.elements[i].law);
  return sum;
}

// A damper between tool and ground is always the brake's, even if its value is zero at first.
void add_direct_dampers(const Network& network, std::vector<std::size_t>& dampers) {
  for (std::size_t i = 0; i < network.elements.size(); ++i) {
    const Element& element = network.elements[i];
    const bool is_direct = (element.a == tool && element.b == ground) || (element.a == ground && element.b == tool);
    if (is_direct && is_damper(element.law) && damping_of(element.law) == 0) dampers.push_back(i);
  }
}

std::string names_of(const std::vector<std::size_t>& elements, const Network& network) {
  std::string names;
  for (std::size_t i : elements) names += (names.empty() ? "" : " + ") + network.elements[i].name;
  return names.empty() ? "0" : names;
}

BrakeRule observed_rule(const Network& network, const Candidate& choice, double reference_frequency,
                        ObserverRule observer) {
  const std::optional<Tree> tree = series_parallel_tree(network);
  if (!tree) return {BrakeFollows::zero_frequency, 0, {}, {}, "the network's zero-frequency damping"};
  std::vector<std::size_t> dampers =
      dampers_at_tool(observe(*tree, network, observer, reference_frequency).realisation);
  if (std::abs(sum_of(dampers, network) - choice.wanted_damping) > 1e-12 * choice.wanted_damping)
    return {BrakeFollows::within_viscosity,
            choice.wanted_damping,
            {},
            {},
            "its value at the defaults, but no more than the network's zero-frequency damping"};
  add_direct_dampers(network, dampers);
  const std::string text = names_of(dampers, network);
  return {BrakeFollows::observed, 0, std::move(dampers), {}, text};
}

// Keeps the damping that was chosen at the default values; unless it was above the network's viscosity there, it never
// exceeds it.
BrakeRule faithful_rule(const Decomposition& decomposition) {
  const Candidate& choice = decomposition.choice();
  if (choice.velocity_gain == 0) return {BrakeFollows::feedthrough, 0, {}, {}, "the feedthrough damping"};
  const auto viscous = std::find_if(decomposition.candidates.begin(), decomposition.candidates.end(),
                                    [](const Candidate& candidate) { return candidate.name == "zero-frequency"; });
  const bool is_within = choice.damping <= viscous->wanted_damping;
  return {is_within ? BrakeFollows::within_viscosity : BrakeFollows::constant,
          choice.damping,
          {},
          {},
          is_within ? "its value at the defaults, but no more than the network's zero-frequency damping"
                    : "its value at the defaults, whatever the parameters"};
}

BrakeRule uncapped_rule(const Network& network, const Decomposition& decomposition, double reference_frequency) {
  const Candidate& choice = decomposition.choice();
  if (choice.name == "faithful" && choice.faithful) return faithful_rule(decomposition);
  if (choice.name == "velocity-free") return {BrakeFollows::feedthrough, 0, {}, {}, "the feedthrough damping"};
  if (choice.name == "zero-frequency")
    return {BrakeFollows::zero_frequency, 0, {}, {}, "the network's zero-frequency damping"};
  if (choice.name == "quietest-passive")
    return {BrakeFollows::half_zero_frequency, 0, {}, {}, "half the network's zero-frequency damping"};
  if (choice.name == "paper" || choice.name == "faithful")
    return observed_rule(network, choice, reference_frequency, ObserverRule::most_dissipative);
  if (choice.name == "largest-observer")
    return observed_rule(network, choice, reference_frequency, ObserverRule::largest);
  return {BrakeFollows::constant, choice.wanted_damping, {}, {}, "its value at the defaults, whatever the parameters"};
}

}  // namespace

BrakeRule brake_rule_of(const Network& network, const Decomposition& decomposition, const PortDevice& device) {
  BrakeRule rule = uncapped_rule(network, decomposition, device.reference_frequency());
  // With a contact, more damping would have to be compensated in the samples of a touch.
  if (network.contact && rule.follows != BrakeFollows::constant)
    rule = {BrakeFollows::feedthrough, 0, {}, {}, "the feedthrough damping"};
  rule.max_damping = device.max_damping();
  return rule;
}

}  // namespace dashpot::compiler
