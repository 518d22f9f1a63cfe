// What the motor makes behind slips and contacts, reduced to what passivity depends on (theory, sections 5 and 6).
//
// m_k = f_k − x_k Δu_k/h, where the brake makes x_k ≤ b∞ of the regime. A slip takes energy, and so does a contact:
// from f ≥ 0, gap ≥ 0 and f·gap = 0 follows f Δs ≤ f Δu. For any cut (cut.hpp), with M = L − x e eᵀ ⪰ 0 the dampers'
// Laplacian less the brake's part, and y the motions in a regime,
//     eᵀM′y′ Δu − ½ y′ᵀM′y′ − eᵀM y Δu − ½ yᵀM y ≤ (b∞(cut) − ½ (x + x′)) Δu²
// so that for any motion, any jitter up to T_max, whatever slides, sticks, touches or lets go, a constant damping of
//     β T_max + (b∞(cut) − min x) T_max/h
// is enough. A force that comes n samples late, or through an amplifier of lag τ, differs from the one that would be
// passive, part by part, by no more than the share s = n + 1 + L/2T_max of what the longest hold does: β takes its
// square. L = 2 √(T_max τ (1 − q²_T)/2)/(1 − q), q of the shortest hold and q_T of the longest, is the lag's
// (motor_limits.hpp): what is lacking after a hold is q of what was, less the next change, and √(τ (1 − q²)/2) of it is
// felt over the hold. Where no damper crosses the cut, β takes 2s − 1: the work of all parts on the increments of their
// forces, Δp δ, sums to no less than nothing for slips, dampers and contacts, and on the cut to Σ (1 + a) ΔF²/2c at
// least, so that ‖ΔF‖ ≤ 2β ‖Δu‖. A motor that adds −κ v̂ with a constant κ, and ‖v̂‖₂ ≤ γ ‖Δu/h‖₂, adds κ γ T_max/h.
// A ramp takes back no more than (1 − ε) (h/T_max) of the brake's own excess in every sample that the estimate depends
// on; so it adds nothing.
#pragma once

#include <optional>
#include <string>

#include "certify/motor_constants.hpp"
#include "certify/sampled_loop.hpp"
#include "decompose/decomposition.hpp"
#include "linear/normal_form.hpp"

namespace dashpot::compiler {

struct SlipMotor {
  bool behind_contact = false;       // the whole network is, and the brake is off while the tool is free
  double stiffness = 0;              // β of the cut [N/m], rounded up beyond what rounding of the constants does
  double damping = 0;                // b∞(cut) − min x [N·s/m], the same
  bool springs_alone = true;         // no damper crosses the cut
  double held_compensation = 0;      // largest β of ramps, which the brake's own excess covers [N·s/m]
  double compensation = 0;           // gain of any other use of the velocity estimate [N·s/m]
  bool lets_go_by_estimate = false;  // a contact's command ends where f′ + b∞ v̂ < 0
  double held_gain = 0;              // Σ|h_j| of the parts behind slips or a contact while all slips hold [N/m]
  bool slides_within_step = false;   // the encoder's step alone can make a slip give way
  double least_brake = 0;            // behind slips, in any regime [N·s/m]
  double largest_brake = 0;
};

// Empty for a network without slips or contact.
std::optional<SlipMotor> slip_motor(const Network& network, const NormalForm& form, const Decomposition& decomposition,
                                    const Choices& choices, const SampledLoop& loop);

// `linear`, the motor of the part that reaches ground without a slip; an empty one behind a contact, where SlipMotor
// covers everything.
MotorConstants motor_beside(const std::optional<SlipMotor>& slips, const MotorConstants& linear);

// Upper bound of s; without the lag if two samples may follow at once, where nothing is proved anyway.
double lateness(const SampledLoop& loop);

// The factor of β in a loop that is late: 2s − 1 or s², rounded up.
double stiffness_share(const SlipMotor& motor, const SampledLoop& loop);

// Why no certificate covers such a contact where the loop is late, in words; empty if it is covered.
std::string contact_uncovered_when_late(const SlipMotor& motor, const SampledLoop& loop);

// The same where, in a late loop, forces of springs alone are bounded: why those of this contact, or of dampers in the
// parts with slips, are not.
std::string uncovered_when_late(const SlipMotor& motor, const SampledLoop& loop);

}  // namespace dashpot::compiler
