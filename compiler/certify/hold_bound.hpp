// The hold certificate's constant (theory, section 6a): for a motor that is driven by position alone, without delay,
//     V_{k+1} − V_k ≤ m_k Δu_{k+1} + β Δu_{k+1}²,      V = ½ k0 u² + Σ F_i²/(2 c_i),      β = k0/2 + Σ c_i/(1 + a_i)
// for any motion, so that a physical damping of β times the longest hold keeps the loop passive under any jitter.
//
// As emitted: c_i = d_i/a_i, and what is left of the step stiffness, r = s − Σ c_i, which is rounding and modes that
// vanish within a sample, stores ½|r| Δu² and costs |r|. So does a gain whose decay is zero.
#pragma once

#include "certify/motor_constants.hpp"

namespace dashpot::compiler {

// β [N/m], in rational arithmetic; the terms of many modes are rounded up at 2⁻¹²⁰⁰, so that the sum stays short.
// Requires that the motor does not follow the estimate.
Rational hold_stiffness(const MotorConstants& motor);

// The rational rounded up at 2⁻¹²⁰⁰, as a number of such steps, and back.
boost::multiprecision::cpp_int grid_steps_up(const Rational& value);
Rational of_grid_steps(const boost::multiprecision::cpp_int& steps);

// The least double that is not below `value`.
double ceiling(const Rational& value);

}  // namespace dashpot::compiler
