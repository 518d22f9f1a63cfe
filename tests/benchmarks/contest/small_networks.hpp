// The contest's networks with one hidden state: two Kelvins in series (Fig. 3), and the needle of Fig. 10.
#pragma once

namespace dashpot::contest {

// The element at the tool, which the brake takes the place of, comes first: (10) and (11) hold for either order.
struct two_kelvins {
  static constexpr double stiffness[2] = {80, 200};  // K1, K2 [N/m]
  static constexpr double damping[2] = {6, 4};       // B1, B2 [N·s/m]
};

struct needle {
  static constexpr double stiffness = 1000;         // K [N/m]
  static constexpr double damping[2] = {2.5, 0.8};  // B1, B2 [N·s/m]
  static constexpr double yield_force = 0.5;        // Y [N]
};

}  // namespace dashpot::contest
