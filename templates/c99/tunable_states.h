// What a change of parameters works on: the springs, what stands between them, and the slips.
typedef struct law_tunables {
  scalar elongation[law_springs];     // z [m]
  scalar offset[law_springs];         // r, how far the rest length is from home [m]
  scalar tank;                        // energy that changes have set free [J]
  int is_owing;                       // some offset is not home
  int is_shed;                        // and what was shed is the reason
#if MAP
  int is_changing;                    // since the last sample; what there was before:
  scalar sampled_stiffness[law_springs], sampled_elongation[law_springs], sampled_offset[law_springs];
  scalar sampled_tank;
#endif
#if MAP && STATIC
  scalar stiffest_share;              // of the static spring: its largest k over this one; 0: there is none
#endif
  scalar stiffness[law_springs];      // what follows from the values: k [N/m]
  scalar share[law_springs];          // φ of a relaxation [1]
  scalar loss[law_springs];           // α of a relaxation [1]
  scalar block_stiffness[law_blocks_room];    // g of every block [N/m]
  scalar block_held[law_blocks_room];         // π [N]
  scalar block_elongation[law_blocks_room];   // δ in this sample [m]
  scalar block_feedthrough[law_blocks_room];  // b∞; 0 of block 0, whose is the law's own [N·s/m]
#if MESH
  law_mesh_room mesh, other_mesh;
  law_meshes meshes;
#endif
#if LIMITS
  scalar last_force, now_force;  // m of the sample before, and of this one [N]
  scalar kept_share;             // of all forces
#if CONTACT
  scalar dent;      // of a surface, by what was shed [m]
  scalar returned;  // of it in this sample [m]
#endif
#endif
#if SLIPS
  int sign[law_slips + 1], last_sign[law_slips + 1];
#endif
#if TREE
  law_node nodes[law_tree_nodes_room];
  law_part_state part_states[law_tree_nodes_room];
  law_corner corners[law_corners], merged[law_merged];
#endif
#if GRAPH
  scalar tie_stiffness[law_blocks_room];  // g of blocks in graphs [N/m]
  law_link links[law_slips + 1];
  scalar end_between[law_ends_room * law_ends_room], end_to_tool[law_ends_room], end_to_ground[law_ends_room];
  scalar end_held[law_ends_room + 2], end_moved[law_ends_room];
  scalar end_joined[law_ends_room * law_ends_room], end_numbers[8 * law_ends_room];
  int end_group[law_ends_room + 2];
#endif
#if BRAKE
  int commanded[law_slips];
  int slid[law_slips], slides_now[law_slips];
  scalar slid_at[law_slips], slid_at_now[law_slips];  // where the tool was when a slip last slid [m]
  scalar root, root_now;                              // √b
#endif
} law_tunables;

