// Random networks with tunable parameters, taken through the compiler, and random schedules of their values.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "compile.hpp"
#include "law/evaluate.hpp"
#include "support/random.hpp"

namespace dashpot::testing {

// Text through all stages. Throws std::runtime_error with the diagnostics where one refuses.
class TunableLaw {
 public:
  explicit TunableLaw(const std::string& text, const compiler::Choices& choices = {});

  const compiler::UpdateLaw& law() const { return compilation_->law; }
  const compiler::Compilation& compilation() const { return *compilation_; }
  const std::vector<compiler::Tunable>& tunables() const { return law().tunable->tunables; }
  std::vector<double> defaults() const;

 private:
  std::unique_ptr<compiler::SourceFile> source_;
  std::optional<compiler::Compilation> compilation_;
};

// Slips in a graph are in no tree, some of them; touched ones are behind a contact at 0.
enum class Kind {
  parallel_branches,
  tree,
  graph,
  slips,
  touched,
  touched_slips,
  slips_in_graph,
  touched_slips_in_graph
};

inline constexpr std::uint64_t kinds = 8;

// A network file of that kind in which about half of all elements are tunable, over ranges from zero or a tenth to ten
// times their value; some start at zero, where there are no slips.
std::string tunable_network(std::uint64_t seed, Kind kind);

// Values within the ranges, now and then at their ends, most of them as they were.
std::vector<double> next_values(const std::vector<compiler::Tunable>& tunables, const std::vector<double>& present,
                                Random& random);

// Displacements [m]: rests, moves over several decades, reversals, returns to 0.
std::vector<double> random_walk(Random& random, std::size_t samples);

}  // namespace dashpot::testing
