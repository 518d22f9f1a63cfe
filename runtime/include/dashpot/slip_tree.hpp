// One step of slips that are coupled through a tree of linear blocks: exact, with a bound on the work, without
// iteration.
//
// In a sample each block answers its elongation δ with the force p = g δ + π, each slip holds |p| ≤ Y and gives way
// only at ±Y. Three passes over the parts of the tree:
//   curves    every part is a monotone polyline in (δ, p). In parallel forces add, in series elongations do;
//   signs     from the tool down, which slips give way, and to which side;
//   numbers   with these known every part is rigid, a constant force, or p = g δ + π. Corners alone would lose digits.
// Neither heap nor recursion; every loop is bounded by the tree, also for non-finite inputs. Elongations are finite
// where the force is.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/slip_curve.hpp>

namespace dashpot {

enum class slip_part : unsigned char { block, slip, series, parallel };

// A part of the tree. Parts stand breadth first, the root at 0: children are neighbours and come after their parent.
// A series or parallel has at least one slip somewhere below; no path of slips alone joins the ends of the root.
template <class Scalar>
struct slip_node {
  slip_part kind;
  int first_child;  // of a series or parallel
  int child_count;
  int slips;          // in this part
  int place;          // of a block or slip: where it stands in the inputs and outputs of a step
  int first_corner;   // where the curve begins in the scratch space, room for slip_curve_room(slips); of all but blocks
  Scalar stiffness;   // g of a block; of the others dp/dδ at both ends of the curve, 0 where flat [N/m]
  Scalar compliance;  // its inverse, 0 where flat [m/N]
  Scalar yield;       // Y of a slip [N]
};

// Floating-point additions, multiplications and divisions of one step at most. For n slips in a tree where every series
// or parallel holds a slip of its own or joins two parts with slips, no more than 20 n (n + 1) + 80.
template <class Scalar>
constexpr int slip_tree_operations(const slip_node<Scalar>* nodes, int count) noexcept {
  int operations = 2;
  for (int k = 0; k < count; ++k) {
    const slip_node<Scalar>& node = nodes[k];
    if (node.kind == slip_part::slip) operations += 1;
    if (node.child_count == 0) continue;
    int slips = 0;
    for (int i = node.first_child; i < node.first_child + node.child_count; ++i) {
      const slip_node<Scalar>& child = nodes[i];
      slips += child.slips;
      if (child.kind == slip_part::block) operations += 6 * node.slips;
      // A slip bends the others' curve in two places; other curves meet at every corner.
      if (child.kind == slip_part::slip && slips > 1) operations += 2 * slips + 20;
      if (child.kind > slip_part::slip && slips > child.slips) operations += 18 * slips;
      operations += node.kind == slip_part::parallel ? 2 : child.kind > slip_part::slip ? 16 : 9;
    }
    operations += node.kind == slip_part::series ? 14 : 1;
  }
  return operations;
}

// And of a push.
template <class Scalar>
constexpr int slip_tree_push_operations(const slip_node<Scalar>* nodes, int count) noexcept {
  return slip_tree_operations(nodes, count) + 9;
}

// Corners that the curve of a part needs room for: two a slip, and of each of the curves that are added up in it, and
// of a block, the point where that part rests.
constexpr int slip_curve_room(int slips) noexcept { return 3 * slips + 1; }

// Corners that the curves of a tree need room for.
template <class Scalar>
constexpr int slip_tree_corners(const slip_node<Scalar>* nodes, int count) noexcept {
  int corners = 0;
  for (int k = 0; k < count; ++k)
    if (nodes[k].kind != slip_part::block) corners += slip_curve_room(nodes[k].slips);
  return corners;
}

enum class slip_hold : unsigned char { rigid, constant, affine };

// What is known of a part in the course of a step.
template <class Scalar>
struct slip_part_state {
  int corners;      // of its curve
  int sign;         // of a slip: 0 stuck, ±1 the side to which it gives way
  bool takes_rest;  // gets what is left over of its series' elongation
  slip_hold hold;
  Scalar stiffness;   // g where affine [N/m]
  Scalar compliance;  // 1/g [m/N]
  Scalar force;       // π where affine, the force itself where constant [N]
  Scalar elongation;  // δ [m]
};

// Room for the steps of one tree; the contents do not matter between steps.
template <class Scalar, int Nodes, int Slips, int Corners>
struct slip_tree_scratch {
  slip_part_state<Scalar> parts[unsigned{Nodes}];
  slip_corner<Scalar> corners[unsigned{Corners}];  // slip_tree_corners()
  slip_corner<Scalar> merged[unsigned{slip_curve_room(Slips)}];
};

template <class Scalar>
class slip_tree {
 public:
  // All arrays outlive the tree: `count` nodes and as many parts, corners and merged as in slip_tree_scratch.
  constexpr slip_tree(const slip_node<Scalar>* nodes, int count, slip_part_state<Scalar>* parts,
                      slip_corner<Scalar>* corners, slip_corner<Scalar>* merged) noexcept
      : nodes_(nodes), count_(count), parts_(parts), corners_(corners), merged_(merged) {}

  template <unsigned size, int Nodes, int Slips, int Corners>
  constexpr slip_tree(const slip_node<Scalar> (&nodes)[size],
                      slip_tree_scratch<Scalar, Nodes, Slips, Corners>& scratch) noexcept
      : slip_tree(nodes, Nodes, scratch.parts, scratch.corners, scratch.merged) {
    static_assert(size == Nodes, "a part for every node");
  }

  // In: the root's elongation in this sample [m], π of every block [N]. Out: the force that opposes it [N], δ of every
  // block [m], and for every slip 0 where it holds, ±1 where it gives way to that side.
  constexpr Scalar step(Scalar change, const Scalar* held, Scalar* elongation, int* sign) noexcept {
    draw_curves(held);
    find_signs(change, held, sign);
    add_up(held);
    share(change, elongation);
    return force_at(change);
  }

  // The same where the tool pushes and cannot pull: `change` is what the root's elongation would be if it stuck to the
  // tool, `surface` what it is, never less: the force is 0 where it is more.
  constexpr Scalar push(Scalar change, const Scalar* held, Scalar* elongation, int* sign, Scalar& surface) noexcept {
    draw_curves(held);
    const Scalar near = free_elongation();
    find_signs(near > change ? near : change, held, sign);
    add_up(held);
    const slip_part_state<Scalar>& root = parts_[0];
    const Scalar free = root.hold == slip_hold::affine ? -root.force * root.compliance : near;
    const bool is_free = free > change;
    surface = is_free ? free : change;
    share(surface, elongation);
    const Scalar force = force_at(surface);
    return is_free || force < Scalar(0) ? Scalar(0) : force;
  }

 private:
  using Node = slip_node<Scalar>;
  using Corner = slip_corner<Scalar>;
  using State = slip_part_state<Scalar>;

  using Range = slip_range<Scalar>;
  using Curve = slip_curve<Scalar>;

  // A block, and the slopes at the ends of a curve, read by elongation (in parallel) or by force (in series).
  struct Parallel : by_elongation<Scalar> {
    static constexpr Scalar end_slope(const Node& node) noexcept { return node.stiffness; }
    static constexpr Scalar of_block(const Node& block, Scalar held, Scalar elongation) noexcept {
      return block.stiffness * elongation + held;
    }
    static constexpr bool is_open(const Node&) noexcept { return false; }
  };
  struct Series : by_force<Scalar> {
    static constexpr Scalar end_slope(const Node& node) noexcept { return node.compliance; }
    static constexpr Scalar of_block(const Node& block, Scalar held, Scalar force) noexcept {
      return (force - held) * block.compliance;
    }
    static constexpr bool is_open(const Node& node) noexcept { return node.stiffness == Scalar(0); }
  };

  template <class Way>
  constexpr Curve curve(int k) const noexcept {
    return {corners_ + nodes_[k].first_corner, parts_[k].corners, Way::end_slope(nodes_[k]), Way::is_open(nodes_[k])};
  }

  constexpr Scalar force_at(Scalar change) const noexcept {
    const slip_part_state<Scalar>& root = parts_[0];
    return root.hold == slip_hold::affine ? root.stiffness * change + root.force : root.force;
  }

  // Where the root's curve crosses 0, to the rounding of reading it.
  constexpr Scalar free_elongation() const noexcept {
    const Range range = slip_curve_at<Series>(curve<Series>(0), Scalar(0));
    return range.open_low ? range.high : range.low;
  }

  constexpr void draw_curves(const Scalar* held) noexcept {
    for (int k = count_ - 1; k >= 0; --k) {
      if (nodes_[k].kind == slip_part::slip) draw_slip(k);
      if (nodes_[k].kind == slip_part::parallel) draw<Parallel>(k, held);
      if (nodes_[k].kind == slip_part::series) draw<Series>(k, held);
    }
  }

  constexpr void draw_slip(int k) noexcept {
    corners_[nodes_[k].first_corner] = {Scalar(0), -nodes_[k].yield, true};
    corners_[nodes_[k].first_corner + 1] = {Scalar(0), nodes_[k].yield, true};
    parts_[k].corners = 2;
  }

  template <class Way>
  constexpr void draw(int k, const Scalar* held) noexcept {
    const Node& node = nodes_[k];
    Corner* const corners = corners_ + node.first_corner;
    Curve sum{corners, 0, Scalar(0), false};
    for (int i = node.first_child; i < node.first_child + node.child_count; ++i)
      if (nodes_[i].kind != slip_part::block) sum = with<Way>(sum, curve<Way>(i), corners);
    for (int i = node.first_child; i < node.first_child + node.child_count; ++i)
      if (nodes_[i].kind == slip_part::block)
        sum = with_block<Way>(sum, nodes_[i], held[nodes_[i].place], node.kind, corners);
    parts_[k].corners = sum.count;
    if (node.kind == slip_part::series) parts_[k].corners = mark_rest(curve<Parallel>(k), corners);
  }

  // In series the point where the block has no elongation is added to the curve.
  template <class Way>
  static constexpr Curve with_block(Curve sum, const Node& block, Scalar held, slip_part kind,
                                    Corner* corners) noexcept {
    if (kind == slip_part::series) {
      const Range rest = slip_curve_at<Way>(sum, held);
      if (rest.exists && !rest.is_kink)
        sum.count = insert_corner<Way>(corners, sum.count, Way::corner(held, rest.low, false));
    }
    for (int i = 0; i < sum.count; ++i)
      corners[i] =
          Way::corner(Way::at(corners[i]), Way::value(corners[i]) + Way::of_block(block, held, Way::at(corners[i])),
                      corners[i].is_kink);
    return {corners, sum.count, sum.end_slope + (kind == slip_part::series ? block.compliance : block.stiffness),
            sum.is_open};
  }

  // The sum of two curves; `to` is where the first one is stored, and then the sum.
  template <class Way>
  constexpr Curve with(const Curve& sum, const Curve& other, Corner* to) noexcept {
    const Corner* from = sum.count == 0 ? other.corners : merged_;
    const int count = sum.count == 0 ? other.count : merge_curves<Way>(sum, other, merged_);
    for (int i = 0; i < count; ++i) to[i] = from[i];
    return {to, count, sum.end_slope + other.end_slope, sum.is_open || other.is_open};
  }

  constexpr void find_signs(Scalar change, const Scalar* held, int* sign) noexcept {
    parts_[0].elongation = change;
    for (int k = 0; k < count_; ++k) {
      if (nodes_[k].kind == slip_part::parallel) find_signs_in_parallel(k);
      if (nodes_[k].kind == slip_part::series) find_signs_in_series(k, held);
      if (nodes_[k].kind == slip_part::slip) sign[nodes_[k].place] = parts_[k].sign;
    }
  }

  constexpr void find_signs_in_parallel(int k) noexcept {
    const Scalar elongation = parts_[k].elongation;
    for (int i = nodes_[k].first_child; i < nodes_[k].first_child + nodes_[k].child_count; ++i) {
      parts_[i].elongation = elongation;
      parts_[i].takes_rest = false;
      parts_[i].sign = elongation > Scalar(0) ? 1 : elongation < Scalar(0) ? -1 : 0;
    }
  }

  constexpr void find_signs_in_series(int k, const Scalar* held) noexcept {
    const Range forces = slip_curve_at<Parallel>(curve<Parallel>(k), parts_[k].elongation);
    const Scalar force = forces.low < forces.high ? forces.low + (forces.high - forces.low) / Scalar(2) : forces.low;
    Scalar rest = parts_[k].elongation;
    for (int i = nodes_[k].first_child; i < nodes_[k].first_child + nodes_[k].child_count; ++i) {
      const Range range = elongations(i, force, held);
      parts_[i].elongation = range.open_low ? range.high : range.low;
      parts_[i].takes_rest = range.low < range.high || range.open_low || range.open_high;
      parts_[i].sign = force >= nodes_[i].yield ? 1 : force <= -nodes_[i].yield ? -1 : 0;
      rest -= parts_[i].elongation;
    }
    place_rest(k, rest, force);
  }

  constexpr Range elongations(int i, Scalar force, const Scalar* held) const noexcept {
    if (nodes_[i].kind != slip_part::block) return slip_curve_at<Series>(curve<Series>(i), force);
    const Scalar elongation = Series::of_block(nodes_[i], held[nodes_[i].place], force);
    return {elongation, elongation, false, false, true, false};
  }

  // The elongation that is left over goes to the parts that slide at this force, in turn; all but the last get as much
  // as they can.
  constexpr void place_rest(int k, Scalar rest, Scalar force) noexcept {
    bool is_placed = false;
    for (int i = nodes_[k].first_child; i < nodes_[k].first_child + nodes_[k].child_count; ++i) {
      if (!parts_[i].takes_rest) continue;
      parts_[i].takes_rest = false;
      if (is_placed) continue;
      const Range range = slip_curve_at<Series>(curve<Series>(i), force);
      const Scalar room = range.high - range.low;
      is_placed = range.open_low || range.open_high || rest < room;
      parts_[i].takes_rest = is_placed;
      const bool is_backwards = range.open_low ? rest > Scalar(0) : rest < Scalar(0);
      if (is_placed && !is_backwards) parts_[i].elongation += rest;
      if (is_placed) continue;
      parts_[i].elongation = range.high;
      rest -= room;
    }
  }

  constexpr void add_up(const Scalar* held) noexcept {
    for (int k = count_ - 1; k >= 0; --k) {
      State& state = parts_[k];
      switch (nodes_[k].kind) {
        case slip_part::block:
          become(state, slip_hold::affine, nodes_[k].stiffness, nodes_[k].compliance, held[nodes_[k].place]);
          break;
        case slip_part::slip:
          become(state, state.sign == 0 ? slip_hold::rigid : slip_hold::constant, Scalar(0), Scalar(0),
                 Scalar(state.sign) * nodes_[k].yield);
          break;
        case slip_part::parallel: add_up_parallel(k); break;
        case slip_part::series: add_up_series(k); break;
      }
    }
  }

  static constexpr void become(State& state, slip_hold hold, Scalar stiffness, Scalar compliance,
                               Scalar force) noexcept {
    state.hold = hold;
    state.stiffness = stiffness;
    state.compliance = compliance;
    state.force = force;
  }

  // Any rigid → rigid; else g = Σ g_i, π = Σ π_i; all constant → constant.
  constexpr void add_up_parallel(int k) noexcept {
    int rigid = 0, affine = 0;
    Scalar stiffness = 0, force = 0;
    for (int i = nodes_[k].first_child; i < nodes_[k].first_child + nodes_[k].child_count; ++i) {
      if (parts_[i].hold == slip_hold::rigid) ++rigid;
      if (parts_[i].hold == slip_hold::affine) ++affine;
      if (parts_[i].hold == slip_hold::affine) stiffness += parts_[i].stiffness;
      force += parts_[i].force;
    }
    if (rigid != 0) return become(parts_[k], slip_hold::rigid, Scalar(0), Scalar(0), Scalar(0));
    if (affine == 0) return become(parts_[k], slip_hold::constant, Scalar(0), Scalar(0), force);
    become(parts_[k], slip_hold::affine, stiffness, Scalar(1) / stiffness, force);
  }

  // If a part has a constant force, that is the force of all; rigid parts drop out; 1/g = Σ 1/g_i, π = g Σ π_i/g_i; all
  // rigid → rigid.
  constexpr void add_up_series(int k) noexcept {
    int affine = 0, last = 0;
    Scalar compliance = 0, weighted = 0;
    if (const int i = constant_child(k); i != 0)
      return become(parts_[k], slip_hold::constant, Scalar(0), Scalar(0), parts_[i].force);
    for (int i = nodes_[k].first_child; i < nodes_[k].first_child + nodes_[k].child_count; ++i) {
      if (parts_[i].hold != slip_hold::affine) continue;
      ++affine;
      last = i;
      compliance += parts_[i].compliance;
      weighted += parts_[i].force * parts_[i].compliance;
    }
    if (affine == 0) return become(parts_[k], slip_hold::rigid, Scalar(0), Scalar(0), Scalar(0));
    if (affine == 1)
      return become(parts_[k], slip_hold::affine, parts_[last].stiffness, parts_[last].compliance, parts_[last].force);
    const Scalar stiffness = Scalar(1) / compliance;
    become(parts_[k], slip_hold::affine, stiffness, compliance, weighted * stiffness);
  }

  // A child that holds a constant force, preferably the one that takes the rest; 0 for none.
  constexpr int constant_child(int k) const noexcept {
    int found = 0;
    for (int i = nodes_[k].first_child; i < nodes_[k].first_child + nodes_[k].child_count; ++i)
      if (parts_[i].hold == slip_hold::constant && (found == 0 || parts_[i].takes_rest)) found = i;
    return found;
  }

  constexpr void share(Scalar change, Scalar* elongation) noexcept {
    parts_[0].elongation = change;
    for (int k = 0; k < count_; ++k) {
      if (nodes_[k].kind == slip_part::parallel) share_in_parallel(k);
      if (nodes_[k].kind == slip_part::series) share_in_series(k);
      if (nodes_[k].kind == slip_part::block) elongation[nodes_[k].place] = parts_[k].elongation;
    }
  }

  constexpr void share_in_parallel(int k) noexcept {
    for (int i = nodes_[k].first_child; i < nodes_[k].first_child + nodes_[k].child_count; ++i)
      parts_[i].elongation = parts_[k].elongation;
  }

  // δ_i = (p − π_i)/g_i where affine, 0 where rigid; the rest where constant.
  constexpr void share_in_series(int k) noexcept {
    const State& whole = parts_[k];
    const int taker = constant_child(k);
    const bool is_undivided = taker == 0 && is_only_affine(k);
    const Scalar force =
        whole.hold == slip_hold::affine ? whole.stiffness * whole.elongation + whole.force : whole.force;
    Scalar rest = whole.elongation;
    for (int i = nodes_[k].first_child; i < nodes_[k].first_child + nodes_[k].child_count; ++i) {
      State& part = parts_[i];
      if (i == taker) continue;
      if (part.hold == slip_hold::rigid) part.elongation = 0;
      if (part.hold == slip_hold::affine)
        part.elongation = is_undivided ? whole.elongation : (force - part.force) * part.compliance;
      rest -= part.elongation;
    }
    if (taker != 0) parts_[taker].elongation = rest;
  }

  constexpr bool is_only_affine(int k) const noexcept {
    int affine = 0;
    for (int i = nodes_[k].first_child; i < nodes_[k].first_child + nodes_[k].child_count; ++i)
      if (parts_[i].hold == slip_hold::affine) ++affine;
    return affine == 1;
  }

  const Node* nodes_;
  int count_;
  State* parts_;
  Corner* corners_;
  Corner* merged_;
};

}  // namespace dashpot
