#include "support/exact_oracle.hpp"

#include <map>
#include <vector>

namespace dashpot::testing {
namespace {

using compiler::Element;
using compiler::Network;
using compiler::NodeIndex;

// neighbours[i][j] is the dynamic stiffness between the nodes i and j.
using Mesh = std::vector<std::map<NodeIndex, ExactComplex>>;

void tie(Mesh& mesh, NodeIndex a, NodeIndex b, const ExactComplex& stiffness) {
  mesh[a][b] = mesh[a][b] + stiffness;
  mesh[b][a] = mesh[b][a] + stiffness;
}

ExactComplex stiffness_of(const Element& element, const ExactComplex& s) {
  if (const auto* damper = std::get_if<compiler::Damper>(&element.law)) return s * ExactComplex{damper->damping, 0};
  return {std::get<compiler::Spring>(element.law).stiffness, 0};
}

// A star of stiffnesses y_i becomes a mesh of y_i y_j / Σ y.
void eliminate(Mesh& mesh, NodeIndex node) {
  const std::map<NodeIndex, ExactComplex> star = std::move(mesh[node]);
  mesh[node].clear();
  ExactComplex sum;
  for (const auto& [end, stiffness] : star) sum = sum + stiffness;
  for (auto i = star.begin(); i != star.end(); ++i) {
    mesh[i->first].erase(node);
    for (auto j = star.begin(); j != i; ++j) tie(mesh, i->first, j->first, i->second * j->second / sum);
  }
}

NodeIndex with_fewest_neighbours(const Mesh& mesh) {
  NodeIndex best = compiler::ground;
  for (NodeIndex node = 0; node < mesh.size(); ++node)
    if (node != compiler::tool && node != compiler::ground && !mesh[node].empty())
      if (best == compiler::ground || mesh[node].size() < mesh[best].size()) best = node;
  return best;
}

}  // namespace

ExactComplex operator+(const ExactComplex& x, const ExactComplex& y) {
  return {x.real + y.real, x.imaginary + y.imaginary};
}

ExactComplex operator-(const ExactComplex& x, const ExactComplex& y) {
  return {x.real - y.real, x.imaginary - y.imaginary};
}

ExactComplex operator*(const ExactComplex& x, const ExactComplex& y) {
  return {x.real * y.real - x.imaginary * y.imaginary, x.real * y.imaginary + x.imaginary * y.real};
}

ExactComplex operator/(const ExactComplex& x, const ExactComplex& y) {
  const Exact square = y.real * y.real + y.imaginary * y.imaginary;
  const ExactComplex product = x * ExactComplex{y.real, -y.imaginary};
  return {product.real / square, product.imaginary / square};
}

Exact magnitude(const ExactComplex& x) { return sqrt(x.real * x.real + x.imaginary * x.imaginary); }

ExactComplex dynamic_stiffness_by_elimination(const Network& network, const ExactComplex& s) {
  Mesh mesh(network.nodes.size());
  for (const Element& element : network.elements)
    if (element.has_effect) tie(mesh, element.a, element.b, stiffness_of(element, s));
  for (NodeIndex node = with_fewest_neighbours(mesh); node != compiler::ground; node = with_fewest_neighbours(mesh))
    eliminate(mesh, node);
  return mesh[compiler::tool][compiler::ground];
}

ExactComplex dynamic_stiffness_by_elimination(const Network& network, const Exact& angular_frequency) {
  return dynamic_stiffness_by_elimination(network, ExactComplex{0, angular_frequency});
}

}  // namespace dashpot::testing
