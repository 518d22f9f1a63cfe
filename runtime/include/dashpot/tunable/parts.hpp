// The linear parts of a law with tunable parameters: what follows for each from the law's numbers, and its states.
#pragma once

#include <dashpot/tunable/mesh.hpp>
#include <dashpot/tunable/springs.hpp>
#include <dashpot/tunable/tables.hpp>

namespace dashpot {

template <class Scalar, int Springs, int Nodes>
class tunable_parts {
 public:
  using tables = tunable_tables<Scalar>;
  using part_type = tunable_part;

  tunable_springs<Scalar, Springs> springs;

  template <class Visit>
  static constexpr void each(const tables& t, const tunable_block<Scalar>& block, Visit visit) noexcept {
    for (int i = block.first_part; i < block.first_part + block.part_count; ++i) visit(t.parts[i]);
  }

  constexpr void take_numbers(const tables& t, const Scalar* numbers) noexcept {
    for (int i = 0; i < t.spring_count; ++i) springs.set_stiffness(i, numbers[t.springs[i]]);
    for (int i = 0; i < t.part_count; ++i) {
      if (t.parts[i].kind != tunable_kind::relaxation) continue;
      share_[t.parts[i].spring] = numbers[t.parts[i].share];
      loss_[t.parts[i].spring] = numbers[t.parts[i].loss];
    }
  }

  // b∞ [N·s/m]
  constexpr Scalar feedthrough(const tables& t, const part_type& part, const Scalar* numbers) noexcept {
    if (part.kind == tunable_kind::damper) return numbers[part.damping];
    return part.kind == tunable_kind::mesh ? eliminate(t, part, 0, 1, numbers, mesh_) : Scalar(0);
  }

  // g = dp/dδ over a sample [N/m]. Leaves a mesh as the steps need it.
  constexpr Scalar step_stiffness(const tables& t, const part_type& part, const Scalar* numbers) noexcept {
    switch (part.kind) {
      case tunable_kind::spring: return springs.stiffness(part.spring);
      case tunable_kind::damper: return numbers[part.damping] * t.rate;
      case tunable_kind::relaxation: break;
      case tunable_kind::mesh: return eliminate(t, part, 1, t.rate, numbers, mesh_);
    }
    return springs.stiffness(part.spring) * share_[part.spring];
  }

  // The viscosity of a mesh at low frequency: the second term of K + s B seen at the port, as s goes to 0.
  constexpr Scalar viscosity(const tables& t, const part_type& part, const Scalar* numbers) noexcept {
    other_.clear(part.first_node, part.node_count);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
      const tunable_edge& edge = t.edges[i];
      const bool is_spring = edge.spring != no_index;
      other_.join(part.first_node, edge, is_spring ? springs.stiffness(edge.spring) : Scalar(0),
                  is_spring ? Scalar(0) : numbers[edge.damping]);
    }
    const Scalar found = other_.eliminate_to_first_order(part.first_node, part.node_count);
    return found > 0 ? found : Scalar(0);
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
    if (part.kind == tunable_kind::mesh) return advance_mesh(t, part, change, mesh_);
    if (part.kind == tunable_kind::spring) return springs.stretch(part.spring, change, t.threshold);
    springs.stretch(part.spring, share_[part.spring] * change - loss_[part.spring] * springs.elongation(part.spring),
                    t.threshold);
  }

  // The dampers of a mesh rest, its springs alone carry the load.
  constexpr void load(const tables& t, const part_type& part, Scalar position) noexcept {
    if (part.kind != tunable_kind::mesh) return;
    eliminate(t, part, 1, 0, nullptr, other_);
    other_.release(part.first_node, part.node_count);
    other_.rest(part.first_node, part.node_count);
    advance_mesh(t, part, position, other_);
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
    if (t.map.is_there && part.spring != no_index && part.spring == t.static_spring) return;  // lets go by itself
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

  // Without `numbers` of springs alone.
  constexpr Scalar eliminate(const tables& t, const part_type& part, Scalar per_stiffness, Scalar per_damping,
                             const Scalar* numbers, tunable_mesh<Scalar, Nodes>& mesh) noexcept {
    mesh.clear(part.first_node, part.node_count);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
      const tunable_edge& edge = t.edges[i];
      if (edge.spring != no_index) mesh.join(part.first_node, edge, per_stiffness * springs.stiffness(edge.spring));
      else if (numbers != nullptr) mesh.join(part.first_node, edge, per_damping * numbers[edge.damping]);
    }
    return mesh.eliminate(part.first_node, part.node_count);
  }

  constexpr void advance_mesh(const tables& t, const part_type& part, Scalar change,
                              tunable_mesh<Scalar, Nodes>& mesh) noexcept {
    mesh.spread(part.first_node, part.node_count, change);
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
      const tunable_edge& edge = t.edges[i];
      if (edge.spring != no_index)
        springs.stretch(edge.spring, mesh.elongation(part.first_node, edge, change), t.threshold);
    }
  }

  Scalar share_[Springs] = {};         // φ of a relaxation [1]
  Scalar loss_[Springs] = {};          // α of a relaxation [1]
  tunable_mesh<Scalar, Nodes> mesh_;   // as the steps need it
  tunable_mesh<Scalar, Nodes> other_;  // in between, with the dampers left out or s near 0
};

}  // namespace dashpot
