#include "report/tree_layout.hpp"

#include <algorithm>
#include <vector>

namespace dashpot::compiler {
namespace {

constexpr double rail_lead = 12;  // from a rail to where its children start [px]
constexpr double row_gap = 8;     // between rows of a parallel [px]

// A part around its axis, the line on which it meets its neighbours.
struct Extent {
  double length = 0, above = 0, below = 0;
};

// A part of the tree with its size.
struct Part {
  const Tree* tree;
  Extent extent;
  double rails = 0;  // of a parallel, from the axis of its first child to that of its last [px]
  std::vector<Part> children;
};

double step_between(const Part& upper, const Part& lower) { return upper.extent.below + row_gap + lower.extent.above; }

Extent row(const std::vector<Part>& children) {
  Extent all;
  for (const Part& child : children)
    all = {all.length + child.extent.length, std::max(all.above, child.extent.above),
           std::max(all.below, child.extent.below)};
  return all;
}

// The axis is half way between those of the first and the last child.
Extent stack(const std::vector<Part>& children, double rails) {
  if (children.empty()) return {symbol_length, symbol_drop, symbol_drop};
  double length = 0;
  for (const Part& child : children) length = std::max(length, child.extent.length);
  return {length + 2 * rail_lead, children.front().extent.above + rails / 2, children.back().extent.below + rails / 2};
}

Part measured(const Tree& tree, const Network& network) {
  Part part{&tree, {}, 0, {}};
  for (const Tree& child : tree.children) part.children.push_back(measured(child, network));
  for (std::size_t i = 1; i < part.children.size(); ++i)
    part.rails += step_between(part.children[i - 1], part.children[i]);
  switch (tree.kind) {
    case Tree::Kind::leaf:
      part.extent = {element_length(network.elements[tree.element], network.port_motion), label_rise, symbol_drop};
      break;
    case Tree::Kind::series: part.extent = row(part.children); break;
    case Tree::Kind::parallel: part.extent = stack(part.children, part.rails); break;
  }
  return part;
}

std::string drawn(const Part& part, Place start, double length, const Network& network);

std::string drawn_row(const Part& part, Place start, const Network& network) {
  std::string svg;
  for (const Part& child : part.children) {
    svg += drawn(child, start, child.extent.length, network);
    start.x += child.extent.length;
  }
  return svg;
}

std::string drawn_stack(const Part& part, Place start, const Network& network) {
  if (part.children.empty()) return "";
  const double left = start.x, right = start.x + part.extent.length;
  double y = start.y - part.rails / 2;
  std::string svg = wire({left, y}, {left, y + part.rails}) + wire({right, y}, {right, y + part.rails});
  svg += junction(start) + junction({right, start.y});
  for (std::size_t i = 0; i < part.children.size(); ++i) {
    if (i > 0) y += step_between(part.children[i - 1], part.children[i]);
    svg += wire({left, y}, {left + rail_lead, y}) + wire({right - rail_lead, y}, {right, y});
    svg += drawn(part.children[i], {left + rail_lead, y}, part.extent.length - 2 * rail_lead, network);
  }
  return svg;
}

// Fills the length from `start` on; what is shorter stands in the middle between wires.
std::string drawn(const Part& part, Place start, double length, const Network& network) {
  const double own = part.extent.length, lead = (length - own) / 2;
  const Place inner{start.x + lead, start.y};
  const std::string wires = wire(start, inner) + wire({inner.x + own, start.y}, {start.x + length, start.y});
  switch (part.tree->kind) {
    case Tree::Kind::leaf:
      return wires + element_symbol(network.elements[part.tree->element], network.port_motion, inner, own);
    case Tree::Kind::series: return wires + drawn_row(part, inner, network);
    case Tree::Kind::parallel: return wires + drawn_stack(part, inner, network);
  }
  return wires;
}

}  // namespace

Inside tree_layout(const Tree& tree, const Network& network) {
  const Part all = measured(tree, network);
  const Extent& size = all.extent;
  const std::string svg = drawn(all, {0, size.above}, size.length, network) +
                          wire({size.length, size.above}, {size.length + 12, size.above});
  return {svg, size.length, size.above + size.below, size.above, size.above - 26, size.above + 26};
}

}  // namespace dashpot::compiler
