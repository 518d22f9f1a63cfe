// Slips that meet in no tree, with what is between their ends as one-ports.
#pragma once

#include <vector>

#include "decompose/regimes.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// Springs and dampers in parallel or not that join two ends and no third.
struct OnePort {
  NodeIndex from, to;  // from the tool's side to the ground's, where it is next to one of them
  std::vector<std::size_t> elements;
};

struct GraphLink {
  NodeIndex a, b;
  SlipElements slips;  // side by side
};

struct SlipGraph {
  std::vector<NodeIndex> ends;  // the inner ones: where slips end, and where other than one-ports meet
  std::vector<GraphLink> links;
  std::vector<OnePort> ties;
  std::vector<std::size_t> opened;  // elements at inner ends that no slip has: their relaxations mix over several ends
};

// In: a network, those of its elements that are behind slips which meet in no tree. Ensures: every element is in one
// link or tie.
SlipGraph slip_graph(const Network& network, const std::vector<std::size_t>& elements);

// The elements of a one-port between tool and ground, with inner nodes of their own.
Network laid_out(const Network& network, const OnePort& port);

// True where nothing but slips is beside it at one of its inner ends: then its springs' rest lengths mean nothing.
bool is_loose(const SlipGraph& graph, const OnePort& tie);

}  // namespace dashpot::compiler
