// The numbers of a law with tunable parameters as affine functions of them, in rational numbers.
#pragma once

#include <span>
#include <vector>

#include "certify/motor_constants.hpp"

namespace dashpot::compiler {

// base + Σ factors[i] θ_i, exactly
struct Affine {
  Rational base = 0;
  std::vector<Rational> factors;
};

Affine plus(Affine first, const Affine& second, const Rational& weight = 1);

class BoxNumbers {
 public:
  explicit BoxNumbers(const TunableTables& tables) : tables_(tables) {}

  Affine number(int index) const;
  Affine stiffness(int spring) const { return number(tables_.springs[static_cast<std::size_t>(spring)]); }

  std::span<const BlockPart> parts_of(const TunableBlock& block) const {
    return std::span(tables_.parts).subspan(std::size_t(block.first_part), std::size_t(block.part_count));
  }
  // The numbers whose least is the slip's yield force.
  std::span<const int> cuts_of(const TunableYield& yield) const {
    return std::span(tables_.cuts).subspan(std::size_t(yield.first_cut), std::size_t(yield.cut_count));
  }

  // The largest and the smallest value over the box.
  Rational most(const Affine& f) const { return extreme(f, true); }
  Rational least(const Affine& f) const { return extreme(f, false); }

 protected:
  const TunableTables& tables_;

 private:
  Rational extreme(const Affine& f, bool largest) const;
};

}  // namespace dashpot::compiler
