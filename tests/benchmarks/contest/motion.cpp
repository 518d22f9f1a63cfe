#include "motion.hpp"

#include <cmath>
#include <functional>
#include <random>

namespace dashpot::contest {
namespace {

constexpr int samples = 1024;
constexpr double period = 0.001;  // [s]

motion along(const std::function<double(int)>& path) {
  motion all;
  for (int i = 0; i < samples; ++i) {
    all.position.push_back(path(i));
    all.velocity.push_back((path(i) - path(i - 1)) / period);
  }
  return all;
}

double turn(int i) { return 2 * M_PI * i / samples; }

}  // namespace

motion motion_for(const std::string& network) {
  if (network == "fig_10_stuck") return along([](int i) { return 2e-4 * std::sin(turn(i)); });
  if (network == "fig_10_sliding")
    return along([](int i) { return 0.05 * std::fabs(1 - 2.0 * ((i + samples) % samples) / samples); });
  if (network == "fig_10_switching") {
    std::mt19937_64 random(10);
    std::vector<double> places;
    for (int i = 0; i <= samples; ++i) places.push_back(std::uniform_real_distribution<>(-7e-4, 7e-4)(random));
    return along([&](int i) { return places[static_cast<std::size_t>(i + 1)]; });
  }
  // At 0 before the first sample, so that velocities are changes of position from the first on.
  return along([](int i) { return 0.005 * (1 - std::cos(turn(i + 1))); });
}

}  // namespace dashpot::contest
