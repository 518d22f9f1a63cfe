// The structure of a network whose parameters change while it runs, as tables: what tunable_law.hpp steps. The tables
// are constants; they hold no state. Stiffnesses, dampings and yield forces are numbers that the law works out from the
// parameters and gives by their place.
#pragma once

#include <dashpot/slip_tree.hpp>

namespace dashpot {

template <class Scalar>
struct tunable_range {
  Scalar value;  // to begin with
  Scalar min;
  Scalar max;
};

// `value` becomes what is wanted of it, within its range; what is no number at all leaves it as it is. Returns 1 where
// that is not what was wanted, else 0.
template <class Scalar>
constexpr unsigned take_value(const tunable_range<Scalar>& range, Scalar wanted, Scalar& value) noexcept {
  if (wanted == wanted) value = wanted < range.min ? range.min : wanted > range.max ? range.max : wanted;
  return value == wanted ? 0u : 1u;
}

// What a part of a block is. Parts stand in parallel.
enum class tunable_kind : unsigned char {
  spring,      // p = k (z − r)
  damper,      // p = B ż
  relaxation,  // a spring and a damper in series
  mesh,        // springs and dampers between inner nodes
};

inline constexpr int no_index = -1;
inline constexpr int mesh_port = -1;  // the ends of a mesh, in the place of a node
inline constexpr int mesh_held = -2;

struct tunable_part {
  tunable_kind kind;
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
struct tunable_edge {
  int from;
  int to;
  int spring;   // into springs, or none
  int damping;  // a number, or none
};

template <class Scalar>
struct tunable_block {
  int first_part;
  int part_count;
  Scalar least_stiffness;  // behind a slip no softer [N/m]
};

// Yield force of a slip: the least of numbers[cuts[first]] …, one number for each way to cut it through.
template <class Scalar>
struct tunable_yield {
  int first_cut;
  int cut_count;
  Scalar least;  // no less, whatever the numbers are [N]
};

// Slips that are stepped together: nodes of the tree, blocks in the order of their places, slips likewise.
struct tunable_coupling {
  int first_node;
  int node_count;
  int first_block;
  int first_slip;
  int first_corner;
};

// What a block or a slip is between where slips meet in no tree: inner ends by their number from 0, then the tool, then
// the ground.
struct tunable_ends {
  int from;
  int to;
};

// Slips that are stepped together and meet in no tree, and the blocks between their ends, one a tie. With a contact the
// last inner end is the surface.
struct tunable_graph {
  int end_count;  // inner ones
  int link_count;
  int first_slip;  // into slips and links
  int tie_count;
  int first_tie;
  int first_block;
};

// The surface that the tool pushes and cannot pull, if there is one.
template <class Scalar>
struct tunable_contact {
  bool is_there;
  Scalar at;            // where it lies unloaded [m]
  Scalar encoder_step;  // how far the gap may open before the command lets go [m]
};

// What slips leave to the brake.
template <class Scalar>
struct tunable_slip_rule {
  bool takes_part;
  Scalar hysteresis;  // of the tool's displacement, before a slide has ended for the command [m]
  Scalar coil_share;  // κ: of what is missing from √b, that the coil makes up in a sample [1]
};

// The map of a static curve that the network lies behind, if there is one. Nothing is held there that the bend of the
// curve cannot pay for (theory, section 11).
template <class Scalar>
struct tunable_map {
  bool is_there;
  Scalar largest_change;     // of w while a force is held, at the largest speed [m]
  Scalar largest_stiffness;  // of the spring that joins tool and ground directly, whatever is set [N/m]
};

// Block 0 is what joins tool and ground without a slip. With a contact and slips it is a part of the one coupling or
// graph.
template <class Scalar>
struct tunable_tables {
  Scalar rate;        // 1/h [Hz]
  Scalar retention;   // what an offset keeps in a sample where the tank pays [1]
  Scalar threshold;   // magnitudes of states below are zero
  int static_spring;  // the spring that joins tool and ground directly, or none
  tunable_contact<Scalar> contact;
  tunable_slip_rule<Scalar> slip_rule;
  int spring_count, part_count, block_count, slip_count, coupling_count, graph_count;
  const int* springs;  // number of each spring's stiffness
  const tunable_part* parts;
  const tunable_edge* edges;
  const tunable_block<Scalar>* blocks;
  const int* cuts;
  const tunable_yield<Scalar>* yields;
  const tunable_coupling* couplings;
  const slip_node<Scalar>* nodes;  // without stiffness, compliance and yield force
  const tunable_graph* graphs;
  const tunable_ends* links;  // one a slip
  const tunable_ends* ties;
  Scalar motor_limit = 0;  // of its force; 0: none [N]
  Scalar motor_step = 0;   // of its change in a period; 0: none [N]
  tunable_map<Scalar> map = {false, 0, 0};
};

}  // namespace dashpot
