// A law with tunable parameters as the tables of dashpot::tunable_law (theory, section 6, "Changing parameters while
// running").
#pragma once

#include <dashpot/tunable/tables.hpp>

#include <cstddef>
#include <string>
#include <vector>

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
  std::vector<double> shares;  // of each term; empty where all are 1
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
  bool sheds() const { return head.motor_limit > 0 || head.motor_step > 0; }
};

// What evaluate() has room for; refused beyond.
inline constexpr int most_tunables = 32, most_tunable_modes = 16, most_tunable_slips = 8, most_tunable_springs = 64,
                     most_tunable_nodes = 32, most_tunable_blocks = 24, most_tunable_slip_parts = 64,
                     most_tunable_corners = 512, most_tunable_ends = 16;

// Additions, multiplications, divisions at most.
struct TunableCost {
  std::size_t set;
  std::size_t output;
  std::size_t update;
  std::size_t states;
};
TunableCost cost_of(const TunableTables& tables);

}  // namespace dashpot::compiler
