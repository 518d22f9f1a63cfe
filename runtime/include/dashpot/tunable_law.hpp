// A law whose parameters change while it runs. Emitted code and the compiler's evaluate() run this same class, so that they
// agree in every bit under -ffp-contract=off.
//
// The states are elongations z of springs, and how far from home each one's rest length is, the offset r: a spring's force is
// k (z − r). A change of parameters leaves the forces alone and moves the offsets, as far as energy allows (energy_tank.hpp);
// with every sample the offsets then go home by a part of the way, where the tank pays for it. V + T never rises by more than
// the work that the tool does.
//
// No heap, no recursion, no division but in set(), in reset() and between coupled slips; every loop is bounded by the tables.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/exponential.hpp>
#include <dashpot/slip_regime.hpp>
#include <dashpot/slip_tree.hpp>
#include <dashpot/tunable/energy_tank.hpp>
#include <dashpot/tunable/mesh.hpp>
#include <dashpot/tunable/sample.hpp>
#include <dashpot/tunable/slip_brake.hpp>
#include <dashpot/tunable/tables.hpp>

namespace dashpot {

// Sizes are those of the tables, at least 1 each but for `Slips`. `SlipParts` and `Corners` are those of all couplings
// together.
template <class Scalar, int Tunables, int Springs, int Nodes, int Blocks, int SlipParts, int Slips, int Corners>
class tunable_law {
 public:
  using tables = tunable_tables<Scalar>;

  // All members get `t`, the tables that the law was made with.
  explicit constexpr tunable_law(const tables& t) noexcept {
    for (int i = 0; i < node_count(t); ++i) slip_nodes_[i] = t.nodes[i];
    for (int i = 0; i < t.tunable_count; ++i) values_[i] = t.tunables[i].max;
    tune(t);
    for (int i = 0; i < t.block_count; ++i) least_stiffness_[i] = t.least_share * block_stiffness_[i];
    for (int i = 0; i < t.slip_count; ++i) least_yield_[i] = t.least_share * yield_force(t, i);
    for (int i = 0; i < t.tunable_count; ++i) values_[i] = t.tunables[i].value;
    tune(t);
    find_held(t);
    if constexpr (Slips > 0) slip_brake_.reset(regime_damping(t, held_signs()));
  }

  // At rest at `position`: what joins tool and ground is loaded by it, what is behind a slip is not.
  constexpr void reset(const tables& t, Scalar position) noexcept {
    for (int i = 0; i < t.spring_count; ++i) elongation_[i] = offset_[i] = 0;
    for (int i = 0; i < Blocks; ++i) block_elongation_[i] = 0;
    tank_ = 0;
    is_owing_ = false;
    if (t.static_spring != no_index) elongation_[t.static_spring] = position;
    each_part(t, t.blocks[0], [&](const tunable_part<Scalar>& part) {
      if (part.kind == tunable_kind::mesh) load(t, part, position);
    });
    find_held(t);
    if constexpr (Slips > 0) slip_brake_.reset(regime_damping(t, held_signs()));
  }

  // b of a tool that is in touch and at rest [N·s/m].
  constexpr Scalar damping_at_rest(const tables& t) noexcept {
    if (t.contact.is_there) return 0;
    Scalar damping = damping_;
    if constexpr (Slips > 0) damping += regime_damping(t, held_signs());
    return damping;
  }

  // In: where the tool, or the surface that it pushes, was in the sample before; where the tool is, and its velocity.
  tunable_sample<Scalar> output(const tables& t, Scalar last, Scalar position, Scalar velocity) noexcept {
    tunable_answer<Scalar> answer = {0, velocity_gain_, damping_};
    if (!t.contact.is_there) {
      const Scalar change = position - last;
      answer.opposing = step_stiffness_ * change + held_[0];
      if constexpr (Slips > 0) {
        answer.opposing += slip_force(t, change);
        leave_to_brake(t, change, position, answer);
      }
      return held_sample(change, position, velocity, answer);
    }
    const Scalar depth = position - t.contact.at, approach = depth - last;
    Scalar change = -(held_[0] * release_compliance_);
    if (!(change > approach)) change = approach;
    if (t.coupling_count == 0) answer.opposing = step_stiffness_ * change + held_[0];
    if constexpr (Slips > 0)
      if (t.coupling_count > 0) {
        answer.opposing = pushed_force(t, approach, change) - feedthrough_ * t.rate * change;
        leave_to_brake(t, change, position, answer);
      }
    return touching_sample(t.contact, t.threshold, last, depth, change, velocity, answer);
  }

  // Takes the states over the sample that output() has seen last, by its change and to its position.
  void update(const tables& t, Scalar change, Scalar position) noexcept {
    block_elongation_[0] = change;
    for (int i = 0; i < t.block_count; ++i)
      each_part(t, t.blocks[i], [&](const tunable_part<Scalar>& part) { advance(t, part, block_elongation_[i]); });
    if (t.static_spring != no_index) elongation_[t.static_spring] = position;
    if (is_owing_) bring_offsets_home(t);
    if constexpr (Slips > 0) slip_brake_.keep(t.slip_count);
    find_held(t);
  }

  // Bit i of the result: wanted[i] was no number within the range. What is no number at all leaves its parameter as it is.
  // Where nothing changes, no bit of the states does. To be called between samples.
  constexpr unsigned set(const tables& t, const Scalar* wanted) noexcept {
    unsigned clamped = 0;
    bool is_new = false;
    for (int i = 0; i < t.tunable_count; ++i) {
      const Scalar value = within(t.tunables[i], wanted[i], values_[i]);
      if (!(value == wanted[i])) clamped |= 1u << i;
      if (value != values_[i]) is_new = true;
      values_[i] = value;
    }
    if (!is_new) return clamped;
    for (int i = 0; i < t.spring_count; ++i) changes_[i] = {stiffness_[i], 0, force_of(i), 0};
    tune(t);
    for (int i = 0; i < t.spring_count; ++i) changes_[i].new_stiffness = stiffness_[i];
    change_springs(t);
    find_held(t);
    return clamped;
  }

  // V + T [J]
  Scalar stored_energy(const tables& t) const noexcept {
    Scalar energy = tank_;
    for (int i = 0; i < t.spring_count; ++i) energy += force_of(i) * (elongation_[i] - offset_[i]) * Scalar(0.5);
    return energy;
  }

  Scalar value(int tunable) const noexcept { return values_[tunable]; }

 private:
  static constexpr int slip_room = Slips > 0 ? Slips : 1;

  Scalar slip_force(const tables& t, Scalar change) noexcept {
    Scalar sum = 0;
    for (int i = 0; i < t.coupling_count; ++i) {
      const tunable_coupling& c = t.couplings[i];
      slip_tree<Scalar> tree(slip_nodes_ + c.first_node, c.node_count, slip_parts_ + c.first_node, corners_ + c.first_corner, merged_);
      sum += tree.step(change, held_ + c.first_block, block_elongation_ + c.first_block, sign_ + c.first_slip);
    }
    return sum;
  }

  // The one coupling of a contact: the whole network.
  Scalar pushed_force(const tables& t, Scalar approach, Scalar& change) noexcept {
    const tunable_coupling& c = t.couplings[0];
    slip_tree<Scalar> tree(slip_nodes_, c.node_count, slip_parts_, corners_, merged_);
    return tree.push(approach, held_ + c.first_block, block_elongation_ + c.first_block, sign_, change);
  }

  constexpr const int* held_signs() noexcept {
    for (int i = 0; i < slip_room; ++i) commanded_[i] = 0;
    return commanded_;
  }

  // b∞ of all that is behind slips, within what the brake has left.
  constexpr Scalar regime_damping(const tables& t, const int* sign) noexcept {
    if (!t.slip_rule.takes_part) return 0;
    Scalar sum = 0;
    for (int i = 0; i < t.coupling_count; ++i) {
      const tunable_coupling& c = t.couplings[i];
      sum += slip_regime_feedthrough(slip_nodes_ + c.first_node, c.node_count, block_feedthrough_ + c.first_block, sign + c.first_slip,
                                     slip_parts_ + c.first_node);
    }
    const Scalar left = t.max_damping - damping_;
    return sum < left ? sum : left;
  }

  void leave_to_brake(const tables& t, Scalar change, Scalar position, tunable_answer<Scalar>& answer) noexcept {
    if (!t.slip_rule.takes_part) return;
    answer.opposing -= regime_damping(t, sign_) * t.rate * change;
    slip_brake_.follow(t.slip_rule, t.slip_count, sign_, position, commanded_);
    const Scalar wanted = regime_damping(t, commanded_), damping = slip_brake_.damping(t.slip_rule, wanted);
    answer.damping += damping;
    if (!t.contact.is_there) answer.gain += clamp_to(make_up_, wanted - damping);
  }

  template <class Visit>
  static constexpr void each_part(const tables& t, const tunable_block& block, Visit visit) noexcept {
    for (int i = block.first_part; i < block.first_part + block.part_count; ++i) visit(t.parts[i]);
  }

  static constexpr int node_count(const tables& t) noexcept {
    int count = 0;
    for (int i = 0; i < t.coupling_count; ++i) count += t.couplings[i].node_count;
    return count;
  }

  static constexpr Scalar within(const tunable_range<Scalar>& range, Scalar wanted, Scalar present) noexcept {
    if (wanted != wanted) return present;
    return wanted < range.min ? range.min : wanted > range.max ? range.max : wanted;
  }

  constexpr Scalar number(const tables& t, int index) const noexcept {
    const tunable_number<Scalar>& n = t.numbers[index];
    Scalar sum = n.base;
    for (int i = n.first; i < n.first + n.count; ++i) sum += values_[t.terms[i]];
    return sum;
  }

  constexpr Scalar force_of(int spring) const noexcept { return stiffness_[spring] * (elongation_[spring] - offset_[spring]); }

  // Everything that follows from the parameters.
  constexpr void tune(const tables& t) noexcept {
    for (int i = 0; i < t.spring_count; ++i) stiffness_[i] = number(t, t.springs[i]);
    tune_brake(t);
    for (int i = 0; i < t.block_count; ++i) block_feedthrough_[i] = i == 0 ? Scalar(0) : feedthrough_of(t, t.blocks[i]);
    // Last, so that every mesh is left as the steps need it.
    for (int i = 0; i < t.block_count; ++i) {
      Scalar stiffness = 0;
      each_part(t, t.blocks[i], [&](const tunable_part<Scalar>& part) { stiffness += step_stiffness(t, part); });
      block_stiffness_[i] = stiffness;
    }
    release_compliance_ = block_stiffness_[0] > 0 ? 1 / block_stiffness_[0] : Scalar(0);
    step_stiffness_ = 0;
    each_part(t, t.blocks[0], [&](const tunable_part<Scalar>& part) { step_stiffness_ += step_stiffness_at_port(t, part); });
    for (int i = 0; i < t.coupling_count; ++i) tune_slips(t, t.couplings[i]);
  }

  constexpr Scalar feedthrough_of(const tables& t, const tunable_block& block) noexcept {
    Scalar sum = 0;
    each_part(t, block, [&](const tunable_part<Scalar>& part) {
      if (part.kind == tunable_kind::damper) sum += number(t, part.damping);
      if (part.kind == tunable_kind::mesh) sum += eliminate(t, part, 0, 1);
    });
    return sum;
  }

  // g = dp/dδ of a part over a sample.
  constexpr Scalar step_stiffness(const tables& t, const tunable_part<Scalar>& part) noexcept {
    switch (part.kind) {
      case tunable_kind::spring: return stiffness_[part.spring];
      case tunable_kind::damper: return number(t, part.damping) * t.rate;
      case tunable_kind::relaxation: tune_relaxation(t, part); break;
      case tunable_kind::fixed_relaxation:
        share_[part.spring] = part.share;
        loss_[part.spring] = part.loss;
        break;
      case tunable_kind::mesh: return eliminate(t, part, 1, t.rate);
    }
    return stiffness_[part.spring] * share_[part.spring];
  }

  // b∞ is taken out: it acts through the velocity.
  constexpr Scalar step_stiffness_at_port(const tables& t, const tunable_part<Scalar>& part) noexcept {
    if (part.kind == tunable_kind::damper) return 0;
    const Scalar through = part.kind == tunable_kind::mesh ? eliminate(t, part, 0, t.rate) : Scalar(0);
    return step_stiffness(t, part) - through;
  }

  // z ← z + φ δ − α z with x = k h/B, α = x φ. Exact φ = (1 − e^(−x))/x; backward Euler φ = 1/(1 + x).
  constexpr void tune_relaxation(const tables& t, const tunable_part<Scalar>& part) noexcept {
    const Scalar stiffness = stiffness_[part.spring], damping = number(t, part.damping);
    // Division by zero, and infinity, are no constant expressions: a damper of nothing leaves nothing of the spring by itself.
    if (stiffness > 0 && !(damping > 0)) {
      share_[part.spring] = 0;
      loss_[part.spring] = 1;
      return;
    }
    const Scalar x = stiffness > 0 ? stiffness * t.period / damping : Scalar(0);
    const Scalar share = t.is_exact ? mean_decay(x) : 1 / (1 + x);
    share_[part.spring] = share;
    loss_[part.spring] = x - x == 0 ? x * share : Scalar(1);
  }

  constexpr Scalar eliminate(const tables& t, const tunable_part<Scalar>& part, Scalar per_stiffness, Scalar per_damping) noexcept {
    mesh_.clear(part.first_node, part.node_count);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
      const tunable_edge& edge = t.edges[i];
      mesh_.join(part.first_node, edge, edge.spring != no_index ? per_stiffness * stiffness_[edge.spring] : per_damping * number(t, edge.damping));
    }
    return mesh_.eliminate(part.first_node, part.node_count);
  }

  // The viscosity of a mesh at low frequency: the second term of K + s B seen at the port, as s goes to 0.
  constexpr Scalar viscosity(const tables& t, const tunable_part<Scalar>& part) noexcept {
    mesh_.clear(part.first_node, part.node_count);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
      const tunable_edge& edge = t.edges[i];
      const bool is_spring = edge.spring != no_index;
      mesh_.join(part.first_node, edge, is_spring ? stiffness_[edge.spring] : Scalar(0), is_spring ? Scalar(0) : number(t, edge.damping));
    }
    const Scalar found = mesh_.eliminate_to_first_order(part.first_node, part.node_count);
    return found > 0 ? found : Scalar(0);
  }

  constexpr void tune_brake(const tables& t) noexcept {
    feedthrough_ = 0;
    Scalar relaxing = 0;
    each_part(t, t.blocks[0], [&](const tunable_part<Scalar>& part) {
      if (part.kind == tunable_kind::damper) feedthrough_ += number(t, part.damping);
      if (part.kind == tunable_kind::relaxation || part.kind == tunable_kind::fixed_relaxation) relaxing += number(t, part.damping);
      if (part.kind != tunable_kind::mesh) return;
      const Scalar through = eliminate(t, part, 0, 1);
      feedthrough_ += through;
      relaxing += viscosity(t, part) - through;
    });
    const Scalar wanted = brake_damping(t, feedthrough_ + relaxing);
    damping_ = wanted < t.max_damping ? wanted : t.max_damping;
    // Where a surface can be left the motor compensates nothing.
    if (t.contact.is_there && damping_ > feedthrough_) damping_ = feedthrough_;
    velocity_gain_ = feedthrough_ - damping_;
    const Scalar assured = t.slip_rule.assured_share * damping_ - (velocity_gain_ < 0 ? -velocity_gain_ : velocity_gain_);
    make_up_ = assured > 0 ? assured : Scalar(0);
  }

  constexpr Scalar brake_damping(const tables& t, Scalar zero_frequency) const noexcept {
    switch (t.rule) {
      case brake_rule::constant: break;
      case brake_rule::observed: return number(t, t.observed);
      case brake_rule::zero_frequency: return zero_frequency;
      case brake_rule::half_zero_frequency: return zero_frequency / 2 > feedthrough_ ? zero_frequency / 2 : feedthrough_;
      case brake_rule::feedthrough: return feedthrough_;
      case brake_rule::within_viscosity: return zero_frequency < t.damping ? zero_frequency : t.damping;
    }
    return t.damping;
  }

  constexpr void tune_slips(const tables& t, const tunable_coupling& c) noexcept {
    for (int k = c.first_node + c.node_count - 1; k >= c.first_node; --k) {
      slip_node<Scalar>& node = slip_nodes_[k];
      if (node.kind == slip_part::slip) node.yield = yield_force(t, c.first_slip + node.place);
      const Scalar g = end_stiffness(c, node);
      node.stiffness = g;
      node.compliance = g > 0 ? 1 / g : Scalar(0);
    }
  }

  // A block that is made softer than the least adds a little damping in its place: curves of slips through parts that give way
  // without end would lose their digits.
  //
  // With every slip giving way: in parallel the sum, in series the inverse of Σ 1/g.
  constexpr Scalar end_stiffness(const tunable_coupling& c, const slip_node<Scalar>& node) const noexcept {
    if (node.kind == slip_part::slip) return 0;
    if (node.kind == slip_part::block) {
      const int block = c.first_block + node.place;
      return block_stiffness_[block] > least_stiffness_[block] ? block_stiffness_[block] : least_stiffness_[block];
    }
    Scalar sum = 0, compliance = 0;
    bool is_flat = false;
    for (int i = node.first_child; i < node.first_child + node.child_count; ++i) {
      const slip_node<Scalar>& child = slip_nodes_[c.first_node + i];
      sum += child.stiffness;
      compliance += child.compliance;
      is_flat = is_flat || child.stiffness == Scalar(0);
    }
    return node.kind == slip_part::parallel ? sum : is_flat ? Scalar(0) : 1 / compliance;
  }

  constexpr Scalar yield_force(const tables& t, int slip) const noexcept {
    const tunable_yield& yield = t.yields[slip];
    Scalar least = number(t, t.cuts[yield.first_cut]);
    for (int i = yield.first_cut + 1; i < yield.first_cut + yield.cut_count; ++i) {
      const Scalar sum = number(t, t.cuts[i]);
      least = sum < least ? sum : least;
    }
    return least > least_yield_[slip] ? least : least_yield_[slip];
  }

  // p = g δ + π: π of every block, and what its meshes need to be spread.
  constexpr void find_held(const tables& t) noexcept {
    for (int i = 0; i < t.block_count; ++i) {
      Scalar held = 0;
      each_part(t, t.blocks[i], [&](const tunable_part<Scalar>& part) { held += held_by(t, part); });
      held_[i] = held;
    }
  }

  constexpr Scalar held_by(const tables& t, const tunable_part<Scalar>& part) noexcept {
    if (part.kind == tunable_kind::damper) return 0;
    if (part.kind == tunable_kind::spring) return force_of(part.spring);
    if (part.kind != tunable_kind::mesh) return force_of(part.spring) - stiffness_[part.spring] * (loss_[part.spring] * elongation_[part.spring]);
    Scalar force = 0;
    mesh_.release(part.first_node, part.node_count);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i)
      if (t.edges[i].spring != no_index) force += mesh_.pull(part.first_node, t.edges[i], force_of(t.edges[i].spring));
    return force + mesh_.rest(part.first_node, part.node_count);
  }

  void advance(const tables& t, const tunable_part<Scalar>& part, Scalar change) noexcept {
    if (part.kind == tunable_kind::damper) return;
    if (part.kind == tunable_kind::mesh) return advance_mesh(t, part, change);
    Scalar& z = elongation_[part.spring];
    if (part.kind == tunable_kind::spring)
      z = flush_below(t.threshold, z + change);
    else
      z = flush_below(t.threshold, z + (share_[part.spring] * change - loss_[part.spring] * z));
  }

  constexpr void advance_mesh(const tables& t, const tunable_part<Scalar>& part, Scalar change) noexcept {
    mesh_.spread(part.first_node, part.node_count, change);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
      const tunable_edge& edge = t.edges[i];
      if (edge.spring == no_index) continue;
      elongation_[edge.spring] = flush_below(t.threshold, elongation_[edge.spring] + mesh_.elongation(part.first_node, edge, change));
    }
  }

  // The dampers rest, the springs alone carry the load.
  constexpr void load(const tables& t, const tunable_part<Scalar>& part, Scalar position) noexcept {
    eliminate(t, part, 1, 0);
    mesh_.release(part.first_node, part.node_count);
    mesh_.rest(part.first_node, part.node_count);
    advance_mesh(t, part, position);
    eliminate(t, part, 1, t.rate);
  }

  constexpr void change_springs(const tables& t) noexcept {
    tank_ = carry_forces_over(changes_, t.spring_count, tank_);
    if (t.static_spring != no_index) {
      Scalar missing = 0;
      each_part(t, t.blocks[0], [&](const tunable_part<Scalar>& part) {
        if (part.spring != no_index) missing += changes_[part.spring].force - changes_[part.spring].new_force;
      });
      if (missing != 0) tank_ = make_up(changes_[t.static_spring], missing, tank_);
    }
    for (int i = 0; i < t.part_count; ++i) take_forces(t, t.parts[i]);
  }

  // In a relaxation the damper makes room, of a loose spring the slip; of other springs the offset does.
  constexpr void take_forces(const tables& t, const tunable_part<Scalar>& part) noexcept {
    if (part.kind == tunable_kind::spring && !part.is_loose) return move_offset(part.spring);
    if (part.spring != no_index && is_changed(part.spring)) {
      const spring_change<Scalar>& change = changes_[part.spring];
      elongation_[part.spring] = change.new_stiffness > 0 ? change.new_force / change.new_stiffness : Scalar(0);
    }
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i)
      if (t.edges[i].spring != no_index) move_offset(t.edges[i].spring);
  }

  constexpr bool is_changed(int spring) const noexcept {
    return changes_[spring].new_stiffness != changes_[spring].stiffness || changes_[spring].new_force != changes_[spring].force;
  }

  // r = z − F/k; what is no more than rounding of z is none.
  constexpr void move_offset(int spring) noexcept {
    if (!is_changed(spring)) return;
    const spring_change<Scalar>& change = changes_[spring];
    const Scalar z = elongation_[spring];
    const Scalar offset = change.new_stiffness > 0 ? z - change.new_force / change.new_stiffness : Scalar(0);
    offset_[spring] = z + offset / 4 == z ? Scalar(0) : offset;
    is_owing_ = is_owing_ || offset_[spring] != 0;
  }

  void bring_offsets_home(const tables& t) noexcept {
    is_owing_ = false;
    for (int i = 0; i < t.spring_count; ++i) {
      const Scalar before = offset_[i], after = flush_below(t.threshold, t.retention * before);
      if (before == 0) continue;
      const Scalar z = elongation_[i];
      const Scalar cost = stiffness_[i] * (before - after) * ((z - after) + (z - before)) * Scalar(0.5);
      if (cost <= tank_) {
        tank_ -= cost;
        offset_[i] = after;
      }
      is_owing_ = is_owing_ || offset_[i] != 0;
    }
  }

  Scalar values_[Tunables] = {};
  Scalar stiffness_[Springs] = {};         // k [N/m]
  Scalar share_[Springs] = {};             // φ of a relaxation [1]
  Scalar loss_[Springs] = {};              // α of a relaxation [1]
  Scalar block_stiffness_[Blocks] = {};    // g [N/m]
  Scalar least_stiffness_[Blocks] = {}, least_yield_[slip_room] = {};
  Scalar step_stiffness_ = 0;              // g of block 0 without b∞/h [N/m]
  Scalar feedthrough_ = 0, damping_ = 0, velocity_gain_ = 0;  // b∞, b, b∞ − b, without slips [N·s/m]
  Scalar block_feedthrough_[Blocks] = {};  // b∞; 0 of block 0, whose is the above [N·s/m]
  Scalar release_compliance_ = 0;          // 1/g of block 0 [m/N]
  Scalar make_up_ = 0;                     // of b that the motor makes up at most [N·s/m]
  slip_node<Scalar> slip_nodes_[SlipParts] = {};

  Scalar elongation_[Springs] = {};        // z [m]
  Scalar offset_[Springs] = {};            // r [m]
  Scalar held_[Blocks] = {};               // π [N]
  Scalar tank_ = 0;                        // T [J]
  bool is_owing_ = false;                  // some offset is not home

  Scalar block_elongation_[Blocks] = {};   // δ in this sample [m]
  tunable_mesh<Scalar, Nodes> mesh_;
  spring_change<Scalar> changes_[Springs] = {};
  slip_part_state<Scalar> slip_parts_[SlipParts] = {};
  slip_corner<Scalar> corners_[Corners] = {}, merged_[slip_curve_room(slip_room)] = {};
  int sign_[slip_room] = {}, commanded_[slip_room] = {};
  tunable_slip_brake<Scalar, slip_room> slip_brake_;
};

}  // namespace dashpot
