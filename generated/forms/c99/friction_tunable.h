// Presliding and Coulomb friction beside a viscous drag, all of which change while it runs
//
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, but for
//   samples in which a slip or a contact changes
// brake: makes b = 12 N·s/m of damping, behind slips also what follows, and the motor the rest of the force; by
//   the rule 'faithful': no device to be faithful on, so the paper's rule: dampers at the tool in parallel add
// behind friction: velocity-free, parameters change while it runs; b is that of their default values; b = 0 N·s/m
//   stuck, 0 sliding
// states: what is kept of the past follows the measured position (position driven, so that a change of parameters
//   injects no energy)
// late velocity: with 0 N·s/m more in an exact brake, no lateness of the estimate alone costs passivity
// passivity: not certified for any motion, whatever slides, sticks, touches or lets go, any values within their
//   ranges between changes, however the brake changes above its least command: needs 2.5 N·s/m, counted sample by
//   sample over a hold of up to 0.001 s, at least 0 N·s/m is there, 2.5 N·s/m more is missing in the brake's
//   command
//   on an ideal device with the difference of two samples for a velocity; nothing is added for passivity
// energy: whatever the values within their ranges, no motion gets more work out of the law than stored_energy()
//   falls; rounding adds at most 1.1e-14 of the sum of the force's terms
// device: none is named: exact brake, no delay, and for velocity the difference of the last two positions over the
//   period. Pass that one: a smoother estimate is later, and of it nothing is certified here
// tunable: yield (0 to 5 N), presliding (200 to 5000 N/m), drag (0 to 40 N s/m)
//   set() brings no energy in: a rise of stiffness while the tool presses stays owed until the springs can pay
//   b [N·s/m] follows damper_3
// cost of output(): at most 82 additions, multiplications and divisions
// cost of update(): at most 21 additions and multiplications; 1 numbers are kept between samples
// cost of set(): at most 24 additions, multiplications and divisions for the constants, 384 for the springs'
//   energy
// words: passive is what gives the hand no more energy than it got; certified, what is proved to be passive
//
// Written by dashpot 0.1.0 from a network with digest
// c86fcb8b7c393e3b623d21078d88e80af59e3eaf3833b10700b69af0c86379ba. It belongs to whoever had it
// written. C99, and C++; compile it with -ffp-contract=off where results are compared bit for bit.
#ifndef DASHPOT_GENERATED_friction_tunable_H
#define DASHPOT_GENERATED_friction_tunable_H

// <dashpot/command.h>, so that this file is all that is needed.
// What an update law in C returns every sample, and the arithmetic that it shares with the law in C++. C99 and C++;
// includes nothing. The sign convention is that of <dashpot/command.hpp>: the network opposes the tool with the force
// f = damping·u̇ + force, positive against +u.
#ifndef DASHPOT_COMMAND_H
#define DASHPOT_COMMAND_H

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "dashpot needs IEEE arithmetic: finite checks and compensated sums do not survive -ffast-math"
#endif

// Of a law in float both numbers are floats, widened without rounding.
typedef struct dashpot_command {
  double damping;  // brake damping [N·s/m], or [N·m·s/rad] in rotation; never negative
  double force;    // motor force opposing +u [N], or torque [N·m] in rotation
} dashpot_command;

// 1 where all three are finite, else 0: x − x is 0 for a finite x and NaN for the others, and NaN alone differs from
// itself.
static inline int dashpot_all_finite(double a, double b, double c) {
  const double nothing = ((a - a) + (b - b)) + (c - c);
  return (nothing == nothing) ? 1 : 0;
}
static inline int dashpot_all_finitef(float a, float b, float c) {
  const float nothing = ((a - a) + (b - b)) + (c - c);
  return (nothing == nothing) ? 1 : 0;
}

// Zero for a magnitude below `threshold`, the value itself otherwise: keeps decaying states out of the subnormal range.
static inline double dashpot_flush_below(double threshold, double value) {
  return ((value > threshold) || (value < -threshold)) ? value : 0.0;
}
static inline float dashpot_flush_belowf(float threshold, float value) {
  return ((value > threshold) || (value < -threshold)) ? value : 0.0f;
}

// `value` within ± `limit`, which is not negative: what a slip holds of the force that acts on it.
static inline double dashpot_clamp_to(double limit, double value) {
  const double below = (value < limit) ? value : limit;
  return (below > -limit) ? below : -limit;
}
static inline float dashpot_clamp_tof(float limit, float value) {
  const float below = (value < limit) ? value : limit;
  return (below > -limit) ? below : -limit;
}

// How far a tool at `position` has pushed in a surface that lies at `at`, unloaded; 0 before it.
static inline double dashpot_pushed_in(double at, double position) { return (position > at) ? (position - at) : 0.0; }
static inline float dashpot_pushed_inf(float at, float position) { return (position > at) ? (position - at) : 0.0f; }

#endif

// √x to the nearest number, and 0 for x ≤ 0. Infinity stays infinity. By one instruction where the processor has it, else
// by the same steps for every x.
static inline double friction_tunable_square_root(double x) {
# if defined(__GNUC__) && defined(__SSE2__) && !defined(__AVX__) && !defined(__FRAMAC__)
  if (!(x > 0)) return 0;
  __asm__("sqrtsd %0, %0" : "+x"(x));
  return x;
# elif defined(__GNUC__) && defined(__ARM_FP) && !defined(__aarch64__) && !defined(__FRAMAC__) && (__ARM_FP & 8)
  if (!(x > 0)) return 0;
  __asm__("vsqrt.f64 %P0, %P0" : "+w"(x));
  return x;
# else
  // Powers of two that take any number to between 1 and 4.
  static const double halves[] = {1.157920892373162e+77, 1.157920892373162e+77, 3.402823669209385e+38, 1.8446744073709552e+19, 4294967296.0, 65536.0, 256.0, 16.0, 4.0, 2.0};
  double scale = 1;
  if (!(x > 0)) return 0;
  if ((x - x) != 0) return x;
  for (int i = 0; i < (int)(sizeof halves / sizeof halves[0]); ++i) {
    const double half = halves[i];
    const int is_large = (x / half) >= half, is_small = !is_large && ((x * half) < (4 / half));
    if (is_large) x = x / half / half;
    if (is_small) x = x * half * half;
    scale = is_large ? scale * half : (is_small ? scale / half : scale);
  }
  // The chord through (1, 1) and (4, 2) is at most 6 % wrong; each of Newton's steps squares the relative error.
  double root = (x + 2) / 3;
  for (int step = 0; step < 4; ++step) root = (root + x / root) / 2;
  // Off by a last place at most. x − root² is exact, from products of half of the digits (Dekker 1971), and a multiple
  // of the last place squared, as root times the last place is; half way between two roots there is none.
  const double spread = 134217729.0 * root, high = spread - (spread - root), low = root - high, square = root * root;
  const double rest = (x - square) - ((((high * high) - square) + (2 * high * low)) + (low * low));
  const double nearest = root * 2.220446049250313e-16;
  if (rest > nearest) root = root + 2.220446049250313e-16;
  else if (rest <= -nearest) root = root - 2.220446049250313e-16;
  return scale * root;
# endif
}

// One step of slips that are coupled through a tree of linear blocks: exact, with a bound on the work, without
// iteration. In a sample each block answers its elongation δ with the force p = g δ + π, each slip holds |p| ≤ Y and
// gives way only at ±Y. Three passes over the parts of the tree:
//   curves    every part is a monotone polyline in (δ, p). In parallel forces add, in series elongations do;
//   signs     from the tool down, which slips give way, and to which side;
//   numbers   with these known every part is rigid, a constant force, or p = g δ + π. Corners alone would lose digits.
enum { friction_tunable_block, friction_tunable_slip, friction_tunable_series, friction_tunable_parallel };

// A part of the tree. Parts stand breadth first, the root at 0: children are neighbours and come after their parent.
typedef struct friction_tunable_node {
  int kind;
  int first_child;  // of a series or parallel
  int child_count;
  int slips;          // in this part
  int place;          // of a block or slip: where it stands in the inputs and outputs of a step
  int first_corner;   // where its curve begins
  double stiffness;   // g of a block; of the others dp/dδ at both ends of the curve, 0 where flat [N/m]
  double compliance;  // its inverse, 0 where flat [m/N]
  double yield;       // Y of a slip [N]
} friction_tunable_node;

// The curve of a part that gives way, p against δ: a polyline that never falls. Beside its kinks it knows its force at
// δ = 0.
typedef struct friction_tunable_corner {
  double elongation;  // δ [m]
  double force;       // p [N]
  int is_kink;        // else the point at δ = 0
} friction_tunable_corner;

// As it is read by elongation where parts stand in parallel, by force where they stand in series.
typedef struct friction_tunable_curve {
  const friction_tunable_corner *corners;
  int count;
  int by_force;
  double end_slope;  // of what is read, at both ends
  int is_open;       // flat ends, read by force: no value beyond them, any value at them
} friction_tunable_curve;

// All values of a curve at one place: more than one on a step.
typedef struct friction_tunable_range {
  double low, high;
  int open_low, open_high;  // reaches to infinity
  int exists;               // false beyond open ends
  int is_kink;
} friction_tunable_range;

enum { friction_tunable_rigid, friction_tunable_constant, friction_tunable_affine };

// What is known of a part in the course of a step.
typedef struct friction_tunable_part_state {
  int corners;     // of its curve
  int sign;        // of a slip: 0 stuck, ±1 the side to which it gives way
  int takes_rest;  // gets what is left over of its series' elongation
  int hold;
  double stiffness;   // g where affine [N/m]
  double compliance;  // 1/g [m/N]
  double force;       // π where affine, the force itself where constant [N]
  double elongation;  // δ [m]
} friction_tunable_part_state;

typedef struct friction_tunable_tree {
  const friction_tunable_node *nodes;
  int count;
  friction_tunable_part_state *parts;
  friction_tunable_corner *corners;
  friction_tunable_corner *merged;  // room for the sum of two curves, as large as the root's
} friction_tunable_tree;

// Corners that a part's curve needs: two a slip, and of each of the curves that are added up in it, and of a block, the
// point where that part rests. No more are ever written, whatever the numbers are.
static inline int friction_tunable_corner_room(const friction_tunable_node *node) { return 3 * node->slips + 1; }
static inline int friction_tunable_at_most(int count, int room) { return (count < room) ? count : room; }

static inline double friction_tunable_corner_at(const friction_tunable_corner *corner, int by_force) {
  return by_force ? corner->force : corner->elongation;
}
static inline double friction_tunable_corner_value(const friction_tunable_corner *corner, int by_force) {
  return by_force ? corner->elongation : corner->force;
}
static inline friction_tunable_corner friction_tunable_make_corner(int by_force, double at, double value, int is_kink) {
  friction_tunable_corner corner = {at, value, is_kink};
  if (by_force) {
    corner.elongation = value;
    corner.force = at;
  }
  return corner;
}

// From the nearer corner, never beyond either.
static inline double friction_tunable_between(const friction_tunable_corner *a, const friction_tunable_corner *b, int by_force, double at) {
  const double low = friction_tunable_corner_value(a, by_force), high = friction_tunable_corner_value(b, by_force);
  if (low == high) return low;
  const double before = at - friction_tunable_corner_at(a, by_force), after = friction_tunable_corner_at(b, by_force) - at;
  const double rise = (high - low) / (before + after);
  return (before < after) ? (low + before * rise) : (high - after * rise);
}

static inline double friction_tunable_beyond(const friction_tunable_curve *curve, const friction_tunable_corner *end, double at) {
  if (curve->end_slope == 0) return friction_tunable_corner_value(end, curve->by_force);
  return friction_tunable_corner_value(end, curve->by_force) + curve->end_slope * (at - friction_tunable_corner_at(end, curve->by_force));
}

// Where no corner is: between two, or beyond the ends.
static inline friction_tunable_range friction_tunable_beside(const friction_tunable_curve *curve, int next, double at) {
  const int is_end = (next == 0) || (next >= curve->count);
  const double value = is_end ? friction_tunable_beyond(curve, &curve->corners[(next == 0) ? 0 : (next - 1)], at)
                              : friction_tunable_between(&curve->corners[next - 1], &curve->corners[next], curve->by_force, at);
  const int is_open = is_end && curve->is_open;
  const friction_tunable_range range = {value, value, is_open && (next == 0), is_open && (next != 0), !is_open, 0};
  return range;
}

// Reads a curve at places that never fall; `next` is the corner that comes next.
static inline friction_tunable_range friction_tunable_read(const friction_tunable_curve *curve, int *next, double at) {
  const int first = *next;
  int is_kink = 0;
  while ((*next < curve->count) && (friction_tunable_corner_at(&curve->corners[*next], curve->by_force) == at)) {
    is_kink = curve->corners[*next].is_kink || is_kink;
    ++*next;
  }
  if (first == *next) return friction_tunable_beside(curve, *next, at);
  const friction_tunable_range range = {friction_tunable_corner_value(&curve->corners[first], curve->by_force),
                           friction_tunable_corner_value(&curve->corners[*next - 1], curve->by_force),
                           curve->is_open && (first == 0),
                           curve->is_open && (*next == curve->count),
                           1,
                           is_kink};
  return range;
}

static inline friction_tunable_range friction_tunable_curve_at(const friction_tunable_curve *curve, double at) {
  int next = 0;
  while ((next < curve->count) && (friction_tunable_corner_at(&curve->corners[next], curve->by_force) < at)) ++next;
  return friction_tunable_read(curve, &next, at);
}

// Behind `count` corners in `to`. Rounding must not bend a curve back.
static inline int friction_tunable_append_corner(friction_tunable_corner *to, int count, int room, int by_force, double at, double value,
                                    int is_kink) {
  if (count >= room) return room;
  const int falls = (count > 0) && (value < friction_tunable_corner_value(&to[count - 1], by_force));
  to[count] = friction_tunable_make_corner(by_force, at, falls ? friction_tunable_corner_value(&to[count - 1], by_force) : value, is_kink);
  return count + 1;
}

// The sum of two curves; `to` has `room` for it. Returns how many corners there are.
static inline int friction_tunable_merge_curves(const friction_tunable_curve *a, const friction_tunable_curve *b, friction_tunable_corner *to, int room) {
  const int most = friction_tunable_at_most(a->count + b->count, room), by_force = a->by_force;
  int count = 0, next_a = 0, next_b = 0;
  for (int i = 0; (i < most) && ((next_a < a->count) || (next_b < b->count)); ++i) {
    const int takes_b =
        (next_a == a->count) || ((next_b < b->count) && (friction_tunable_corner_at(&b->corners[next_b], by_force) <
                                                         friction_tunable_corner_at(&a->corners[next_a], by_force)));
    const double at = takes_b ? friction_tunable_corner_at(&b->corners[next_b], by_force)
                              : friction_tunable_corner_at(&a->corners[next_a], by_force);
    const friction_tunable_range in_a = friction_tunable_read(a, &next_a, at), in_b = friction_tunable_read(b, &next_b, at);
    if (!in_a.exists || !in_b.exists) continue;
    const int is_kink = in_a.is_kink || in_b.is_kink;
    count = friction_tunable_append_corner(to, count, most, by_force, at, in_a.low + in_b.low, is_kink);
    if ((in_a.low < in_a.high) || (in_b.low < in_b.high))
      count = friction_tunable_append_corner(to, count, most, by_force, at, in_a.high + in_b.high, is_kink);
  }
  return count;
}

// Puts a point of the curve where it belongs, `count` being how many corners there are. Returns how many there then are.
static inline int friction_tunable_insert_corner(friction_tunable_corner *corners, int count, int room, int by_force, friction_tunable_corner corner) {
  int place = count;
  if (count >= room) return room;
  for (; (place > 0) && (friction_tunable_corner_at(&corners[place - 1], by_force) > friction_tunable_corner_at(&corner, by_force)); --place)
    corners[place] = corners[place - 1];
  corners[place] = corner;
  return count + 1;
}

// Leaves the kinks and the point at δ = 0; on a flat end nothing is gained by it. Returns how many there are.
static inline int friction_tunable_mark_rest(const friction_tunable_curve *curve, friction_tunable_corner *corners, int room) {
  const friction_tunable_range rest = friction_tunable_curve_at(curve, 0);
  int count = 0;
  for (int i = 0; i < curve->count; ++i)
    if (corners[i].is_kink && (count < room)) corners[count++] = corners[i];
  if (count == 0) return 0;
  const int is_flat =
      (curve->end_slope == 0) && ((corners[0].elongation > 0) || (corners[count - 1].elongation < 0));
  if (rest.is_kink || is_flat) return count;
  return friction_tunable_insert_corner(corners, count, room, 0, friction_tunable_make_corner(0, 0, rest.low, 0));
}

static inline friction_tunable_curve friction_tunable_curve_of(const friction_tunable_tree *tree, int k, int by_force) {
  const friction_tunable_node *node = &tree->nodes[k];
  const friction_tunable_curve curve = {tree->corners + node->first_corner, tree->parts[k].corners, by_force,
                           by_force ? node->compliance : node->stiffness, by_force && (node->stiffness == 0)};
  return curve;
}

// p of a block where it is read by elongation, δ where by force.
static inline double friction_tunable_block_value(const friction_tunable_node *block, int by_force, double held, double at) {
  return by_force ? ((at - held) * block->compliance) : (block->stiffness * at + held);
}

static inline friction_tunable_range friction_tunable_curve_by_force_at(const friction_tunable_tree *tree, int k, double force) {
  const friction_tunable_curve curve = friction_tunable_curve_of(tree, k, 1);
  return friction_tunable_curve_at(&curve, force);
}

static inline void friction_tunable_draw_slip(const friction_tunable_tree *tree, int k) {
  const friction_tunable_node *node = &tree->nodes[k];
  tree->corners[node->first_corner] = friction_tunable_make_corner(0, 0, -node->yield, 1);
  tree->corners[node->first_corner + 1] = friction_tunable_make_corner(0, 0, node->yield, 1);
  tree->parts[k].corners = 2;
}

// The sum of two curves, `to` being where the first one lies and the sum shall.
static inline friction_tunable_curve friction_tunable_with(const friction_tunable_tree *tree, friction_tunable_curve sum, const friction_tunable_curve *other, friction_tunable_corner *to, int room) {
  const friction_tunable_corner *from = (sum.count == 0) ? other->corners : tree->merged;
  const int count =
      (sum.count == 0) ? friction_tunable_at_most(other->count, room) : friction_tunable_merge_curves(&sum, other, tree->merged, room);
  for (int i = 0; i < count; ++i) to[i] = from[i];
  const friction_tunable_curve both = {to, count, sum.by_force, sum.end_slope + other->end_slope, sum.is_open || other->is_open};
  return both;
}

// In series the point where the block rests is one of the curve too.
static inline friction_tunable_curve friction_tunable_with_block(friction_tunable_curve sum, const friction_tunable_node *block, double held, friction_tunable_corner *corners, int room) {
  if (sum.by_force) {
    const friction_tunable_range rest = friction_tunable_curve_at(&sum, held);
    if (rest.exists && !rest.is_kink)
      sum.count = friction_tunable_insert_corner(corners, sum.count, room, 1, friction_tunable_make_corner(1, held, rest.low, 0));
  }
  for (int i = 0; i < sum.count; ++i) {
    const double at = friction_tunable_corner_at(&corners[i], sum.by_force);
    const double value = friction_tunable_corner_value(&corners[i], sum.by_force) + friction_tunable_block_value(block, sum.by_force, held, at);
    corners[i] = friction_tunable_make_corner(sum.by_force, at, value, corners[i].is_kink);
  }
  sum.end_slope = sum.end_slope + (sum.by_force ? block->compliance : block->stiffness);
  return sum;
}

static inline void friction_tunable_draw(const friction_tunable_tree *tree, int k, const double *held) {
  const friction_tunable_node *node = &tree->nodes[k];
  const int room = friction_tunable_corner_room(node);
  friction_tunable_corner *corners = tree->corners + node->first_corner;
  friction_tunable_curve sum = {corners, 0, node->kind == friction_tunable_series, 0, 0};
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i)
    if (tree->nodes[i].kind != friction_tunable_block) {
      const friction_tunable_curve other = friction_tunable_curve_of(tree, i, sum.by_force);
      sum = friction_tunable_with(tree, sum, &other, corners, room);
    }
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i)
    if (tree->nodes[i].kind == friction_tunable_block)
      sum = friction_tunable_with_block(sum, &tree->nodes[i], held[tree->nodes[i].place], corners, room);
  tree->parts[k].corners = sum.count;
  if (node->kind == friction_tunable_series) {
    const friction_tunable_curve curve = friction_tunable_curve_of(tree, k, 0);
    tree->parts[k].corners = friction_tunable_mark_rest(&curve, corners, room);
  }
}

static inline void friction_tunable_draw_curves(const friction_tunable_tree *tree, const double *held) {
  for (int k = tree->count - 1; k >= 0; --k) {
    if (tree->nodes[k].kind == friction_tunable_slip) friction_tunable_draw_slip(tree, k);
    if (tree->nodes[k].kind >= friction_tunable_series) friction_tunable_draw(tree, k, held);
  }
}

static inline void friction_tunable_find_signs_in_parallel(const friction_tunable_tree *tree, int k) {
  const friction_tunable_node *node = &tree->nodes[k];
  const double elongation = tree->parts[k].elongation;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    tree->parts[i].elongation = elongation;
    tree->parts[i].takes_rest = 0;
    tree->parts[i].sign = (elongation > 0) ? 1 : ((elongation < 0) ? -1 : 0);
  }
}

// What is left over goes to those that may give way at this force, in turn; all but the last as far as they can.
static inline void friction_tunable_place_rest(const friction_tunable_tree *tree, int k, double rest, double force) {
  const friction_tunable_node *node = &tree->nodes[k];
  int is_placed = 0;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    friction_tunable_part_state *part = &tree->parts[i];
    if (!part->takes_rest) continue;
    part->takes_rest = 0;
    if (is_placed) continue;
    const friction_tunable_range range = friction_tunable_curve_by_force_at(tree, i, force);
    const double room = range.high - range.low;
    is_placed = range.open_low || range.open_high || (rest < room);
    part->takes_rest = is_placed;
    const int is_backwards = range.open_low ? (rest > 0) : (rest < 0);
    if (is_placed && !is_backwards) part->elongation += rest;
    if (is_placed) continue;
    part->elongation = range.high;
    rest -= room;
  }
}

static inline friction_tunable_range friction_tunable_elongations(const friction_tunable_tree *tree, int i, double force, const double *held) {
  if (tree->nodes[i].kind != friction_tunable_block) return friction_tunable_curve_by_force_at(tree, i, force);
  const double elongation = friction_tunable_block_value(&tree->nodes[i], 1, held[tree->nodes[i].place], force);
  const friction_tunable_range range = {elongation, elongation, 0, 0, 1, 0};
  return range;
}

static inline void friction_tunable_find_signs_in_series(const friction_tunable_tree *tree, int k, const double *held) {
  const friction_tunable_node *node = &tree->nodes[k];
  const friction_tunable_curve curve = friction_tunable_curve_of(tree, k, 0);
  const friction_tunable_range forces = friction_tunable_curve_at(&curve, tree->parts[k].elongation);
  const double force = (forces.low < forces.high) ? (forces.low + (forces.high - forces.low) / 2) : forces.low;
  double rest = tree->parts[k].elongation;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    const friction_tunable_range range = friction_tunable_elongations(tree, i, force, held);
    friction_tunable_part_state *part = &tree->parts[i];
    part->elongation = range.open_low ? range.high : range.low;
    part->takes_rest = (range.low < range.high) || range.open_low || range.open_high;
    part->sign = (force >= tree->nodes[i].yield) ? 1 : ((force <= -tree->nodes[i].yield) ? -1 : 0);
    rest -= part->elongation;
  }
  friction_tunable_place_rest(tree, k, rest, force);
}

static inline void friction_tunable_find_signs(const friction_tunable_tree *tree, double change, const double *held, int *sign) {
  tree->parts[0].elongation = change;
  for (int k = 0; k < tree->count; ++k) {
    if (tree->nodes[k].kind == friction_tunable_parallel) friction_tunable_find_signs_in_parallel(tree, k);
    if (tree->nodes[k].kind == friction_tunable_series) friction_tunable_find_signs_in_series(tree, k, held);
    if (tree->nodes[k].kind == friction_tunable_slip) sign[tree->nodes[k].place] = tree->parts[k].sign;
  }
}

static inline void friction_tunable_become(friction_tunable_part_state *part, int hold, double stiffness, double compliance, double force) {
  part->hold = hold;
  part->stiffness = stiffness;
  part->compliance = compliance;
  part->force = force;
}

// Any rigid → rigid; else g = Σ g_i, π = Σ π_i; all constant → constant.
static inline void friction_tunable_add_up_parallel(const friction_tunable_tree *tree, int k) {
  const friction_tunable_node *node = &tree->nodes[k];
  int rigid = 0, affine = 0;
  double stiffness = 0, force = 0;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    const friction_tunable_part_state *part = &tree->parts[i];
    if (part->hold == friction_tunable_rigid) ++rigid;
    if (part->hold == friction_tunable_affine) {
      ++affine;
      stiffness += part->stiffness;
    }
    force += part->force;
  }
  if (rigid != 0) friction_tunable_become(&tree->parts[k], friction_tunable_rigid, 0, 0, 0);
  else if (affine == 0) friction_tunable_become(&tree->parts[k], friction_tunable_constant, 0, 0, force);
  else friction_tunable_become(&tree->parts[k], friction_tunable_affine, stiffness, 1 / stiffness, force);
}

// The child that holds a constant force, by choice the one that takes the rest; 0 for none.
static inline int friction_tunable_constant_child(const friction_tunable_tree *tree, int k) {
  const friction_tunable_node *node = &tree->nodes[k];
  int found = 0;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i)
    if ((tree->parts[i].hold == friction_tunable_constant) && ((found == 0) || tree->parts[i].takes_rest)) found = i;
  return found;
}

// A constant force wins; rigid parts drop out; 1/g = Σ 1/g_i, π = g Σ π_i/g_i; all rigid → rigid.
static inline void friction_tunable_add_up_series(const friction_tunable_tree *tree, int k) {
  const friction_tunable_node *node = &tree->nodes[k];
  friction_tunable_part_state *whole = &tree->parts[k];
  const int constant = friction_tunable_constant_child(tree, k);
  int affine = 0, last = 0;
  double compliance = 0, weighted = 0;
  if (constant != 0) {
    friction_tunable_become(whole, friction_tunable_constant, 0, 0, tree->parts[constant].force);
    return;
  }
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    const friction_tunable_part_state *part = &tree->parts[i];
    if (part->hold != friction_tunable_affine) continue;
    ++affine;
    last = i;
    compliance += part->compliance;
    weighted += part->force * part->compliance;
  }
  if (affine == 0) {
    friction_tunable_become(whole, friction_tunable_rigid, 0, 0, 0);
  } else if (affine == 1) {
    const friction_tunable_part_state *part = &tree->parts[last];
    friction_tunable_become(whole, friction_tunable_affine, part->stiffness, part->compliance, part->force);
  } else {
    const double stiffness = 1 / compliance;
    friction_tunable_become(whole, friction_tunable_affine, stiffness, compliance, weighted * stiffness);
  }
}

static inline void friction_tunable_add_up(const friction_tunable_tree *tree, const double *held) {
  for (int k = tree->count - 1; k >= 0; --k) {
    const friction_tunable_node *node = &tree->nodes[k];
    friction_tunable_part_state *part = &tree->parts[k];
    if (node->kind == friction_tunable_block)
      friction_tunable_become(part, friction_tunable_affine, node->stiffness, node->compliance, held[node->place]);
    else if (node->kind == friction_tunable_slip)
      friction_tunable_become(part, (part->sign == 0) ? friction_tunable_rigid : friction_tunable_constant, 0, 0, (double)part->sign * node->yield);
    else if (node->kind == friction_tunable_parallel) friction_tunable_add_up_parallel(tree, k);
    else friction_tunable_add_up_series(tree, k);
  }
}

static inline int friction_tunable_is_only_affine(const friction_tunable_tree *tree, int k) {
  const friction_tunable_node *node = &tree->nodes[k];
  int affine = 0;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i)
    if (tree->parts[i].hold == friction_tunable_affine) ++affine;
  return affine == 1;
}

// δ_i = (p − π_i)/g_i where affine, 0 where rigid; the rest where constant.
static inline void friction_tunable_share_in_series(const friction_tunable_tree *tree, int k) {
  const friction_tunable_node *node = &tree->nodes[k];
  const friction_tunable_part_state *whole = &tree->parts[k];
  const int taker = friction_tunable_constant_child(tree, k);
  const int is_undivided = (taker == 0) && friction_tunable_is_only_affine(tree, k);
  const double force =
      (whole->hold == friction_tunable_affine) ? (whole->stiffness * whole->elongation + whole->force) : whole->force;
  double rest = whole->elongation;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    friction_tunable_part_state *part = &tree->parts[i];
    if (i == taker) continue;
    if (part->hold == friction_tunable_rigid) part->elongation = 0;
    if (part->hold == friction_tunable_affine)
      part->elongation = is_undivided ? whole->elongation : ((force - part->force) * part->compliance);
    rest -= part->elongation;
  }
  if (taker != 0) tree->parts[taker].elongation = rest;
}

static inline void friction_tunable_share(const friction_tunable_tree *tree, double change, double *elongation) {
  tree->parts[0].elongation = change;
  for (int k = 0; k < tree->count; ++k) {
    const friction_tunable_node *node = &tree->nodes[k];
    if (node->kind == friction_tunable_parallel)
      for (int i = node->first_child; i < (node->first_child + node->child_count); ++i)
        tree->parts[i].elongation = tree->parts[k].elongation;
    if (node->kind == friction_tunable_series) friction_tunable_share_in_series(tree, k);
    if (node->kind == friction_tunable_block) elongation[node->place] = tree->parts[k].elongation;
  }
}

static inline double friction_tunable_force_at(const friction_tunable_tree *tree, double change) {
  const friction_tunable_part_state *root = &tree->parts[0];
  return (root->hold == friction_tunable_affine) ? (root->stiffness * change + root->force) : root->force;
}

// In: the root's elongation in this sample [m], π of every block [N]. Out: the force that opposes it [N], δ of every
// block [m], and for every slip 0 where it holds, ±1 where it gives way to that side.
static inline double friction_tunable_tree_step(const friction_tunable_tree *tree, double change, const double *held, double *elongation,
                                   int *sign) {
  friction_tunable_draw_curves(tree, held);
  friction_tunable_find_signs(tree, change, held, sign);
  friction_tunable_add_up(tree, held);
  friction_tunable_share(tree, change, elongation);
  return friction_tunable_force_at(tree, change);
}

// The feedthrough damping b∞ of coupled slips for one pattern of those that give way: of a slip that holds rigid, of
// one that slides none. In parallel any rigid part makes all rigid, else dampings add up; in series one that slides
// makes all slide, rigid parts drop out, and the rest is 1/Σ 1/b.
static inline void friction_tunable_find_regime_in_parallel(const friction_tunable_tree *tree, int k) {
  const friction_tunable_node *node = &tree->nodes[k];
  friction_tunable_part_state *whole = &tree->parts[k];
  int is_rigid = 0, is_affine = 0;
  double sum = 0;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    is_rigid = is_rigid || (tree->parts[i].hold == friction_tunable_rigid);
    if (tree->parts[i].hold != friction_tunable_affine) continue;
    is_affine = 1;
    sum += tree->parts[i].stiffness;
  }
  whole->hold = is_rigid ? friction_tunable_rigid : (is_affine ? friction_tunable_affine : friction_tunable_constant);
  whole->stiffness = is_rigid ? 0 : sum;
}

static inline void friction_tunable_find_regime_in_series(const friction_tunable_tree *tree, int k) {
  const friction_tunable_node *node = &tree->nodes[k];
  friction_tunable_part_state *whole = &tree->parts[k];
  int slides = 0, is_affine = 0, is_free = 0;
  double inverse = 0;
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    const friction_tunable_part_state *part = &tree->parts[i];
    slides = slides || (part->hold == friction_tunable_constant);
    if (part->hold != friction_tunable_affine) continue;
    is_affine = 1;
    is_free = is_free || !(part->stiffness > 0);
    if (part->stiffness > 0) inverse += 1 / part->stiffness;
  }
  whole->hold = slides ? friction_tunable_constant : (is_affine ? friction_tunable_affine : friction_tunable_rigid);
  whole->stiffness = (slides || !is_affine || is_free) ? 0 : (1 / inverse);
}

// In: b∞ of every block by its place [N·s/m], for every slip 0 where it holds. What is in the tree's parts is lost.
static inline double friction_tunable_regime_feedthrough(const friction_tunable_tree *tree, const double *feedthrough, const int *sign) {
  for (int k = tree->count - 1; k >= 0; --k) {
    const friction_tunable_node *node = &tree->nodes[k];
    friction_tunable_part_state *part = &tree->parts[k];
    if (node->kind == friction_tunable_parallel) friction_tunable_find_regime_in_parallel(tree, k);
    if (node->kind == friction_tunable_series) friction_tunable_find_regime_in_series(tree, k);
    if (node->kind == friction_tunable_slip) part->hold = (sign[node->place] == 0) ? friction_tunable_rigid : friction_tunable_constant;
    if (node->kind == friction_tunable_block) part->hold = friction_tunable_affine;
    if (node->child_count == 0) part->stiffness = (node->kind == friction_tunable_block) ? feedthrough[node->place] : 0;
  }
  return (tree->parts[0].hold == friction_tunable_affine) ? tree->parts[0].stiffness : 0;
}

enum {
  friction_tunable_spring_count = 1,
  friction_tunable_springs = 1,
  friction_tunable_part_count = 2,
  friction_tunable_block_count = 2,
  friction_tunable_blocks_room = 2,
  friction_tunable_mesh_nodes = 1,
  friction_tunable_slips = 1,
  friction_tunable_coupling_count = 1,
  friction_tunable_tree_nodes_room = 3,
  friction_tunable_corners = 8,
  friction_tunable_merged = 4,
  friction_tunable_graph_count = 0,
  friction_tunable_ends_room = 1,
  friction_tunable_static_spring = -1
};

typedef struct friction_tunable_range_of_parameter {
  double value;  // to begin with
  double min;
  double max;
} friction_tunable_range_of_parameter;

// What a part of a block is. Parts stand in parallel.
enum {
  friction_tunable_spring,      // p = k (z − r)
  friction_tunable_damper,      // p = B ż
  friction_tunable_relaxation,  // a spring and a damper in series
  friction_tunable_mesh         // springs and dampers between inner nodes
};

enum { friction_tunable_none = -1, friction_tunable_mesh_port = -1, friction_tunable_mesh_held = -2 };  // the ends of a mesh, in the place of a node

typedef struct friction_tunable_part {
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
} friction_tunable_part;

typedef struct friction_tunable_block_parts {
  int first_part;
  int part_count;
  double least_stiffness;  // behind a slip no softer [N/m]
} friction_tunable_block_parts;

// One spring across a change of its stiffness.
typedef struct friction_tunable_spring_change {
  double stiffness;      // before [N/m]
  double new_stiffness;  // after
  double force;          // before [N]
  double new_force;      // after
} friction_tunable_spring_change;

// Yield force of a slip: the least of numbers[cuts[first]] …, one number for each way to cut it through.
typedef struct friction_tunable_yield {
  int first_cut;
  int cut_count;
  double least;  // no less, whatever the numbers are [N]
} friction_tunable_yield;

// Slips that are stepped together: nodes of the tree, blocks in the order of their places, slips likewise.
typedef struct friction_tunable_coupling {
  int first_node;
  int node_count;
  int first_block;
  int first_slip;
  int first_corner;
} friction_tunable_coupling;

// Of slips and the brake.
typedef struct friction_tunable_slip_brake {
  double now;      // b∞/h behind slips in this sample, as far as the brake makes it [N/m]
  double damping;  // b of it, on its way there with the coil [N·s/m]
  double wanted;   // and where it is going [N·s/m]
} friction_tunable_slip_brake;

static const double friction_tunable_rate = 1000.0;  // 1/h [Hz]
static const double friction_tunable_retention = 0.9900498337491681;  // what an offset keeps in a sample where the tank pays [1]
static const double friction_tunable_threshold = 6.223015277861142e-61;  // magnitudes of states below are zero
static const double friction_tunable_surface_at = 0.0;  // where the surface lies unloaded [m]
static const double friction_tunable_encoder_step = 0.0;  // how far the gap may open before the command lets go [m]
static const double friction_tunable_hysteresis = 0.0;  // before a slide has ended for the command [m]
static const double friction_tunable_coil_share = 1.0;  // of what is missing from √b, in a sample [1]
static const double friction_tunable_motor_limit = 0.0;  // of its force; 0: none [N]
static const double friction_tunable_motor_step = 0.0;  // of its change in a period; 0: none [N]
static const friction_tunable_range_of_parameter friction_tunable_ranges[3] = {
    {1.5, 0.0, 5.0},  // yield [N]
    {2000.0, 200.0, 5000.0},  // presliding [N/m]
    {12.0, 0.0, 40.0},  // drag [N s/m]
};
static const int friction_tunable_spring_numbers[1] = {1};
static const friction_tunable_part friction_tunable_parts[2] = {
    {friction_tunable_damper, -1, 0, -1, -1, 0, 0, 0, 0, 0},
    {friction_tunable_spring, 0, -1, -1, -1, 0, 0, 0, 0, 1},
};
static const friction_tunable_block_parts friction_tunable_block_table[2] = {
    {0, 1, 0.0},
    {1, 1, 0.0002980232238769531},
};
static const int friction_tunable_cuts[1] = {2};
static const friction_tunable_yield friction_tunable_yields[1] = {
    {0, 1, 2.980232238769531e-07},
};
static const friction_tunable_coupling friction_tunable_couplings[1] = {
    {0, 3, 1, 0, 0},
};
static const friction_tunable_node friction_tunable_tree_nodes[3] = {
    {friction_tunable_series, 1, 2, 1, 0, 0, 0, 0, 0},
    {friction_tunable_block, 0, 0, 0, 0, 0, 0, 0, 0},
    {friction_tunable_slip, 0, 0, 1, 0, 4, 0, 0, 0},
};

// What a change of parameters works on: the springs, what stands between them, and the slips.
typedef struct friction_tunable_tunables {
  double elongation[friction_tunable_springs];     // z [m]
  double offset[friction_tunable_springs];         // r, how far the rest length is from home [m]
  double tank;                        // energy that changes have set free [J]
  int is_owing;                       // some offset is not home
  int is_shed;                        // and what was shed is the reason
  double stiffness[friction_tunable_springs];      // what follows from the values: k [N/m]
  double share[friction_tunable_springs];          // φ of a relaxation [1]
  double loss[friction_tunable_springs];           // α of a relaxation [1]
  double block_stiffness[friction_tunable_blocks_room];    // g of every block [N/m]
  double block_held[friction_tunable_blocks_room];         // π [N]
  double block_elongation[friction_tunable_blocks_room];   // δ in this sample [m]
  double block_feedthrough[friction_tunable_blocks_room];  // b∞; 0 of block 0, whose is the law's own [N·s/m]
  int sign[friction_tunable_slips + 1], last_sign[friction_tunable_slips + 1];
  friction_tunable_node nodes[friction_tunable_tree_nodes_room];
  friction_tunable_part_state part_states[friction_tunable_tree_nodes_room];
  friction_tunable_corner corners[friction_tunable_corners], merged[friction_tunable_merged];
  int commanded[friction_tunable_slips];
  int slid[friction_tunable_slips], slides_now[friction_tunable_slips];
  double slid_at[friction_tunable_slips], slid_at_now[friction_tunable_slips];  // where the tool was when a slip last slid [m]
  double root, root_now;                              // √b
} friction_tunable_tunables;

// What may change while the law runs, to begin with as in the network's file.
typedef struct friction_tunable_parameters {
  double yield;  // 0 to 5 [N]
  double presliding;  // 200 to 5000 [N/m]
  double drag;  // 0 to 40 [N s/m]
} friction_tunable_parameters;

typedef struct friction_tunable {
  double held_force;  // π, what springs hold [N]
  double yield;  // parameter [N]
  double presliding;  // parameter [N/m]
  double drag;  // parameter [N s/m]
  double step_stiffness;  // what springs answer in a sample [N/m]
  double steady_brake;  // b of what no slip changes [N·s/m]
  double velocity_gain;  // b∞ − b [N·s/m]
  double brake_left;  // what the brake has left for slips [N·s/m]
  double last_position;  // u of the sample before [m]
  double last_brake;  // b of the sample before [N·s/m]
  double sampled_position;  // port displacement u, at this sample [m]
  double sampled_position_change;  // Δu since the sample before, at this sample [m]
  double resting_brake;  // b of what is behind slips that hold [N·s/m]
  friction_tunable_tunables law;  // springs, slips and tank
  int sampled;  // 1 while a finite sample waits for friction_tunable_update()
} friction_tunable;

// What a servo loop compares with the device that it drives. An empty digest: no device was named, any will do.
static inline double friction_tunable_sample_period(void) { return 0.001; }  // [s]
static inline int friction_tunable_is_rotation(void) { return 0; }
static inline const char *friction_tunable_device(void) { return "ideal"; }
static inline const char *friction_tunable_device_digest(void) { return ""; }
static inline const char *friction_tunable_estimator(void) { return "exact"; }
static inline unsigned friction_tunable_loop_delay(void) { return 0u; }  // [samples]
static inline int friction_tunable_is_certified(void) { return 0; }  // on that device, or on an ideal one

// The part of the brake's command that is there for passivity alone: what is felt is the network and this damping.
static inline double friction_tunable_added_damping(void) { return 0.0; }

static inline int friction_tunable_parameter_count(void) { return 3; }
static inline const char * friction_tunable_parameter_name(int i) {
  if (i == 0) return "yield";
  if (i == 1) return "presliding";
  if (i == 2) return "drag";
  return "";
}
static inline const char * friction_tunable_parameter_unit(int i) {
  if (i == 0) return "N";
  if (i == 1) return "N/m";
  if (i == 2) return "N s/m";
  return "";
}
static inline double friction_tunable_parameter_value(int i) {
  if (i == 0) return 1.5;
  if (i == 1) return 2000.0;
  if (i == 2) return 12.0;
  return 0;
}
static inline double friction_tunable_parameter_min(int i) {
  if (i == 0) return 0.0;
  if (i == 1) return 200.0;
  if (i == 2) return 0.0;
  return 0;
}
static inline double friction_tunable_parameter_max(int i) {
  if (i == 0) return 5.0;
  if (i == 1) return 5000.0;
  if (i == 2) return 40.0;
  return 0;
}

// A spring's force is k (z − r). A change of stiffness leaves the forces alone and moves the offsets r, as far as energy
// allows; with every sample the offsets then go home by a part of the way, where the tank pays for it.
static inline double friction_tunable_spring_force(const friction_tunable_tunables *self, int spring) {
  return self->stiffness[spring] * (self->elongation[spring] - self->offset[spring]);
}

static inline void friction_tunable_stretch_spring(friction_tunable_tunables *self, int spring, double change) {
  self->elongation[spring] = dashpot_flush_below(friction_tunable_threshold, self->elongation[spring] + change);
}

// F²/2k; nothing where there is no spring.
static inline double friction_tunable_spring_energy(double force, double stiffness) {
  return (stiffness > 0) ? (force * (force / stiffness) / 2) : 0;
}

// A stiffer spring keeps its force, and the tank takes what that sets free. A softer one keeps what its own energy can
// hold, F √(k′/k), and then more, up to F, as far as the tank pays; the springs in turn. So V + T, V = Σ F²/2k, is the
// same before and after. Returns what is left in the tank [J].
static inline double friction_tunable_carry_over(friction_tunable_spring_change *springs, double tank) {
  for (int i = 0; i < friction_tunable_spring_count; ++i) {
    friction_tunable_spring_change *s = &springs[i];
    if (s->new_stiffness >= s->stiffness) s->new_force = s->force;
    else if (s->new_stiffness > 0) s->new_force = s->force * friction_tunable_square_root(s->new_stiffness / s->stiffness);
    else s->new_force = 0;
    // Only a stiffer spring sets energy free: for the others the two energies are equal but for rounding.
    if (s->new_stiffness > s->stiffness)
      tank += friction_tunable_spring_energy(s->force, s->stiffness) - friction_tunable_spring_energy(s->force, s->new_stiffness);
    if (s->new_stiffness <= 0) tank += friction_tunable_spring_energy(s->force, s->stiffness);
  }
  for (int i = 0; i < friction_tunable_spring_count; ++i) {
    friction_tunable_spring_change *s = &springs[i];
    if ((s->new_stiffness > 0) && (s->new_force != s->force)) {
      const double held = friction_tunable_spring_energy(s->new_force, s->new_stiffness);
      const double cost = friction_tunable_spring_energy(s->force, s->new_stiffness) - held;
      const int is_paid = cost <= tank;
      const double most = friction_tunable_square_root(2 * s->new_stiffness * (held + tank));
      s->new_force = is_paid ? s->force : ((s->force > 0) ? most : -most);
      tank = is_paid ? (tank - cost) : 0;
    }
  }
  return tank;
}

static inline int friction_tunable_is_changed(const friction_tunable_spring_change *change) {
  return (change->new_stiffness != change->stiffness) || (change->new_force != change->force);
}

// What is next to a spring makes room for another elongation.
static inline void friction_tunable_move_end(friction_tunable_tunables *self, int spring, const friction_tunable_spring_change *change) {
  if (!friction_tunable_is_changed(change)) return;
  self->elongation[spring] = (change->new_stiffness > 0) ? (change->new_force / change->new_stiffness) : 0;
}

// r = z − F/k; what is no more than rounding of z is none.
static inline void friction_tunable_move_offset(friction_tunable_tunables *self, int spring, const friction_tunable_spring_change *change) {
  if (!friction_tunable_is_changed(change)) return;
  const double z = self->elongation[spring];
  const double offset = (change->new_stiffness > 0) ? (z - change->new_force / change->new_stiffness) : 0;
  self->offset[spring] = ((z + offset / 4) == z) ? 0 : offset;
  self->is_owing = self->is_owing || (self->offset[spring] != 0);
}

// Once a sample.
static inline void friction_tunable_bring_offsets_home(friction_tunable_tunables *self) {
  if (!self->is_owing) return;
  self->is_owing = 0;
  for (int i = 0; i < friction_tunable_spring_count; ++i) {
    const double before = self->offset[i], after = dashpot_flush_below(friction_tunable_threshold, friction_tunable_retention * before);
    if (before == 0) continue;
    const double z = self->elongation[i];
    const double cost = self->stiffness[i] * (before - after) * ((z - after) + (z - before)) * 0.5;
    if (cost <= self->tank) {
      self->tank -= cost;
      self->offset[i] = after;
    }
    self->is_owing = self->is_owing || (self->offset[i] != 0);
  }
  self->is_shed = self->is_shed && self->is_owing;
}

// b∞ [N·s/m]
static inline double friction_tunable_part_feedthrough(friction_tunable_tunables *self, const friction_tunable_part *part, const double *numbers) {
  if (part->kind == friction_tunable_damper) return numbers[part->damping];
  (void)self;
  return 0;
}

// g = dp/dδ over a sample [N/m]. Leaves a mesh as the steps need it.
static inline double friction_tunable_part_stiffness(friction_tunable_tunables *self, const friction_tunable_part *part, const double *numbers) {
  if (part->kind == friction_tunable_spring) return self->stiffness[part->spring];
  if (part->kind == friction_tunable_damper) return numbers[part->damping] * friction_tunable_rate;
  return self->stiffness[part->spring] * self->share[part->spring];
}

// π, and what a mesh needs to be spread.
static inline double friction_tunable_held_by_part(friction_tunable_tunables *self, const friction_tunable_part *part) {
  if (part->kind == friction_tunable_damper) return 0;
  if (part->kind == friction_tunable_spring) return friction_tunable_spring_force(self, part->spring);
  return friction_tunable_spring_force(self, part->spring) -
         self->stiffness[part->spring] * (self->loss[part->spring] * self->elongation[part->spring]);
}

static inline void friction_tunable_advance(friction_tunable_tunables *self, const friction_tunable_part *part, double change) {
  if (part->kind == friction_tunable_damper) return;
  if (part->kind == friction_tunable_spring) friction_tunable_stretch_spring(self, part->spring, change);
  else
    friction_tunable_stretch_spring(self, part->spring,
                       self->share[part->spring] * change - self->loss[part->spring] * self->elongation[part->spring]);
}

// In a relaxation the damper makes room, of a loose spring the slip; of other springs the offset does.
static inline void friction_tunable_take_forces(friction_tunable_tunables *self, const friction_tunable_part *part, const friction_tunable_spring_change *changes) {
  if ((part->kind == friction_tunable_spring) && !part->is_loose) friction_tunable_move_offset(self, part->spring, &changes[part->spring]);
  else if (part->spring != friction_tunable_none) friction_tunable_move_end(self, part->spring, &changes[part->spring]);
}

static inline double friction_tunable_yield_force(const friction_tunable_yield *yield, const double *numbers) {
  double weakest = numbers[friction_tunable_cuts[yield->first_cut]];
  for (int i = yield->first_cut + 1; i < (yield->first_cut + yield->cut_count); ++i)
    weakest = (numbers[friction_tunable_cuts[i]] < weakest) ? numbers[friction_tunable_cuts[i]] : weakest;
  return (weakest > yield->least) ? weakest : yield->least;
}

// Curves of slips through parts that give way without end would lose their digits.
static inline double friction_tunable_bounded_stiffness(const friction_tunable_tunables *self, int block) {
  const double least = friction_tunable_block_table[block].least_stiffness;
  return (self->block_stiffness[block] > least) ? self->block_stiffness[block] : least;
}

static inline friction_tunable_tree friction_tunable_tree_of(friction_tunable_tunables *self, const friction_tunable_coupling *c) {
  const friction_tunable_tree tree = {self->nodes + c->first_node, c->node_count, self->part_states + c->first_node,
                         self->corners + c->first_corner, self->merged};
  return tree;
}

// dp/dδ with every slip giving way: in parallel the sum, in series the inverse of Σ 1/g.
static inline double friction_tunable_end_stiffness(const friction_tunable_tunables *self, const friction_tunable_coupling *c, const friction_tunable_node *node) {
  double sum = 0, compliance = 0;
  int is_flat = 0;
  if (node->kind == friction_tunable_slip) return 0;
  if (node->kind == friction_tunable_block) return friction_tunable_bounded_stiffness(self, c->first_block + node->place);
  for (int i = node->first_child; i < (node->first_child + node->child_count); ++i) {
    const friction_tunable_node *child = &self->nodes[c->first_node + i];
    sum += child->stiffness;
    compliance += child->compliance;
    is_flat = is_flat || (child->stiffness == 0);
  }
  return (node->kind == friction_tunable_parallel) ? sum : (is_flat ? 0 : (1 / compliance));
}

static inline void friction_tunable_tune_tree(friction_tunable_tunables *self, const friction_tunable_coupling *c, const double *numbers) {
  for (int k = c->first_node + c->node_count - 1; k >= c->first_node; --k) {
    friction_tunable_node *node = &self->nodes[k];
    *node = friction_tunable_tree_nodes[k];
    if (node->kind == friction_tunable_slip) node->yield = friction_tunable_yield_force(&friction_tunable_yields[c->first_slip + node->place], numbers);
    node->stiffness = friction_tunable_end_stiffness(self, c, node);
    node->compliance = (node->stiffness > 0) ? (1 / node->stiffness) : 0;
  }
}

static inline double friction_tunable_step_slips(friction_tunable_tunables *self, double change) {
  double sum = 0;
  for (int i = 0; i < friction_tunable_coupling_count; ++i) {
    const friction_tunable_coupling *c = &friction_tunable_couplings[i];
    const friction_tunable_tree tree = friction_tunable_tree_of(self, c);
    sum += friction_tunable_tree_step(&tree, change, self->block_held + c->first_block, self->block_elongation + c->first_block,
                         self->sign + c->first_slip);
  }
  return sum;
}

// b∞ of all that is behind slips, for one pattern of those that give way [N·s/m].
static inline double friction_tunable_damping_of(friction_tunable_tunables *self, const int *sign) {
  double sum = 0;
  for (int i = 0; i < friction_tunable_coupling_count; ++i) {
    const friction_tunable_coupling *c = &friction_tunable_couplings[i];
    const friction_tunable_tree tree = friction_tunable_tree_of(self, c);
    sum += friction_tunable_regime_feedthrough(&tree, self->block_feedthrough + c->first_block, sign + c->first_slip);
  }
  return sum;
}

static inline double friction_tunable_least(double one, double other) { return (one < other) ? one : other; }

// After a reset: what slips leave to a brake that has `left` for them [N·s/m].
static inline double friction_tunable_tunable_resting_brake(friction_tunable_tunables *self, double left) {
  for (int i = 0; i < friction_tunable_slips; ++i) {
    self->commanded[i] = 0;
    self->slid[i] = 0;
    self->slid_at[i] = 0;
  }
  const double damping = friction_tunable_least(friction_tunable_damping_of(self, self->commanded), left);
  self->root = friction_tunable_square_root(damping);
  return damping;
}

// Which slips slide for the command: a slide ends where the tool has gone the hysteresis, to either side, and the slip
// not with it.
static inline void friction_tunable_follow_slides(friction_tunable_tunables *self, double position) {
  for (int i = 0; i < friction_tunable_slips; ++i) {
    const double way = position - self->slid_at[i];
    self->slides_now[i] = (self->sign[i] != 0) || (self->slid[i] && ((friction_tunable_hysteresis * friction_tunable_hysteresis - way * way) > 0));
    self->slid_at_now[i] = (self->sign[i] != 0) ? position : self->slid_at[i];
    self->commanded[i] = self->slides_now[i] ? 1 : 0;
  }
}

// b on its way to what the regime would have: √b ← √b + κ (√b_regime − √b).
static inline double friction_tunable_reached_damping(friction_tunable_tunables *self, double wanted) {
  if (!(friction_tunable_coil_share < 1)) return wanted;
  self->root_now = self->root + friction_tunable_coil_share * (friction_tunable_square_root(wanted) - self->root);
  return self->root_now * self->root_now;
}

// What slips leave to a brake that has `left` for them, after their step, by where the tool is.
static inline friction_tunable_slip_brake friction_tunable_tunable_slip_brake(friction_tunable_tunables *self, double position, double left) {
  const double now = friction_tunable_least(friction_tunable_damping_of(self, self->sign), left);
  friction_tunable_follow_slides(self, position);
  const double wanted = friction_tunable_least(friction_tunable_damping_of(self, self->commanded), left);
  const friction_tunable_slip_brake found = {now * friction_tunable_rate, friction_tunable_reached_damping(self, wanted), wanted};
  return found;
}

static inline void friction_tunable_keep_slips(friction_tunable_tunables *self) {
  for (int i = 0; i <= friction_tunable_slips; ++i) self->last_sign[i] = self->sign[i];
  for (int i = 0; i < friction_tunable_slips; ++i) {
    self->slid[i] = self->slides_now[i];
    self->slid_at[i] = self->slid_at_now[i];
  }
  self->root = self->root_now;
}

// g and b∞ of every block. Returns g of all that joins tool and ground without a slip but for dampers and meshes.
static inline double friction_tunable_find_curves(friction_tunable_tunables *self, const double *numbers) {
  double springs = 0;
  for (int i = 0; i < friction_tunable_block_count; ++i) {
    self->block_feedthrough[i] = self->block_stiffness[i] = 0;
    for (int k = 0; k < friction_tunable_block_table[i].part_count; ++k) {
      const friction_tunable_part *part = &friction_tunable_parts[friction_tunable_block_table[i].first_part + k];
      const double through = friction_tunable_part_feedthrough(self, part, numbers);
      const double stiffness = friction_tunable_part_stiffness(self, part, numbers);
      self->block_feedthrough[i] += through;
      self->block_stiffness[i] += stiffness;
      if ((i > 0) || (part->kind == friction_tunable_damper)) continue;
      springs += stiffness;
    }
  }
  // Of what no slip changes the brake has been told already.
  self->block_feedthrough[0] = 0;
  return springs;
}

// p = g δ + π: π of every block, and what its meshes need to be spread.
static inline void friction_tunable_find_held(friction_tunable_tunables *self) {
  for (int i = 0; i < friction_tunable_block_count; ++i) {
    double held = 0;
    for (int k = 0; k < friction_tunable_block_table[i].part_count; ++k)
      held += friction_tunable_held_by_part(self, &friction_tunable_parts[friction_tunable_block_table[i].first_part + k]);
    self->block_held[i] = held;
  }
}

// Everything but the parameters' values and what follows from them.
static inline void friction_tunable_rest(friction_tunable_tunables *self) {
  for (int i = 0; i < friction_tunable_springs; ++i) self->elongation[i] = self->offset[i] = 0;
  for (int i = 0; i < friction_tunable_blocks_room; ++i) self->block_elongation[i] = 0;
  self->tank = 0;
  self->is_owing = self->is_shed = 0;
  for (int i = 0; i <= friction_tunable_slips; ++i) self->last_sign[i] = 0;
}

// At rest at `position`. Returns π of what joins tool and ground without a slip [N].
static inline double friction_tunable_tunable_reset(friction_tunable_tunables *self, double position) {
  friction_tunable_rest(self);
  friction_tunable_find_held(self);
  (void)position;
  return self->block_held[0];
}

// π of what joins tool and ground without a slip [N].
static inline double friction_tunable_tunable_held(const friction_tunable_tunables *self) { return self->block_held[0]; }

// Of all slips, by the tool's displacement in this sample: the force that opposes it [N].
static inline double friction_tunable_tunable_slip(friction_tunable_tunables *self, double change) { return friction_tunable_step_slips(self, change); }

// Takes the states over a sample, by the change of the tool, or of the surface that it pushes, and to its position.
// Returns π of what joins tool and ground without a slip [N].
static inline double friction_tunable_tunable_update(friction_tunable_tunables *self, double change, double position) {
  self->block_elongation[0] = change;
  for (int i = 0; i < friction_tunable_block_count; ++i)
    for (int k = 0; k < friction_tunable_block_table[i].part_count; ++k)
      friction_tunable_advance(self, &friction_tunable_parts[friction_tunable_block_table[i].first_part + k], self->block_elongation[i]);
  (void)position;
  friction_tunable_bring_offsets_home(self);
  friction_tunable_keep_slips(self);
  friction_tunable_find_held(self);
  return self->block_held[0];
}

// V + T [J]
static inline double friction_tunable_tunable_stored_energy(const friction_tunable_tunables *self) {
  double stored = self->tank;
  for (int i = 0; i < friction_tunable_spring_count; ++i)
    stored += friction_tunable_spring_force(self, i) * (self->elongation[i] - self->offset[i]) * (double)0.5;
  return stored;
}

// `value` becomes what is wanted of it, within its range; what is no number at all leaves it as it is. Returns 1 where
// that is not what was wanted, else 0.
static inline unsigned friction_tunable_take_value(const friction_tunable_range_of_parameter *range, double wanted, double *value) {
  if (wanted == wanted) *value = (wanted < range->min) ? range->min : ((wanted > range->max) ? range->max : wanted);
  return (*value == wanted) ? 0u : 1u;
}

// With new numbers: the springs' forces stay as they are as far as energy allows. Returns g of all that joins tool and
// ground without a slip but for dampers and meshes [N/m].
static inline double friction_tunable_tunable_set(friction_tunable_tunables *self, const double *numbers) {
  friction_tunable_spring_change changes[friction_tunable_springs];
  for (int i = 0; i < friction_tunable_springs; ++i) {
    changes[i].stiffness = self->stiffness[i];
    changes[i].force = friction_tunable_spring_force(self, i);
    changes[i].new_force = 0;
  }
  for (int i = 0; i < friction_tunable_spring_count; ++i) self->stiffness[i] = numbers[friction_tunable_spring_numbers[i]];
  const double stiffness = friction_tunable_find_curves(self, numbers);
  for (int i = 0; i < friction_tunable_coupling_count; ++i) friction_tunable_tune_tree(self, &friction_tunable_couplings[i], numbers);
  for (int i = 0; i < friction_tunable_springs; ++i) changes[i].new_stiffness = self->stiffness[i];
  self->tank = friction_tunable_carry_over(changes, self->tank);
  for (int i = 0; i < friction_tunable_part_count; ++i) friction_tunable_take_forces(self, &friction_tunable_parts[i], changes);
  friction_tunable_find_held(self);
  return stiffness;
}

// Before all else.
static inline void friction_tunable_tunable_begin(friction_tunable_tunables *self) {
  for (int i = 0; i < friction_tunable_springs; ++i) self->stiffness[i] = self->share[i] = self->loss[i] = 0;
  for (int i = 0; i < friction_tunable_blocks_room; ++i)
    self->block_stiffness[i] = self->block_held[i] = self->block_feedthrough[i] = 0;
  for (int i = 0; i <= friction_tunable_slips; ++i) self->sign[i] = 0;
  for (int i = 0; i < friction_tunable_tree_nodes_room; ++i) {
    self->nodes[i] = friction_tunable_tree_nodes[i];
    self->part_states[i].corners = self->part_states[i].sign = self->part_states[i].takes_rest = 0;
    self->part_states[i].elongation = 0;
    friction_tunable_become(&self->part_states[i], friction_tunable_rigid, 0, 0, 0);
  }
  for (int i = 0; i < friction_tunable_corners; ++i) self->corners[i] = friction_tunable_make_corner(0, 0, 0, 0);
  for (int i = 0; i < friction_tunable_merged; ++i) self->merged[i] = friction_tunable_make_corner(0, 0, 0, 0);
  for (int i = 0; i < friction_tunable_slips; ++i) {
    self->slides_now[i] = 0;
    self->slid_at_now[i] = 0;
  }
  self->root_now = 0;
  friction_tunable_rest(self);
}

// At rest at `position` [m], springs relaxed at 0 but for the static load. A NaN or infinite position is
// treated as 0. Parameters stay as they are.
static inline void friction_tunable_reset(friction_tunable *self, double position) {
  self->held_force = 0.0;
  self->last_position = (dashpot_all_finite(position, position, position) != 0) ? position : 0.0;
  self->last_brake = 0.0;
  self->sampled_position = 0.0;
  self->sampled_position_change = 0.0;
  self->resting_brake = 0.0;
  self->held_force = friction_tunable_tunable_reset(&self->law, self->last_position);
  self->resting_brake = friction_tunable_tunable_resting_brake(&self->law, self->brake_left);
  self->last_brake = self->steady_brake + self->resting_brake;
  self->sampled = 0;
}

// At rest at 0, with the parameters' values of the network's file. To be called before all others.
static inline void friction_tunable_init(friction_tunable *self) {
  friction_tunable_tunable_begin(&self->law);
  self->yield = 1.5;
  self->presliding = 2000.0;
  self->drag = 12.0;
  const double max_damping = 1.7976931348623157e+308;  // what the brake can give [N·s/m]
  const double set_numbers[3] = {self->drag, self->presliding, self->yield};
  self->step_stiffness = friction_tunable_tunable_set(&self->law, set_numbers);
  self->held_force = friction_tunable_tunable_held(&self->law);
  // b follows damper_3
  self->steady_brake = self->drag;
  // b∞ − b
  self->velocity_gain = self->drag - self->steady_brake;
  self->brake_left = max_damping - self->steady_brake;
  friction_tunable_reset(self, 0);
  self->sampled = 0;
}

// The command for this sample: port position [m] and an estimate of its velocity [m/s]. After a
// non-finite input the states stay as they were and the motor's force is 0.
static inline dashpot_command friction_tunable_output(friction_tunable *self, double position, double velocity) {
  dashpot_command command;
  // Δu = u − u₋
  const double position_change = position - self->last_position;
  // σ of all slips
  const double slips_force = friction_tunable_tunable_slip(&self->law, position_change);
  // b of the slips' regime
  const friction_tunable_slip_brake slip_brake = friction_tunable_tunable_slip_brake(&self->law, position, self->brake_left);
  const double slips_feedthrough = slip_brake.now;
  const double slips_brake = slip_brake.damping;
  // m = f − b u̇
  const double force = self->step_stiffness * position_change + self->held_force +
      slips_force - slips_feedthrough * position_change + self->velocity_gain * velocity;
  // b
  const double brake = self->steady_brake + slips_brake;
  self->sampled = dashpot_all_finite(position, velocity, force);
  if (self->sampled != 0) {
    self->last_brake = brake;
    self->sampled_position = position;
    self->sampled_position_change = position_change;
    command.damping = brake;
    command.force = force;
  } else {
    command.damping = self->last_brake;
    command.force = 0.0;
  }
  return command;
}

// Takes the states to the next sample; to be called once after each friction_tunable_output(), when the command has left.
static inline void friction_tunable_update(friction_tunable *self) {
  if (self->sampled != 0) {
    self->held_force = friction_tunable_tunable_update(&self->law, self->sampled_position_change, self->sampled_position);
    // u₋ = u
    self->last_position = self->sampled_position;
    self->sampled = 0;
  }
}

// output() and then update(), where nothing else has to happen in between.
static inline dashpot_command friction_tunable_step(friction_tunable *self, double position, double velocity) {
  const dashpot_command command = friction_tunable_output(self, position, velocity);
  friction_tunable_update(self);
  return command;
}

// The value of a parameter now, counted from 0.
static inline double friction_tunable_parameter(const friction_tunable *self, int i) {
  if (i == 0) return self->yield;
  if (i == 1) return self->presliding;
  if (i == 2) return self->drag;
  return 0;
}

// Parameters in turn, between samples. Injects no energy. Bit i of the result: parameter i was beyond its range and is at
// its bound now, or it was no number and is as it was. What waits for friction_tunable_update() belongs to the parameters before.
static inline unsigned friction_tunable_set_values(friction_tunable *self, const double *wanted) {
  friction_tunable_update(self);
  unsigned clamped = 0u;
  clamped |= friction_tunable_take_value(&friction_tunable_ranges[0], wanted[0], &self->yield) << 0;
  clamped |= friction_tunable_take_value(&friction_tunable_ranges[1], wanted[1], &self->presliding) << 1;
  clamped |= friction_tunable_take_value(&friction_tunable_ranges[2], wanted[2], &self->drag) << 2;
  const double max_damping = 1.7976931348623157e+308;  // what the brake can give [N·s/m]
  const double set_numbers[3] = {self->drag, self->presliding, self->yield};
  self->step_stiffness = friction_tunable_tunable_set(&self->law, set_numbers);
  self->held_force = friction_tunable_tunable_held(&self->law);
  // b follows damper_3
  self->steady_brake = self->drag;
  // b∞ − b
  self->velocity_gain = self->drag - self->steady_brake;
  self->brake_left = max_damping - self->steady_brake;
  return clamped;
}

static inline friction_tunable_parameters friction_tunable_parameters_at_first(void) {
  const friction_tunable_parameters first = {1.5, 2000.0, 12.0};
  return first;
}

static inline unsigned friction_tunable_set(friction_tunable *self, const friction_tunable_parameters *wanted) {
  const double values[3] = {wanted->yield, wanted->presliding, wanted->drag};
  return friction_tunable_set_values(self, values);
}

// The share of all forces in the network that the last output kept, for the motor to be able to follow.
static inline double friction_tunable_kept_share(const friction_tunable *self) {
  (void)self;
  return 1;
}

// In the springs, and set free by changes of parameters, after the last update() [J].
static inline double friction_tunable_stored_energy(const friction_tunable *self) {
  // V + T: in the springs, and what changes of parameters have set free
  const double stored = friction_tunable_tunable_stored_energy(&self->law);
  return stored;
}

#endif
