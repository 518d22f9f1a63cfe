// The feedthrough damping b∞ of coupled slips for one pattern of those that give way (theory, section 5, "Regimes"): of
// a slip that holds rigid, of one that slides none. In parallel any rigid part makes all rigid, else dampings add up;
// in series one that slides makes all slide, rigid parts drop out, and the rest is 1/Σ 1/b.
#pragma once

#include <dashpot/slip_tree.hpp>

namespace dashpot {

// Floating-point operations at most.
template <class Scalar>
constexpr int slip_regime_operations(const slip_node<Scalar>* nodes, int count) noexcept {
  int operations = 0;
  for (int k = 0; k < count; ++k)
    operations += nodes[k].kind == slip_part::series ? 2 * nodes[k].child_count + 1 : nodes[k].child_count;
  return operations;
}

template <class Scalar>
constexpr void find_regime_in_parallel(const slip_node<Scalar>& node, slip_part_state<Scalar>* parts,
                                       slip_part_state<Scalar>& whole) noexcept {
  bool is_rigid = false, is_affine = false;
  Scalar sum = 0;
  for (int i = node.first_child; i < node.first_child + node.child_count; ++i) {
    is_rigid = is_rigid || parts[i].hold == slip_hold::rigid;
    if (parts[i].hold != slip_hold::affine) continue;
    is_affine = true;
    sum += parts[i].stiffness;
  }
  whole.hold = is_rigid ? slip_hold::rigid : is_affine ? slip_hold::affine : slip_hold::constant;
  whole.stiffness = is_rigid ? Scalar(0) : sum;
}

template <class Scalar>
constexpr void find_regime_in_series(const slip_node<Scalar>& node, slip_part_state<Scalar>* parts,
                                     slip_part_state<Scalar>& whole) noexcept {
  bool slides = false, is_affine = false, is_free = false;
  Scalar inverse = 0;
  for (int i = node.first_child; i < node.first_child + node.child_count; ++i) {
    slides = slides || parts[i].hold == slip_hold::constant;
    if (parts[i].hold != slip_hold::affine) continue;
    is_affine = true;
    is_free = is_free || !(parts[i].stiffness > Scalar(0));
    if (parts[i].stiffness > Scalar(0)) inverse += Scalar(1) / parts[i].stiffness;
  }
  whole.hold = slides ? slip_hold::constant : is_affine ? slip_hold::affine : slip_hold::rigid;
  whole.stiffness = slides || !is_affine || is_free ? Scalar(0) : Scalar(1) / inverse;
}

// In: b∞ of every block by its place [N·s/m], for every slip 0 where it holds. What is in `parts` is lost.
template <class Scalar>
constexpr Scalar slip_regime_feedthrough(const slip_node<Scalar>* nodes, int count, const Scalar* feedthrough,
                                         const int* sign, slip_part_state<Scalar>* parts) noexcept {
  for (int k = count - 1; k >= 0; --k) {
    const slip_node<Scalar>& node = nodes[k];
    slip_part_state<Scalar>& part = parts[k];
    if (node.kind == slip_part::parallel) find_regime_in_parallel(node, parts, part);
    if (node.kind == slip_part::series) find_regime_in_series(node, parts, part);
    if (node.kind == slip_part::slip) part.hold = sign[node.place] == 0 ? slip_hold::rigid : slip_hold::constant;
    if (node.kind == slip_part::block) part.hold = slip_hold::affine;
    if (node.child_count == 0) part.stiffness = node.kind == slip_part::block ? feedthrough[node.place] : Scalar(0);
  }
  return parts[0].hold == slip_hold::affine ? parts[0].stiffness : Scalar(0);
}

}  // namespace dashpot
