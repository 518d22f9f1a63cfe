// The tables from which a law with tunable parameters is written: the parameters, the network's structure, and what the
// certificate has added (theory, section 6, "Changing parameters while running").
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/slip_tree.hpp>
#include <dashpot/tunable_range.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "law/id.hpp"
#include "law/subject.hpp"

namespace dashpot {

inline bool operator==(const slip_node<double>& a, const slip_node<double>& b) {
  return std::tie(a.kind, a.first_child, a.child_count, a.slips, a.place, a.first_corner, a.stiffness, a.compliance,
                  a.yield) == std::tie(b.kind, b.first_child, b.child_count, b.slips, b.place, b.first_corner,
                                       b.stiffness, b.compliance, b.yield);
}

inline bool operator==(const tunable_range<double>& a, const tunable_range<double>& b) {
  return std::tie(a.value, a.min, a.max) == std::tie(b.value, b.min, b.max);
}

}  // namespace dashpot

namespace dashpot::compiler {

struct Variable;

// What a part of a block is. Parts stand in parallel.
enum class PartKind : std::uint8_t {
  spring,      // p = k (z − r)
  damper,      // p = B ż
  relaxation,  // a spring and a damper in series
  mesh,        // springs and dampers between inner nodes
};

inline constexpr int no_index = -1;
inline constexpr int mesh_port = -1;  // the two ends of a mesh, used in place of a node
inline constexpr int mesh_held = -2;

struct BlockPart {
  PartKind kind;
  int spring;      // index into springs; none for a mesh
  int damping;     // index of a number: damping of a damper or relaxation [N·s/m]
  int share;       // index of φ: share of a displacement that is left in a relaxation's spring after a sample [1]
  int loss;        // index of α: share that a relaxation loses in a sample [1]
  int first_node;  // this and the following are for a mesh only
  int node_count;
  int first_edge;
  int edge_count;
  bool is_loose;  // a spring in series with a slip, which can take up any rest length
  bool operator==(const BlockPart&) const = default;
};

// A spring or a damper of a mesh between two of its nodes, counted from the mesh's first; `from` is the end at the
// port's side.
struct MeshEdge {
  int from;
  int to;
  int spring;   // index into springs, or none
  int damping;  // index into numbers, or none
  bool operator==(const MeshEdge&) const = default;
};

struct TunableBlock {
  int first_part;
  int part_count;
  double least_stiffness;  // behind a slip, its stiffness is not allowed to fall below [N/m]
  bool operator==(const TunableBlock&) const = default;
};

// Yield force of a slip: the least of numbers[cuts[first]] …, one number for each way to cut it through.
struct TunableYield {
  int first_cut;
  int cut_count;
  double least;  // the yield force is not allowed to fall below [N]
  bool operator==(const TunableYield&) const = default;
};

// Slips that are solved together in one tree: its nodes, its blocks and slips in the order of their places.
struct TunableCoupling {
  int first_node;
  int node_count;
  int first_block;
  int first_slip;
  bool operator==(const TunableCoupling&) const = default;
};

// The two ends of a block or slip where slips meet in no tree: inner ends are numbered from 0, then come the tool and
// the ground.
struct TunableEnds {
  int from;
  int to;
  bool operator==(const TunableEnds&) const = default;
};

// Slips that are solved together and meet in no tree, and the blocks between their ends, one for each tie. With a
// contact the last inner end is the surface.
struct TunableGraph {
  int end_count;  // of inner ends
  int link_count;
  int first_slip;  // index into slips and links
  int tie_count;
  int first_tie;
  int first_block;
  bool operator==(const TunableGraph&) const = default;
};

// The surface that the tool pushes and cannot pull, if there is one.
struct TunableContact {
  bool is_there;
  double at;            // where it lies unloaded [m]
  double encoder_step;  // the largest gap at which the command goes on [m]
  bool operator==(const TunableContact&) const = default;
};

// How slips take part in the brake's command.
struct TunableSlipRule {
  bool takes_part;
  double hysteresis;  // how far the tool moves before the command takes a slide as ended [m]
  double coil_share;  // κ: share of the missing √b that the coil makes up in a sample [1]
  bool operator==(const TunableSlipRule&) const = default;
};

// The map of a static curve that the network lies behind, if there is one. Changes of parameters then also need energy
// for the change of w while a force is held (theory, section 11).
struct TunableMap {
  bool is_there;
  double largest_change;     // largest change of w while a force is held [m]
  double largest_stiffness;  // largest k of the spring between tool and ground [N/m]
  bool operator==(const TunableMap&) const = default;
};

// When an offset shrinks, the motor still holds the old force: for how many samples, and how far the tool moves
// meanwhile.
struct TunableHold {
  int samples = 0;    // 0 if the device states no largest speed: nothing is counted then
  double change = 0;  // largest movement of the tool in a sample [m]
  double rest = 0;    // movement after these samples, weighted by what the amplifier's lag still holds [m]
  bool operator==(const TunableHold&) const = default;
};

// Facts of the whole law. Block 0 is the part that joins tool and ground without a slip. With a contact and slips it
// belongs to the only coupling or graph.
struct TunableHead {
  double rate;        // 1/h, h being the sample period [Hz]
  double retention;   // share of an offset that is left after a sample, if the tank has the energy [1]
  int static_spring;  // the spring that joins tool and ground directly, or none
  TunableContact contact;
  TunableSlipRule slip_rule;
  motion port_motion = motion::translation;
  double motor_limit = 0;  // largest force; 0: no limit [N]
  double motor_step = 0;   // largest change of the force in a sample; 0: no limit [N]
  TunableMap map = {false, 0, 0};
  TunableHold hold = {};
  bool acts_late = false;  // commands act later than at the instants of their samples
  bool operator==(const TunableHead&) const = default;
};

struct Tunable {
  std::string name;
  std::string unit;
  tunable_range<double> range;
  Id<Variable> value = {};  // its variable in the law
  bool operator==(const Tunable&) const = default;
};

struct TunableTerm {
  std::size_t tunable;
  double share;
  std::size_t element = 0;  // whose value it is, index into Network::elements
  bool operator==(const TunableTerm&) const = default;
};

enum class NumberKind : std::uint8_t {
  elements,         // sum of springs, dampers or slips side by side
  block_stiffness,  // k0 of a block
  block_damping,    // b∞ of a block, meshes aside
  mode_stiffness,   // k of a block's mode that no parameter touches, by ascending relaxation rate
  mode_damping,     // B of that mode
  observed,         // sum of the dampers that the brake replaces
};

// What a number stands for: its kind, the elements side by side or those of the block, and which of the block's modes.
struct NumberSubject {
  NumberKind kind;
  ElementList elements;
  std::size_t mode = 0;
  bool operator==(const NumberSubject&) const = default;
};

// base + Σ share · tunable
struct TunableNumber {
  double base;
  std::vector<TunableTerm> terms;
  std::string name;  // of the elements whose values are in it
  std::string unit;
  NumberSubject of;
  bool operator==(const TunableNumber&) const = default;
};

// A relaxation that no tunable touches: φ, the share of a displacement that is left in its spring after a sample, and
// α, the share that is lost in a sample.
struct FixedRelaxation {
  double share, loss;
  bool operator==(const FixedRelaxation&) const = default;
};

// The largest ratio h k/B: beyond it nothing is left of a relaxation after a sample.
inline constexpr double largest_ratio = 0x1p100;

// What the brake's damping follows.
enum class BrakeFollows : std::uint8_t {
  constant,             // nothing: it stays the same
  observed,             // the sum of the dampers that the brake replaces
  zero_frequency,       // Z(0), the network's zero-frequency damping
  half_zero_frequency,  // ½ Z(0), never below b∞
  feedthrough,          // b∞
  within_viscosity,     // the constant, never above Z(0)
};

struct TunableBrake {
  BrakeFollows follows = BrakeFollows::constant;
  double damping = 0;        // the constant, for constant and within_viscosity [N·s/m]
  int observed = 0;          // index of the number, for observed
  double max_damping = 0;    // the most that the brake can give, without `added` [N·s/m]
  double added = 0;          // by the certificate, in every regime [N·s/m]
  double assured_share = 0;  // share of b that the motor may add while the coil lags [1]
  std::string text;          // what it follows, for people
  bool operator==(const TunableBrake&) const = default;
};

// Numbers are already rounded to the law's scalar type.
struct TunableTables {
  std::string network;  // its name, which names of functions in C begin with
  TunableHead head = {};
  std::vector<Tunable> tunables;
  std::vector<TunableNumber> numbers;
  std::vector<int> springs;
  std::vector<std::string> spring_names;              // for comments
  std::vector<std::optional<FixedRelaxation>> fixed;  // one for each spring; empty if a parameter changes it
  std::vector<BlockPart> parts;
  std::vector<MeshEdge> edges;
  std::vector<TunableBlock> blocks;
  std::vector<std::string> block_names;  // of their elements
  std::vector<ElementList> block_elements;
  std::vector<int> cuts;
  std::vector<TunableYield> yields;
  std::vector<std::string> slip_names;                  // one for each yield force
  std::vector<std::vector<std::size_t>> slip_elements;  // the same, indices into Network::elements
  std::vector<TunableCoupling> couplings;
  std::vector<slip_node<double>> nodes;
  std::vector<TunableGraph> graphs;
  std::vector<TunableEnds> links;  // not used for slips in trees
  std::vector<TunableEnds> ties;
  int mesh_nodes = 0;
  int ends = 0;  // of the largest graph
  TunableBrake brake;
  bool is_exact = true;  // relaxations by the exact scheme, else backward Euler; meshes always by the latter
  // Stiffnesses behind slips, and yield forces, are not allowed to fall below this share of their largest value [1].
  double least_share = 0;
  std::vector<std::string> mesh_elements;  // whose states are kept by backward Euler, for people
  bool has_slips() const { return !yields.empty(); }
  bool sheds() const { return head.motor_limit > 0 || head.motor_step > 0; }
  bool operator==(const TunableTables&) const = default;
};

// Larger networks are refused: set() reports each parameter by a bit, the work for a mesh of relaxations grows with the
// third power of its nodes, and each slip outside a tree triples the number of patterns.
inline constexpr int most_tunables = 32, most_tunable_nodes = 32, most_tunable_slips = 8, most_tunable_ends = 16;

}  // namespace dashpot::compiler
