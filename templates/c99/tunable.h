// A spring's force is k (z − r). A change of stiffness leaves the forces alone and moves the offsets r, as far as energy
// allows; with every sample the offsets then go home by a part of the way, where the tank pays for it.
static inline scalar law_spring_force(const law_tunables *self, int spring) {
  return self->stiffness[spring] * (self->elongation[spring] - self->offset[spring]);
}

static inline void law_stretch_spring(law_tunables *self, int spring, scalar change) {
  self->elongation[spring] = dashpot_flush_belowF(law_threshold, self->elongation[spring] + change);
}

// F²/2k; nothing where there is no spring.
static inline scalar law_spring_energy(scalar force, scalar stiffness) {
  return (stiffness > 0) ? (force * (force / stiffness) / 2) : 0;
}

#if MAP
static inline scalar law_size_of(scalar x) { return (x > 0) ? x : -x; }

// Behind a static curve no force grows at a change. A stiffer spring keeps its force, and the tank takes what that sets
// free. A softer one keeps its force where the tank pays for all of it, else its elongation, F k′/k: so that the command
// that is held meanwhile gives out no more than the spring did. Of what that sets free the tank takes what is left when
// the tool has come back by the largest change of w. Returns what is left in the tank [J].
static inline scalar law_carry_over(law_spring_change *springs, scalar tank) {
  for (int i = 0; i < law_spring_count; ++i) {
    law_spring_change *s = &springs[i];
    s->new_force = s->force;
    if (s->new_stiffness > s->stiffness)
      tank += law_spring_energy(s->force, s->stiffness) - law_spring_energy(s->force, s->new_stiffness);
  }
  for (int i = 0; i < law_spring_count; ++i) {
    law_spring_change *s = &springs[i];
    if (s->new_stiffness >= s->stiffness) continue;
    const scalar cost = law_spring_energy(s->force, s->new_stiffness) - law_spring_energy(s->force, s->stiffness);
    const int is_paid = (s->new_stiffness > 0) && (cost <= tank);
    const scalar elongation = s->force / s->stiffness;
    const scalar left = law_size_of(elongation) - law_largest_change;
    const scalar freed = (left > 0) ? ((s->stiffness - s->new_stiffness) * (left * left) / 2) : 0;
    s->new_force = is_paid ? s->force : (s->new_stiffness * elongation);
    tank = is_paid ? (tank - cost) : (tank + freed);
  }
  return tank;
}

#else
// A stiffer spring keeps its force, and the tank takes what that sets free. A softer one keeps what its own energy can
// hold, F √(k′/k), and then more, up to F, as far as the tank pays; the springs in turn. So V + T, V = Σ F²/2k, is the
// same before and after. Returns what is left in the tank [J].
static inline scalar law_carry_over(law_spring_change *springs, scalar tank) {
  for (int i = 0; i < law_spring_count; ++i) {
    law_spring_change *s = &springs[i];
    if (s->new_stiffness >= s->stiffness) s->new_force = s->force;
    else if (s->new_stiffness > 0) s->new_force = s->force * law_square_root(s->new_stiffness / s->stiffness);
    else s->new_force = 0;
    // Only a stiffer spring sets energy free: for the others the two energies are equal but for rounding.
    if (s->new_stiffness > s->stiffness)
      tank += law_spring_energy(s->force, s->stiffness) - law_spring_energy(s->force, s->new_stiffness);
    if (s->new_stiffness <= 0) tank += law_spring_energy(s->force, s->stiffness);
  }
  for (int i = 0; i < law_spring_count; ++i) {
    law_spring_change *s = &springs[i];
    if ((s->new_stiffness > 0) && (s->new_force != s->force)) {
      const scalar held = law_spring_energy(s->new_force, s->new_stiffness);
      const scalar cost = law_spring_energy(s->force, s->new_stiffness) - held;
      const int is_paid = cost <= tank;
      const scalar most = law_square_root(2 * s->new_stiffness * (held + tank));
      s->new_force = is_paid ? s->force : ((s->force > 0) ? most : -most);
      tank = is_paid ? (tank - cost) : 0;
    }
  }
  return tank;
}

#endif
#if STATIC && !MAP
// The spring between tool and ground makes up for `missing` force, as far as the tank pays. Returns what is left in it.
static inline scalar law_make_up_for(law_spring_change *spring, scalar missing, scalar tank) {
  if (!(spring->new_stiffness > 0)) return tank;
  const scalar all = law_spring_energy(spring->new_force, spring->new_stiffness) + tank;
  const scalar most = law_square_root(2 * spring->new_stiffness * all);
  const scalar wanted = spring->new_force + missing;
  spring->new_force = (wanted > most) ? most : ((wanted < -most) ? -most : wanted);
  const scalar rest = all - law_spring_energy(spring->new_force, spring->new_stiffness);
  return (rest > 0) ? rest : 0;
}

#endif
static inline int law_is_changed(const law_spring_change *change) {
  return (change->new_stiffness != change->stiffness) || (change->new_force != change->force);
}

// What is next to a spring makes room for another elongation.
static inline void law_move_end(law_tunables *self, int spring, const law_spring_change *change) {
  if (!law_is_changed(change)) return;
  self->elongation[spring] = (change->new_stiffness > 0) ? (change->new_force / change->new_stiffness) : 0;
}

// r = z − F/k; what is no more than rounding of z is none.
static inline void law_move_offset(law_tunables *self, int spring, const law_spring_change *change) {
  if (!law_is_changed(change)) return;
  const scalar z = self->elongation[spring];
  const scalar offset = (change->new_stiffness > 0) ? (z - change->new_force / change->new_stiffness) : 0;
  self->offset[spring] = ((z + offset / 4) == z) ? 0 : offset;
  self->is_owing = self->is_owing || (self->offset[spring] != 0);
}

#if MAP && STATIC
// Behind a static curve, once a sample: what the spring between tool and ground holds is between nothing and what it
// would hold at home were it the stiffest. What is beyond is let go of as soon as that sets free what the command that
// is held meanwhile may give out.
static inline void law_let_go(law_tunables *self) {
  const int spring = law_static_spring;
  if (self->offset[spring] == 0) return;
  const scalar z = self->elongation[spring], k = self->stiffness[spring], stretched = z - self->offset[spring];
  const scalar stiffest = self->stiffest_share * z;
  const int is_less = stretched < stiffest;
  const scalar least = is_less ? stretched : stiffest, most = is_less ? stiffest : stretched;
  const scalar kept = (least > 0) ? least : ((most < 0) ? most : 0);
  const scalar change = law_size_of(stretched - kept), left = law_size_of(stretched + kept) / 2 - law_largest_change;
  if ((change == 0) || (left < 0)) return;
  self->tank += k * change * left;
  self->offset[spring] = z - kept;
}

#endif
// Once a sample.
static inline void law_bring_offsets_home(law_tunables *self) {
  if (!self->is_owing) return;
  self->is_owing = 0;
  for (int i = 0; i < law_spring_count; ++i) {
    const scalar before = self->offset[i], after = dashpot_flush_belowF(law_threshold, law_retention * before);
    if (before == 0) continue;
    const scalar z = self->elongation[i];
#if MAP
    const scalar of_spring = self->stiffness[i] * (before - after) * ((z - after) + (z - before)) * NUMBER(0.5);
    const scalar cost = of_spring + law_size_of(self->stiffness[i] * (before - after)) * law_largest_change;
#else
    const scalar cost = self->stiffness[i] * (before - after) * ((z - after) + (z - before)) * NUMBER(0.5);
#endif
    if (cost <= self->tank) {
      self->tank -= cost;
      self->offset[i] = after;
    }
    self->is_owing = self->is_owing || (self->offset[i] != 0);
  }
  self->is_shed = self->is_shed && self->is_owing;
}

#if MESHES
static inline void law_mesh_clear(law_mesh_room *mesh, int first, int count) {
  for (int i = first; i < (first + count); ++i) {
    mesh->to_port[i] = mesh->to_held[i] = mesh->inverse[i] = 0;
#if VISCOSITY
    mesh->next_to_port[i] = mesh->next_to_held[i] = 0;
#endif
    for (int j = first; j < (first + count); ++j) {
      mesh->weight[i][j] = 0;
#if VISCOSITY
      mesh->next[i][j] = 0;
#endif
    }
  }
  mesh->through = 0;
#if VISCOSITY
  mesh->next_through = 0;
#endif
}

// A conductance between two nodes or ends.
static inline void law_mesh_join(law_mesh_room *mesh, int first, int from, int to, scalar conductance) {
  const int low = (from < to) ? from : to, high = (from < to) ? to : from;
  if (low >= 0) mesh->weight[first + low][first + high] += conductance;
  else if (high < 0) mesh->through += conductance;
  else if (low == law_mesh_port) mesh->to_port[first + high] += conductance;
  else mesh->to_held[first + high] += conductance;
}

// Ready for rest and spread. Returns the conductance from port to held end.
static inline scalar law_mesh_eliminate(law_mesh_room *mesh, int first, int count) {
  const int end = first + count;
  for (int i = first; i < end; ++i) {
    scalar pivot = mesh->to_port[i] + mesh->to_held[i];
    for (int j = i + 1; j < end; ++j) pivot += mesh->weight[i][j];
    const scalar inverse = (pivot > 0) ? (1 / pivot) : 0;
    mesh->inverse[i] = ((inverse - inverse) == 0) ? inverse : 0;
    for (int j = i + 1; j < end; ++j) {
      const scalar share = mesh->weight[i][j] * mesh->inverse[i];
      for (int k = j + 1; k < end; ++k) mesh->weight[j][k] += share * mesh->weight[i][k];
      mesh->to_port[j] += share * mesh->to_port[i];
      mesh->to_held[j] += share * mesh->to_held[i];
    }
    mesh->through += mesh->to_port[i] * mesh->inverse[i] * mesh->to_held[i];
    for (int j = i + 1; j < end; ++j) mesh->weight[i][j] *= mesh->inverse[i];
    mesh->to_port[i] *= mesh->inverse[i];
  }
  return mesh->through;
}

#endif
#if MESH
static inline void law_mesh_release(law_mesh_room *mesh, int first, int count) {
  for (int i = first; i < (first + count); ++i) mesh->push[i] = 0;
}

// A spring's force pulls its ends together. Returns its part of the force at the port.
static inline scalar law_mesh_pull(law_mesh_room *mesh, int first, const law_edge *edge, scalar force) {
  if (edge->from >= 0) mesh->push[first + edge->from] -= force;
  if (edge->to >= 0) mesh->push[first + edge->to] += force;
  return (edge->from == law_mesh_port) ? force : ((edge->to == law_mesh_port) ? -force : 0);
}

// What the pushes come to at the port while it does not move.
static inline scalar law_mesh_rest(law_mesh_room *mesh, int first, int count) {
  scalar force = 0;
  for (int i = first; i < (first + count); ++i) {
    for (int j = i + 1; j < (first + count); ++j) mesh->push[j] += mesh->weight[i][j] * mesh->push[i];
    force -= mesh->to_port[i] * mesh->push[i];
  }
  return force;
}

// How far every node moves with the port, after rest.
static inline void law_mesh_spread(law_mesh_room *mesh, int first, int count, scalar change) {
  for (int i = first + count - 1; i >= first; --i) {
    scalar moved = mesh->inverse[i] * mesh->push[i] + mesh->to_port[i] * change;
    for (int j = i + 1; j < (first + count); ++j) moved += mesh->weight[i][j] * mesh->moved[j];
    mesh->moved[i] = moved;
  }
}

static inline scalar law_mesh_moved(const law_mesh_room *mesh, int first, int node, scalar change) {
  return (node >= 0) ? mesh->moved[first + node] : ((node == law_mesh_port) ? change : 0);
}

// Without `numbers` of springs alone.
static inline scalar law_eliminate(const law_tunables *self, const law_part *part, scalar per_stiffness, scalar per_damping,
                                   const scalar *numbers, law_mesh_room *mesh) {
  law_mesh_clear(mesh, part->first_node, part->node_count);
  for (int i = part->first_edge; i < (part->first_edge + part->edge_count); ++i) {
    const law_edge *edge = &law_edges[i];
    if (edge->spring != law_none)
      law_mesh_join(mesh, part->first_node, edge->from, edge->to, per_stiffness * self->stiffness[edge->spring]);
    else if (numbers != 0)
      law_mesh_join(mesh, part->first_node, edge->from, edge->to, per_damping * numbers[edge->damping]);
  }
  return law_mesh_eliminate(mesh, part->first_node, part->node_count);
}

static inline void law_advance_mesh(law_tunables *self, const law_part *part, scalar change, law_mesh_room *mesh) {
  law_mesh_spread(mesh, part->first_node, part->node_count, change);
  for (int i = part->first_edge; i < (part->first_edge + part->edge_count); ++i) {
    const law_edge *edge = &law_edges[i];
    if (edge->spring != law_none)
      law_stretch_spring(self, edge->spring, law_mesh_moved(mesh, part->first_node, edge->from, change) -
                                                 law_mesh_moved(mesh, part->first_node, edge->to, change));
  }
}

#endif
#if VISCOSITY
typedef struct law_first_order {
  scalar lead, next;
} law_first_order;

static inline law_first_order law_order(scalar lead, scalar next) {
  const law_first_order both = {lead, next};
  return both;
}

// a b/p to first order. Where p has no lead neither a nor b has one.
static inline void law_bridge(law_first_order a, law_first_order b, law_first_order p, scalar *lead, scalar *next) {
  if (p.lead > 0) {
    const scalar ratio = b.lead / p.lead;
    *lead += a.lead * ratio;
    *next += a.next * ratio + a.lead / p.lead * (b.next - ratio * p.next);
  } else if (p.next > 0) {
    *next += a.next * (b.next / p.next);
  }
}

// Elimination with conductances g + s n as s goes to 0. Returns n from port to held end.
static inline scalar law_eliminate_to_first_order(law_mesh_room *mesh, int first, int count) {
  const int end = first + count;
  for (int i = first; i < end; ++i) {
    law_first_order pivot =
        law_order(mesh->to_port[i] + mesh->to_held[i], mesh->next_to_port[i] + mesh->next_to_held[i]);
    const law_first_order port = law_order(mesh->to_port[i], mesh->next_to_port[i]);
    const law_first_order held = law_order(mesh->to_held[i], mesh->next_to_held[i]);
    for (int j = i + 1; j < end; ++j) {
      pivot.lead += mesh->weight[i][j];
      pivot.next += mesh->next[i][j];
    }
    for (int j = i + 1; j < end; ++j) {
      const law_first_order here = law_order(mesh->weight[i][j], mesh->next[i][j]);
      for (int k = j + 1; k < end; ++k)
        law_bridge(here, law_order(mesh->weight[i][k], mesh->next[i][k]), pivot, &mesh->weight[j][k],
                   &mesh->next[j][k]);
      law_bridge(here, port, pivot, &mesh->to_port[j], &mesh->next_to_port[j]);
      law_bridge(here, held, pivot, &mesh->to_held[j], &mesh->next_to_held[j]);
    }
    law_bridge(port, held, pivot, &mesh->through, &mesh->next_through);
  }
  return mesh->next_through;
}

// The viscosity of a mesh at low frequency: the second term of K + s B seen at the port, as s goes to 0.
static inline scalar law_mesh_viscosity(law_tunables *self, const law_part *part, const scalar *numbers) {
  law_mesh_room *mesh = &self->other_mesh;
  law_mesh_clear(mesh, part->first_node, part->node_count);
  for (int i = part->first_edge; i < (part->first_edge + part->edge_count); ++i) {
    const law_edge *edge = &law_edges[i];
    const int first = part->first_node, is_spring = edge->spring != law_none;
    const scalar lead = is_spring ? self->stiffness[edge->spring] : 0;
    const scalar next = is_spring ? 0 : numbers[edge->damping];
    const int low = (edge->from < edge->to) ? edge->from : edge->to;
    const int high = (edge->from < edge->to) ? edge->to : edge->from;
    law_mesh_join(mesh, first, edge->from, edge->to, lead);
    if (low >= 0) mesh->next[first + low][first + high] += next;
    else if (high < 0) mesh->next_through += next;
    else if (low == law_mesh_port) mesh->next_to_port[first + high] += next;
    else mesh->next_to_held[first + high] += next;
  }
  const scalar found = law_eliminate_to_first_order(mesh, part->first_node, part->node_count);
  return (found > 0) ? found : 0;
}

#endif
// b∞ [N·s/m]
static inline scalar law_part_feedthrough(law_tunables *self, const law_part *part, const scalar *numbers) {
  if (part->kind == law_damper) return numbers[part->damping];
#if MESH
  if (part->kind == law_mesh) return law_eliminate(self, part, 0, 1, numbers, &self->mesh);
#else
  (void)self;
#endif
  return 0;
}

// g = dp/dδ over a sample [N/m]. Leaves a mesh as the steps need it.
static inline scalar law_part_stiffness(law_tunables *self, const law_part *part, const scalar *numbers) {
  if (part->kind == law_spring) return self->stiffness[part->spring];
  if (part->kind == law_damper) return numbers[part->damping] * law_rate;
#if MESH
  if (part->kind == law_mesh) return law_eliminate(self, part, 1, law_rate, numbers, &self->mesh);
#endif
  return self->stiffness[part->spring] * self->share[part->spring];
}

// π, and what a mesh needs to be spread.
static inline scalar law_held_by_part(law_tunables *self, const law_part *part) {
  if (part->kind == law_damper) return 0;
  if (part->kind == law_spring) return law_spring_force(self, part->spring);
#if MESH
  if (part->kind == law_mesh) {
    scalar force = 0;
    law_mesh_release(&self->mesh, part->first_node, part->node_count);
    for (int i = part->first_edge; i < (part->first_edge + part->edge_count); ++i)
      if (law_edges[i].spring != law_none)
        force += law_mesh_pull(&self->mesh, part->first_node, &law_edges[i],
                               law_spring_force(self, law_edges[i].spring));
    return force + law_mesh_rest(&self->mesh, part->first_node, part->node_count);
  }
#endif
  return law_spring_force(self, part->spring) -
         self->stiffness[part->spring] * (self->loss[part->spring] * self->elongation[part->spring]);
}

static inline void law_advance(law_tunables *self, const law_part *part, scalar change) {
  if (part->kind == law_damper) return;
#if MESH
  if (part->kind == law_mesh) {
    law_advance_mesh(self, part, change, &self->mesh);
    return;
  }
#endif
  if (part->kind == law_spring) law_stretch_spring(self, part->spring, change);
  else
    law_stretch_spring(self, part->spring,
                       self->share[part->spring] * change - self->loss[part->spring] * self->elongation[part->spring]);
}

// In a relaxation the damper makes room, of a loose spring the slip; of other springs the offset does.
static inline void law_take_forces(law_tunables *self, const law_part *part, const law_spring_change *changes) {
  if ((part->kind == law_spring) && !part->is_loose) law_move_offset(self, part->spring, &changes[part->spring]);
  else if (part->spring != law_none) law_move_end(self, part->spring, &changes[part->spring]);
#if MESH
  for (int i = part->first_edge; i < (part->first_edge + part->edge_count); ++i)
    if (law_edges[i].spring != law_none) law_move_offset(self, law_edges[i].spring, &changes[law_edges[i].spring]);
#endif
}

#if LIMITS
// All but `share` of a spring's force is let go of: what is next to it makes room, its offset does, or both do. Behind a
// surface that can move everything shrinks alike.
static inline void law_shed_spring(law_tunables *self, const law_part *part, int spring, scalar share) {
#if CONTACT
  (void)part;
  self->elongation[spring] *= share;
  self->offset[spring] *= share;
#else
  if ((part->kind == law_mesh) || ((part->kind == law_spring) && !part->is_loose)) {
    self->offset[spring] = self->elongation[spring] - share * (self->elongation[spring] - self->offset[spring]);
    self->is_owing = self->is_shed = 1;
  } else {
    self->elongation[spring] = self->offset[spring] + share * (self->elongation[spring] - self->offset[spring]);
  }
#endif
}

static inline void law_shed_part(law_tunables *self, const law_part *part, scalar share) {
  if (part->spring != law_none) law_shed_spring(self, part, part->spring, share);
#if MESH
  for (int i = part->first_edge; i < (part->first_edge + part->edge_count); ++i)
    if (law_edges[i].spring != law_none) law_shed_spring(self, part, law_edges[i].spring, share);
#endif
}

// What has been shed is not asked for again, and nothing pulls because of it: the offset is no further from home than
// the spring, the middle one of 0, r and z.
static inline void law_bring_shed_offset_home(law_tunables *self, int spring) {
  const scalar r = self->offset[spring], z = self->elongation[spring];
  const scalar least = (r < z) ? r : z, most = (r < z) ? z : r;
  self->offset[spring] = (least > 0) ? least : ((most < 0) ? most : 0);
}

static inline void law_bring_shed_offsets_home(law_tunables *self, const law_part *part) {
#if MAP && STATIC
  if (part->spring == law_static_spring) return;  // lets go by itself
#endif
  if (part->spring != law_none) law_bring_shed_offset_home(self, part->spring);
#if MESH
  for (int i = part->first_edge; i < (part->first_edge + part->edge_count); ++i)
    if (law_edges[i].spring != law_none) law_bring_shed_offset_home(self, law_edges[i].spring);
#endif
}

static inline scalar law_within_limit(scalar force) {
  return (law_motor_limit > 0) ? dashpot_clamp_toF(law_motor_limit, force) : force;
}

// m within the motor's limits, and the share s = m/wanted where `wanted` is beyond it.
static inline scalar law_limited(law_tunables *self, scalar wanted) {
  scalar now = law_within_limit(wanted);
  self->kept_share = 1;
  if (law_motor_step > 0) {
    const scalar most = law_within_limit(self->last_force + law_motor_step);
    const scalar least = law_within_limit(self->last_force - law_motor_step);
    now = (wanted > most) ? most : ((wanted < least) ? least : wanted);
  }
  if (((wanted - now) * wanted) > 0) self->kept_share = ((now * wanted) > 0) ? (now / wanted) : 0;
  self->now_force = now;
  return now;
}

// After the parts have advanced, by the share that the command has kept.
static inline void law_shed(law_tunables *self, scalar position) {
  const scalar share = self->kept_share;
#if RETURNS
  // How far from where the surface lies unloaded it now lies at rest.
  self->dent -= self->returned;
  if (share < 1) self->dent = position - share * (position - self->dent);
  const scalar at = position - self->dent;
#else
  const scalar at = position;
#endif
#if STATIC && !CONTACT
  self->elongation[law_static_spring] = at;
#endif
  for (int i = 0; (i < law_part_count) && (share < 1); ++i) law_shed_part(self, &law_parts[i], share);
#if STATIC && CONTACT
  self->elongation[law_static_spring] = at;
#endif
#if !STATIC
  (void)at;
#endif
  for (int i = 0; (i < law_part_count) && self->is_shed; ++i) law_bring_shed_offsets_home(self, &law_parts[i]);
  self->last_force = self->now_force;
}

#endif
#if SLIPS
static inline scalar law_yield_force(const law_yield *yield, const scalar *numbers) {
  scalar weakest = numbers[law_cuts[yield->first_cut]];
  for (int i = yield->first_cut + 1; i < (yield->first_cut + yield->cut_count); ++i)
    weakest = (numbers[law_cuts[i]] < weakest) ? numbers[law_cuts[i]] : weakest;
  return (weakest > yield->least) ? weakest : yield->least;
}

// Curves of slips through parts that give way without end would lose their digits.
static inline scalar law_bounded_stiffness(const law_tunables *self, int block) {
  const scalar least = law_block_table[block].least_stiffness;
  return (self->block_stiffness[block] > least) ? self->block_stiffness[block] : least;
}

#endif
#if TREE
static inline law_tree law_tree_of(law_tunables *self, const law_coupling *c) {
  const law_tree tree = {self->nodes + c->first_node, c->node_count, self->part_states + c->first_node,
                         self->corners + c->first_corner, self->merged};
  return tree;
}

// dp/dδ with every slip giving way: in parallel the sum, in series the inverse of Σ 1/g.
static inline scalar law_end_stiffness(const law_tunables *self, const law_coupling *c, const law_node *node) {
  scalar sum = 0, compliance = 0;
  int is_flat = 0;
  if (node->kind == law_slip) return 0;
  if (node->kind == law_block) return law_bounded_stiffness(self, c->first_block + node->place);
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    const law_node *child = &self->nodes[c->first_node + i];
    sum += child->stiffness;
    compliance += child->compliance;
    is_flat = is_flat || (child->stiffness == 0);
  }
  return (node->kind == law_parallel) ? sum : (is_flat ? 0 : (1 / compliance));
}

static inline void law_tune_tree(law_tunables *self, const law_coupling *c, const scalar *numbers) {
  for (int k = c->first_node + c->node_count - 1; k >= c->first_node; --k) {
    law_node *node = &self->nodes[k];
    *node = law_tree_nodes[k];
    if (node->kind == law_slip) node->yield = law_yield_force(&law_yields[c->first_slip + node->place], numbers);
    node->stiffness = law_end_stiffness(self, c, node);
    node->compliance = (node->stiffness > 0) ? (1 / node->stiffness) : 0;
  }
}

#endif
#if GRAPH
static inline void law_tune_graph(law_tunables *self, const law_graph *g, const scalar *numbers) {
  for (int i = g->first_block; i < (g->first_block + g->tie_count); ++i)
    self->tie_stiffness[i] = law_bounded_stiffness(self, i);
  for (int k = g->first_slip; k < (g->first_slip + g->link_count); ++k) {
    const scalar yield = law_yield_force(&law_yields[k], numbers);
    const law_link link = {law_slip_ends[k].from, law_slip_ends[k].to, -yield, yield};
    self->links[k] = link;
  }
#if CONTACT
  const law_link surface = {g->end_count, g->end_count - 1, 0, LARGEST};
  self->links[law_slips] = surface;
#endif
}

// A tie between two ends, in the way that a step of the network reads it.
static inline void law_put_tie(law_tunables *self, const law_graph *g, int first, int second, scalar stiffness,
                               scalar *through) {
  if (second < g->end_count) {
    self->end_between[first * g->end_count + second] += stiffness;
    self->end_between[second * g->end_count + first] += stiffness;
  } else if (first >= g->end_count) {
    *through += stiffness;
  } else if (second == g->end_count) {
    self->end_to_tool[first] += stiffness;
  } else {
    self->end_to_ground[first] += stiffness;
  }
}

static inline scalar law_end_moved(const law_tunables *self, const law_graph *g, int end, scalar change) {
  return (end < g->end_count) ? self->end_moved[end] : ((end == g->end_count) ? change : 0);
}

// From the pattern of the sample before. With a contact one link more is the tool's own.
static inline scalar law_step_graph(law_tunables *self, const law_graph *g, int links, scalar change) {
  scalar through = 0;
  for (int k = g->first_slip; k < (g->first_slip + links); ++k) self->sign[k] = self->last_sign[k];
  for (int i = 0; i < (g->end_count * g->end_count); ++i) self->end_between[i] = 0;
  for (int i = 0; i < g->end_count; ++i) self->end_to_tool[i] = self->end_to_ground[i] = 0;
  for (int i = 0; i < (g->end_count + 2); ++i) self->end_held[i] = 0;
  for (int i = 0; i < g->tie_count; ++i) {
    const int block = g->first_block + i, a = law_ties[g->first_tie + i].from, b = law_ties[g->first_tie + i].to;
    law_put_tie(self, g, (a < b) ? a : b, (a < b) ? b : a, self->tie_stiffness[block], &through);
    self->end_held[a] += self->block_held[block];
    self->end_held[b] -= self->block_held[block];
  }
  law_network network;
  network.links = self->links + g->first_slip;
  network.slips = links;
  network.nodes = g->end_count;
  network.between = self->end_between;
  network.to_tool = self->end_to_tool;
  network.to_ground = self->end_to_ground;
  network.through = through;
  network.change = change;
  network.held = self->end_held;
  network.moved = self->end_moved;
  network.sign = self->sign + g->first_slip;
  network.group = self->end_group;
  network.joined = self->end_joined;
  const scalar force = law_network_step(&network, self->end_numbers);
  for (int i = 0; i < g->tie_count; ++i) {
    const law_ends *tie = &law_ties[g->first_tie + i];
    self->block_elongation[g->first_block + i] =
        law_end_moved(self, g, tie->from, change) - law_end_moved(self, g, tie->to, change);
  }
  return force;
}

#endif
#if GRAPH && BRAKE
static inline int law_mesh_end(const law_tunables *self, const law_graph *g, int end, int tool) {
  const int group = self->end_group[end];
  return (group == tool) ? law_mesh_port : ((group == (g->end_count + 1)) ? law_mesh_held : group);
}

// b∞ between `tool`, one of the ends, and the ground: slips that hold join their ends, of one that slides nothing is
// left. Tool and ground come last and stay what they are.
static inline scalar law_graph_feedthrough(law_tunables *self, const law_graph *g, int tool, const int *sign) {
  law_mesh_room mesh;
  for (int i = 0; i < (g->end_count + 2); ++i) self->end_group[i] = i;
  for (int k = 0; k < g->link_count; ++k) {
    if (sign[k] != 0) continue;
    const int a = self->end_group[law_slip_ends[g->first_slip + k].from];
    const int b = self->end_group[law_slip_ends[g->first_slip + k].to];
    for (int i = 0; i < (g->end_count + 2); ++i)
      if (self->end_group[i] == ((a < b) ? a : b)) self->end_group[i] = (a < b) ? b : a;
  }
  law_mesh_clear(&mesh, 0, g->end_count);
  for (int i = 0; i < g->tie_count; ++i) {
    const int from = law_mesh_end(self, g, law_ties[g->first_tie + i].from, tool);
    const int to = law_mesh_end(self, g, law_ties[g->first_tie + i].to, tool);
    if (from != to) law_mesh_join(&mesh, 0, from, to, self->block_feedthrough[g->first_block + i]);
  }
  return law_mesh_eliminate(&mesh, 0, g->end_count);
}

#endif
#if SLIPS && !CONTACT
static inline scalar law_step_slips(law_tunables *self, scalar change) {
  scalar sum = 0;
#if TREE
  for (int i = 0; i < law_coupling_count; ++i) {
    const law_coupling *c = &law_couplings[i];
    const law_tree tree = law_tree_of(self, c);
    sum += law_tree_step(&tree, change, self->block_held + c->first_block, self->block_elongation + c->first_block,
                         self->sign + c->first_slip);
  }
#endif
#if GRAPH
  for (int i = 0; i < law_graph_count; ++i)
    sum += law_step_graph(self, &law_graphs[i], law_graphs[i].link_count, change);
#endif
  return sum;
}

#endif
#if SLIPS && CONTACT
// The one coupling, or graph, of a contact: the whole network.
static inline scalar law_push_slips(law_tunables *self, scalar approach, scalar *change) {
#if GRAPH
  const scalar force = law_step_graph(self, &law_graphs[0], law_graphs[0].link_count + 1, approach);
  *change = self->end_moved[law_graphs[0].end_count - 1];
  return force;
#else
  const law_coupling *c = &law_couplings[0];
  const law_tree tree = law_tree_of(self, c);
  return law_tree_push(&tree, approach, self->block_held + c->first_block, self->block_elongation + c->first_block,
                       self->sign, change);
#endif
}

#endif
#if BRAKE
// b∞ of all that is behind slips, for one pattern of those that give way [N·s/m].
static inline scalar law_damping_of(law_tunables *self, const int *sign) {
  scalar sum = 0;
#if TREE
  for (int i = 0; i < law_coupling_count; ++i) {
    const law_coupling *c = &law_couplings[i];
    const law_tree tree = law_tree_of(self, c);
    sum += law_regime_feedthrough(&tree, self->block_feedthrough + c->first_block, sign + c->first_slip);
  }
#endif
#if GRAPH
  for (int i = 0; i < law_graph_count; ++i) {
    const law_graph *g = &law_graphs[i];
#if CONTACT
    const int tool = g->end_count - 1;
#else
    const int tool = g->end_count;
#endif
    sum += law_graph_feedthrough(self, g, tool, sign + g->first_slip);
  }
#endif
  return sum;
}

static inline scalar law_least(scalar one, scalar other) { return (one < other) ? one : other; }

// After a reset: what slips leave to a brake that has `left` for them [N·s/m].
static inline scalar law_tunable_resting_brake(law_tunables *self, scalar left) {
  for (int i = 0; i < law_slips; ++i) {
    self->commanded[i] = 0;
    self->slid[i] = 0;
    self->slid_at[i] = 0;
  }
  const scalar damping = law_least(law_damping_of(self, self->commanded), left);
  self->root = law_square_root(damping);
  return damping;
}

// Which slips slide for the command: a slide ends where the tool has gone the hysteresis, to either side, and the slip
// not with it.
static inline void law_follow_slides(law_tunables *self, scalar position) {
  for (int i = 0; i < law_slips; ++i) {
    const scalar way = position - self->slid_at[i];
    self->slides_now[i] = (self->sign[i] != 0) || (self->slid[i] && ((law_hysteresis * law_hysteresis - way * way) > 0));
    self->slid_at_now[i] = (self->sign[i] != 0) ? position : self->slid_at[i];
    self->commanded[i] = self->slides_now[i] ? 1 : 0;
  }
}

// b on its way to what the regime would have: √b ← √b + κ (√b_regime − √b).
static inline scalar law_reached_damping(law_tunables *self, scalar wanted) {
  if (!(law_coil_share < 1)) return wanted;
  self->root_now = self->root + law_coil_share * (law_square_root(wanted) - self->root);
  return self->root_now * self->root_now;
}

// What slips leave to a brake that has `left` for them, after their step, by where the tool is.
static inline law_slip_brake law_tunable_slip_brake(law_tunables *self, scalar position, scalar left) {
  const scalar now = law_least(law_damping_of(self, self->sign), left);
  law_follow_slides(self, position);
  const scalar wanted = law_least(law_damping_of(self, self->commanded), left);
  const law_slip_brake found = {now * law_rate, law_reached_damping(self, wanted), wanted};
  return found;
}

#endif
#if SLIPS
static inline void law_keep_slips(law_tunables *self) {
  for (int i = 0; i <= law_slips; ++i) self->last_sign[i] = self->sign[i];
#if BRAKE
  for (int i = 0; i < law_slips; ++i) {
    self->slid[i] = self->slides_now[i];
    self->slid_at[i] = self->slid_at_now[i];
  }
  self->root = self->root_now;
#endif
}

#endif
// g and b∞ of every block. Returns g of all that joins tool and ground without a slip but for dampers and meshes.
static inline scalar law_find_curves(law_tunables *self, const scalar *numbers) {
  scalar springs = 0;
#if MESH
  self->meshes.stiffness = self->meshes.feedthrough = 0;
#endif
  for (int i = 0; i < law_block_count; ++i) {
    self->block_feedthrough[i] = self->block_stiffness[i] = 0;
    for (int k = 0; k < law_block_table[i].part_count; ++k) {
      const law_part *part = &law_parts[law_block_table[i].first_part + k];
      const scalar through = law_part_feedthrough(self, part, numbers);
      const scalar stiffness = law_part_stiffness(self, part, numbers);
      self->block_feedthrough[i] += through;
      self->block_stiffness[i] += stiffness;
      if ((i > 0) || (part->kind == law_damper)) continue;
#if MESH
      if (part->kind == law_mesh) {
        self->meshes.stiffness += stiffness - through * law_rate;
        self->meshes.feedthrough += through;
        continue;
      }
#endif
      springs += stiffness;
    }
  }
  // Of what no slip changes the brake has been told already.
  self->block_feedthrough[0] = 0;
  return springs;
}

// p = g δ + π: π of every block, and what its meshes need to be spread.
static inline void law_find_held(law_tunables *self) {
  for (int i = 0; i < law_block_count; ++i) {
    scalar held = 0;
    for (int k = 0; k < law_block_table[i].part_count; ++k)
      held += law_held_by_part(self, &law_parts[law_block_table[i].first_part + k]);
    self->block_held[i] = held;
  }
}

// Everything but the parameters' values and what follows from them.
static inline void law_rest(law_tunables *self) {
  for (int i = 0; i < law_springs; ++i) self->elongation[i] = self->offset[i] = 0;
  for (int i = 0; i < law_blocks_room; ++i) self->block_elongation[i] = 0;
  self->tank = 0;
  self->is_owing = self->is_shed = 0;
#if MAP
  self->is_changing = 0;
#endif
#if LIMITS
  self->last_force = self->now_force = 0;
  self->kept_share = 1;
#if CONTACT
  self->dent = self->returned = 0;
#endif
#endif
#if SLIPS
  for (int i = 0; i <= law_slips; ++i) self->last_sign[i] = 0;
#endif
}

// At rest at `position`. Returns π of what joins tool and ground without a slip [N].
static inline scalar law_tunable_reset(law_tunables *self, scalar position) {
  law_rest(self);
#if STATIC
  self->elongation[law_static_spring] = position;
#endif
#if MESH
  // The dampers of a mesh rest, its springs alone carry the load.
  for (int i = 0; i < law_block_table[0].part_count; ++i) {
    const law_part *part = &law_parts[law_block_table[0].first_part + i];
    if (part->kind != law_mesh) continue;
    law_eliminate(self, part, 1, 0, 0, &self->other_mesh);
    law_mesh_release(&self->other_mesh, part->first_node, part->node_count);
    law_mesh_rest(&self->other_mesh, part->first_node, part->node_count);
    law_advance_mesh(self, part, position, &self->other_mesh);
  }
#endif
  law_find_held(self);
  (void)position;
  return self->block_held[0];
}

// π of what joins tool and ground without a slip [N].
static inline scalar law_tunable_held(const law_tunables *self) { return self->block_held[0]; }

#if MESH
// What a change has found of meshes without a slip.
static inline law_meshes law_tunable_meshes(const law_tunables *self) { return self->meshes; }

#endif
#if VISCOSITY
// Of those the viscosity at low frequency [N·s/m].
static inline scalar law_tunable_viscosity(law_tunables *self, const scalar *numbers) {
  scalar sum = 0;
  for (int i = 0; i < law_block_table[0].part_count; ++i) {
    const law_part *part = &law_parts[law_block_table[0].first_part + i];
    if (part->kind == law_mesh) sum += law_mesh_viscosity(self, part, numbers);
  }
  return sum;
}

#endif
#if SLIPS && !CONTACT
// Of all slips, by the tool's displacement in this sample: the force that opposes it [N].
static inline scalar law_tunable_slip(law_tunables *self, scalar change) { return law_step_slips(self, change); }

#endif
#if SLIPS && CONTACT
// The same of slips behind a surface, and all beside them: by what the surface's change would be if it stuck to the tool.
static inline law_push law_tunable_push(law_tunables *self, scalar approach) {
  law_push pushed = {0, 0};
  pushed.force = law_push_slips(self, approach, &pushed.change);
  return pushed;
}

#endif
#if LIMITS
// The motor's part within its limits, and of all forces the share that is kept for it.
static inline law_limit law_tunable_limit(law_tunables *self, scalar wanted) {
  law_limit limited = {0, 1};
  limited.force = law_limited(self, wanted);
  limited.share = self->kept_share;
  return limited;
}

#endif
#if RETURNS
// Where the surface stands when it and its dent have followed a tool that is gone, until the dent is none.
static inline scalar law_tunable_follow(law_tunables *self, scalar surface, scalar depth) {
#if LIMITS
  const scalar gap = surface - depth;
  self->returned = ((gap > 0) && (self->dent > 0)) ? ((gap < self->dent) ? gap : self->dent) : 0;
  return surface - self->returned;
#else
  (void)self;
  (void)depth;
  return surface;
#endif
}

#endif
// Takes the states over a sample, by the change of the tool, or of the surface that it pushes, and to its position.
// Returns π of what joins tool and ground without a slip [N].
static inline scalar law_tunable_update(law_tunables *self, scalar change, scalar position) {
  self->block_elongation[0] = change;
  for (int i = 0; i < law_block_count; ++i)
    for (int k = 0; k < law_block_table[i].part_count; ++k)
      law_advance(self, &law_parts[law_block_table[i].first_part + k], self->block_elongation[i]);
#if LIMITS
  law_shed(self, position);
#elif STATIC
  self->elongation[law_static_spring] = position;
#endif
  (void)position;
#if MAP
  self->is_changing = 0;
#endif
#if MAP && STATIC
  law_let_go(self);
#endif
  law_bring_offsets_home(self);
#if SLIPS
  law_keep_slips(self);
#endif
  law_find_held(self);
  return self->block_held[0];
}

// V + T [J]
static inline scalar law_tunable_stored_energy(const law_tunables *self) {
  scalar stored = self->tank;
  for (int i = 0; i < law_spring_count; ++i)
    stored += law_spring_force(self, i) * (self->elongation[i] - self->offset[i]) * (scalar)0.5;
  return stored;
}

// `value` becomes what is wanted of it, within its range; what is no number at all leaves it as it is. Returns 1 where
// that is not what was wanted, else 0.
static inline unsigned law_take_value(const law_range_of_parameter *range, scalar wanted, scalar *value) {
  if (wanted == wanted) *value = (wanted < range->min) ? range->min : ((wanted > range->max) ? range->max : wanted);
  return (*value == wanted) ? 0u : 1u;
}

// With new numbers: the springs' forces stay as they are as far as energy allows. Returns g of all that joins tool and
// ground without a slip but for dampers and meshes [N/m].
static inline scalar law_tunable_set(law_tunables *self, const scalar *numbers) {
  law_spring_change changes[law_springs];
#if MAP
  // Several changes between two samples are one, from what there was at the first of them: one command is held meanwhile.
  for (int i = 0; i < law_springs; ++i) {
    if (self->is_changing) {
      self->stiffness[i] = self->sampled_stiffness[i];
      self->elongation[i] = self->sampled_elongation[i];
      self->offset[i] = self->sampled_offset[i];
    } else {
      self->sampled_stiffness[i] = self->stiffness[i];
      self->sampled_elongation[i] = self->elongation[i];
      self->sampled_offset[i] = self->offset[i];
    }
  }
  if (self->is_changing) self->tank = self->sampled_tank;
  else self->sampled_tank = self->tank;
  self->is_changing = 1;
#endif
  for (int i = 0; i < law_springs; ++i) {
    changes[i].stiffness = self->stiffness[i];
    changes[i].force = law_spring_force(self, i);
    changes[i].new_force = 0;
  }
  for (int i = 0; i < law_spring_count; ++i) self->stiffness[i] = numbers[law_spring_numbers[i]];
#if RELAXES
  for (int i = 0; i < law_part_count; ++i) {
    if (law_parts[i].kind != law_relaxation) continue;
    self->share[law_parts[i].spring] = numbers[law_parts[i].share];
    self->loss[law_parts[i].spring] = numbers[law_parts[i].loss];
  }
#endif
  const scalar stiffness = law_find_curves(self, numbers);
#if TREE
  for (int i = 0; i < law_coupling_count; ++i) law_tune_tree(self, &law_couplings[i], numbers);
#endif
#if GRAPH
  for (int i = 0; i < law_graph_count; ++i) law_tune_graph(self, &law_graphs[i], numbers);
#endif
  for (int i = 0; i < law_springs; ++i) changes[i].new_stiffness = self->stiffness[i];
  self->tank = law_carry_over(changes, self->tank);
#if MAP && STATIC
  const scalar static_stiffness = self->stiffness[law_static_spring];
  self->stiffest_share = (static_stiffness > 0) ? (law_largest_stiffness / static_stiffness) : 0;
#elif STATIC
  // The spring between tool and ground makes up for what others could not keep.
  scalar missing = 0;
  for (int i = 0; i < law_block_table[0].part_count; ++i) {
    const int spring = law_parts[law_block_table[0].first_part + i].spring;
    if (spring != law_none) missing += changes[spring].force - changes[spring].new_force;
  }
  if (missing != 0) self->tank = law_make_up_for(&changes[law_static_spring], missing, self->tank);
#endif
  for (int i = 0; i < law_part_count; ++i) law_take_forces(self, &law_parts[i], changes);
  law_find_held(self);
  return stiffness;
}

// Before all else.
static inline void law_tunable_begin(law_tunables *self) {
#if MAP
  self->is_changing = 0;
#endif
  for (int i = 0; i < law_springs; ++i) self->stiffness[i] = self->share[i] = self->loss[i] = 0;
  for (int i = 0; i < law_blocks_room; ++i)
    self->block_stiffness[i] = self->block_held[i] = self->block_feedthrough[i] = 0;
#if MESH
  law_mesh_clear(&self->mesh, 0, law_mesh_nodes);
  law_mesh_clear(&self->other_mesh, 0, law_mesh_nodes);
  for (int i = 0; i < law_mesh_nodes; ++i)
    self->mesh.push[i] = self->mesh.moved[i] = self->other_mesh.push[i] = self->other_mesh.moved[i] = 0;
#endif
#if SLIPS
  for (int i = 0; i <= law_slips; ++i) self->sign[i] = 0;
#endif
#if TREE
  for (int i = 0; i < law_tree_nodes_room; ++i) {
    self->nodes[i] = law_tree_nodes[i];
    self->part_states[i].corners = self->part_states[i].sign = self->part_states[i].takes_rest = 0;
    self->part_states[i].elongation = 0;
    law_become(&self->part_states[i], law_rigid, 0, 0, 0);
  }
  for (int i = 0; i < law_corners; ++i) self->corners[i] = law_make_corner(0, 0, 0, 0);
  for (int i = 0; i < law_merged; ++i) self->merged[i] = law_make_corner(0, 0, 0, 0);
#endif
#if GRAPH
  for (int i = 0; i < law_ends_room; ++i) self->end_moved[i] = 0;
  for (int i = 0; i < (8 * law_ends_room); ++i) self->end_numbers[i] = 0;
#endif
#if BRAKE
  for (int i = 0; i < law_slips; ++i) {
    self->slides_now[i] = 0;
    self->slid_at_now[i] = 0;
  }
  self->root_now = 0;
#endif
  law_rest(self);
}
