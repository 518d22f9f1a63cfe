// The slips of a law with tunable parameters, and the curves of the parts between them: one step of dashpot::slip_tree for
// each coupling, and what they leave to the brake.
#pragma once

#include <dashpot/slip_regime.hpp>
#include <dashpot/slip_tree.hpp>
#include <dashpot/tunable/slip_brake.hpp>
#include <dashpot/tunable/tables.hpp>

namespace dashpot {

// Of all blocks: p = g δ + π over a sample, and b∞.
template <class Scalar, int Blocks>
struct tunable_curves {
  Scalar stiffness[Blocks] = {};    // g [N/m]
  Scalar held[Blocks] = {};         // π [N]
  Scalar elongation[Blocks] = {};   // δ in this sample [m]
  Scalar feedthrough[Blocks] = {};  // b∞; 0 of block 0, whose is the law's own [N·s/m]
};

template <class Scalar, int Blocks, int SlipParts, int Slips, int Corners>
class tunable_slips {
 public:
  using tables = tunable_tables<Scalar>;
  using curves = tunable_curves<Scalar, Blocks>;

  constexpr void begin(const tables& t) noexcept {
    for (int i = 0; i < t.coupling_count; ++i)
      for (int k = t.couplings[i].first_node; k < t.couplings[i].first_node + t.couplings[i].node_count; ++k) nodes_[k] = t.nodes[k];
  }

  // What is told of the parameters at their largest says how little a part may become: curves of slips through parts that
  // give way without end would lose their digits. `number` gives the numbers of the tables.
  template <class Number>
  constexpr void remember_largest(const tables& t, const curves& of, Number number) noexcept {
    for (int i = 0; i < t.block_count; ++i) least_stiffness_[i] = t.least_share * of.stiffness[i];
    for (int i = 0; i < t.slip_count; ++i) least_yield_[i] = t.least_share * yield_force(t, i, number);
  }

  template <class Number>
  constexpr void tune(const tables& t, const curves& of, Number number) noexcept {
    for (int i = 0; i < t.coupling_count; ++i) tune_tree(t, t.couplings[i], of, number);
  }

  constexpr void reset(Scalar damping) noexcept { brake_.reset(damping); }

  Scalar step(const tables& t, Scalar change, curves& of) noexcept {
    Scalar sum = 0;
    for (int i = 0; i < t.coupling_count; ++i) {
      const tunable_coupling& c = t.couplings[i];
      sum += tree(c).step(change, of.held + c.first_block, of.elongation + c.first_block, sign_ + c.first_slip);
    }
    return sum;
  }

  // The one coupling of a contact: the whole network.
  Scalar push(const tables& t, Scalar approach, curves& of, Scalar& change) noexcept {
    const tunable_coupling& c = t.couplings[0];
    return tree(c).push(approach, of.held + c.first_block, of.elongation + c.first_block, sign_, change);
  }

  // b∞ of all that is behind slips, in the regime of this sample, and in the command's [N·s/m].
  constexpr Scalar damping_now(const tables& t, const curves& of) noexcept { return damping_of(t, of, sign_); }
  constexpr Scalar damping_at_rest(const tables& t, const curves& of) noexcept {
    for (int& slides : commanded_) slides = 0;
    return damping_of(t, of, commanded_);
  }
  Scalar commanded_damping(const tables& t, const curves& of, Scalar position) noexcept {
    brake_.follow(t.slip_rule, t.slip_count, sign_, position, commanded_);
    return damping_of(t, of, commanded_);
  }

  // b on its way there.
  Scalar reached_damping(const tables& t, Scalar wanted) noexcept { return brake_.damping(t.slip_rule, wanted); }

  void keep(const tables& t) noexcept { brake_.keep(t.slip_count); }

 private:
  static constexpr int room = Slips > 0 ? Slips : 1;

  slip_tree<Scalar> tree(const tunable_coupling& c) noexcept {
    return slip_tree<Scalar>(nodes_ + c.first_node, c.node_count, parts_ + c.first_node, corners_ + c.first_corner, merged_);
  }

  constexpr Scalar damping_of(const tables& t, const curves& of, const int* sign) noexcept {
    Scalar sum = 0;
    for (int i = 0; i < t.coupling_count; ++i) {
      const tunable_coupling& c = t.couplings[i];
      sum += slip_regime_feedthrough(nodes_ + c.first_node, c.node_count, of.feedthrough + c.first_block, sign + c.first_slip,
                                     parts_ + c.first_node);
    }
    return sum;
  }

  template <class Number>
  constexpr void tune_tree(const tables& t, const tunable_coupling& c, const curves& of, Number number) noexcept {
    for (int k = c.first_node + c.node_count - 1; k >= c.first_node; --k) {
      slip_node<Scalar>& node = nodes_[k];
      if (node.kind == slip_part::slip) node.yield = bounded_yield(t, c.first_slip + node.place, number);
      const Scalar g = end_stiffness(c, node, of);
      node.stiffness = g;
      node.compliance = g > 0 ? 1 / g : Scalar(0);
    }
  }

  // A block that is made softer than the least adds a little damping in its place.
  constexpr Scalar bounded_stiffness(int block, const curves& of) const noexcept {
    return of.stiffness[block] > least_stiffness_[block] ? of.stiffness[block] : least_stiffness_[block];
  }

  // With every slip giving way: in parallel the sum, in series the inverse of Σ 1/g.
  constexpr Scalar end_stiffness(const tunable_coupling& c, const slip_node<Scalar>& node, const curves& of) const noexcept {
    if (node.kind == slip_part::slip) return 0;
    if (node.kind == slip_part::block) return bounded_stiffness(c.first_block + node.place, of);
    Scalar sum = 0, compliance = 0;
    bool is_flat = false;
    for (int i = node.first_child; i < node.first_child + node.child_count; ++i) {
      const slip_node<Scalar>& child = nodes_[c.first_node + i];
      sum += child.stiffness;
      compliance += child.compliance;
      is_flat = is_flat || child.stiffness == Scalar(0);
    }
    return node.kind == slip_part::parallel ? sum : is_flat ? Scalar(0) : 1 / compliance;
  }

  template <class Number>
  constexpr Scalar yield_force(const tables& t, int slip, Number number) const noexcept {
    const tunable_yield& yield = t.yields[slip];
    Scalar least = number(t.cuts[yield.first_cut]);
    for (int i = yield.first_cut + 1; i < yield.first_cut + yield.cut_count; ++i) {
      const Scalar sum = number(t.cuts[i]);
      least = sum < least ? sum : least;
    }
    return least;
  }

  template <class Number>
  constexpr Scalar bounded_yield(const tables& t, int slip, Number number) const noexcept {
    const Scalar yield = yield_force(t, slip, number);
    return yield > least_yield_[slip] ? yield : least_yield_[slip];
  }

  Scalar least_stiffness_[Blocks] = {}, least_yield_[room] = {};
  slip_node<Scalar> nodes_[SlipParts] = {};
  slip_part_state<Scalar> parts_[SlipParts] = {};
  slip_corner<Scalar> corners_[Corners] = {}, merged_[slip_curve_room(room)] = {};
  int sign_[room] = {}, commanded_[room] = {};
  tunable_slip_brake<Scalar, room> brake_;
};

}  // namespace dashpot
