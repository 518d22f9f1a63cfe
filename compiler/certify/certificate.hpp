// What is proved about a law on a device (theory, section 6), from the constants that are really emitted.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "certify/energy_lemma.hpp"
#include "certify/motor_limits.hpp"
#include "certify/sampled_bound.hpp"
#include "certify/slip_motor.hpp"

namespace dashpot::compiler {

enum class Proof {
  none,     // nothing is proved, for `reason`
  hold,     // theory 6a: any motion, sample by sample, any switching of the brake above its command
  sampled,  // theory 6b: any motion, over all frequencies
};

std::string_view name_of(Proof proof);  // "none", "hold", "sampled"

// How much physical damping the loop needs, whoever supplies it.
struct PassivityBound {
  Proof proof = Proof::none;
  double needed =
      0;  // S or β T_max, not below it; where nothing is proved, what would have to be there for it, or 0 [N·s/m]
  double frequency = 0;       // at which most is needed [Hz]; 0 if the proof is not over frequencies
  std::string reason;         // why nothing is proved, or why it is not the hold certificate; one clause
  bool any_regime = false;    // with slips or a contact: whatever slides, sticks, touches or lets go
  bool any_value = false;     // with tunables: wherever they are in their ranges
  bool over_changes = false;  // and in the samples in which they change
  // Proved for punctual samples only, because the amplifier lags. Otherwise it holds under any jitter up to the
  // device's; a certificate states the former only for a device that states no jitter.
  bool constant_period_only = false;
  // P, by rows up to the diagonal, of the storage function that proves `needed`; empty where that rests on another one.
  std::optional<std::vector<std::vector<double>>> storage = {};
};

struct Certificate {
  SampledLoop loop;
  PassivityBound bound;
  double assured = 0;  // lower bound of the physical damping at the tool under the emitted brake command [N·s/m]
  double minimum_damping = 0;  // the least damping that must be added to the brake, uncompensated [N·s/m]
  double added_damping = 0;    // the damping that has been added [N·s/m]
  bool certified = false;      // assured ≥ needed, compared exactly
  EnergyLemma energy;
  MotorLimits limits;                 // of the motor; all of the above assumes a motor that gives what it is asked for
  double quantisation_stiffness = 0;  // 2 f_c/Δ [N/m]; 0 where the encoder's step or the friction is not stated
  std::optional<double> quantisation_gain;  // K; friction covers it up to 2 f_c/Δ [N/m]; empty: not bounded
};

// (K Δ/2 − f_c)⁺: the energy that the encoder's step may bring in, beyond friction, for each metre of travel [N].
double unpaid_force(const Certificate& certificate);

// What a certificate is worth, in the words that header, certificate and `verify` use: "certified", "certified for a
// constant period only" or "not certified".
std::string_view grade_of(const Certificate& certificate);

// Why the law is not certified, with the number that is missing, as one clause.
std::string why_not_certified(const Certificate& certificate, motion port_motion);

// In: a law's constants, the loop around it. Out: the strongest statement that covers them. With fewer `terms` than
// `most_terms` it is found sooner, and may require a little more damping.
PassivityBound passivity_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop,
                               std::size_t terms = most_terms);

// For a law with slips or a contact: what its part `linear`, which reaches ground without a slip, needs; and that
// together with what the slips need, under the device's jitter.
PassivityBound bound_beside_slips(const MotorConstants& linear, const SlipMotor& slips, const SampledLoop& loop,
                                  std::size_t terms = most_terms);
PassivityBound with_slips(PassivityBound beside, const SlipMotor& slips, const SampledLoop& loop);

// x = ((S − b_device)/share − b)⁺: the damping that the brake's command lacks, rounded up; infinite if no command is
// enough.
double missing_damping(const PassivityBound& bound, const SampledLoop& loop, double brake);

// Whether the damping that is assured is as much as the certificate's bound asks for.
void compare_with_bound(Certificate& certificate, const Rational& assured);

// The brake's command for the b of the decomposition, `damping`: on a device with what passivity lacks added, as far as
// the brake reaches. A number of the scalar's type.
double brake_command(const PassivityBound& bound, const SampledLoop& loop, double damping, ScalarType scalar);

// In: a law, the loop around it, the motor's part behind slips. Out: its certificate. On a device, the damping that
// passivity lacks is added to the law's brake command, uncompensated, as far as the brake reaches: what is rendered is
// then D + x s. Without a device it is only reported.
Certificate certify(UpdateLaw& law, const SampledLoop& loop, const std::optional<SlipMotor>& slips);

// The same for a search, without the rest of the certificate: energy between samples, quantisation, limits of the
// motor.
Certificate certify_in_search(UpdateLaw& law, const SampledLoop& loop, const std::optional<SlipMotor>& slips);

// For a law with a number that is not finite: it is not emitted.
Certificate beyond_numbers(const SampledLoop& loop);

// One or more lines on what is proved; `unit` of a damping.
std::vector<std::string> passivity_lines(const Certificate& certificate, const std::string& unit);

std::string to_text(const Certificate& certificate, motion port_motion);

}  // namespace dashpot::compiler
