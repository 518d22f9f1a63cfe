// The random networks whose emitted code is compared with evaluate(): the writer and the test must mean the same ones.
#pragma once

#include <cstdint>
#include <string>

#include "slip_run.hpp"
#include "support/random_network.hpp"

namespace dashpot::testing {

// Every third seed is left as it comes; for the others the next network with coupled slips is taken. Every fourth is behind
// a contact.
inline compiler::Network slip_network(std::uint64_t seed) {
  NetworkRecipe recipe;
  recipe.most_nodes = 9;
  recipe.most_slips = 6;
  compiler::Network network = random_network(1000 * seed, recipe);
  for (std::uint64_t i = 1; seed % 3 != 0 && most_coupled(compiled(network, compiler::Scheme::exact)) < 2; ++i)
    network = random_network(1000 * seed + i, recipe);
  if (seed % 4 == 0) network.contact = compiler::Contact{0, {}};
  network.name = "slips_" + std::to_string(seed);
  return network;
}

inline compiler::Compilation slip_law(std::uint64_t seed) {
  return compiled(slip_network(seed), seed % 2 == 0 ? compiler::Scheme::exact : compiler::Scheme::backward_euler,
                  seed % 5 == 0 ? compiler::ScalarType::float32 : compiler::ScalarType::float64);
}

}  // namespace dashpot::testing
