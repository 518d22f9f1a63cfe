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
//   falls; rounding adds at most 5.4e-15 of the sum of the force's terms
// device: none is named: exact brake, no delay, and for velocity the difference of the last two positions over the
//   period. Pass that one: a smoother estimate is later, and of it nothing is certified here
// tunable: yield (0 to 5 N), presliding (200 to 5000 N/m), drag (0 to 40 N s/m)
//   set() brings no energy in: a rise of stiffness while the tool presses stays owed until the springs can pay
//   b [N·s/m] follows damper_3
// cost of output(): 4 additions, 2 multiplications, 0 guards against subnormal numbers
//   and at most 41 additions, multiplications and divisions for the coupled slips
// cost of update(): 1 additions, 1 multiplications, 1 guards against subnormal numbers; 9 numbers are kept between
//   samples
// cost of set(): 7 operations for the constants, 53 for the forces of springs and their energy
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

typedef struct friction_tunable_range_of_parameter {
  double min;
  double max;
} friction_tunable_range_of_parameter;

// `value` becomes what is wanted of it, within its range; what is no number at all leaves it as it is. Returns 1 where
// that is not what was wanted, else 0.
static inline unsigned friction_tunable_take_value(const friction_tunable_range_of_parameter *range, double wanted, double *value) {
  if (wanted == wanted) *value = (wanted < range->min) ? range->min : ((wanted > range->max) ? range->max : wanted);
  return (*value == wanted) ? 0u : 1u;
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

static const friction_tunable_range_of_parameter friction_tunable_ranges[3] = {
    {0.0, 5.0},  // yield [N]
    {200.0, 5000.0},  // presliding [N/m]
    {0.0, 40.0},  // drag [N s/m]
};

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
  double last_position;  // u of the sample before [m]
  double last_brake;  // b of the sample before [N·s/m]
  double sampled_position;  // port displacement u, at this sample [m]
  double sampled_position_change;  // Δu since the sample before, at this sample [m]
  double spring_2_elongation;  // z [m]
  double spring_2_carried_stiffness;  // k for which the force is what it is [N/m]
  double spring_2_held;  // π, what the block holds [N]
  double tank;  // T, set free by changes of parameters [J]
  double friction_yield;  // Y [N]
  double spring_2_answer;  // g of a part whose slips give way [N/m]
  double spring_2_give;  // 1/g of it [m/N]
  double sampled_spring_2_stretched;  // δ of the block, at this sample [m]
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

// At rest at `position` [m], springs relaxed at 0 but for the static load. A NaN or infinite position is
// treated as 0. Parameters stay as they are.
static inline void friction_tunable_reset(friction_tunable *self, double position) {
  const double zero = 0.0;  // nothing [1]
  self->held_force = 0.0;
  self->last_position = (dashpot_all_finite(position, position, position) != 0) ? position : 0.0;
  self->last_brake = 12.0;
  self->sampled_position = 0.0;
  self->sampled_position_change = 0.0;
  self->spring_2_elongation = 0.0;
  self->spring_2_held = 0.0;
  self->tank = 0.0;
  self->sampled_spring_2_stretched = 0.0;
  // π
  self->held_force = zero;
  self->last_brake = self->steady_brake;
  self->sampled = 0;
}

// At rest at 0, with the parameters' values of the network's file. To be called before all others.
static inline void friction_tunable_init(friction_tunable *self) {
  self->yield = 1.5;
  self->presliding = 2000.0;
  self->drag = 12.0;
  self->step_stiffness = 0.0;
  self->steady_brake = 12.0;
  self->velocity_gain = 0.0;
  self->spring_2_carried_stiffness = 2000.0;
  self->friction_yield = 1.5;
  self->spring_2_answer = 2000.0;
  self->spring_2_give = 0.0005;
  friction_tunable_reset(self, 0);
  self->sampled = 0;
}

// The command for this sample: port position [m] and an estimate of its velocity [m/s]. After a
// non-finite input the states stay as they were and the motor's force is 0.
static inline dashpot_command friction_tunable_output(friction_tunable *self, double position, double velocity) {
  dashpot_command command;
  // Δu = u − u₋
  const double position_change = position - self->last_position;
  // f and every block's δ, by curves, signs and numbers
  // kind, children, slips, place, first corner, stiffness, compliance, yield force
  const friction_tunable_node friction_tunable_coupled_friction[3] = {
      {friction_tunable_series, 1, 2, 1, 0, 0, 0.0, 0.0, 0.0},
      {friction_tunable_block, 0, 0, 0, 0, 0, self->spring_2_answer, self->spring_2_give, 0.0},
      {friction_tunable_slip, 0, 0, 1, 0, 4, 0.0, 0.0, self->friction_yield},
  };
  const double coupled_friction_held[1] = {self->spring_2_held};
  double coupled_friction_elongation[1] = {0};
  int coupled_friction_sign[1] = {0};
  friction_tunable_part_state coupled_friction_parts[3] = {{0, 0, 0, 0, 0, 0, 0, 0}};
  friction_tunable_corner coupled_friction_corners[8] = {{0, 0, 0}}, coupled_friction_merged[4] = {{0, 0, 0}};
  const friction_tunable_tree coupled_friction_tree = {friction_tunable_coupled_friction, 3, coupled_friction_parts, coupled_friction_corners, coupled_friction_merged};
  const double slips_force = friction_tunable_tree_step(&coupled_friction_tree, position_change,
      coupled_friction_held, coupled_friction_elongation, coupled_friction_sign);
  const double spring_2_stretched = coupled_friction_elongation[0];
  // m = f − b u̇
  const double force = self->step_stiffness * position_change + self->held_force + slips_force +
      self->velocity_gain * velocity;
  // b
  const double brake = self->steady_brake;
  self->sampled = dashpot_all_finite(position, velocity, force);
  if (self->sampled != 0) {
    self->last_brake = brake;
    self->sampled_position = position;
    self->sampled_position_change = position_change;
    self->sampled_spring_2_stretched = spring_2_stretched;
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
    const double threshold = 6.223015277861142e-61;  // below, a force is zero: no subnormal state
    const double zero = 0.0;  // nothing [1]
    // z ← z + δ
    self->spring_2_elongation = dashpot_flush_below(threshold, self->spring_2_elongation +
        self->sampled_spring_2_stretched);
    // π
    self->held_force = zero;
    // π of the block
    self->spring_2_held = self->presliding * self->spring_2_elongation;
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
  const double zero = 0.0;  // nothing [1]
  const double friction_least_yield = 2.980232238769531e-07;  // Y, no less whatever the parameters are [N]
  const double spring_2_least_answer = 0.0002980232238769531;  // g, no less whatever the parameters are [N/m]
  const double one = 1.0;  // one [1]
  const double two = 2.0;  // two [1]
  const double minus_one = -1.0;  // minus one [1]
  // g of what joins tool and ground
  self->step_stiffness = zero;
  self->friction_yield = (self->yield - friction_least_yield > 0) ? self->yield : friction_least_yield;
  self->spring_2_answer = (self->presliding - spring_2_least_answer > 0) ? self->presliding :
      spring_2_least_answer;
  self->spring_2_give = (self->spring_2_answer > 0) ? one / self->spring_2_answer : zero;
  // b follows damper_3
  self->steady_brake = self->drag;
  // b∞ − b
  self->velocity_gain = self->drag - self->steady_brake;
  const double spring_2_force_before = self->spring_2_carried_stiffness * self->spring_2_elongation;
  // F, or F √(k′/k) of a softer spring
  const double spring_2_force_kept = (self->spring_2_carried_stiffness - self->presliding > 0) ?
      ((self->presliding > 0) ? spring_2_force_before *
      friction_tunable_square_root(self->presliding / self->spring_2_carried_stiffness) : zero) :
      spring_2_force_before;
  const double spring_2_energy_before = (self->spring_2_carried_stiffness > 0) ? spring_2_force_before *
      (spring_2_force_before / self->spring_2_carried_stiffness) / two : zero;
  const double spring_2_energy_after = (self->presliding > 0) ? spring_2_force_before *
      (spring_2_force_before / self->presliding) / two : zero;
  self->tank = self->tank + ((self->presliding - self->spring_2_carried_stiffness > 0) ?
      spring_2_energy_before - spring_2_energy_after : zero) +
      ((self->presliding > 0) ? zero : spring_2_energy_before);
  const double spring_2_energy_held = (self->presliding > 0) ? spring_2_force_kept *
      (spring_2_force_kept / self->presliding) / two : zero;
  const double spring_2_energy_missing = spring_2_energy_after - spring_2_energy_held;
  const double spring_2_force_most = friction_tunable_square_root(two * self->presliding * (spring_2_energy_held +
      self->tank));
  const double spring_2_force_short = spring_2_force_kept - spring_2_force_before;
  const double spring_2_force_short_size = (spring_2_force_short > 0) ? spring_2_force_short :
      zero - spring_2_force_short;
  const double spring_2_falls_short = (self->presliding > 0) ? spring_2_force_short_size : zero;
  const double spring_2_energy_unpaid = spring_2_energy_missing - self->tank;
  // F, as far as the tank pays
  const double spring_2_force_after = (spring_2_falls_short > 0) ? ((spring_2_energy_unpaid > 0) ?
      ((spring_2_force_before > 0) ? spring_2_force_most : minus_one *
      spring_2_force_most) : spring_2_force_before) : spring_2_force_kept;
  self->tank = (spring_2_falls_short > 0) ? ((spring_2_energy_unpaid > 0) ? zero :
      self->tank - spring_2_energy_missing) : self->tank;
  const double spring_2_force_change = spring_2_force_after - spring_2_force_before;
  const double spring_2_force_change_size = (spring_2_force_change > 0) ? spring_2_force_change :
      zero - spring_2_force_change;
  const double spring_2_stiffness_change = self->presliding - self->spring_2_carried_stiffness;
  const double spring_2_stiffness_change_size = (spring_2_stiffness_change > 0) ? spring_2_stiffness_change :
      zero - spring_2_stiffness_change;
  const double spring_2_is_changed = spring_2_force_change_size + spring_2_stiffness_change_size;
  // z = F/k
  self->spring_2_elongation = (spring_2_is_changed > 0) ? ((self->presliding > 0) ?
      spring_2_force_after / self->presliding : zero) : self->spring_2_elongation;
  self->spring_2_carried_stiffness = self->presliding;
  // π
  self->held_force = zero;
  // π of the block
  self->spring_2_held = self->presliding * self->spring_2_elongation;
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
  const double half = 0.5;  // a half [1]
  // V + T: in the springs, and what changes of parameters have set free
  const double stored = self->tank +
      self->presliding * self->spring_2_elongation * self->spring_2_elongation * half;
  return stored;
}

#endif
