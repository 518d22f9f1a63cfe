// Arms that several tests look at, and joint positions in which they are used.
#pragma once

#include <numbers>
#include <vector>

#include "axes/workspace.hpp"
#include "support/random.hpp"

namespace dashpot::testing {

using namespace dashpot::compiler::axes;

inline constexpr double pi = std::numbers::pi;

inline const Arm serial_arm{Kinematics::serial, 63e-3, 75e-3, 0};
inline const Arm parallelogram_arm{Kinematics::parallelogram, 63e-3, 75e-3, 0};
inline const Arm five_bar_arm{Kinematics::five_bar, 63e-3, 75e-3, 25e-3};
inline const Arm coaxial_arm{Kinematics::five_bar, 70e-3, 90e-3, 0};
inline const std::vector<Arm> every_arm{serial_arm, parallelogram_arm, five_bar_arm, coaxial_arm, Arm{}};

// 100 × 60 mm, 70 to 130 mm out.
inline const Box desk{Interval(-50e-3, 50e-3), Interval(70e-3, 130e-3)};
// Within which all arms above are regular.
inline const Box inner_desk{Interval(-40e-3, 40e-3), Interval(70e-3, 110e-3)};

inline Pair<double> random_tip(Random& random, const Box& workspace = inner_desk) {
  return {random.uniform(workspace[0].low, workspace[0].high), random.uniform(workspace[1].low, workspace[1].high)};
}

// A part of a workspace, at most `size` of either side.
inline Box random_part(Random& random, double size, const Box& workspace = inner_desk) {
  Box part;
  for (const std::size_t i : {0u, 1u}) {
    const double width = workspace[i].width() * random.uniform(0, size);
    const double from = random.uniform(workspace[i].low, workspace[i].high - width);
    part[i] = Interval(from, from + width);
  }
  return part;
}

}  // namespace dashpot::testing
