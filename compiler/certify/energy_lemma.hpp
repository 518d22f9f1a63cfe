// The energy lemma of the law itself (theory, section 6): the discrete tissue never gives more work than it stores,
//     V_k − V_{k−1} ≤ f_k Δu_k,     V = ½ k0 u² + Σ w_i G_i²,     f_k = k0 u_k + s Δu_k + Σ G_i
// for the emitted constants and in exact arithmetic, whatever the motion. With G_i′ = a_i G_i + d_i Δu the slack is
//     Σ [w_i (1 − a_i²) G_i² + (1 − 2 w_i a_i d_i) G_i Δu] + (½ k0 + s − Σ w_i d_i²) Δu²
// and is never negative exactly when
//     ½ k0 + s − Σ w_i d_i² ≥ Σ (1 − 2 w_i a_i d_i)²/(4 w_i (1 − a_i²)).
// With w = 1/(2 k a²), a mode's share is theory's a² + (1 − c/k)² ≤ 1.
#pragma once

#include "certify/motor_constants.hpp"

namespace dashpot::compiler {

enum class EnergyStorage {
  emitted,   // V is what stored_energy() computes
  weighted,  // in some modes w = 1/(2 a d), the mode's step response in place of its spring
};

struct EnergyLemma {
  bool applies = false;  // the lemma is only for laws whose modes all follow the position
  bool holds = false;
  bool over_box = false;  // for every value of the tunables; with meshes by backward Euler, where Φ is convex
  bool with_slips =
      false;  // slips or a contact: a step balances every part's force, and slips and contacts only take energy
  EnergyStorage storage = EnergyStorage::emitted;
  std::size_t reweighted_modes = 0;
  double shortfall = 0;  // [N/m]: V_k − V_{k−1} ≤ f_k Δu_k + shortfall·Δu²; 0 where it holds
  // Rounding changes the force by at most this share of the sum of the sizes of its terms, and the energy of a run by
  // that force times its path.
  double rounding_share = 0;
};

EnergyLemma check_energy_lemma(const MotorConstants& motor);

// The same for a law with slips or a contact: for every part by itself, F ← a F + c δ, with w = 1/(2 a d) in the modes
// and 1/(2 k) in the springs, for which 0 ≤ a ≤ 1 and d ≥ 0 are enough; the sum of all parts' work is the tool's and no
// slip gives any.
EnergyLemma check_energy_lemma_with_slips(const MotorConstants& linear, const std::vector<MotorConstants>& parts);

}  // namespace dashpot::compiler
