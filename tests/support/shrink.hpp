// Property tests over random networks: what fails is reported with its seed and as the smallest network that still
// does.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "support/random_network.hpp"
#include "support/repetitions.hpp"

namespace dashpot::testing {

// What is wrong with a network; empty where nothing is.
using Complaint = std::function<std::string(const compiler::Network&)>;

// Takes elements away, joins their ends and rounds their values for as long as the complaint, whatever it says,
// remains.
compiler::Network smallest_failing(compiler::Network network, const Complaint& complaint);

// Networks of `count` seeds from `first_seed` on. Empty where there is no complaint about any, else the seed, the
// smallest failing network as JSON and the complaint about it, to be compared with "" in a test.
std::string first_failure(std::uint64_t first_seed, std::size_t count, const NetworkRecipe& recipe,
                          const Complaint& complaint);

}  // namespace dashpot::testing
