// Gauss's two-stage collocation, order 4 (Hairer, Lubich & Wanner 2006, II.1.3): slopes k_i at the times c_i h,
//     y_i = y_0 + h Σ_j a_ij k_j,     y_1 = y_0 + (h/2)(k_1 + k_2).
// It keeps quadratic invariants: the kinetic energy gained in a step is exactly (h/2) Σ_i F_i v_i, whatever the forces,
// so a ledger of these products closes to rounding.
#pragma once

namespace dashpot::simulated::gauss {

inline constexpr double sqrt3 = 1.7320508075688772935;
inline constexpr double c[2] = {0.5 - sqrt3 / 6, 0.5 + sqrt3 / 6};
inline constexpr double a[2][2] = {{0.25, 0.25 - sqrt3 / 6}, {0.25 + sqrt3 / 6, 0.25}};
inline constexpr double a_inverse[2][2] = {{3, -3 + 2 * sqrt3}, {-3 - 2 * sqrt3, 3}};

// The quantity at the end of a step from its stage values: y_0 + (h/2)(k_1 + k_2) = y_0 + √3 (y_2 − y_1).
constexpr double end(double start, const double (&stage)[2]) { return start + sqrt3 * (stage[1] - stage[0]); }

}  // namespace dashpot::simulated::gauss
