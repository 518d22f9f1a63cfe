// A network with tunable parameters once more, by code that shares nothing with discretise/: every linear block as
// parts in parallel whose stiffnesses and dampings are affine functions of the parameters, and every yield force as the
// least of some.
#pragma once

#include <vector>

#include "law/subject.hpp"
#include "verify/reference_slips.hpp"

namespace dashpot::compiler {

// base + Σ of factors × tunables, in the order of the network's tunable parameters
struct ReferenceSum {
  Reference base = 0;
  std::vector<Reference> factors = {};
  ElementList elements = {};  // whose values are in it one by one, and not by a canonical form
};

ReferenceSum added(ReferenceSum first, const ReferenceSum& second, const Reference& weight = 1);

// A spring and a damper in series.
struct ReferenceRelaxation {
  ReferenceSum stiffness, damping;
  bool is_fixed;
  ModeFactors factors;  // of a fixed one
};

// Springs and dampers between the same two nodes.
struct ReferenceEdge {
  bool is_at_port;
  bool is_spring;
  ReferenceSum value;
};

struct ReferenceBlock {
  ReferenceSum stiffness, damping;  // k0 and b∞ of all but the meshes
  bool has_spring = false, has_damper = false;
  Reference largest_stiffness = 0;  // g over a sample, with every parameter at its largest
  std::vector<ReferenceRelaxation> relaxations;
  std::vector<std::vector<ReferenceEdge>> meshes;
  ElementList elements;  // all of them
};

// Slips that meet in no tree, and the blocks between their ends.
struct ReferenceTie {
  NodeIndex from, to;
  ReferenceBlock block;
};
struct ReferenceGraph {
  std::vector<NodeIndex> ends;  // but for tool and ground
  std::vector<std::pair<NodeIndex, NodeIndex>> slips;
  std::vector<ReferenceTie> ties;
};

// As ReferenceTree with every parameter at its largest; blocks and slips in the order of the parts, the linear block
// first.
struct ReferenceTunables {
  std::vector<const Parameter*> parameters;
  ReferenceTree tree;
  ReferenceBlock linear;
  std::vector<std::vector<ReferenceBlock>> blocks;  // of each component
  std::vector<ReferenceGraph> graphs;
  std::vector<std::vector<ReferenceSum>> yield_forces;  // one list of cuts a slip, of all components and graphs
};

ReferenceTunables reference_tunables(const Network& network, const LawFacts& facts);

// The greatest value, which every parameter has where it is largest.
Reference at_largest(const ReferenceSum& sum, const std::vector<const Parameter*>& parameters);

}  // namespace dashpot::compiler
