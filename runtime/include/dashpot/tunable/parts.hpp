// The linear parts of a law with tunable parameters: what follows for each from the parameters' values, and its states.
#pragma once

#include <dashpot/exponential.hpp>
#include <dashpot/tunable/mesh.hpp>
#include <dashpot/tunable/springs.hpp>
#include <dashpot/tunable/tables.hpp>
#include <dashpot/tunable/values.hpp>

namespace dashpot {

template <class Scalar, int Tunables, int Springs, int Nodes>
class tunable_parts {
 public:
  using tables = tunable_tables<Scalar>;
  using part_type = tunable_part<Scalar>;

  tunable_values<Scalar, Tunables> values;
  tunable_springs<Scalar, Springs> springs;

  constexpr Scalar number(const tables& t, int index) const noexcept { return values.number(t, index); }

  template <class Visit>
  static constexpr void each(const tables& t, const tunable_block& block, Visit visit) noexcept {
    for (int i = block.first_part; i < block.first_part + block.part_count; ++i) visit(t.parts[i]);
  }

  constexpr void find_stiffnesses(const tables& t) noexcept {
    for (int i = 0; i < t.spring_count; ++i) springs.set_stiffness(i, number(t, t.springs[i]));
  }

  // b∞ [N·s/m]
  constexpr Scalar feedthrough(const tables& t, const part_type& part) noexcept {
    if (part.kind == tunable_kind::damper) return number(t, part.damping);
    return part.kind == tunable_kind::mesh ? eliminate(t, part, 0, 1) : Scalar(0);
  }

  // What it has at low frequency beyond `through`, its b∞ [N·s/m].
  constexpr Scalar relaxing_damping(const tables& t, const part_type& part, Scalar through) noexcept {
    if (part.kind == tunable_kind::relaxation || part.kind == tunable_kind::fixed_relaxation)
      return number(t, part.damping);
    return part.kind == tunable_kind::mesh ? viscosity(t, part) - through : Scalar(0);
  }

  // g = dp/dδ over a sample [N/m]. Leaves a mesh as the steps need it.
  constexpr Scalar step_stiffness(const tables& t, const part_type& part) noexcept {
    switch (part.kind) {
      case tunable_kind::spring: return springs.stiffness(part.spring);
      case tunable_kind::damper: return number(t, part.damping) * t.rate;
      case tunable_kind::relaxation: tune_relaxation(t, part); break;
      case tunable_kind::fixed_relaxation:
        share_[part.spring] = part.share;
        loss_[part.spring] = part.loss;
        break;
      case tunable_kind::mesh: return eliminate(t, part, 1, t.rate);
    }
    return springs.stiffness(part.spring) * share_[part.spring];
  }

  // b∞ is taken out: it acts through the velocity.
  constexpr Scalar step_stiffness_at_port(const tables& t, const part_type& part) noexcept {
    if (part.kind == tunable_kind::damper) return 0;
    const Scalar through = part.kind == tunable_kind::mesh ? eliminate(t, part, 0, t.rate) : Scalar(0);
    return step_stiffness(t, part) - through;
  }

  // π, and what a mesh needs to be spread.
  constexpr Scalar held_by(const tables& t, const part_type& part) noexcept {
    if (part.kind == tunable_kind::damper) return 0;
    if (part.kind == tunable_kind::spring) return springs.force(part.spring);
    if (part.kind != tunable_kind::mesh)
      return springs.force(part.spring) -
             springs.stiffness(part.spring) * (loss_[part.spring] * springs.elongation(part.spring));
    Scalar force = 0;
    mesh_.release(part.first_node, part.node_count);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i)
      if (t.edges[i].spring != no_index)
        force += mesh_.pull(part.first_node, t.edges[i], springs.force(t.edges[i].spring));
    return force + mesh_.rest(part.first_node, part.node_count);
  }

  constexpr void advance(const tables& t, const part_type& part, Scalar change) noexcept {
    if (part.kind == tunable_kind::damper) return;
    if (part.kind == tunable_kind::mesh) return advance_mesh(t, part, change);
    if (part.kind == tunable_kind::spring) return springs.stretch(part.spring, change, t.threshold);
    springs.stretch(part.spring, share_[part.spring] * change - loss_[part.spring] * springs.elongation(part.spring),
                    t.threshold);
  }

  // The dampers of a mesh rest, its springs alone carry the load.
  constexpr void load(const tables& t, const part_type& part, Scalar position) noexcept {
    if (part.kind != tunable_kind::mesh) return;
    eliminate(t, part, 1, 0);
    mesh_.release(part.first_node, part.node_count);
    mesh_.rest(part.first_node, part.node_count);
    advance_mesh(t, part, position);
    eliminate(t, part, 1, t.rate);
  }

  // In a relaxation the damper makes room, of a loose spring the slip; of other springs the offset does.
  constexpr void take_forces(const tables& t, const part_type& part) noexcept {
    if (is_between_tool_and_ground(part)) return springs.move_offset(part.spring);
    if (part.spring != no_index) springs.move_end(part.spring);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i)
      if (t.edges[i].spring != no_index) springs.move_offset(t.edges[i].spring);
  }

  // All but `share` of its forces is let go of. Behind a surface that can move everything shrinks alike.
  constexpr void shed(const tables& t, const part_type& part, Scalar share) noexcept {
    each_spring(t, part, [&](int spring) {
      if (t.contact.is_there) springs.shed_both(spring, share);
      else if (part.kind == tunable_kind::mesh || is_between_tool_and_ground(part)) springs.shed_offset(spring, share);
      else springs.shed_end(spring, share);
    });
  }

  constexpr void bring_shed_offsets_home(const tables& t, const part_type& part) noexcept {
    each_spring(t, part, [&](int spring) { springs.bring_shed_offset_home(spring); });
  }

 private:
  static constexpr bool is_between_tool_and_ground(const part_type& part) noexcept {
    return part.kind == tunable_kind::spring && !part.is_loose;
  }

  template <class Visit>
  static constexpr void each_spring(const tables& t, const part_type& part, Visit visit) noexcept {
    if (part.spring != no_index) visit(part.spring);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i)
      if (t.edges[i].spring != no_index) visit(t.edges[i].spring);
  }

  // z ← z + φ δ − α z with x = k h/B, α = x φ. Exact φ = (1 − e^(−x))/x; backward Euler φ = 1/(1 + x).
  constexpr void tune_relaxation(const tables& t, const part_type& part) noexcept {
    const Scalar stiffness = springs.stiffness(part.spring), damping = number(t, part.damping);
    // Division by zero, and infinity, are no constant expressions: a damper of nothing leaves nothing of the spring by
    // itself.
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

  constexpr Scalar eliminate(const tables& t, const part_type& part, Scalar per_stiffness,
                             Scalar per_damping) noexcept {
    mesh_.clear(part.first_node, part.node_count);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
      const tunable_edge& edge = t.edges[i];
      mesh_.join(part.first_node, edge,
                 edge.spring != no_index ? per_stiffness * springs.stiffness(edge.spring)
                                         : per_damping * number(t, edge.damping));
    }
    return mesh_.eliminate(part.first_node, part.node_count);
  }

  // The viscosity of a mesh at low frequency: the second term of K + s B seen at the port, as s goes to 0.
  constexpr Scalar viscosity(const tables& t, const part_type& part) noexcept {
    mesh_.clear(part.first_node, part.node_count);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
      const tunable_edge& edge = t.edges[i];
      const bool is_spring = edge.spring != no_index;
      mesh_.join(part.first_node, edge, is_spring ? springs.stiffness(edge.spring) : Scalar(0),
                 is_spring ? Scalar(0) : number(t, edge.damping));
    }
    const Scalar found = mesh_.eliminate_to_first_order(part.first_node, part.node_count);
    return found > 0 ? found : Scalar(0);
  }

  constexpr void advance_mesh(const tables& t, const part_type& part, Scalar change) noexcept {
    mesh_.spread(part.first_node, part.node_count, change);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
      const tunable_edge& edge = t.edges[i];
      if (edge.spring != no_index)
        springs.stretch(edge.spring, mesh_.elongation(part.first_node, edge, change), t.threshold);
    }
  }

  Scalar share_[Springs] = {};  // φ of a relaxation [1]
  Scalar loss_[Springs] = {};   // α of a relaxation [1]
  tunable_mesh<Scalar, Nodes> mesh_;
};

}  // namespace dashpot
