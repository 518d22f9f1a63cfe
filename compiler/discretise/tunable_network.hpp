// A network with tunable parameters as the tables of dashpot::tunable_law (theory, section 6, "Changing parameters
// while running").
#pragma once

#include <dashpot/tunable/tables.hpp>

#include <optional>
#include <string>
#include <vector>

#include "decompose/brake_rule.hpp"
#include "decompose/choices.hpp"
#include "decompose/decomposition.hpp"

namespace dashpot::compiler {

struct Tunable {
  std::string name;
  std::string unit;
  tunable_range<double> range;
};

// Numbers are already rounded to the law's scalar type.
struct TunableTables {
  tunable_tables<double> head = {};  // without its arrays, which are those below
  std::vector<Tunable> tunables;
  std::vector<int> terms;
  std::vector<tunable_number<double>> numbers;
  std::vector<int> springs;
  std::vector<std::string> spring_names;  // for remarks
  std::vector<tunable_part<double>> parts;
  std::vector<tunable_edge> edges;
  std::vector<tunable_block> blocks;
  std::vector<int> cuts;
  std::vector<tunable_yield> yields;
  std::vector<tunable_coupling> couplings;
  std::vector<slip_node<double>> nodes;
  std::vector<tunable_graph> graphs;
  std::vector<tunable_ends> links;  // of slips in trees nothing
  std::vector<tunable_ends> ties;
  int mesh_nodes = 0;
  int corners = 0;
  int ends = 0;                                      // of the largest graph
  double added_damping = 0;                          // what the brake is told beyond b [N·s/m]
  std::string brake;                                 // what b follows, for people
  std::vector<std::string> mesh_elements;            // whose states are kept by backward Euler, for people
  int operations(const tunable_graph& graph) const;  // of a step, at most
};

// What evaluate() has room for; refused beyond.
inline constexpr int most_tunables = 32, most_tunable_modes = 16, most_tunable_slips = 8, most_tunable_springs = 64,
                     most_tunable_nodes = 32, most_tunable_blocks = 24, most_tunable_slip_parts = 64,
                     most_tunable_corners = 512, most_tunable_ends = 16;

bool has_tunables(const Network& network);

// The same network with what its tunables' values let no force through marked as without effect.
Network at_default(const Network& network);

// In: a network with tunables; its linear part and its canonical form at the default values, the decomposition chosen
// for it. Out: its tables. Ensures: parts that no tunable touches are reduced to modes, Maxwell branches keep the
// chosen scheme, other parts with tunables keep element states by backward Euler. Refuses: more states, slips, … than
// there is room for; more slips outside a tree than are compiled there without tunables.
std::optional<TunableTables> tunable_tables_of(const Network& linear, const Network& network, const LinearForm& form,
                                               const Decomposition& decomposition, const Choices& choices,
                                               const Real& sample_period, const Device* device,
                                               Diagnostics& diagnostics);

// Additions, multiplications, divisions at most.
struct TunableCost {
  std::size_t set;
  std::size_t output;
  std::size_t update;
  std::size_t states;
};
TunableCost cost_of(const TunableTables& tables);

}  // namespace dashpot::compiler
