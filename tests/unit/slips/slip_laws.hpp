// The random networks whose emitted code is compared with evaluate(): the writer and the test must mean the same ones.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "slip_run.hpp"
#include "support/random.hpp"
#include "support/random_network.hpp"
#include "support/written_network.hpp"

namespace dashpot::testing {

// So many branches of two shapes that loops are rolled.
inline compiler::Network many_slips(std::uint64_t seed) {
  Random random(seed);
  std::string branches;
  for (std::uint64_t i = 0; i < 18 + seed % 8; ++i) {
    const std::string slip = fmt::format("{{\"slip\": {}}}", random.log_uniform(1e-2, 1));
    const std::string damped =
        fmt::format("{{\"parallel\": [{}, {{\"damper\": {}}}]}}", slip, random.log_uniform(1e-2, 1));
    branches += fmt::format("{}{{\"series\": [{{\"spring\": {}}}, {}]}}", i == 0 ? "" : ", ",
                            random.log_uniform(10, 1000), i % 3 == 0 ? slip : damped);
  }
  return written_network("{\"parallel\": [" + branches + "]}");
}

// Every third seed is left as it comes; for the others the next network with coupled slips is taken. Every sixth has
// slips outside a tree, every twelfth many branches; about every third is behind a contact.
inline compiler::Network slip_network(std::uint64_t seed) {
  NetworkRecipe recipe;
  recipe.most_nodes = 9;
  recipe.most_slips = 6;
  if (seed % 6 == 3) recipe.topology = Topology::graph;
  compiler::Network network = seed % 12 == 0 ? many_slips(seed) : random_network(1000 * seed, recipe);
  for (std::uint64_t i = 1; seed % 6 == 3 && compiled(network, compiler::Scheme::exact).law.networks.empty(); ++i)
    network = random_network(1000 * seed + i, recipe);
  for (std::uint64_t i = 1; seed % 3 != 0 && most_coupled(compiled(network, compiler::Scheme::exact)) < 2; ++i)
    network = random_network(1000 * seed + i, recipe);
  if ((seed % 4 == 0 && seed % 12 != 0) || seed % 12 == 9) network.contact = compiler::Contact{0, {}};
  network.name = "slips_" + std::to_string(seed);
  return network;
}

// A brake with a slow coil and an encoder, so that every law has its hysteresis and its hold.
inline compiler::Device slow_device() {
  compiler::Device device;
  device.name = "slow";
  device.description.loop.sample_period = slip_period;
  device.description.encoder.step = 1e-5;
  device.description.velocity.window = 3;
  device.description.brake = {brake_kind::eddy_current, 1000, 0, 0, 0.05, 0.01, 0, 0, 0};
  return device;
}

inline compiler::Compilation slip_law(std::uint64_t seed) {
  static const compiler::Device device = slow_device();
  static const char* const laws[] = {"velocity-free", "steady", "gated", "ramped"};
  compiler::Choices choices;
  choices.scheme = seed % 2 == 0 ? compiler::Scheme::exact : compiler::Scheme::backward_euler;
  choices.scalar = seed % 5 == 0 ? compiler::ScalarType::float32 : compiler::ScalarType::float64;
  const compiler::Network network = slip_network(seed);
  const bool has_slips = compiler::normal_form(network).has_slips();
  const compiler::Device* const on = seed % 4 < 2 ? nullptr : &device;
  const char* const law = laws[has_slips ? seed / 3 % 4 : seed / 3 % 2];  // the others are of slips alone
  choices.decomposition = can_have(network, law, on) ? law : "velocity-free";
  return compiled(network, choices, on);
}

}  // namespace dashpot::testing
