#include "linear/modal_reduction.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "linear/pencil.hpp"
#include "network/disjoint_sets.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

using Matrix = RealMatrix;
using Vector = RealVector;

// K + sB over the internal nodes, and their coupling to the port: K_ii, B_ii, K_ip, B_ip, K_pp, B_pp.
struct NodalEquations {
  Matrix stiffness, damping;
  Vector port_stiffness, port_damping;
  Real tool_stiffness = 0, tool_damping = 0;
};

void stamp(const Element& element, const Part& part, const std::map<NodeIndex, Eigen::Index>& row,
           NodalEquations& equations) {
  const Real k = stiffness_of(element.law), b = damping_of(element.law);
  const NodeIndex ends[2] = {element.a, element.b};
  for (int end = 0; end < 2; ++end) {
    const NodeIndex here = ends[end], there = ends[1 - end];
    if (here == part.port) {
      equations.tool_stiffness += k;
      equations.tool_damping += b;
    } else if (here != part.held) {
      const Eigen::Index i = row.at(here);
      equations.stiffness(i, i) += k;
      equations.damping(i, i) += b;
      if (there == part.port) {
        equations.port_stiffness(i) -= k;
        equations.port_damping(i) -= b;
      } else if (there != part.held) {
        equations.stiffness(i, row.at(there)) -= k;
        equations.damping(i, row.at(there)) -= b;
      }
    }
  }
}

NodalEquations nodal_equations(const Part& part, const Network& network) {
  std::map<NodeIndex, Eigen::Index> row;
  for (NodeIndex node : part.internal) row.emplace(node, static_cast<Eigen::Index>(row.size()));
  const auto size = static_cast<Eigen::Index>(row.size());
  NodalEquations equations{Matrix::Zero(size, size), Matrix::Zero(size, size), Vector::Zero(size), Vector::Zero(size)};
  for (std::size_t element : part.elements) stamp(network.elements[element], part, row, equations);
  return equations;
}

// Sets of nodes that elements of one kind tie together.
template <class ValueOf>
DisjointSets tied_by(const Part& part, const Network& network, ValueOf value_of) {
  DisjointSets sets(network.nodes.size());
  for (std::size_t element : part.elements)
    if (value_of(network.elements[element].law) > 0)
      sets.unite(network.elements[element].a, network.elements[element].b);
  return sets;
}

// Clusters of internal nodes that elements of one kind tie together but not to port or held node: each is one
// direction in which the matrix of that kind is singular.
template <class ValueOf>
Eigen::Index floating_clusters(const Part& part, const Network& network, ValueOf value_of) {
  return tied_by(part, network, value_of).count_apart(part.internal, std::array{part.port, part.held});
}

// Whether elements of one kind alone lead from the port to the held node.
template <class ValueOf>
bool leads_through(const Part& part, const Network& network, ValueOf value_of) {
  const DisjointSets sets = tied_by(part, network, value_of);
  return sets.find(part.port) == sets.find(part.held);
}

// One mode's −(p + s q)²/(m + s d), as in theory, section 2.
void add_relaxing_mode(LinearForm& form, const Real& p, const Real& q, const Real& m, const Real& d, const Part& part) {
  const Real rate = m / d;
  const Real drive = p - q * rate;
  const Real c = drive * drive / d;
  form.feedthrough_damping -= q * q / d;
  form.static_stiffness -= (2 * p * q - q * q * rate) / d + c / rate;
  if (c > 0) form.modes.push_back({c / rate, rate, p / drive, part.elements});
}

void add_modes(LinearForm& form, const Part& part, const Network& network, const NodalEquations& equations) {
  Matrix drives(equations.stiffness.rows(), 2);
  drives << equations.port_stiffness, equations.port_damping;
  const Pencil pencil = solve_pencil(equations.stiffness, equations.damping, drives);
  const auto held_by_dampers = floating_clusters(part, network, stiffness_of);
  const auto held_by_springs = floating_clusters(part, network, damping_of);
  const Vector p = pencil.drives.col(0), q = pencil.drives.col(1);
  const Eigen::Index size = p.size();
  for (Eigen::Index i = 0; i < size; ++i) {
    if (i < held_by_dampers) form.feedthrough_damping -= q(i) * q(i) * pencil.shift;
    else if (i >= size - held_by_springs) form.static_stiffness -= p(i) * p(i);
    else add_relaxing_mode(form, p(i), q(i), pencil.mu(i), (1 - pencil.mu(i)) / pencil.shift, part);
  }
}

}  // namespace

std::vector<Part> independent_parts(const Network& network, std::span<const std::size_t> elements, NodeIndex port,
                                    NodeIndex held) {
  const auto is_terminal = [&](NodeIndex node) { return node == port || node == held; };
  DisjointSets sets(network.nodes.size());
  for (std::size_t element : elements) {
    const Element& e = network.elements[element];
    if (!is_terminal(e.a) && !is_terminal(e.b)) sets.unite(e.a, e.b);
  }
  std::map<std::size_t, std::size_t> index;  // from a set's representative, or an element between the terminals
  std::vector<Part> parts;
  for (std::size_t element : elements) {
    const Element& e = network.elements[element];
    const bool direct = is_terminal(e.a) && is_terminal(e.b);
    const std::size_t key = direct ? network.nodes.size() + element : sets.find(is_terminal(e.a) ? e.b : e.a);
    const auto [place, is_new] = index.emplace(key, parts.size());
    if (is_new) parts.push_back({{}, {}, port, held});
    parts[place->second].elements.push_back(element);
    for (NodeIndex node : {e.a, e.b})
      if (!is_terminal(node)) parts[place->second].internal.push_back(node);
  }
  for (Part& part : parts) {
    std::sort(part.internal.begin(), part.internal.end());
    part.internal.erase(std::unique(part.internal.begin(), part.internal.end()), part.internal.end());
  }
  return parts;
}

void add_part(LinearForm& form, const Part& part, const Network& network) {
  const NodalEquations equations = nodal_equations(part, network);
  LinearForm own;
  own.static_stiffness = equations.tool_stiffness;
  own.feedthrough_damping = equations.tool_damping;
  if (!part.internal.empty()) add_modes(own, part, network, equations);
  // Entries that are zero by the network's structure are set to exactly zero, not left as rounding errors.
  if (leads_through(part, network, stiffness_of)) {
    form.static_stiffness += own.static_stiffness;
    form.static_elements.insert(form.static_elements.end(), part.elements.begin(), part.elements.end());
  }
  if (leads_through(part, network, damping_of)) {
    form.feedthrough_damping += own.feedthrough_damping;
    form.feedthrough_elements.insert(form.feedthrough_elements.end(), part.elements.begin(), part.elements.end());
  }
  form.modes.insert(form.modes.end(), own.modes.begin(), own.modes.end());
}

}  // namespace dashpot::compiler
