#include "equality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "maxwell_networks.hpp"
#include "motion.hpp"
#include "small_networks.hpp"

namespace dashpot::contest {
namespace {

constexpr int rounds = 2;

std::vector<command<double>> commands(const contender& c, const motion& tool) {
  std::vector<command<double>> all;
  const std::shared_ptr<void> law = c.make();
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < tool.position.size(); ++i) {
      all.push_back(c.output(law.get(), tool.position[i], tool.velocity[i]));
      if (c.update != nullptr) c.update(law.get());
    }
  return all;
}

// Σ B/h, or a slip's spring [N/m].
double largest_stiffness(const std::string& network) {
  if (network == "fig_5") return constants_of<fig_5>.brake / period;
  if (network == "kelvin_11") return (two_kelvins::damping[0] + two_kelvins::damping[1]) / period;
  if (network == "maxwell_8") return constants_of<many_branches<8>>.brake / period;
  if (network == "maxwell_64") return constants_of<many_branches<64>>.brake / period;
  if (network == "maxwell_512") return constants_of<many_branches<512>>.brake / period;
  return needle::stiffness;
}

double tolerance(const std::string& network, const motion& tool) {
  const auto [low, high] = std::minmax_element(tool.position.begin(), tool.position.end());
  const double travel = *high - *low;  // [m]
  const double held =
      network.rfind("fig_10", 0) == 0 ? needle::yield_force * rounds * static_cast<double>(tool.position.size()) : 0;
  return std::numeric_limits<double>::epsilon() * (8 * largest_stiffness(network) * travel + held);
}

verdict held_against(const contender& who, const std::vector<command<double>>& expected, const motion& tool) {
  verdict v{who, 0, 0, tolerance(who.network, tool)};
  const std::vector<command<double>> got = commands(who, tool);
  for (std::size_t i = 0; i < got.size(); ++i) {
    v.force_difference = std::max(v.force_difference, std::fabs(got[i].force - expected[i].force));
    v.damping_difference = std::max(v.damping_difference, std::fabs(got[i].damping - expected[i].damping));
  }
  return v;
}

}  // namespace

std::vector<verdict> compare(const std::vector<contender>& contenders) {
  std::vector<verdict> all;
  std::map<std::string, std::vector<command<double>>> first;
  for (const contender& c : contenders) {
    const motion tool = motion_for(c.network);
    if (first.count(c.network) == 0) first[c.network] = commands(c, tool);
    all.push_back(held_against(c, first[c.network], tool));
  }
  return all;
}

}  // namespace dashpot::contest
