// The slips of a law with tunable parameters: one step for each coupling of slips that meet in a tree, and for each
// graph of others, and what all leave to the brake.
#pragma once

#include <dashpot/slip_regime.hpp>
#include <dashpot/slip_tree.hpp>
#include <dashpot/tunable/slip_brake.hpp>
#include <dashpot/tunable/slip_graph.hpp>
#include <dashpot/tunable/tables.hpp>

namespace dashpot {

template <class Scalar, int Blocks, int SlipParts, int Slips, int Corners, int Ends>
class tunable_slips {
 public:
  using tables = tunable_tables<Scalar>;
  using curves = tunable_curves<Scalar, Blocks>;

  constexpr void tune(const tables& t, const curves& of, const Scalar* numbers) noexcept {
    for (int i = 0; i < t.coupling_count; ++i) tune_tree(t, t.couplings[i], of, numbers);
    if constexpr (Ends > 0)
      for (int i = 0; i < t.graph_count; ++i) tune_graph(t, t.graphs[i], of, numbers);
  }

  constexpr void reset() noexcept {
    for (int& sign : last_sign_) sign = 0;
  }
  constexpr void reset_brake(Scalar damping) noexcept { brake_.reset(damping); }

  Scalar step(const tables& t, Scalar change, curves& of) noexcept {
    Scalar sum = 0;
    for (int i = 0; i < t.coupling_count; ++i) {
      const tunable_coupling& c = t.couplings[i];
      sum += tree(c).step(change, of.held + c.first_block, of.elongation + c.first_block, sign_ + c.first_slip);
    }
    if constexpr (Ends > 0)
      for (int i = 0; i < t.graph_count; ++i) sum += step_graph(t, t.graphs[i], t.graphs[i].link_count, change, of);
    return sum;
  }

  // The one coupling, or graph, of a contact: the whole network.
  Scalar push(const tables& t, Scalar approach, curves& of, Scalar& change) noexcept {
    if constexpr (Ends > 0)
      if (t.graph_count > 0) {
        const Scalar force = step_graph(t, t.graphs[0], t.graphs[0].link_count + 1, approach, of);
        change = graph_.surface_change(t.graphs[0]);
        return force;
      }
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

  void keep(const tables& t) noexcept {
    for (int i = 0; i <= t.slip_count; ++i) last_sign_[i] = sign_[i];
    brake_.keep(t.slip_count);
  }

 private:
  static constexpr int room = Slips > 0 ? Slips : 1, end_room = Ends > 0 ? Ends : 1;

  static constexpr Scalar largest_finite() noexcept {
    if constexpr (sizeof(Scalar) == sizeof(float)) return 0x1.fffffep127f;
    else return 0x1.fffffffffffffp1023;
  }

  slip_tree<Scalar> tree(const tunable_coupling& c) noexcept {
    return slip_tree<Scalar>(nodes_ + c.first_node, c.node_count, parts_ + c.first_node, corners_ + c.first_corner,
                             merged_);
  }

  constexpr Scalar damping_of(const tables& t, const curves& of, const int* sign) noexcept {
    Scalar sum = 0;
    for (int i = 0; i < t.coupling_count; ++i) {
      const tunable_coupling& c = t.couplings[i];
      sum += slip_regime_feedthrough(nodes_ + c.first_node, c.node_count, of.feedthrough + c.first_block,
                                     sign + c.first_slip, parts_ + c.first_node);
    }
    if constexpr (Ends > 0)
      for (int i = 0; i < t.graph_count; ++i) {
        const tunable_graph& g = t.graphs[i];
        const int tool = t.contact.is_there ? g.end_count - 1 : g.end_count;
        sum += graph_.feedthrough(g, t.ties + g.first_tie, t.links + g.first_slip, tool, of, sign + g.first_slip);
      }
    return sum;
  }

  // From the pattern of the sample before. With a contact one link more is the tool's own.
  Scalar step_graph(const tables& t, const tunable_graph& g, int links, Scalar change, curves& of) noexcept {
    for (int k = g.first_slip; k < g.first_slip + links; ++k) sign_[k] = last_sign_[k];
    return graph_.step(g, t.ties + g.first_tie, links_ + g.first_slip, links, change, tie_stiffness_, of,
                       sign_ + g.first_slip);
  }

  constexpr void tune_graph(const tables& t, const tunable_graph& g, const curves& of, const Scalar* numbers) noexcept {
    for (int i = g.first_block; i < g.first_block + g.tie_count; ++i) tie_stiffness_[i] = bounded_stiffness(t, i, of);
    for (int k = g.first_slip; k < g.first_slip + g.link_count; ++k) {
      const Scalar yield = yield_force(t.yields[k], t.cuts, numbers);
      links_[k] = {t.links[k].from, t.links[k].to, -yield, yield};
    }
    if (t.contact.is_there) links_[t.slip_count] = {g.end_count, g.end_count - 1, 0, largest_finite()};
  }

  constexpr void tune_tree(const tables& t, const tunable_coupling& c, const curves& of,
                           const Scalar* numbers) noexcept {
    for (int k = c.first_node + c.node_count - 1; k >= c.first_node; --k) {
      slip_node<Scalar>& node = nodes_[k];
      // Member by member: a whole one may be a call of memcpy, which may not be there.
      node.kind = t.nodes[k].kind;
      node.first_child = t.nodes[k].first_child;
      node.child_count = t.nodes[k].child_count;
      node.slips = t.nodes[k].slips;
      node.place = t.nodes[k].place;
      node.first_corner = t.nodes[k].first_corner;
      if (node.kind == slip_part::slip) node.yield = yield_force(t.yields[c.first_slip + node.place], t.cuts, numbers);
      const Scalar g = end_stiffness(t, c, node, of);
      node.stiffness = g;
      node.compliance = g > 0 ? 1 / g : Scalar(0);
    }
  }

  // Curves of slips through parts that give way without end would lose their digits. A block that is made stiffer adds
  // a little damping in its place.
  static constexpr Scalar bounded_stiffness(const tables& t, int block, const curves& of) noexcept {
    const Scalar least = t.blocks[block].least_stiffness;
    return of.stiffness[block] > least ? of.stiffness[block] : least;
  }

  // With every slip giving way: in parallel the sum, in series the inverse of Σ 1/g.
  constexpr Scalar end_stiffness(const tables& t, const tunable_coupling& c, const slip_node<Scalar>& node,
                                 const curves& of) const noexcept {
    if (node.kind == slip_part::slip) return 0;
    if (node.kind == slip_part::block) return bounded_stiffness(t, c.first_block + node.place, of);
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

  static constexpr Scalar yield_force(const tunable_yield<Scalar>& yield, const int* cuts,
                                      const Scalar* numbers) noexcept {
    Scalar weakest = numbers[cuts[yield.first_cut]];
    for (int i = yield.first_cut + 1; i < yield.first_cut + yield.cut_count; ++i)
      weakest = numbers[cuts[i]] < weakest ? numbers[cuts[i]] : weakest;
    return weakest > yield.least ? weakest : yield.least;
  }

  slip_node<Scalar> nodes_[SlipParts] = {};
  slip_part_state<Scalar> parts_[SlipParts] = {};
  slip_corner<Scalar> corners_[Corners] = {}, merged_[slip_curve_room(room)] = {};
  Scalar tie_stiffness_[Blocks] = {};  // g of blocks in graphs [N/m]
  slip_link<Scalar> links_[room + 1] = {};
  tunable_slip_graph<Scalar, end_room> graph_;
  int sign_[room + 1] = {}, last_sign_[room + 1] = {}, commanded_[room] = {};
  tunable_slip_brake<Scalar, room> brake_;
};

}  // namespace dashpot
