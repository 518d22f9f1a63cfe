// How the motor's force limit and slew limit change what is proved (theory, section 10).
//
// Clamp: a linear law that is driven by position alone may hold φ(m) in place of m, for any fixed nondecreasing φ of
// slope at most 1 with φ(0) = 0; β does not change. (1/H of force per increment is a Zames-Falb multiplier, since H is
// completely monotone.)
//
// Shed: any other law multiplies all its forces by one s in [0, 1], so that its command is within the limit. Its
// storage falls to s²V, and the next step starts from a state like any other. Its part c of position then changes by
//     |Δc| ≤ |D| + |w| + |w₋|,        D what it would have changed by,   w = g v̂ what the estimate adds,
// for s brings c no further back than to the limit, within which it was before. So ‖Δc‖ ≤ 2 β ‖Δu‖ + 2 ‖w‖, as without
// a limit but for w, and ‖w‖ ≤ |g| γ ‖Δu‖/h whatever s does to it. With β′ = β + |g| γ/h, n samples of delay, an
// amplifier's lag τ and a slew ρ of which the law uses σ at most, a physical damping of
//     β′ ((1 + 2n) T + L + S + W)
//     L = 2 √(T τ (1 − q²_T)/2)/(1 − q),   q = e^{−(h − j)/τ},   q_T = e^{−T/τ},      S = 2 T √(σ/3ρ)
// is enough for any motion, sample by sample. L and S are shortfalls: where the motor is off by e(t) while x of the
// damping is not needed for anything else, it costs at most ∫e²/4x dt. W is of a command that acts d = sT after its
// sample. Until then the one before acts on what the tool moves, c = s Δu + ρ, which is 2 β′ ‖Δu‖ ‖c‖ at most, and a
// damping turns b (Δu² + ρ²/(s (1 − s)))/T into heat: with m = 1 + 2n + 2s it takes
//     b/β′T = ½ (m + √(m² + 4 s (1 − s))) = 1 + 2n + W/T
//
// A force F0 that ought to vanish at once and falls by ρT a period costs no more than the F0²/2K that a spring K no
// longer holds where F0 (1 + 3/2N + (½ + B)/N²) ≤ 6 ρ x/K, N = F0/ρT ≥ 1, with B = √3/36 for a last step that is not a
// whole one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "certify/sampled_loop.hpp"
#include "certify/slip_motor.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {

enum class LimitRule {
  none,    // no limit is stated, or it never binds
  clamps,  // the motor clips its command, the states are not changed
  sheds,   // the law shrinks its states
};

std::string_view name_of(LimitRule rule);  // "none", "clamps", "sheds"

// Why no bound is known of the force that a law asks for.
enum class Unbounded : unsigned char {
  nothing,   // one is known
  no_range,  // the encoder's range is not stated
  estimate,  // the motor follows the velocity's estimate
  contact,   // the contact is released by an estimate of the velocity
  dampers,   // there are dampers behind slips
  tunables,  // parameters change while the law runs
  curve,     // a static curve lies in front of the law
};

struct MotorLimits {
  LimitRule rule = LimitRule::none;
  bool is_covered = true;  // the damping there is enough, whatever the motor clips or the law sheds
  Unbounded unbounded = Unbounded::nothing;
  double needed = 0;                            // damping needed for that [N·s/m]; 0 if none is, or if it is not known
  std::optional<double> available;              // the damping there, if it is less than needed [N·s/m]
  std::string reason;                           // why no damping would be enough; else empty
  std::optional<double> largest_force;          // asked for within the encoder's range [N]; empty: not bounded
  std::optional<double> slew_needed;            // to follow at every stated speed [N/s]; empty: not bounded
  std::optional<double> largest_discontinuity;  // jump of the force that the slew covers [N]; empty: no slew
};

// For a law without tunables, before shedding is written. `slips` as in the certificate; `needed` and `assured` the
// certificate's [N·s/m].
MotorLimits motor_limits(const UpdateLaw& law, const std::optional<SlipMotor>& slips, const SampledLoop& loop,
                         double needed, const Rational& assured);

// With tunables, whose laws shed. What is proved for one sample at any values in their ranges does not depend on how
// large the forces are: it holds with all of them shrunk too, as long as no command of an earlier sample is still on
// its way. `needed` as above, empty if nothing is proved.
MotorLimits motor_limits_over_box(const SampledLoop& loop, const std::optional<double>& needed,
                                  const Rational& assured);

// β′ ((1 + 2n) T + L + W) [N·s/m], which is enough under any jitter up to the device's, whether the law sheds or not;
// empty where it is not known, and where the motor's slew is limited.
std::optional<double> needed_sample_by_sample(const MotorConstants& linear, const std::optional<SlipMotor>& slips,
                                              const SampledLoop& loop);

// Why the limits are not covered, with `unit` for damping; empty if they are. The damping is that of the statement
// sample by sample, which may differ from the certificate's, a statement over all frequencies.
std::string why_not_covered(const MotorLimits& limits, const std::string& unit);

// (k0 + Σ c_i) v T/(h − j) + Σ |F_i| (1 − a_i)/(h − j), not below it, of a linear law; empty where it is not bounded.
std::optional<double> slew_needed(const MotorConstants& motor, const SampledLoop& loop);

// 2 β′ T √(σ/3ρ): the damping that a slew ρ costs if the law uses σ of it; empty if the estimator's gain is not known.
std::optional<double> damping_for_slew(const MotorConstants& motor, double used, const SampledLoop& loop);

// L [s]; 0 without a lag, infinite with one where two samples may follow at once.
double time_of_lag(const SampledLoop& loop);

// Upper bound of W [s]; 0 if commands act at once.
double time_of_write(const SampledLoop& loop);

// L, and what a command's own lateness asks for whatever is done at the same sample: 2 √(T d) [s], not below it.
double time_of_lateness(const SampledLoop& loop);

// The largest F0 with this property (see above); 0 if there is none.
double covered_discontinuity(double slew, double spare_damping, double stiffness, double sample_period);

// The largest change of the motor's force in a period, ρ (h − j) [N]; 0: unlimited.
double largest_change(const SampledLoop& loop);

std::vector<std::string> to_lines(const MotorLimits& limits, const SampledLoop& loop, const PortUnits& units);

}  // namespace dashpot::compiler
