// Springs and dampers between inner nodes as statements. Node after node is eliminated; with conductances g between the
// nodes, the star around node i becomes a mesh:
//     g_jk += g_ij g_ik / Σ g_i
// Conductances are only added, multiplied and divided, never subtracted: nothing cancels, at any ratio of values, and a
// node that nothing holds is recognised exactly. A conductance that is not there is `nothing`, and so is its product
// with anything.
#pragma once

#include <vector>

#include "law/tunable_tables.hpp"
#include "discretise/tuned_numbers.hpp"

namespace dashpot::compiler {

class TunedMesh {
 public:
  // The arguments must outlive this object.
  TunedMesh(TunedNumbers& numbers, const BlockPart& part, const std::vector<MeshEdge>& edges);

  // In what follows `values` are stiffness or damping of each edge.

  // In set(): the numbers of the steps.
  void tune(const std::vector<ExpressionId>& values, ExpressionId rate);
  // After that, in the same program: g, and b∞.
  ExpressionId stiffness() const { return stiffness_; }
  ExpressionId feedthrough() const { return feedthrough_; }
  // Damping at low frequency.
  ExpressionId viscosity(const std::vector<ExpressionId>& values);

  // The elongation of each edge: when the port has moved by `change`, under the pushes left by held(); and at rest with
  // the port at `position`, where the springs alone carry force.
  std::vector<ExpressionId> moved(ExpressionId change);
  std::vector<ExpressionId> loaded(const std::vector<ExpressionId>& values, ExpressionId position);

  // In: the force of each edge's spring, `nothing` for a damper. Out: the force held at the port. Leaves the pushes for
  // moved().
  ExpressionId held(const std::vector<ExpressionId>& forces);

 private:
  using Row = std::vector<ExpressionId>;
  struct Conductances {
    std::vector<Row> weight;  // above the diagonal
    Row to_port, to_held;
    ExpressionId through = nothing;
  };
  // Prepared for moved() and held(): 1/Σ g_i in place of Σ g_i, and each weight divided by that sum.
  struct Shares {
    std::vector<Row> weight;
    Row to_port, inverse;
    ExpressionId through = nothing;
  };
  struct FirstOrder {
    ExpressionId lead = nothing, next = nothing;
  };

  Conductances joined_up(const Row& of_edges) const;
  Shares eliminated(const Row& of_edges, const std::string& prefix, bool is_kept);
  ExpressionId inverse(ExpressionId pivot, const std::string& name);
  // A local or, with `is_kept`, a tuned variable that lasts until the next set().
  ExpressionId told(const std::string& name, const char* unit, ExpressionId value, bool is_kept);
  std::vector<ExpressionId> spread(const Shares& shares, const Row& pushes, ExpressionId change,
                                   const std::string& prefix);
  void bridge(FirstOrder a, FirstOrder b, FirstOrder p, FirstOrder& sum);
  ExpressionId& place_of(const MeshEdge& edge, Conductances& all) const;
  std::string node_name(int node) const { return "node_" + std::to_string(part_.first_node + node + 1); }
  std::string link_name(int from, int to) const { return node_name(from) + "_to_" + node_name(to); }
  const MeshEdge& edge(int i) const { return edges_[static_cast<std::size_t>(part_.first_edge + i)]; }
  ExpressionId or_zero(ExpressionId value) { return value == nothing ? numbers_.zero() : value; }

  TunedNumbers& numbers_;
  LawWriter& writer_;
  const BlockPart& part_;
  const std::vector<MeshEdge>& edges_;
  Shares shares_;
  std::vector<VariableId> push_;  // forces on the nodes [N]; nothing where no spring pushes
  ExpressionId stiffness_ = nothing, feedthrough_ = nothing;
};

}  // namespace dashpot::compiler
