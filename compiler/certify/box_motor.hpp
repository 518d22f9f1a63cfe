// The damping that the motor of a network with tunable parameters needs, whatever their values within the declared
// ranges (theory, section 6). Every stiffness and damping is an affine function of the tunables with non-negative
// factors.
//
// With the law's own storage, V = Σ ½ k z² and what the tank holds, which set() never raises, a spring on the cut asks
// for β = ½ k and a relaxation for ψ k: with φ = c/k, A = ½ (1 − a²), B = a (1 − φ), C = φ − ½ φ², g = (a − 1, φ),
//     ψ = ¼ (g₁² C − g₁ g₂ B + g₂² A)/(A C − ¼ B²),     the largest of g·(F, δ) − A F² − B F δ − C δ²,
// ½ for backward Euler and never above 0.57 for the exact scheme. Between changes; a change that cannot keep the force
// (tunable_law.hpp) is one jump of the force, held for one sample.
//
// At every point of the box b, and with it b∞ − b, is one of a few affine functions: the alternatives of the brake's
// rule and of its limit. The largest value of an affine function over a box is exact; it is computed in rational
// numbers from the numbers of the law's tables and rounded once, outward, at the end. A margin covers the rounding of
// the numbers that set() computes from them.
#pragma once

#include <optional>
#include <string>

#include "certify/energy_lemma.hpp"
#include "certify/sampled_loop.hpp"
#include "law/update_law.hpp"

namespace dashpot::compiler {

struct BoxMotor {
  double lacking = 0;      // upper bound of what is needed less the assured part of b, over the box [N·s/m]
  double least_brake = 0;  // lower bound of b over the box [N·s/m]
  double largest_brake = 0;
  std::string hindrance;                         // why nothing is proved; empty if something is
  std::optional<double> quantisation_gain = {};  // upper bound of K over the box (quantisation.hpp) [N/m]
  double needed = 0;                             // upper bound over the box, without the cost of the estimate [N·s/m]
  double largest_gain = 0;                       // largest gain from the estimate to the motor's force [N·s/m]
};

// `hold`: T_max/h; `lateness` as in slip_motor.hpp; `gain`: γ of the estimate, empty if it is not known;
// `share`: of the brake's command that is assured; where brake and motor are out of step, of the least one over the
// box: the motor may take out of a command what the brake, still on its way from another or there already, does not
// make.
struct BoxLoop {
  Rational hold;
  double lateness;
  std::optional<double> gain;
  Rational share;
  std::optional<double> pulse = {};  // Σ|h_j| of the estimate [1/s]
  double encoder_step = 0;           // [m]
  bool out_of_step = false;
};

// In: a law with tunables.
BoxMotor box_motor(const UpdateLaw& law, const BoxLoop& loop);

// Checks the energy lemma at every point of the box, with the law's own stored energy.
EnergyLemma check_energy_lemma_over_box(const UpdateLaw& law);

// Upper bound of ψ of a relaxation with φ = `share` and 1 − a = `loss`.
double relaxation_hold(double share, double loss);

inline constexpr double largest_relaxation_hold = 0.57;  // of the exact scheme, over all λh

}  // namespace dashpot::compiler
