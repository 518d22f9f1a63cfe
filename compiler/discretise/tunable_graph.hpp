// Slips that meet in no tree, with the linear parts between their ends.
#pragma once

#include <vector>

#include "decompose/regimes.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// Springs and dampers that join exactly two ends.
struct OnePort {
  NodeIndex from, to;  // `from` on the tool's side, if it is next to tool or ground
  std::vector<std::size_t> elements;
};

struct GraphLink {
  NodeIndex a, b;
  SlipElements slips;  // side by side
};

struct SlipGraph {
  std::vector<NodeIndex> ends;  // inner ones: where slips end, and where parts with more than two ends meet
  std::vector<GraphLink> links;
  std::vector<OnePort> ties;
  std::vector<std::size_t> opened;  // elements at inner ends without a slip: their relaxations mix
};

// In: a network, those of its elements that are behind slips which meet in no tree. Ensures: every element is in one
// link or tie.
SlipGraph slip_graph(const Network& network, const std::vector<std::size_t>& elements);

// The elements of a one-port between tool and ground, with inner nodes of their own.
Network laid_out(const Network& network, const OnePort& port);

// True if at one of its inner ends it meets slips only: the slips can then take up any rest length of its springs.
bool is_loose(const SlipGraph& graph, const OnePort& tie);

}  // namespace dashpot::compiler
