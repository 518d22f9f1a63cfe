// A linear hand at the tool: an impedance, moved by an intended trajectory.
//
// By Thévenin's theorem any linear hand is a motion x_d, which it would make with nothing in its way, and an impedance
// towards it. With w = ẋ_d − u̇, the tool's velocity u̇, and states z whose energy is ½|z|²,
//     ż = A z + B w,     force on the tool = C z + D w − mass · ü.
// Whatever its size, such a hand is passive exactly when is_passive() says so. All numbers at the tool, in SI
// ([N·m/rad], [kg·m²], … where the device is rotary and has no arm radius).
#pragma once

#include <limits>

namespace dashpot::simulated {

struct hand {
  static constexpr unsigned max_states = 6;

  double mass = 0;     // rigidly at the tool [kg]
  double damping = 0;  // D [N·s/m]
  unsigned states = 0;
  double dynamics[max_states][max_states] = {};                   // A [1/s]
  double input[max_states] = {};                                  // B [√(N/m)]
  double output[max_states] = {};                                 // C [√(N/m)]
  double release_time = std::numeric_limits<double>::infinity();  // lets go of the tool, mass and all [s]
};

hand no_hand();
hand mass_spring_damper(double mass, double damping, double stiffness);  // [kg], [N·s/m], [N/m]

// Sets of values as the literature has them.
hand relaxed_hand();  // 0.8 kg, 5.5 N·s/m, 30 N/m
hand firm_hand();     // 0.55 kg, 6.5 N·s/m, 135 N/m
hand stiff_grasp();   // no mass, 8 N·s/m, 400 N/m

// Whether ½|z|² never rises by more than the work done on the hand, for every motion: mass ≥ 0 and the matrix
// [−(A + Aᵀ), Cᵀ − B; C − Bᵀ, 2D] positive semidefinite, to rounding.
bool is_passive(const hand& user);

// The same hand seen from a joint at `arm_radius` r [m]: mass and damping times r², B and C times r.
hand at_joint(const hand& user, double arm_radius);

}  // namespace dashpot::simulated
