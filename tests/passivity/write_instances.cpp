// write_instances COUNT STATES FOLDER: storage functions of random laws on random devices as `compile --proof` writes
// them, FOLDER/0.v …, each with the damping that it proves and with less. COUNT laws, of at most STATES states; of a
// third of them each entry of P is in two doubles, as where one is too coarse. A line for each: its number, that of the
// instance with all of the damping, the share of it, whether dashpot-check's code proves it, and whether there is an
// instance.
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "certified_loop.hpp"
#include "certify/storage_instance.hpp"

namespace dashpot::testing {
namespace {

// The same function with each entry in two doubles, of which the first is rounded to a float.
dashpot_check::Storage in_two_parts(const dashpot_check::Storage& storage) {
  dashpot_check::Storage split = storage;
  for (std::vector<double>& row : split)
    for (std::size_t j = 0, entries = row.size(); j < entries; ++j) {
      const double whole = row[j];
      row[j] = float(whole);
      row.push_back(whole - row[j]);
    }
  return split;
}

void write_instances(int laws, int most_states, const std::string& folder) {
  int found = 0, number = 0;
  for (std::uint64_t seed = 1; found < laws; ++seed) {
    const CompiledCase one = random_case(seed);
    if (!one.compilation || !one.compilation->certificate.bound.storage) continue;
    compiler::PassivityBound bound = one.compilation->certificate.bound;
    compiler::SampledLoop loop = one.compilation->certificate.loop;
    const auto motor = compiler::motor_constants(one.compilation->law);
    const bool divides = loop.velocity.estimator == estimator_kind::interval_difference;
    const bool is_one_recursion = !motor->follows_estimate() || (compiler::estimator_factors(loop) && !divides);
    const bool is_late_twice = loop.write_latest > 0 && loop.amplifier_lag > 0;  // of which there is no theorem
    if (!is_one_recursion || is_late_twice || int(bound.storage->size()) > most_states || bound.needed == 0) continue;
    const bool has_one_part = bound.storage->back().size() == bound.storage->size();
    if (++found % 3 == 0 && has_one_part) bound.storage = in_two_parts(*bound.storage);
    if (bound.constant_period_only) loop = compiler::punctual(loop);
    const double all = bound.needed;
    const int whole = number;
    Random random(seed);
    for (const double share : {1.0, 1 - random.log_uniform(1e-12, 1e-2), 1 - random.log_uniform(1e-4, 0.3)}) {
      bound.needed = all * share;
      const compiler::StorageProof proof = {bound.needed, *bound.storage};
      const dashpot_check::Device device = compiler::checked_device(loop);
      const bool is_proved =
          dashpot_check::proves(compiler::checked_program(*motor), device, proof.storage, proof.damping);
      const auto instance = compiler::coq_instance("law", bound, motor, loop, false);
      if (instance) std::ofstream(folder + "/" + std::to_string(number) + ".v") << *instance;
      std::cout.precision(17);
      std::cout << number++ << ' ' << whole << ' ' << share << ' ' << is_proved << ' ' << instance.has_value() << '\n';
    }
  }
}

}  // namespace
}  // namespace dashpot::testing

int main(int count, char** words) {
  if (count != 4) return std::cerr << "write_instances COUNT STATES FOLDER\n", 2;
  dashpot::testing::write_instances(std::atoi(words[1]), std::atoi(words[2]), words[3]);
}
