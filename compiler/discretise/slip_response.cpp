#include "discretise/slip_response.hpp"

#include <Eigen/LU>

#include <algorithm>

#include "linear/real_traits.hpp"

namespace dashpot::compiler {
namespace {

using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

struct Edge {
  const NormalTree* part;  // block or slip
  std::size_t from, to;
};

constexpr std::size_t held_end = 0, tool_end = 1;

void lay_out(const NormalTree& tree, std::size_t from, std::size_t to, std::size_t& nodes, std::vector<Edge>& edges) {
  if (tree.kind == NormalTree::Kind::parallel) {
    for (const NormalTree& child : tree.children) lay_out(child, from, to, nodes, edges);
  } else if (tree.kind == NormalTree::Kind::series) {
    std::size_t here = from;
    for (std::size_t i = 0; i < tree.children.size(); ++i) {
      const std::size_t next = i + 1 == tree.children.size() ? to : nodes++;
      lay_out(tree.children[i], here, next, nodes, edges);
      here = next;
    }
  } else {
    edges.push_back({&tree, from, to});
  }
}

void collect(const NormalTree& tree, std::vector<const NormalTree*>& blocks) {
  if (tree.kind == NormalTree::Kind::block) blocks.push_back(&tree);
  for (const NormalTree& child : tree.children) collect(child, blocks);
}

// The equations of one component: balance of forces at the inner nodes, and the slip's elongation δ_slip. They are
// solved for a unit of each input in turn: Δu, the held forces π_1 … π_B, δ_slip. Unknowns: displacements of the inner
// nodes, the slip's force.
class Equations {
 public:
  Equations(const NormalTree& component, const std::vector<Real>& stiffness) : stiffness_(stiffness) {
    lay_out(component, tool_end, held_end, nodes_, edges_);
    for (const Edge& edge : edges_)
      if (edge.part->kind == NormalTree::Kind::slip) slip_ = &edge;
    solve();
  }

  const Edge& slip() const { return *slip_; }
  Real slip_force(std::size_t input) const { return solution_(slip_row(), column(input)); }

  Real elongation(std::size_t block, std::size_t input) const {
    const Edge& edge = *block_edges_[block];
    return displacement(edge.from, input) - displacement(edge.to, input);
  }

  Real tool_force(std::size_t input) const {
    Real force = slip_->from == tool_end ? slip_force(input) : Real(0);
    for (std::size_t i = 0; i < block_edges_.size(); ++i)
      if (block_edges_[i]->from == tool_end)
        force += stiffness_[i] * elongation(i, input) + (input == i + 1 ? Real(1) : Real(0));
    return force;
  }

 private:
  static Eigen::Index column(std::size_t input) { return static_cast<Eigen::Index>(input); }
  Eigen::Index slip_row() const { return static_cast<Eigen::Index>(nodes_) - 2; }

  Real displacement(std::size_t node, std::size_t input) const {
    if (node == held_end) return 0;
    if (node == tool_end) return input == 0 ? 1 : 0;
    return solution_(static_cast<Eigen::Index>(node) - 2, column(input));
  }

  void solve() {
    for (const Edge& edge : edges_)
      if (edge.part->kind == NormalTree::Kind::block) block_edges_.push_back(&edge);
    const auto inputs = column(block_edges_.size() + 2);
    Matrix system = Matrix::Zero(slip_row() + 1, slip_row() + 1), inputs_of = Matrix::Zero(slip_row() + 1, inputs);
    for (std::size_t i = 0; i < block_edges_.size(); ++i) stamp_block(i, system, inputs_of);
    for (const auto& [node, sign] : {std::pair(slip_->from, 1), std::pair(slip_->to, -1)}) {
      if (node >= 2) {
        system(static_cast<Eigen::Index>(node) - 2, slip_row()) += sign;
        system(slip_row(), static_cast<Eigen::Index>(node) - 2) += sign;
      } else if (node == tool_end) {
        inputs_of(slip_row(), 0) -= sign;
      }
    }
    inputs_of(slip_row(), inputs - 1) += 1;
    solution_ = system.fullPivLu().solve(inputs_of);
  }

  void stamp_block(std::size_t i, Matrix& system, Matrix& inputs_of) const {
    const Edge& edge = *block_edges_[i];
    for (const auto& [node, other, sign] : {std::tuple(edge.from, edge.to, 1), std::tuple(edge.to, edge.from, -1)}) {
      if (node < 2) continue;
      const Eigen::Index row = static_cast<Eigen::Index>(node) - 2;
      system(row, row) += stiffness_[i];
      inputs_of(row, column(i + 1)) -= sign;
      if (other >= 2) system(row, static_cast<Eigen::Index>(other) - 2) -= stiffness_[i];
      else if (other == tool_end) inputs_of(row, 0) += stiffness_[i];
    }
  }

  const std::vector<Real>& stiffness_;
  std::size_t nodes_ = 2;
  std::vector<Edge> edges_;
  std::vector<const Edge*> block_edges_;
  const Edge* slip_ = nullptr;
  Matrix solution_;
};

}  // namespace

std::vector<const NormalTree*> blocks_of(const NormalTree& component) {
  std::vector<const NormalTree*> blocks;
  collect(component, blocks);
  return blocks;
}

SlipResponse slip_response(const NormalTree& component, const std::vector<Real>& block_stiffness) {
  const std::vector<const NormalTree*> blocks = blocks_of(component);
  const Equations equations(component, block_stiffness);
  const std::size_t sliding = blocks.size() + 1;
  // The trial force falls by G for each unit that the slip gives way, so that it gives way by δ_slip = excess/G.
  const Real per_excess = -1 / equations.slip_force(sliding);
  const auto row = [&](auto value) {
    Row r{value(std::size_t{0}), {}, value(sliding) * per_excess};
    for (std::size_t i = 1; i < sliding; ++i) r.held.push_back(value(i));
    return snapped(std::move(r));
  };
  SlipResponse response;
  response.yield_force = equations.slip().part->yield_force;
  response.slip_elements = equations.slip().part->elements;
  response.trial = row([&](std::size_t input) { return equations.slip_force(input); });
  response.force = row([&](std::size_t input) { return equations.tool_force(input); });
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    response.blocks.push_back({blocks[i], block_stiffness[i]});
    response.elongation.push_back(row([&](std::size_t input) { return equations.elongation(i, input); }));
  }
  return response;
}

Row operator+(Row first, const Row& second) {
  first.change += second.change;
  for (std::size_t i = 0; i < first.held.size(); ++i) first.held[i] += second.held[i];
  first.excess += second.excess;
  return first;
}

Row operator*(const Real& factor, Row row) {
  row.change *= factor;
  for (Real& coefficient : row.held) coefficient *= factor;
  row.excess *= factor;
  return row;
}

Row snapped(Row row) {
  const Real rounding{"1e-38"};
  const auto snap = [&](Real& coefficient) {
    for (int value : {0, 1, -1})
      if (abs(coefficient - value) < rounding) coefficient = value;
  };
  snap(row.change);
  for (Real& coefficient : row.held) snap(coefficient);
  snap(row.excess);
  return row;
}

bool same_but_for_excess(const Row& first, const Row& second) {
  const Real rounding{"1e-38"};
  const auto same = [&](const Real& x, const Real& y) { return abs(x - y) <= rounding * (abs(x) + abs(y)); };
  return same(first.change, second.change) &&
         std::equal(first.held.begin(), first.held.end(), second.held.begin(), same);
}

}  // namespace dashpot::compiler
