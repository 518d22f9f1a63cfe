// What a law with tunable parameters is written from: the parameters, the network's structure, and what the certificate
// has settled (theory, section 6, "Changing parameters while running").
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/slip_tree.hpp>
#include <dashpot/tunable_range.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "law/id.hpp"
#include "law/subject.hpp"

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
inline constexpr int mesh_port = -1;  // the ends of a mesh, in the place of a node
inline constexpr int mesh_held = -2;

struct BlockPart {
  PartKind kind;
  int spring;      // into springs; of a mesh none
  int damping;     // number of a damper or relaxation [N·s/m]
  int share;       // number φ of a relaxation: what a displacement within a sample leaves in its spring [1]
  int loss;        // number α of a relaxation: what is lost in a sample [1]
  int first_node;  // of a mesh, as are those below
  int node_count;
  int first_edge;
  int edge_count;
  bool is_loose;  // a spring in series with a slip, so that its rest length means nothing
};

// A spring or a damper of a mesh between two of its nodes, counted from the mesh's first; `from` is the end at the
// port's side.
struct MeshEdge {
  int from;
  int to;
  int spring;   // into springs, or none
  int damping;  // a number, or none
};

struct TunableBlock {
  int first_part;
  int part_count;
  double least_stiffness;  // behind a slip no softer [N/m]
};

// Yield force of a slip: the least of numbers[cuts[first]] …, one number for each way to cut it through.
struct TunableYield {
  int first_cut;
  int cut_count;
  double least;  // no less, whatever the numbers are [N]
};

// Slips that are stepped together: nodes of the tree, blocks in the order of their places, slips likewise.
struct TunableCoupling {
  int first_node;
  int node_count;
  int first_block;
  int first_slip;
};

// What a block or a slip is between where slips meet in no tree: inner ends by their number from 0, then the tool, then
// the ground.
struct TunableEnds {
  int from;
  int to;
};

// Slips that are stepped together and meet in no tree, and the blocks between their ends, one a tie. With a contact the
// last inner end is the surface.
struct TunableGraph {
  int end_count;  // inner ones
  int link_count;
  int first_slip;  // into slips and links
  int tie_count;
  int first_tie;
  int first_block;
};

// The surface that the tool pushes and cannot pull, if there is one.
struct TunableContact {
  bool is_there;
  double at;            // where it lies unloaded [m]
  double encoder_step;  // how far the gap may open before the command lets go [m]
};

// What slips leave to the brake.
struct TunableSlipRule {
  bool takes_part;
  double hysteresis;  // of the tool's displacement, before a slide has ended for the command [m]
  double coil_share;  // κ: of what is missing from √b, that the coil makes up in a sample [1]
};

// The map of a static curve that the network lies behind, if there is one. Changes of parameters then also pay for how
// far w goes while a force is held (theory, section 11).
struct TunableMap {
  bool is_there;
  double largest_change;     // of w while a force is held, at the largest speed [m]
  double largest_stiffness;  // of the spring that joins tool and ground directly, whatever is set [N/m]
};

// The force from before an offset went home is held meanwhile: for how long, and how far the tool goes.
struct TunableHold {
  int samples = 0;    // of `change` at most; 0 where the device states no largest speed, and nothing is counted
  double change = 0;  // of the tool, from one sample to the next [m]
  double rest = 0;  // of the tool, beyond these samples, weighted by what an amplifier that lags still makes of it [m]
};

// Block 0 is what joins tool and ground without a slip. With a contact and slips it is a part of the one coupling or
// graph.
struct TunableHead {
  double rate;        // 1/T [Hz]
  double retention;   // what an offset keeps in a sample where the tank pays [1]
  int static_spring;  // the spring that joins tool and ground directly, or none
  TunableContact contact;
  TunableSlipRule slip_rule;
  motion port_motion = motion::translation;
  double motor_limit = 0;  // of its force; 0: none [N]
  double motor_step = 0;   // of its change in a period; 0: none [N]
  TunableMap map = {false, 0, 0};
  TunableHold hold = {};
};

struct Tunable {
  std::string name;
  std::string unit;
  tunable_range<double> range;
  Id<Variable> value = {};  // of the law
};

struct TunableTerm {
  std::size_t tunable;
  double share;
  std::size_t element = 0;  // whose value it is, of the network's
};

enum class NumberKind : std::uint8_t {
  elements,         // of springs, dampers or slips side by side
  block_stiffness,  // k0 of a block
  block_damping,    // b∞ of a block, meshes aside
  mode_stiffness,   // k of a block's mode that no parameter touches, by ascending relaxation rate
  mode_damping,     // b of it
  observed,         // of the dampers that the brake takes the place of
};

// What a number is: its kind, the elements that are side by side, or those of the block, and which of its modes.
struct NumberSubject {
  NumberKind kind;
  ElementList elements;
  std::size_t mode = 0;
};

// base + Σ of tunables, each times its share
struct TunableNumber {
  double base;
  std::vector<TunableTerm> terms;
  std::string name;  // of the elements whose values are in it
  std::string unit;
  NumberSubject of;
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
  double max_damping = 0;    // what the brake can give, apart from what is added [N·s/m]
  double added = 0;          // by the certificate, to what it gives in every regime [N·s/m]
  double assured_share = 0;  // of b, what the motor may make up by an estimate while the coil is on its way [1]
  std::string text;          // what it follows, for people
};

// Numbers are already rounded to the law's scalar type.
struct TunableTables {
  std::string network;  // its name, with which those of functions in C begin
  TunableHead head = {};
  std::vector<Tunable> tunables;
  std::vector<TunableNumber> numbers;
  std::vector<int> springs;
  std::vector<std::string> spring_names;              // for remarks
  std::vector<std::optional<FixedRelaxation>> fixed;  // one for each spring; empty if a parameter changes it
  std::vector<BlockPart> parts;
  std::vector<MeshEdge> edges;
  std::vector<TunableBlock> blocks;
  std::vector<std::string> block_names;  // of their elements
  std::vector<ElementList> block_elements;
  std::vector<int> cuts;
  std::vector<TunableYield> yields;
  std::vector<std::string> slip_names;                  // one a yield force
  std::vector<std::vector<std::size_t>> slip_elements;  // the same, indices into Network::elements
  std::vector<TunableCoupling> couplings;
  std::vector<slip_node<double>> nodes;
  std::vector<TunableGraph> graphs;
  std::vector<TunableEnds> links;  // of slips in trees nothing
  std::vector<TunableEnds> ties;
  int mesh_nodes = 0;
  int ends = 0;  // of the largest graph
  TunableBrake brake;
  bool is_exact = true;    // relaxations by the exact scheme, else backward Euler; meshes always by the latter
  double least_share = 0;  // of its greatest value: behind a slip no part is softer, no slip yields sooner [1]
  std::vector<std::string> mesh_elements;  // whose states are kept by backward Euler, for people
  bool has_slips() const { return !yields.empty(); }
  bool sheds() const { return head.motor_limit > 0 || head.motor_step > 0; }
};

// Larger networks are refused: set() reports each parameter by a bit, the work for a mesh of relaxations grows with the
// third power of its nodes, and each slip outside a tree triples the number of patterns.
inline constexpr int most_tunables = 32, most_tunable_nodes = 32, most_tunable_slips = 8, most_tunable_ends = 16;

}  // namespace dashpot::compiler
