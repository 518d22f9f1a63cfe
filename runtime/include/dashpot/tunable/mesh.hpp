// Springs and dampers between inner nodes, eliminated node after node from star to mesh:
//     g_jk += g_ij g_ik / Σ g_i
// Conductances are only added, multiplied and divided, never subtracted: nothing cancels, at any ratio of values, and a
// node that nothing holds is seen exactly.
#pragma once

#include <dashpot/tunable/tables.hpp>

namespace dashpot {

// Room for the nodes of all meshes of a law.
template <class Scalar, int Nodes>
class tunable_mesh {
 public:
  constexpr void clear(int first, int count) noexcept {
    for (int i = first; i < first + count; ++i) {
      to_port_[i] = to_held_[i] = inverse_[i] = next_to_port_[i] = next_to_held_[i] = 0;
      for (int j = first; j < first + count; ++j) weight_[i][j] = next_[i][j] = 0;
    }
    through_ = next_through_ = 0;
  }

  // A conductance between two nodes or ends; `next` is what it grows by with s, where that matters.
  constexpr void join(int first, const tunable_edge& edge, Scalar conductance, Scalar next = 0) noexcept {
    const int low = edge.from < edge.to ? edge.from : edge.to, high = edge.from < edge.to ? edge.to : edge.from;
    if (low >= 0) return add(weight_[first + low][first + high], conductance, next_[first + low][first + high], next);
    if (high < 0) return add(through_, conductance, next_through_, next);
    if (low == mesh_port) return add(to_port_[first + high], conductance, next_to_port_[first + high], next);
    add(to_held_[first + high], conductance, next_to_held_[first + high], next);
  }

  // Ready for rest() and spread(). Returns the conductance from port to held end.
  constexpr Scalar eliminate(int first, int count) noexcept {
    for (int i = first; i < first + count; ++i) {
      Scalar pivot = to_port_[i] + to_held_[i];
      for (int j = i + 1; j < first + count; ++j) pivot += weight_[i][j];
      const Scalar inverse = pivot > 0 ? 1 / pivot : Scalar(0);
      inverse_[i] = inverse - inverse == 0 ? inverse : Scalar(0);
      for (int j = i + 1; j < first + count; ++j) {
        const Scalar share = weight_[i][j] * inverse_[i];
        for (int k = j + 1; k < first + count; ++k) weight_[j][k] += share * weight_[i][k];
        to_port_[j] += share * to_port_[i];
        to_held_[j] += share * to_held_[i];
      }
      through_ += to_port_[i] * inverse_[i] * to_held_[i];
      for (int j = i + 1; j < first + count; ++j) weight_[i][j] *= inverse_[i];
      to_port_[i] *= inverse_[i];
    }
    return through_;
  }

  // The same with conductances g + s n as s goes to 0. Returns n from port to held end.
  constexpr Scalar eliminate_to_first_order(int first, int count) noexcept {
    for (int i = first; i < first + count; ++i) {
      Scalar pivot = to_port_[i] + to_held_[i], next = next_to_port_[i] + next_to_held_[i];
      for (int j = i + 1; j < first + count; ++j) {
        pivot += weight_[i][j];
        next += next_[i][j];
      }
      for (int j = i + 1; j < first + count; ++j) {
        for (int k = j + 1; k < first + count; ++k)
          bridge({weight_[i][j], next_[i][j]}, {weight_[i][k], next_[i][k]}, {pivot, next}, weight_[j][k], next_[j][k]);
        bridge({weight_[i][j], next_[i][j]}, {to_port_[i], next_to_port_[i]}, {pivot, next}, to_port_[j],
               next_to_port_[j]);
        bridge({weight_[i][j], next_[i][j]}, {to_held_[i], next_to_held_[i]}, {pivot, next}, to_held_[j],
               next_to_held_[j]);
      }
      bridge({to_port_[i], next_to_port_[i]}, {to_held_[i], next_to_held_[i]}, {pivot, next}, through_, next_through_);
    }
    return next_through_;
  }

  constexpr void release(int first, int count) noexcept {
    for (int i = first; i < first + count; ++i) push_[i] = 0;
  }

  // A spring's force pulls its ends together. Returns its part of the force at the port.
  constexpr Scalar pull(int first, const tunable_edge& edge, Scalar force) noexcept {
    if (edge.from >= 0) push_[first + edge.from] -= force;
    if (edge.to >= 0) push_[first + edge.to] += force;
    return edge.from == mesh_port ? force : edge.to == mesh_port ? -force : Scalar(0);
  }

  // What the pushes come to at the port while it does not move.
  constexpr Scalar rest(int first, int count) noexcept {
    Scalar force = 0;
    for (int i = first; i < first + count; ++i) {
      for (int j = i + 1; j < first + count; ++j) push_[j] += weight_[i][j] * push_[i];
      force -= to_port_[i] * push_[i];
    }
    return force;
  }

  // How far every node moves with the port, after rest().
  constexpr void spread(int first, int count, Scalar change) noexcept {
    for (int i = first + count - 1; i >= first; --i) {
      Scalar moved = inverse_[i] * push_[i] + to_port_[i] * change;
      for (int j = i + 1; j < first + count; ++j) moved += weight_[i][j] * moved_[j];
      moved_[i] = moved;
    }
  }

  constexpr Scalar elongation(int first, const tunable_edge& edge, Scalar change) const noexcept {
    return moved(first, edge.from, change) - moved(first, edge.to, change);
  }

 private:
  struct first_order {
    Scalar lead, next;
  };

  static constexpr void add(Scalar& lead, Scalar conductance, Scalar& next_lead, Scalar next) noexcept {
    lead += conductance;
    next_lead += next;
  }

  // a b/p to first order. Where p has no lead neither a nor b has one.
  static constexpr void bridge(first_order a, first_order b, first_order p, Scalar& lead, Scalar& next) noexcept {
    if (p.lead > 0) {
      const Scalar ratio = b.lead / p.lead;
      lead += a.lead * ratio;
      next += a.next * ratio + a.lead / p.lead * (b.next - ratio * p.next);
    } else if (p.next > 0) {
      next += a.next * (b.next / p.next);
    }
  }

  constexpr Scalar moved(int first, int node, Scalar change) const noexcept {
    return node >= 0 ? moved_[first + node] : node == mesh_port ? change : Scalar(0);
  }

  Scalar weight_[Nodes][Nodes] = {};  // above the diagonal; g_ij, then g_ij/Σ g_i
  Scalar next_[Nodes][Nodes] = {};
  Scalar to_port_[Nodes] = {}, next_to_port_[Nodes] = {};
  Scalar to_held_[Nodes] = {}, next_to_held_[Nodes] = {};
  Scalar inverse_[Nodes] = {};  // 1/Σ g_i, 0 where nothing holds the node
  Scalar push_[Nodes] = {};     // forces on the nodes [N]
  Scalar moved_[Nodes] = {};    // [m]
  Scalar through_ = 0, next_through_ = 0;
};

}  // namespace dashpot
