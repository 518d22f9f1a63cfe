// Slips of a law with tunable parameters that meet in no tree: one step of dashpot::slip_network over the ends of all
// slips, with blocks between them, and what they leave to the brake.
#pragma once

#include <dashpot/slip_network.hpp>
#include <dashpot/tunable/mesh.hpp>
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

// Room for the steps of all graphs of a law in turn; what is in it does not matter between steps. `Ends`: inner ones of
// the largest graph.
template <class Scalar, int Ends>
class tunable_slip_graph {
 public:
  // In: blocks between ends, links with their yield forces, the tool's displacement in this sample [m], g of every
  // block, their π; the pattern of the sample before. Out: the force that opposes the tool [N], δ of every block, the
  // pattern.
  template <class Curves>
  constexpr Scalar step(const tunable_graph& g, const tunable_ends* ties, const slip_link<Scalar>* links,
                        int link_count, Scalar change, const Scalar* stiffness, Curves& of, int* sign) noexcept {
    gather(g, ties, stiffness, of);
    slip_network<Scalar> network(links, link_count, {between_, to_tool_, to_ground_, through_}, g.end_count,
                                 scratch_.room());
    const Scalar force = network.step(change, held_, moved_, sign);
    for (int i = 0; i < g.tie_count; ++i)
      of.elongation[g.first_block + i] = moved(g, ties[i].from, change) - moved(g, ties[i].to, change);
    return force;
  }

  // Of the last step behind a contact.
  constexpr Scalar surface_change(const tunable_graph& g) const noexcept { return moved_[g.end_count - 1]; }

  // b∞ between `tool`, one of the ends, and the ground: slips that hold join their ends, of one that slides nothing is
  // left.
  template <class Curves>
  constexpr Scalar feedthrough(const tunable_graph& g, const tunable_ends* ties, const tunable_ends* links, int tool,
                               const Curves& of, const int* sign) noexcept {
    for (int i = 0; i < g.end_count + 2; ++i) group_[i] = i;
    for (int k = 0; k < g.link_count; ++k)
      if (sign[k] == 0) join(g, group_[links[k].from], group_[links[k].to]);
    mesh_.clear(0, g.end_count);
    for (int i = 0; i < g.tie_count; ++i) {
      const int from = node(g, ties[i].from, tool), to = node(g, ties[i].to, tool);
      if (from != to) mesh_.join(0, {from, to, no_index, no_index}, of.feedthrough[g.first_block + i]);
    }
    return mesh_.eliminate(0, g.end_count);
  }

 private:
  template <class Curves>
  constexpr void gather(const tunable_graph& g, const tunable_ends* ties, const Scalar* stiffness,
                        const Curves& of) noexcept {
    for (int i = 0; i < g.end_count * g.end_count; ++i) between_[i] = 0;
    for (int i = 0; i < g.end_count; ++i) to_tool_[i] = to_ground_[i] = 0;
    for (int i = 0; i < g.end_count + 2; ++i) held_[i] = 0;
    through_ = 0;
    for (int i = 0; i < g.tie_count; ++i) {
      const int block = g.first_block + i, a = ties[i].from, b = ties[i].to;
      tie(g, a < b ? a : b, a < b ? b : a, stiffness[block]);
      held_[a] += of.held[block];
      held_[b] -= of.held[block];
    }
  }

  constexpr void tie(const tunable_graph& g, int first, int second, Scalar stiffness) noexcept {
    if (second < g.end_count) {
      between_[first * g.end_count + second] += stiffness;
      between_[second * g.end_count + first] += stiffness;
    } else if (first >= g.end_count) {
      through_ += stiffness;
    } else {
      (second == g.end_count ? to_tool_ : to_ground_)[first] += stiffness;
    }
  }

  constexpr Scalar moved(const tunable_graph& g, int end, Scalar change) const noexcept {
    return end < g.end_count ? moved_[end] : end == g.end_count ? change : Scalar(0);
  }

  // Tool and ground come last and stay what they are.
  constexpr void join(const tunable_graph& g, int a, int b) noexcept {
    const int from = a < b ? a : b, to = a < b ? b : a;
    for (int i = 0; i < g.end_count + 2; ++i)
      if (group_[i] == from) group_[i] = to;
  }

  constexpr int node(const tunable_graph& g, int end, int tool) const noexcept {
    const int group = group_[end];
    return group == tool ? mesh_port : group == g.end_count + 1 ? mesh_held : group;
  }

  Scalar between_[Ends * Ends] = {}, to_tool_[Ends] = {}, to_ground_[Ends] = {}, through_ = 0;  // g [N/m]
  Scalar held_[Ends + 2] = {};                                                                  // at every end [N]
  Scalar moved_[Ends] = {};                                                                     // [m]
  int group_[Ends + 2] = {};
  slip_network_scratch<Scalar, Ends> scratch_ = {};
  tunable_mesh<Scalar, Ends> mesh_;
};

}  // namespace dashpot
