// What a law with tunable parameters has beside its programs: the parameters, and the tables of dashpot::tunable_law
// (theory, section 6, "Changing parameters while running").
#pragma once

#include <dashpot/tunable/tables.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "law/id.hpp"

namespace dashpot::compiler {

struct Variable;

// What dashpot::tunable_law is called for with the law's tables.
enum class TunableCall : std::uint8_t {
  set,            // with the law's numbers: g of what joins tool and ground without a slip, but for dampers and meshes
  meshes,         // what that has found of the meshes among them
  viscosity,      // theirs at low frequency, with the law's numbers
  held,           // π of all that joins tool and ground without a slip
  reset,          // at rest at a position: π
  resting_brake,  // then what slips leave to a brake that has so much left for them
  slip,           // of all slips, by a change: the force
  push,           // of all behind a surface, by its approach: the force and the surface's change
  slip_brake,     // what slips leave to it, by the tool's position and what it has left for them
  limit,          // of the motor, by what is wanted of it: the force and the share that is kept of all
  follow,         // where a surface stands, which would be at a place, with the tool at a depth
  update,         // of the states, by a change to a place: the force that is held
  stored_energy,  // in the springs, and set free by changes of parameters
};

std::string_view name_of(TunableCall call);

// Whether it is given all numbers of the law.
inline bool takes_numbers(TunableCall call) { return call == TunableCall::set || call == TunableCall::viscosity; }

struct Tunable {
  std::string name;
  std::string unit;
  tunable_range<double> range;
  Id<Variable> value = {};  // of the law
};

struct TunableTerm {
  std::size_t tunable;
  double share;
};

// base + Σ of tunables, each times its share
struct TunableNumber {
  double base;
  std::vector<TunableTerm> terms;
  std::string name;  // of the elements whose values are in it
  std::string unit;
};

// Of a relaxation that no tunable touches: φ, what a displacement within a sample leaves in its spring, and α, what is
// lost in a sample.
struct FixedRelaxation {
  double share, loss;
};

// T k/b at most: beyond, nothing is left of a relaxation after a sample.
inline constexpr double largest_ratio = 0x1p100;

// What the brake's damping follows.
enum class BrakeFollows : std::uint8_t {
  constant,             // nothing
  observed,             // a number: the dampers that the brake takes the place of
  zero_frequency,       // Z(0), the network's viscosity at low frequency
  half_zero_frequency,  // ½ Z(0), never below b∞
  feedthrough,          // b∞
  within_viscosity,     // the constant, never above Z(0)
};

struct TunableBrake {
  BrakeFollows follows = BrakeFollows::constant;
  double damping = 0;        // of constant and within_viscosity [N·s/m]
  int observed = 0;          // number, of observed
  double max_damping = 0;    // what the brake can give [N·s/m]
  double assured_share = 0;  // of b, what the motor may make up by an estimate while the coil is on its way [1]
  std::string text;          // what it follows, for people
};

// Numbers are already rounded to the law's scalar type.
struct TunableTables {
  tunable_tables<double> head = {};  // without its arrays, which are those below
  std::vector<Tunable> tunables;
  std::vector<TunableNumber> numbers;
  std::vector<int> springs;
  std::vector<std::string> spring_names;              // for remarks
  std::vector<std::optional<FixedRelaxation>> fixed;  // one a spring
  std::vector<tunable_part> parts;
  std::vector<tunable_edge> edges;
  std::vector<tunable_block<double>> blocks;
  std::vector<int> cuts;
  std::vector<tunable_yield<double>> yields;
  std::vector<tunable_coupling> couplings;
  std::vector<slip_node<double>> nodes;
  std::vector<tunable_graph> graphs;
  std::vector<tunable_ends> links;  // of slips in trees nothing
  std::vector<tunable_ends> ties;
  int mesh_nodes = 0;
  int corners = 0;
  int ends = 0;  // of the largest graph
  TunableBrake brake;
  bool is_exact = true;    // relaxations by the exact scheme, else backward Euler; meshes always by the latter
  double least_share = 0;  // of its greatest value: behind a slip no part is softer, no slip yields sooner [1]
  std::vector<std::string> mesh_elements;            // whose states are kept by backward Euler, for people
  int operations(const tunable_graph& graph) const;  // of a step, at most
  bool sheds() const { return head.motor_limit > 0 || head.motor_step > 0; }
};

// What evaluate() has room for; refused beyond.
inline constexpr int most_tunables = 32, most_tunable_modes = 16, most_tunable_slips = 8, most_tunable_springs = 64,
                     most_tunable_nodes = 32, most_tunable_blocks = 24, most_tunable_slip_parts = 64,
                     most_tunable_corners = 512, most_tunable_ends = 16;

// Additions, multiplications, divisions at most, of a call; of `set` without what the springs' energy takes.
std::size_t operations_of(const TunableTables& tables, TunableCall call);
std::size_t operations_of_energy(const TunableTables& tables);

}  // namespace dashpot::compiler
