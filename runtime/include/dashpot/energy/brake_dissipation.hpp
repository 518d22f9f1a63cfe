// How much a brake has dissipated at least, from positions alone.
//
// No velocity is estimated. For any motion, and any damping b(t) over a stretch of time, by Cauchy and Schwarz
//     ∫b v² dt ≥ (∫v dt)² / ∫dt/b = Δu² / Σ Δt/b.
// Positions read from an encoder of step `quantum` are known to less than one step, so only (|Δu| − quantum)⁺ is
// credited, over stretches of several steps: the credit is a rigorous lower bound, and for steady motion at least
// (7/8)² of the truth. With quantum = 0 every hold is a stretch of its own. No heap, no <cmath>.
#pragma once

#include <dashpot/energy/compensated_sum.hpp>

namespace dashpot {

template <class Scalar>
class brake_dissipation {
 public:
  explicit constexpr brake_dissipation(Scalar quantum = 0) noexcept : quantum_(quantum) {}  // [m] or [rad]

  constexpr void reset(Scalar position) noexcept {
    settled_ = {};
    start(position);
  }

  // The brake had at least `damping` (≥ 0) for `duration` (> 0), at whose end the tool is at `position`.
  constexpr void observe(Scalar position, Scalar damping, Scalar duration) noexcept {
    if (!(damping > 0)) return settle(position);
    inverse_ += duration / damping;
    const Scalar moved = position < origin_ ? origin_ - position : position - origin_;
    // Positions are whole steps: half a step keeps their rounding from looking like motion, or like the lack of it.
    const Scalar half = quantum_ / 2;
    const Scalar certain = moved > quantum_ + half ? moved - quantum_ : Scalar(0);
    const Scalar bound = certain * certain / inverse_;
    if (bound > best_) best_ = bound;
    // Waiting where the stretch began would only dilute it, and so would going on after a pause or a reversal. In
    // steady motion the bound falls between two steps to half of its best at most.
    if (moved <= half || moved >= steps_in_a_stretch * quantum_ - half || bound < best_ / 4) settle(position);
  }

  constexpr Scalar value() const noexcept { return settled_.value() + best_; }  // [J]; never falls

 private:
  static constexpr int steps_in_a_stretch = 8;

  constexpr void settle(Scalar position) noexcept {
    settled_.add(best_);
    start(position);
  }
  constexpr void start(Scalar position) noexcept {
    origin_ = position;
    inverse_ = 0;
    best_ = 0;
  }

  Scalar quantum_;                   // [m] or [rad]
  Scalar origin_ = 0;                // where the stretch began [m] or [rad]
  Scalar inverse_ = 0;               // Σ Δt/b over the stretch [m/N] or [rad/(N·m)]
  Scalar best_ = 0;                  // the greatest bound within the stretch [J]
  compensated_sum<Scalar> settled_;  // of the stretches before [J]
};

}  // namespace dashpot
