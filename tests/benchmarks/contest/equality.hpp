// Whether contenders do the same job: nothing is measured before that is known.
#pragma once

#include <vector>

#include "contender.hpp"

namespace dashpot::contest {

// How far a contender's commands are from those of the first one of its network, over two rounds of its motion.
//
// The tolerance [N] is rounding, which the printed laws magnify most: they divide differences of displacements by the
// period. With ε = 2⁻⁵², a displacement is off by ε times the tool's travel, and a force by Σ B/h times that; the
// normalised laws keep forces, off by ε F each sample, for 1/(1 − a) samples, which is the same. Eight such roundings
// are allowed. A slip holds its force without decay: ε Y for each of the samples.
struct verdict {
  contender who;
  double force_difference = 0;    // [N]
  double damping_difference = 0;  // [N·s/m]
  double tolerance = 0;           // [N]; that of the brake is the same number in its unit
  bool is_equal() const { return force_difference <= tolerance && damping_difference <= tolerance; }
};

std::vector<verdict> compare(const std::vector<contender>& contenders);

}  // namespace dashpot::contest
