// One step of slips that are coupled through a linear part of any shape: exact, with a bound on the work.
//
// Over a sample the linear part answers like springs between the ends of the slips, the tool and the ground, and forces
// held at them. The inner ends move to where Φ = Σ ½ c (x_i − x_j)² + Σ p_i x_i + Σ Y |x_a − x_b| is least. A pattern
// says of each slip whether it holds or to which side it slides. For a given pattern the least Φ follows from a linear
// system. On the way there the first slip that would turn back is made to hold; if none does, the first group of ends
// that is pulled harder than its slips hold is let go. Each pattern's least value is below the one before: none comes
// twice, and no more are tried than there are. The pattern of the sample before comes first.
//
// Systems are solved without a subtraction (Grassmann, Taksar & Heyman 1985), so that stiff and soft parts do not blur,
// and a pivot of a part that only slips hold is exactly 0.

// A slip between the ends a and b: an inner one by its number, then the tool, then the ground. It holds forces from
// `lowest` to `highest`: ∓Y, or for a contact of the tool 0 and infinity.
typedef struct law_link {
  int a;
  int b;
  scalar lowest;   // [N]
  scalar highest;  // [N]
} law_link;

typedef struct law_network {
  const law_link *links;
  int slips, nodes;
  const scalar *between, *to_tool, *to_ground;  // what an inner end is held by, beside slips [N/m]
  scalar through;                               // from tool to ground [N/m]
  scalar change;                                // of the tool's displacement in this sample [m]
  const scalar *held;                           // at every inner end and at the tool [N]
  scalar *moved;                                // of every inner end [m]
  int *sign;                                    // of every slip
  int ray;                                      // a part that nothing but slips holds, `nodes` for none
  int *group;                                   // room for nodes + 2
  scalar *joined;                               // room for nodes × nodes
  scalar *tool_tie, *ground_tie, *load, *weight, *pivot, *target, *pull, *pull_weight;  // for nodes each
} law_network;

static inline scalar law_size(scalar x) { return (x < 0) ? -x : x; }

static inline scalar law_at(const law_network *n, int end) {
  return (end == n->nodes) ? n->change : ((end == (n->nodes + 1)) ? 0 : n->moved[end]);
}
static inline scalar law_target(const law_network *n, int end) {
  const int group = n->group[end];
  return (group == n->nodes) ? n->change : ((group == (n->nodes + 1)) ? 0 : n->target[group]);
}
static inline scalar law_stretch(const law_network *n, int k) {
  return law_at(n, n->links[k].a) - law_at(n, n->links[k].b);
}
static inline scalar law_held_by(const law_network *n, int k) {
  return (n->sign[k] > 0) ? n->links[k].highest : n->links[k].lowest;
}

// The last of a group that neither tool nor ground holds.
static inline int law_is_free(const law_network *n, int i) { return n->group[i] == i; }

// Ends joined by slips that hold move as one. A slip between ends of one group holds, whatever the pattern says.
static inline void law_join(law_network *n) {
  for (int i = 0; i < (n->nodes + 2); ++i) n->group[i] = i;
  for (int k = 0; k < n->slips; ++k) {
    if (n->sign[k] != 0) continue;
    const int a = n->group[n->links[k].a], b = n->group[n->links[k].b];
    for (int i = 0; i < (n->nodes + 2); ++i)
      if (n->group[i] == ((a < b) ? a : b)) n->group[i] = (a < b) ? b : a;
  }
  for (int k = 0; k < n->slips; ++k)
    if (n->group[n->links[k].a] == n->group[n->links[k].b]) n->sign[k] = 0;
}

static inline void law_add_load(law_network *n, int end, scalar force) {
  if (n->group[end] >= n->nodes) return;
  n->load[n->group[end]] += force;
  n->weight[n->group[end]] += law_size(force);
}

static inline void law_tie(law_network *n, int a, int b, scalar stiffness) {
  if ((a == b) || ((a >= n->nodes) && (b >= n->nodes))) return;
  const int inner = (a < b) ? a : b, other = (a < b) ? b : a;
  if (other == n->nodes) n->tool_tie[inner] += stiffness;
  if (other == (n->nodes + 1)) n->ground_tie[inner] += stiffness;
  if (other < n->nodes) {
    n->joined[inner * n->nodes + other] += stiffness;
    n->joined[other * n->nodes + inner] = n->joined[inner * n->nodes + other];
  }
}

static inline void law_gather(law_network *n) {
  for (int i = 0; i < (n->nodes * n->nodes); ++i) n->joined[i] = 0;
  for (int i = 0; i < n->nodes; ++i) n->tool_tie[i] = n->ground_tie[i] = n->load[i] = n->weight[i] = 0;
  for (int i = 0; i < n->nodes; ++i) {
    if (n->group[i] < n->nodes) {
      n->tool_tie[n->group[i]] += n->to_tool[i];
      n->ground_tie[n->group[i]] += n->to_ground[i];
      law_add_load(n, i, n->held[i]);
    }
    for (int j = 0; j < i; ++j) law_tie(n, n->group[i], n->group[j], n->between[i * n->nodes + j]);
  }
  for (int k = 0; k < n->slips; ++k) {
    if (n->sign[k] == 0) continue;
    law_add_load(n, n->links[k].a, law_held_by(n, k));
    law_add_load(n, n->links[k].b, -law_held_by(n, k));
  }
}

static inline void law_pass_on(law_network *n, int k, int i, scalar share) {
  n->tool_tie[i] += share * n->tool_tie[k];
  n->ground_tie[i] += share * n->ground_tie[k];
  n->load[i] += share * n->load[k];
  n->weight[i] += law_size(share) * n->weight[k];
  for (int j = k + 1; j < n->nodes; ++j)
    if (j != i) n->joined[i * n->nodes + j] += share * n->joined[k * n->nodes + j];
}

static inline void law_eliminate_groups(law_network *n) {
  for (int k = 0; k < n->nodes; ++k) {
    if (!law_is_free(n, k)) continue;
    n->pivot[k] = n->tool_tie[k] + n->ground_tie[k];
    for (int i = k + 1; i < n->nodes; ++i) n->pivot[k] += n->joined[k * n->nodes + i];
    if (n->pivot[k] == 0) continue;
    for (int i = k + 1; i < n->nodes; ++i)
      if (law_is_free(n, i) && (n->joined[i * n->nodes + k] != 0))
        law_pass_on(n, k, i, n->joined[i * n->nodes + k] / n->pivot[k]);
  }
}

// A part that is tied to nothing but sliding slips, whose forces do not balance, moves on until one of them holds.
static inline void law_place(law_network *n, int k) {
  n->target[k] = n->moved[k];
  if (n->pivot[k] == 0) {
    if (law_size(n->load[k]) > (ROUNDOFF * n->weight[k])) n->ray = k;
    return;
  }
  scalar sum = n->tool_tie[k] * n->change - n->load[k];
  for (int i = k + 1; i < n->nodes; ++i)
    if (law_is_free(n, i)) sum += n->joined[k * n->nodes + i] * n->target[i];
  n->target[k] = sum / n->pivot[k];
}

// Finds where Φ is least with this pattern.
static inline void law_aim(law_network *n) {
  law_join(n);
  law_gather(n);
  law_eliminate_groups(n);
  n->ray = n->nodes;
  for (int k = n->nodes - 1; k >= 0; --k)
    if (law_is_free(n, k)) law_place(n, k);
}

static inline void law_arrive(law_network *n) {
  for (int i = 0; i < n->nodes; ++i) n->moved[i] = law_target(n, i);
}

// After a guessed pattern: sets every slip to the side to which it moved; true if that differs from the guess. A
// surface that the tool would have passed is moved along with it first.
static inline int law_turn_back(law_network *n) {
  for (int k = 0; k < n->slips; ++k)
    if ((n->links[k].lowest == 0) && (law_stretch(n, k) > 0) && (n->links[k].b < n->nodes))
      n->moved[n->links[k].b] = law_at(n, n->links[k].a);
  int any = n->ray < n->nodes;
  for (int k = 0; k < n->slips; ++k) {
    const scalar now = law_stretch(n, k);
    const int side = (now > 0) ? 1 : ((now < 0) ? -1 : 0);
    any = any || (side != n->sign[k]);
    n->sign[k] = side;
  }
  return any;
}

// All else stays; the part moves as a whole, against its load, by a length of the order of all others.
static inline void law_point_along_ray(law_network *n) {
  scalar length = law_size(n->change);
  for (int i = 0; i < n->nodes; ++i) length += law_size(n->moved[i]);
  for (int i = 0; i < n->nodes; ++i) n->target[i] = 0;
  n->target[n->ray] = (n->load[n->ray] > 0) ? -length : length;
  for (int k = n->ray - 1; k >= 0; --k) {
    if (!law_is_free(n, k) || (n->pivot[k] == 0)) continue;
    scalar sum = 0;
    for (int i = k + 1; i <= n->ray; ++i)
      if (law_is_free(n, i)) sum += n->joined[k * n->nodes + i] * n->target[i];
    n->target[k] = sum / n->pivot[k];
  }
  for (int i = 0; i < n->nodes; ++i)
    if (law_is_free(n, i)) n->target[i] += n->moved[i];
}

// Moves towards the target until a slip would turn back: true if none does on the whole way.
static inline int law_advance_ends(law_network *n) {
  int first = n->slips;
  scalar way = 1;
  if (n->ray < n->nodes) law_point_along_ray(n);
  for (int k = 0; k < n->slips; ++k) {
    if (n->sign[k] == 0) continue;
    const scalar here = law_stretch(n, k);
    const scalar further = law_target(n, n->links[k].a) - law_target(n, n->links[k].b) - here;
    if ((n->sign[k] > 0) ? !(further < 0) : !(further > 0)) continue;
    scalar until = -here / further;
    if (until < 0) until = 0;
    // Along a ray the first slip that would turn back counts, however far it is.
    const int may_be_far = (first == n->slips) && (n->ray < n->nodes);
    if (!may_be_far && !(until < way)) continue;
    first = k;
    way = until;
  }
  if (first == n->slips) {
    if (n->ray == n->nodes) law_arrive(n);
    return 1;
  }
  for (int i = 0; i < n->nodes; ++i) n->moved[i] += way * (law_target(n, i) - n->moved[i]);
  n->sign[first] = 0;
  return 0;
}

static inline void law_add_pull(law_network *n, int i, scalar force) {
  n->pull[i] += force;
  n->pull_weight[i] += law_size(force);
}

// The pull of a stiff tie contains the rounding errors of both ends' displacements.
static inline void law_add_tie(law_network *n, int i, scalar stiffness, scalar other) {
  law_add_pull(n, i, stiffness * (n->moved[i] - other));
  n->pull_weight[i] += law_size(stiffness) * (law_size(n->moved[i]) + law_size(other)) * NUMBER(0.125);
}

// The sum of the forces of the linear part and of the sliding slips at each inner end.
static inline void law_find_pulls(law_network *n) {
  for (int i = 0; i < n->nodes; ++i) {
    n->pull[i] = n->held[i];
    n->pull_weight[i] = law_size(n->held[i]);
    law_add_tie(n, i, n->to_tool[i], n->change);
    law_add_tie(n, i, n->to_ground[i], 0);
    for (int j = 0; j < n->nodes; ++j)
      if (j != i) law_add_tie(n, i, n->between[i * n->nodes + j], n->moved[j]);
  }
  for (int k = 0; k < n->slips; ++k) {
    if (n->sign[k] == 0) continue;
    if (n->links[k].a < n->nodes) law_add_pull(n, n->links[k].a, law_held_by(n, k));
    if (n->links[k].b < n->nodes) law_add_pull(n, n->links[k].b, -law_held_by(n, k));
  }
}

static inline int law_is_in(int end, unsigned ends) { return (end < 31) && (((ends >> end) & 1u) != 0); }

static inline int law_in_one_piece(const law_network *n, unsigned ends) {
  unsigned reached = ends & (~ends + 1u);
  for (int round = 0; round < n->slips; ++round)
    for (int k = 0; k < n->slips; ++k) {
      const law_link *link = &n->links[k];
      if (n->sign[k] != 0) continue;
      const unsigned both = ((1u << link->a) | (1u << link->b)) & ends;
      if (((both & reached) != 0) && law_is_in(link->a, ends) && law_is_in(link->b, ends)) reached |= both;
    }
  return reached == ends;
}

static inline int law_try_ends(law_network *n, unsigned ends, unsigned members, int group) {
  scalar pull = 0, up = 0, down = 0, weight = 0;
  for (int i = 0; i < n->nodes; ++i) {
    if (!law_is_in(i, ends)) continue;
    pull += n->pull[i];
    weight += n->pull_weight[i];
  }
  for (int k = 0; k < n->slips; ++k) {
    const law_link *link = &n->links[k];
    const int from = law_is_in(link->a, ends);
    if ((n->sign[k] != 0) || (from == law_is_in(link->b, ends))) continue;
    up += from ? link->highest : -link->lowest;
    down += from ? -link->lowest : link->highest;
  }
  const int rises = (pull + up) < (-ROUNDOFF * weight), falls = (down - pull) < (-ROUNDOFF * weight);
  if (!rises && !falls) return 0;
  if (!law_in_one_piece(n, ends) || !law_in_one_piece(n, (members & ~ends) | (1u << group))) return 0;
  for (int k = 0; k < n->slips; ++k) {
    const int from = law_is_in(n->links[k].a, ends);
    if ((n->sign[k] == 0) && (from != law_is_in(n->links[k].b, ends))) n->sign[k] = (from == rises) ? 1 : -1;
  }
  return 1;
}

// Lets go ends of a group that are pulled harder than the slips around them hold, and returns true; false if there
// are none. They and the rest of the group are each connected. The rest has the tool or ground, or else the last end.
static inline int law_give_way(law_network *n) {
  law_find_pulls(n);
  for (int group = 0; group < (n->nodes + 2); ++group) {
    unsigned members = 0;
    for (int i = 0; i < n->nodes; ++i)
      if ((n->group[i] == group) && (i != group)) members |= 1u << i;
    for (unsigned ends = members & (~members + 1u); ends != 0; ends = (ends - members) & members)
      if (law_try_ends(n, ends, members, group)) return 1;
  }
  return 0;
}

static inline scalar law_network_force(law_network *n) {
  law_find_pulls(n);
  scalar force = n->held[n->nodes] + n->through * n->change;
  for (int i = 0; i < n->nodes; ++i) {
    force += n->to_tool[i] * (n->change - n->moved[i]);
    if (n->group[i] == n->nodes) force += n->pull[i];
  }
  for (int k = 0; k < n->slips; ++k) {
    if (n->sign[k] == 0) continue;
    if (n->links[k].a == n->nodes) force += law_held_by(n, k);
    if (n->links[k].b == n->nodes) force -= law_held_by(n, k);
  }
  return force;
}

// The number of patterns: a contact has two states, a slip three.
static inline int law_patterns(const law_network *n) {
  int patterns = 1;
  for (int k = 0; k < n->slips; ++k) patterns *= (n->links[k].lowest == 0) ? 2 : 3;
  return patterns;
}

// In: the links, the ties, the tool's displacement, the forces held, the pattern of the sample before, and room: `group`,
// `joined` and, in `numbers`, eight for each node. Out: the force that opposes the tool [N], the displacement of every
// inner end [m], the pattern.
static inline scalar law_network_step(law_network *n, scalar *numbers) {
  n->tool_tie = numbers;
  n->ground_tie = n->tool_tie + n->nodes;
  n->load = n->ground_tie + n->nodes;
  n->weight = n->load + n->nodes;
  n->pivot = n->weight + n->nodes;
  n->target = n->pivot + n->nodes;
  n->pull = n->target + n->nodes;
  n->pull_weight = n->pull + n->nodes;
  for (int i = 0; i < n->nodes; ++i) n->moved[i] = 0;
  law_aim(n);
  law_arrive(n);
  int settled = !law_turn_back(n) && !law_give_way(n);
  const int most = law_patterns(n);
  for (int i = 0; (i < most) && !settled; ++i) {
    law_aim(n);
    settled = law_advance_ends(n) && !law_give_way(n);
  }
  return law_network_force(n);
}

