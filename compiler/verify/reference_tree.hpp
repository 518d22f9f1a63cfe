// Splits a network with slips into blocks and slips again, by code that shares nothing with linear/ and decompose/.
// Every block's canonical form is computed in 100 digits from a network of its own elements.
#pragma once

#include <optional>
#include <vector>

#include "network/tree.hpp"
#include "verify/reference_form.hpp"

namespace dashpot::compiler {

struct ReferencePart {
  enum class Kind { block, slip, series, parallel };
  Kind kind;
  Tree elements = {};         // of a block, or of slips that act as one
  ReferenceForm form;         // of a block
  Reference yield_force = 0;  // of a slip
  std::vector<ReferencePart> children;
};

using ReferenceKind = ReferencePart::Kind;

// What reaches ground without a slip, and the parts with slips beside it: trees, and others by their elements. Behind a
// contact all slips are one part if any are in no tree.
struct ReferenceTree {
  Network linear_network;  // with all else marked as without effect
  ReferenceForm linear;
  std::vector<ReferencePart> components;
  std::vector<std::vector<std::size_t>> networks;

  bool has_slips() const { return !components.empty() || !networks.empty(); }
};

ReferenceTree reference_tree(const Network& network);

// Elements that share inner nodes, each part in the order of its first element.
std::vector<std::vector<std::size_t>> parts_between_ends(const Network& network);

// The elements of a tree between a tool and a ground of their own.
Network laid_out(const Tree& tree, const Network& network);

std::size_t slip_count(const ReferencePart& part);
std::vector<std::size_t> elements_of(const ReferencePart& part);
std::vector<std::size_t> elements_of(const Tree& tree);  // in the order of laid_out()
std::vector<std::size_t> sorted(std::vector<std::size_t> elements);

// The same component without the dampers that lie beside its slips.
ReferencePart without_dampers_beside_slips(ReferencePart part);

// b∞ where slip i, in the order of the parts, slides if bit i of the pattern is set and holds else; empty where that is
// rigid.
inline constexpr std::size_t every_slip_slides = ~std::size_t{0};  // of however many
std::optional<Reference> feedthrough_in(const ReferencePart& part, std::size_t pattern);

}  // namespace dashpot::compiler
