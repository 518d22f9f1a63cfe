// What a network answers to motions that are linear between samples (theory, section 3), segment by segment and without
// recursion over samples: for `exact` the network's own force, for `backward-euler` what that scheme makes of it.
#pragma once

#include <vector>

#include "emitted_laws.hpp"
#include "motion.hpp"

namespace dashpot::responses {

class ClosedForm {
 public:
  explicit ClosedForm(const EmittedLaw& law);

  // f at every sample: f = k0 u + b∞ u̇ + Σ [ F_i a_iⁿ + u̇ B_i (1 − a_iⁿ) ], n samples into a segment that begins with
  // the mode forces F_i.
  std::vector<double> force(const Motion& motion) const;

  double static_stiffness() const { return static_cast<double>(static_stiffness_); }        // k0 [N/m]
  double feedthrough_damping() const { return static_cast<double>(feedthrough_damping_); }  // b∞ [N·s/m]

  // a_iⁿ where a_i = e^{−λ_i h} or 1/(1 + λ_i h), and k_i φ_i = c_i, the force of a unit displacement within a sample.
  struct ModeAnswer {
    long double stiffness;        // k_i [N/m]
    long double relaxation_rate;  // λ_i [1/s]
    long double decay_rate;       // −ln a_i, a sample [1]
    long double step_stiffness;   // c_i [N/m]

    long double decay(long double samples) const;  // a_iⁿ
    long double loss(long double samples) const;   // 1 − a_iⁿ
  };
  const std::vector<ModeAnswer>& modes() const { return modes_; }

 private:
  long double static_stiffness_;
  long double feedthrough_damping_;
  long double period_;
  std::vector<ModeAnswer> modes_;
};

// How far rounding may take the felt force from the closed form, relative to its largest part: 1e-12 in double; in
// float what the compiler states for a mode's force and one roundoff for each operation of a sample.
double stated_tolerance(const EmittedLaw& law);

// Runs the law from reset(0) over the motion's samples; a non-fatal failure at the first that departs from `expected`.
void expect_felt_force(const EmittedLaw& law, const Motion& motion, const std::vector<double>& expected);

}  // namespace dashpot::responses
