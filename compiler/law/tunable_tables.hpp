// A law with tunable parameters as the tables of dashpot::tunable_law (theory, section 6, "Changing parameters while
// running").
#pragma once

#include <dashpot/tunable/tables.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot::compiler {

// What dashpot::tunable_law is called for with the law's tables.
enum class TunableCall : std::uint8_t {
  reset,          // at rest at a position: b of a tool that is in touch
  port,           // what the tool meets
  slip,           // of all slips, by a change: the force
  push,           // of all behind a surface, by its approach: the force and the surface's change
  slip_brake,     // what slips leave to it, by the tool's position
  limit,          // of the motor, by what is wanted of it: the force and the share that is kept of all
  follow,         // where a surface stands, which would be at a place, with the tool at a depth
  update,         // of the states, by a change to a place: the force that is held
  stored_energy,  // in the springs, and set free by changes of parameters
};

std::string_view name_of(TunableCall call);

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
  std::string brake;                                 // what b follows, for people
  std::vector<std::string> mesh_elements;            // whose states are kept by backward Euler, for people
  int operations(const tunable_graph& graph) const;  // of a step, at most
  bool sheds() const { return head.motor_limit > 0 || head.motor_step > 0; }
};

// What evaluate() has room for; refused beyond.
inline constexpr int most_tunables = 32, most_tunable_modes = 16, most_tunable_slips = 8, most_tunable_springs = 64,
                     most_tunable_nodes = 32, most_tunable_blocks = 24, most_tunable_slip_parts = 64,
                     most_tunable_corners = 512, most_tunable_ends = 16;

// Additions, multiplications, divisions at most, of a call and of set().
std::size_t operations_of(const TunableTables& tables, TunableCall call);
std::size_t operations_of_set(const TunableTables& tables);

}  // namespace dashpot::compiler
