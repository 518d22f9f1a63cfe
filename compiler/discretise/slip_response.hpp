// How a component with one slip answers a sample (theory, section 5): everything is linear in the displacement Δu of
// the tool, the forces π_i that the blocks would hold at rest, and the excess r of the slip's trial force over its
// yield.
#pragma once

#include <vector>

#include "linear/normal_form.hpp"
#include "linear/real.hpp"

namespace dashpot::compiler {

// A linear part over one sample: force p = g δ + π for the elongation δ.
struct CompanionBlock {
  const NormalTree* block;
  Real stiffness;  // g = k0 + b∞/h + Σ c_i [N/m]
};

// One quantity as a sum: change·Δu + Σ held[i]·π_i + excess·r. Coefficients that are 0 or ±1 in theory are exactly so.
struct Row {
  Real change;
  std::vector<Real> held;
  Real excess;
};

struct SlipResponse {
  std::vector<CompanionBlock> blocks;
  Real yield_force;
  std::vector<std::size_t> slip_elements;
  Row trial;                    // t: the slip's force if it held
  Row force;                    // f: the force with which the component opposes the tool
  std::vector<Row> elongation;  // δ_i of each block
};

// `stiffness_of` gives g of a block. The component must hold exactly one slip.
SlipResponse slip_response(const NormalTree& component, const std::vector<Real>& block_stiffness);

// The blocks of a component in the order of `block_stiffness` and of SlipResponse::blocks.
std::vector<const NormalTree*> blocks_of(const NormalTree& component);

Row operator+(Row first, const Row& second);
Row operator*(const Real& factor, Row row);
// Sets coefficients to 0, 1 or −1 where they differ from it by rounding only, relative to the row's largest.
Row snapped(Row row);
bool same_but_for_excess(const Row& first, const Row& second);

}  // namespace dashpot::compiler
