typedef struct law_range_of_parameter {
  scalar value;  // to begin with
  scalar min;
  scalar max;
} law_range_of_parameter;

// What a part of a block is. Parts stand in parallel.
enum {
  law_spring,      // p = k (z − r)
  law_damper,      // p = B ż
  law_relaxation,  // a spring and a damper in series
  law_mesh         // springs and dampers between inner nodes
};

enum { law_none = -1, law_mesh_port = -1, law_mesh_held = -2 };  // the ends of a mesh, in the place of a node

typedef struct law_part {
  int kind;
  int spring;      // into the springs; of a mesh none
  int damping;     // number of a damper or relaxation [N·s/m]
  int share;       // number φ of a relaxation: what a displacement within a sample leaves in its spring [1]
  int loss;        // number α of a relaxation: what is lost in a sample [1]
  int first_node;  // of a mesh, as are those below
  int node_count;
  int first_edge;
  int edge_count;
  int is_loose;  // a spring in series with a slip, so that its rest length means nothing
} law_part;

#if MESH
// A spring or a damper of a mesh between two of its nodes, counted from the mesh's first; `from` is the end at the
// port's side.
typedef struct law_edge {
  int from;
  int to;
  int spring;   // into the springs, or none
  int damping;  // a number, or none
} law_edge;

#endif
#if MESHES
// Springs and dampers between inner nodes, eliminated node after node from star to mesh: g_jk += g_ij g_ik / Σ g_i.
// Conductances are only added, multiplied and divided, never subtracted.
typedef struct law_mesh_room {
  scalar weight[law_mesh_nodes][law_mesh_nodes];  // above the diagonal; g_ij, then g_ij/Σ g_i
  scalar to_port[law_mesh_nodes], to_held[law_mesh_nodes];
  scalar inverse[law_mesh_nodes];  // 1/Σ g_i, 0 where nothing holds the node
  scalar through;
#if MESH
  scalar push[law_mesh_nodes];   // forces on the nodes [N]
  scalar moved[law_mesh_nodes];  // [m]
#endif
#if VISCOSITY
  scalar next[law_mesh_nodes][law_mesh_nodes];  // what a conductance grows by with s
  scalar next_to_port[law_mesh_nodes], next_to_held[law_mesh_nodes], next_through;
#endif
} law_mesh_room;

#endif
typedef struct law_block_parts {
  int first_part;
  int part_count;
  scalar least_stiffness;  // behind a slip no softer [N/m]
} law_block_parts;

// One spring across a change of its stiffness.
typedef struct law_spring_change {
  scalar stiffness;      // before [N/m]
  scalar new_stiffness;  // after
  scalar force;          // before [N]
  scalar new_force;      // after
} law_spring_change;

#if SLIPS
// Yield force of a slip: the least of numbers[cuts[first]] …, one number for each way to cut it through.
typedef struct law_yield {
  int first_cut;
  int cut_count;
  scalar least;  // no less, whatever the numbers are [N]
} law_yield;

#endif
#if TREE
// Slips that are stepped together: nodes of the tree, blocks in the order of their places, slips likewise.
typedef struct law_coupling {
  int first_node;
  int node_count;
  int first_block;
  int first_slip;
  int first_corner;
} law_coupling;

#endif
#if GRAPH
// What a block or a slip is between where slips meet in no tree: inner ends by their number from 0, then the tool, then
// the ground.
typedef struct law_ends {
  int from;
  int to;
} law_ends;

// Slips that are stepped together and meet in no tree, and the blocks between their ends, one a tie. With a contact the
// last inner end is the surface.
typedef struct law_graph {
  int end_count;  // inner ones
  int link_count;
  int first_slip;  // into slips and links
  int tie_count;
  int first_tie;
  int first_block;
} law_graph;

#endif
#if MESH
// Of the meshes that join tool and ground, or the surface and ground, without a slip.
typedef struct law_meshes {
  scalar stiffness;    // g without b∞/h [N/m]
  scalar feedthrough;  // b∞ [N·s/m]
} law_meshes;

#endif
#if SLIPS && CONTACT
// Of slips behind a surface.
typedef struct law_push {
  scalar force;   // that opposes the tool [N]
  scalar change;  // of the surface [m]
} law_push;

#endif
#if BRAKE
// Of slips and the brake.
typedef struct law_slip_brake {
  scalar now;      // b∞/h behind slips in this sample, as far as the brake makes it [N/m]
  scalar damping;  // b of it, on its way there with the coil [N·s/m]
  scalar wanted;   // and where it is going [N·s/m]
} law_slip_brake;

#endif
#if LIMITS
// Of a motor that can make no more.
typedef struct law_limit {
  scalar force;  // m [N]
  scalar share;  // of all forces in the network, what is kept [1]
} law_limit;

#endif
