// One step of slips that are coupled through a tree of linear blocks: exact, with a bound on the work, without
// iteration. In a sample each block answers its elongation δ with the force p = g δ + π, each slip holds |p| ≤ Y and
// gives way only at ±Y. Three passes over the parts of the tree:
//   curves    every part is a monotone polyline in (δ, p). In parallel forces add, in series elongations do;
//   signs     from the tool down, which slips give way, and to which side;
//   numbers   with these known every part is rigid, a constant force, or p = g δ + π. Corners alone would lose digits.
enum { law_block, law_slip, law_series, law_parallel };

// A part of the tree. Parts stand breadth first, the root at 0: children are neighbours and come after their parent.
typedef struct law_node {
  int kind;
  int first_child;  // of a series or parallel
  int child_count;
  int slips;          // in this part
  int place;          // of a block or slip: where it stands in the inputs and outputs of a step
  int first_corner;   // where its curve begins
  scalar stiffness;   // g of a block; of the others dp/dδ at both ends of the curve, 0 where flat [N/m]
  scalar compliance;  // its inverse, 0 where flat [m/N]
  scalar yield;       // Y of a slip [N]
} law_node;

// The curve of a part that gives way, p against δ: a polyline that never falls. Beside its kinks it knows its force at
// δ = 0.
typedef struct law_corner {
  scalar elongation;  // δ [m]
  scalar force;       // p [N]
  int is_kink;        // else the point at δ = 0
} law_corner;

// As it is read by elongation where parts stand in parallel, by force where they stand in series.
typedef struct law_curve {
  const law_corner *corners;
  int count;
  int by_force;
  scalar end_slope;  // of what is read, at both ends
  int is_open;       // flat ends, read by force: no value beyond them, any value at them
} law_curve;

// All values of a curve at one place: more than one on a step.
typedef struct law_range {
  scalar low, high;
  int open_low, open_high;  // reaches to infinity
  int exists;               // false beyond open ends
  int is_kink;
} law_range;

enum { law_rigid, law_constant, law_affine };

// What is known of a part in the course of a step.
typedef struct law_part_state {
  int corners;     // of its curve
  int sign;        // of a slip: 0 stuck, ±1 the side to which it gives way
  int takes_rest;  // gets what is left over of its series' elongation
  int hold;
  scalar stiffness;   // g where affine [N/m]
  scalar compliance;  // 1/g [m/N]
  scalar force;       // π where affine, the force itself where constant [N]
  scalar elongation;  // δ [m]
} law_part_state;

typedef struct law_tree {
  const law_node *nodes;
  int count;
  law_part_state *parts;
  law_corner *corners;
  law_corner *merged;  // room for the sum of two curves, as large as the root's
} law_tree;

// Corners that a part's curve needs: two a slip, and of each of the curves that are added up in it, and of a block, the
// point where that part rests. No more are ever written, whatever the numbers are.
static inline int law_corner_room(const law_node *node) { return 3 * node->slips + 1; }
static inline int law_at_most(int count, int room) { return (count < room) ? count : room; }

static inline scalar law_corner_at(const law_corner *corner, int by_force) {
  return by_force ? corner->force : corner->elongation;
}
static inline scalar law_corner_value(const law_corner *corner, int by_force) {
  return by_force ? corner->elongation : corner->force;
}
static inline law_corner law_make_corner(int by_force, scalar at, scalar value, int is_kink) {
  law_corner corner = {at, value, is_kink};
  if (by_force) {
    corner.elongation = value;
    corner.force = at;
  }
  return corner;
}

// Interpolates from the nearer corner, never beyond either.
static inline scalar law_between(const law_corner *a, const law_corner *b, int by_force, scalar at) {
  const scalar low = law_corner_value(a, by_force), high = law_corner_value(b, by_force);
  if (low == high) return low;
  const scalar before = at - law_corner_at(a, by_force), after = law_corner_at(b, by_force) - at;
  const scalar rise = (high - low) / (before + after);
  return (before < after) ? (low + before * rise) : (high - after * rise);
}

static inline scalar law_beyond(const law_curve *curve, const law_corner *end, scalar at) {
  if (curve->end_slope == 0) return law_corner_value(end, curve->by_force);
  return law_corner_value(end, curve->by_force) + curve->end_slope * (at - law_corner_at(end, curve->by_force));
}

// Where no corner is: between two, or beyond the ends.
static inline law_range law_beside(const law_curve *curve, int next, scalar at) {
  const int is_end = (next == 0) || (next >= curve->count);
  const scalar value = is_end ? law_beyond(curve, &curve->corners[(next == 0) ? 0 : (next - 1)], at)
                              : law_between(&curve->corners[next - 1], &curve->corners[next], curve->by_force, at);
  const int is_open = is_end && curve->is_open;
  const law_range range = {value, value, is_open && (next == 0), is_open && (next != 0), !is_open, 0};
  return range;
}

// Reads a curve at places that never fall; `next` is the corner that comes next.
static inline law_range law_read(const law_curve *curve, int *next, scalar at) {
  const int first = *next;
  int is_kink = 0;
  while ((*next < curve->count) && (law_corner_at(&curve->corners[*next], curve->by_force) == at)) {
    is_kink = curve->corners[*next].is_kink || is_kink;
    ++*next;
  }
  if (first == *next) return law_beside(curve, *next, at);
  const law_range range = {law_corner_value(&curve->corners[first], curve->by_force),
                           law_corner_value(&curve->corners[*next - 1], curve->by_force),
                           curve->is_open && (first == 0),
                           curve->is_open && (*next == curve->count),
                           1,
                           is_kink};
  return range;
}

static inline law_range law_curve_at(const law_curve *curve, scalar at) {
  int next = 0;
  while ((next < curve->count) && (law_corner_at(&curve->corners[next], curve->by_force) < at)) ++next;
  return law_read(curve, &next, at);
}

// Behind `count` corners in `to`. Rounding must not bend a curve back.
static inline int law_append_corner(law_corner *to, int count, int room, int by_force, scalar at, scalar value,
                                    int is_kink) {
  if (count >= room) return room;
  const int falls = (count > 0) && (value < law_corner_value(&to[count - 1], by_force));
  to[count] = law_make_corner(by_force, at, falls ? law_corner_value(&to[count - 1], by_force) : value, is_kink);
  return count + 1;
}

// The sum of two curves; `to` has `room` for it. Returns how many corners there are.
static inline int law_merge_curves(const law_curve *a, const law_curve *b, law_corner *to, int room) {
  const int most = law_at_most(a->count + b->count, room), by_force = a->by_force;
  int count = 0, next_a = 0, next_b = 0;
  for (int i = 0; (i < most) && ((next_a < a->count) || (next_b < b->count)); ++i) {
    const int takes_b =
        (next_a == a->count) || ((next_b < b->count) && (law_corner_at(&b->corners[next_b], by_force) <
                                                         law_corner_at(&a->corners[next_a], by_force)));
    const scalar at = takes_b ? law_corner_at(&b->corners[next_b], by_force)
                              : law_corner_at(&a->corners[next_a], by_force);
    const law_range in_a = law_read(a, &next_a, at), in_b = law_read(b, &next_b, at);
    if (!in_a.exists || !in_b.exists) continue;
    const int is_kink = in_a.is_kink || in_b.is_kink;
    count = law_append_corner(to, count, most, by_force, at, in_a.low + in_b.low, is_kink);
    if ((in_a.low < in_a.high) || (in_b.low < in_b.high))
      count = law_append_corner(to, count, most, by_force, at, in_a.high + in_b.high, is_kink);
  }
  return count;
}

// Puts a point of the curve where it belongs, `count` being how many corners there are. Returns how many there then are.
static inline int law_insert_corner(law_corner *corners, int count, int room, int by_force, law_corner corner) {
  int place = count;
  if (count >= room) return room;
  for (; (place > 0) && (law_corner_at(&corners[place - 1], by_force) > law_corner_at(&corner, by_force)); --place)
    corners[place] = corners[place - 1];
  corners[place] = corner;
  return count + 1;
}

// Leaves the kinks and the point at δ = 0; on a flat end nothing is gained by it. Returns how many there are.
static inline int law_mark_rest(const law_curve *curve, law_corner *corners, int room) {
  const law_range rest = law_curve_at(curve, 0);
  int count = 0;
  for (int i = 0; i < curve->count; ++i)
    if (corners[i].is_kink && (count < room)) corners[count++] = corners[i];
  if (count == 0) return 0;
  const int is_flat =
      (curve->end_slope == 0) && ((corners[0].elongation > 0) || (corners[count - 1].elongation < 0));
  if (rest.is_kink || is_flat) return count;
  return law_insert_corner(corners, count, room, 0, law_make_corner(0, 0, rest.low, 0));
}

static inline law_curve law_curve_of(const law_tree *tree, int k, int by_force) {
  const law_node *node = &tree->nodes[k];
  const law_curve curve = {tree->corners + node->first_corner, tree->parts[k].corners, by_force,
                           by_force ? node->compliance : node->stiffness, by_force && (node->stiffness == 0)};
  return curve;
}

// p of a block where it is read by elongation, δ where by force.
static inline scalar law_block_value(const law_node *block, int by_force, scalar held, scalar at) {
  return by_force ? ((at - held) * block->compliance) : (block->stiffness * at + held);
}

static inline law_range law_curve_by_force_at(const law_tree *tree, int k, scalar force) {
  const law_curve curve = law_curve_of(tree, k, 1);
  return law_curve_at(&curve, force);
}

static inline void law_draw_slip(const law_tree *tree, int k) {
  const law_node *node = &tree->nodes[k];
  tree->corners[node->first_corner] = law_make_corner(0, 0, -node->yield, 1);
  tree->corners[node->first_corner + 1] = law_make_corner(0, 0, node->yield, 1);
  tree->parts[k].corners = 2;
}

// The sum of two curves; `to` is where the first one is stored, and then the sum.
static inline law_curve law_with(const law_tree *tree, law_curve sum, const law_curve *other, law_corner *to, int room) {
  const law_corner *from = (sum.count == 0) ? other->corners : tree->merged;
  const int count =
      (sum.count == 0) ? law_at_most(other->count, room) : law_merge_curves(&sum, other, tree->merged, room);
  for (int i = 0; i < count; ++i) to[i] = from[i];
  const law_curve both = {to, count, sum.by_force, sum.end_slope + other->end_slope, sum.is_open || other->is_open};
  return both;
}

// In series the point where the block has no elongation is added to the curve.
static inline law_curve law_with_block(law_curve sum, const law_node *block, scalar held, law_corner *corners, int room) {
  if (sum.by_force) {
    const law_range rest = law_curve_at(&sum, held);
    if (rest.exists && !rest.is_kink)
      sum.count = law_insert_corner(corners, sum.count, room, 1, law_make_corner(1, held, rest.low, 0));
  }
  for (int i = 0; i < sum.count; ++i) {
    const scalar at = law_corner_at(&corners[i], sum.by_force);
    const scalar value = law_corner_value(&corners[i], sum.by_force) + law_block_value(block, sum.by_force, held, at);
    corners[i] = law_make_corner(sum.by_force, at, value, corners[i].is_kink);
  }
  sum.end_slope = sum.end_slope + (sum.by_force ? block->compliance : block->stiffness);
  return sum;
}

static inline void law_draw(const law_tree *tree, int k, const scalar *held) {
  const law_node *node = &tree->nodes[k];
  const int room = law_corner_room(node);
  law_corner *corners = tree->corners + node->first_corner;
  law_curve sum = {corners, 0, node->kind == law_series, 0, 0};
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i)
    if (tree->nodes[i].kind != law_block) {
      const law_curve other = law_curve_of(tree, i, sum.by_force);
      sum = law_with(tree, sum, &other, corners, room);
    }
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i)
    if (tree->nodes[i].kind == law_block)
      sum = law_with_block(sum, &tree->nodes[i], held[tree->nodes[i].place], corners, room);
  tree->parts[k].corners = sum.count;
  if (node->kind == law_series) {
    const law_curve curve = law_curve_of(tree, k, 0);
    tree->parts[k].corners = law_mark_rest(&curve, corners, room);
  }
}

static inline void law_draw_curves(const law_tree *tree, const scalar *held) {
  for (int k = tree->count - 1; k >= 0; --k) {
    if (tree->nodes[k].kind == law_slip) law_draw_slip(tree, k);
    if (tree->nodes[k].kind >= law_series) law_draw(tree, k, held);
  }
}

static inline void law_find_signs_in_parallel(const law_tree *tree, int k) {
  const law_node *node = &tree->nodes[k];
  const scalar elongation = tree->parts[k].elongation;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    tree->parts[i].elongation = elongation;
    tree->parts[i].takes_rest = 0;
    tree->parts[i].sign = (elongation > 0) ? 1 : ((elongation < 0) ? -1 : 0);
  }
}

// The elongation that is left over goes to the parts that slide at this force, in turn; all but the last get as much
// as they can.
static inline void law_place_rest(const law_tree *tree, int k, scalar rest, scalar force) {
  const law_node *node = &tree->nodes[k];
  int is_placed = 0;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    law_part_state *part = &tree->parts[i];
    if (!part->takes_rest) continue;
    part->takes_rest = 0;
    if (is_placed) continue;
    const law_range range = law_curve_by_force_at(tree, i, force);
    const scalar room = range.high - range.low;
    is_placed = range.open_low || range.open_high || (rest < room);
    part->takes_rest = is_placed;
    const int is_backwards = range.open_low ? (rest > 0) : (rest < 0);
    if (is_placed && !is_backwards) part->elongation += rest;
    if (is_placed) continue;
    part->elongation = range.high;
    rest -= room;
  }
}

static inline law_range law_elongations(const law_tree *tree, int i, scalar force, const scalar *held) {
  if (tree->nodes[i].kind != law_block) return law_curve_by_force_at(tree, i, force);
  const scalar elongation = law_block_value(&tree->nodes[i], 1, held[tree->nodes[i].place], force);
  const law_range range = {elongation, elongation, 0, 0, 1, 0};
  return range;
}

static inline void law_find_signs_in_series(const law_tree *tree, int k, const scalar *held) {
  const law_node *node = &tree->nodes[k];
  const law_curve curve = law_curve_of(tree, k, 0);
  const law_range forces = law_curve_at(&curve, tree->parts[k].elongation);
  const scalar force = (forces.low < forces.high) ? (forces.low + (forces.high - forces.low) / 2) : forces.low;
  scalar rest = tree->parts[k].elongation;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    const law_range range = law_elongations(tree, i, force, held);
    law_part_state *part = &tree->parts[i];
    part->elongation = range.open_low ? range.high : range.low;
    part->takes_rest = (range.low < range.high) || range.open_low || range.open_high;
    part->sign = (force >= tree->nodes[i].yield) ? 1 : ((force <= -tree->nodes[i].yield) ? -1 : 0);
    rest -= part->elongation;
  }
  law_place_rest(tree, k, rest, force);
}

static inline void law_find_signs(const law_tree *tree, scalar change, const scalar *held, int *sign) {
  tree->parts[0].elongation = change;
  for (int k = 0; k < tree->count; ++k) {
    if (tree->nodes[k].kind == law_parallel) law_find_signs_in_parallel(tree, k);
    if (tree->nodes[k].kind == law_series) law_find_signs_in_series(tree, k, held);
    if (tree->nodes[k].kind == law_slip) sign[tree->nodes[k].place] = tree->parts[k].sign;
  }
}

static inline void law_become(law_part_state *part, int hold, scalar stiffness, scalar compliance, scalar force) {
  part->hold = hold;
  part->stiffness = stiffness;
  part->compliance = compliance;
  part->force = force;
}

// Any rigid → rigid; else g = Σ g_i, π = Σ π_i; all constant → constant.
static inline void law_add_up_parallel(const law_tree *tree, int k) {
  const law_node *node = &tree->nodes[k];
  int rigid = 0, affine = 0;
  scalar stiffness = 0, force = 0;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    const law_part_state *part = &tree->parts[i];
    if (part->hold == law_rigid) ++rigid;
    if (part->hold == law_affine) {
      ++affine;
      stiffness += part->stiffness;
    }
    force += part->force;
  }
  if (rigid != 0) law_become(&tree->parts[k], law_rigid, 0, 0, 0);
  else if (affine == 0) law_become(&tree->parts[k], law_constant, 0, 0, force);
  else law_become(&tree->parts[k], law_affine, stiffness, 1 / stiffness, force);
}

// A child that holds a constant force, preferably the one that takes the rest; 0 for none.
static inline int law_constant_child(const law_tree *tree, int k) {
  const law_node *node = &tree->nodes[k];
  int found = 0;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i)
    if ((tree->parts[i].hold == law_constant) && ((found == 0) || tree->parts[i].takes_rest)) found = i;
  return found;
}

// If a part has a constant force, that is the force of all; rigid parts drop out; 1/g = Σ 1/g_i, π = g Σ π_i/g_i; all
// rigid → rigid.
static inline void law_add_up_series(const law_tree *tree, int k) {
  const law_node *node = &tree->nodes[k];
  law_part_state *whole = &tree->parts[k];
  const int constant = law_constant_child(tree, k);
  int affine = 0, last = 0;
  scalar compliance = 0, weighted = 0;
  if (constant != 0) {
    law_become(whole, law_constant, 0, 0, tree->parts[constant].force);
    return;
  }
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    const law_part_state *part = &tree->parts[i];
    if (part->hold != law_affine) continue;
    ++affine;
    last = i;
    compliance += part->compliance;
    weighted += part->force * part->compliance;
  }
  if (affine == 0) {
    law_become(whole, law_rigid, 0, 0, 0);
  } else if (affine == 1) {
    const law_part_state *part = &tree->parts[last];
    law_become(whole, law_affine, part->stiffness, part->compliance, part->force);
  } else {
    const scalar stiffness = 1 / compliance;
    law_become(whole, law_affine, stiffness, compliance, weighted * stiffness);
  }
}

static inline void law_add_up(const law_tree *tree, const scalar *held) {
  for (int k = tree->count - 1; k >= 0; --k) {
    const law_node *node = &tree->nodes[k];
    law_part_state *part = &tree->parts[k];
    if (node->kind == law_block)
      law_become(part, law_affine, node->stiffness, node->compliance, held[node->place]);
    else if (node->kind == law_slip)
      law_become(part, (part->sign == 0) ? law_rigid : law_constant, 0, 0, (scalar)part->sign * node->yield);
    else if (node->kind == law_parallel) law_add_up_parallel(tree, k);
    else law_add_up_series(tree, k);
  }
}

static inline int law_is_only_affine(const law_tree *tree, int k) {
  const law_node *node = &tree->nodes[k];
  int affine = 0;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i)
    if (tree->parts[i].hold == law_affine) ++affine;
  return affine == 1;
}

// δ_i = (p − π_i)/g_i where affine, 0 where rigid; the rest where constant.
static inline void law_share_in_series(const law_tree *tree, int k) {
  const law_node *node = &tree->nodes[k];
  const law_part_state *whole = &tree->parts[k];
  const int taker = law_constant_child(tree, k);
  const int is_undivided = (taker == 0) && law_is_only_affine(tree, k);
  const scalar force =
      (whole->hold == law_affine) ? (whole->stiffness * whole->elongation + whole->force) : whole->force;
  scalar rest = whole->elongation;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    law_part_state *part = &tree->parts[i];
    if (i == taker) continue;
    if (part->hold == law_rigid) part->elongation = 0;
    if (part->hold == law_affine)
      part->elongation = is_undivided ? whole->elongation : ((force - part->force) * part->compliance);
    rest -= part->elongation;
  }
  if (taker != 0) tree->parts[taker].elongation = rest;
}

static inline void law_share(const law_tree *tree, scalar change, scalar *elongation) {
  tree->parts[0].elongation = change;
  for (int k = 0; k < tree->count; ++k) {
    const law_node *node = &tree->nodes[k];
    if (node->kind == law_parallel)
      for (int i = node->first_child; i < (node->first_child + node->child_count); ++i)
        tree->parts[i].elongation = tree->parts[k].elongation;
    if (node->kind == law_series) law_share_in_series(tree, k);
    if (node->kind == law_block) elongation[node->place] = tree->parts[k].elongation;
  }
}

static inline scalar law_force_at(const law_tree *tree, scalar change) {
  const law_part_state *root = &tree->parts[0];
  return (root->hold == law_affine) ? (root->stiffness * change + root->force) : root->force;
}

#if STEP
// In: the root's elongation in this sample [m], π of every block [N]. Out: the force that opposes it [N], δ of every
// block [m], and for every slip 0 where it holds, ±1 where it gives way to that side.
static inline scalar law_tree_step(const law_tree *tree, scalar change, const scalar *held, scalar *elongation,
                                   int *sign) {
  law_draw_curves(tree, held);
  law_find_signs(tree, change, held, sign);
  law_add_up(tree, held);
  law_share(tree, change, elongation);
  return law_force_at(tree, change);
}

#endif
#if PUSH
// The same where the tool pushes and cannot pull: `change` is what the root's elongation would be if it stuck to the
// tool, `surface` what it is, never less: the force is 0 where it is more.
static inline scalar law_tree_push(const law_tree *tree, scalar change, const scalar *held, scalar *elongation,
                                   int *sign, scalar *surface) {
  law_draw_curves(tree, held);
  // Where the root's curve crosses 0, to within what a reading of it loses.
  const law_range crossing = law_curve_by_force_at(tree, 0, 0);
  const scalar crosses_at = crossing.open_low ? crossing.high : crossing.low;
  law_find_signs(tree, (crosses_at > change) ? crosses_at : change, held, sign);
  law_add_up(tree, held);
  const law_part_state *root = &tree->parts[0];
  const scalar released = (root->hold == law_affine) ? (-root->force * root->compliance) : crosses_at;
  const int is_free = released > change;
  *surface = is_free ? released : change;
  law_share(tree, *surface, elongation);
  const scalar force = law_force_at(tree, *surface);
  return (is_free || (force < 0)) ? 0 : force;
}

#endif
