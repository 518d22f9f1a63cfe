#include "support/shrink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "network/law.hpp"

namespace dashpot::testing {
namespace {

using compiler::Element;
using compiler::Network;
using compiler::NodeIndex;

std::optional<Network> tidied(Network network) {
  return tidy(network) ? std::optional(std::move(network)) : std::nullopt;
}

std::optional<Network> without(Network network, std::size_t element) {
  network.elements.erase(network.elements.begin() + static_cast<std::ptrdiff_t>(element));
  return tidied(std::move(network));
}

// A rigid rod in the element's place; tool and ground stay apart.
std::optional<Network> contracted(Network network, std::size_t element) {
  const NodeIndex kept = std::min(network.elements[element].a, network.elements[element].b);
  const NodeIndex gone = std::max(network.elements[element].a, network.elements[element].b);
  if (gone == compiler::tool) return std::nullopt;
  for (Element& e : network.elements)
    for (NodeIndex* node : {&e.a, &e.b})
      if (*node == gone) *node = kept;
  std::erase_if(network.elements, [](const Element& e) { return e.a == e.b; });
  return tidied(std::move(network));
}

std::optional<Network> with_value(Network network, std::size_t element, double value) {
  compiler::Law& law = network.elements[element].law;
  if (compiler::value_of(law) == value) return std::nullopt;
  std::visit([value](auto& l) { l = {value}; }, law);
  return network;
}

double power_of_ten_near(double value) { return std::pow(10, std::round(std::log10(value))); }

std::vector<Network> smaller_networks(const Network& network, std::size_t element) {
  std::vector<Network> smaller;
  const double value = compiler::value_of(network.elements[element].law);
  for (std::optional<Network> candidate :
       {without(network, element), contracted(network, element), with_value(network, element, 1),
        value == 1 ? std::nullopt : with_value(network, element, power_of_ten_near(value))})
    if (candidate) smaller.push_back(std::move(*candidate));
  return smaller;
}

bool shrink_once(Network& network, const Complaint& complaint) {
  for (std::size_t element = network.elements.size(); element-- > 0;)
    for (Network& smaller : smaller_networks(network, element))
      if (!complaint(smaller).empty()) {
        network = std::move(smaller);
        return true;
      }
  return false;
}

}  // namespace

Network smallest_failing(Network network, const Complaint& complaint) {
  while (shrink_once(network, complaint)) {}
  return network;
}

std::string first_failure(std::uint64_t first_seed, std::size_t count, const NetworkRecipe& recipe,
                          const Complaint& complaint) {
  for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    const Network network = random_network(seed, recipe);
    if (complaint(network).empty()) continue;
    const Network smallest = smallest_failing(network, complaint);
    return fmt::format("seed {}, smallest failing network:\n{}{}\n", seed, json_text(smallest), complaint(smallest));
  }
  return "";
}

}  // namespace dashpot::testing
