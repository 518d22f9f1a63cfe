// The physical damping that the sampled loop needs at one frequency (theory, section 6b; Colgate & Schenkel 1997), and
// on an arc of frequencies.
//
// Motor: z⁻ⁿ H₀(z) from position sample to force, H₀ = k0 + δ (s + Σ d_i w/(1 − a_i w)) + δ Ĝ/T (g + Σ e_i w/(1 − a_i
// w)), w = z⁻¹, δ = 1 − w, held over the period T. The work at the port is a quadratic form in the aliases of the
// tool's motion at the frequencies ω_m = (θ + 2πm)/T. Without lag it is passive with the damping b when
//     b ≥ S(θ) = T Re{δ wⁿ H₀}/|δ|² = T k0 (Σ_{j≤n} cos jθ − ½) − T Re{wⁿ⁺¹ (H₀ − k0)/δ}
// (δ²/|δ|² = −w), which has no singularity left in it. A mode in terms of c_i = d_i/a_i and D_i = |1 − a_i w|²:
//     −Re{c wⁿ⁺¹/(1 − a w)} = −c (½ + ½ (1 − a²)/D) + c Re{δ/(1 − a w) · Σ_{j≤n} wʲ}
// where nothing cancels however slow the mode is; at n = 0 it rises to c/(1 + a) at Nyquist.
//
// Amplifier lag τ: the force is the held one behind A(s) = 1/(1 + τs). The form is then ½(r aᴴ + a rᴴ) with the vectors
// a_m ∝ 1/ω_m, r_m ∝ A(jω_m)/ω_m over the aliases, of rank two, and its eigenvalue gives
//     S = ½ (R + √(R² + Z²)),   R = S₀ + p T Re{w H/(1 − q w)},   Z² = κ T² |H|²/|1 − q w|²,
//     q = e^{−T/τ},   p = (1 − q) τ/T,   κ = p ((1 + q)/2 − p)
// from Σ 1/ω_m², Σ A/ω_m², Σ |A|²/ω_m² in closed form. It is necessary and sufficient for passivity against every
// motion, not only against linear hands.
//
// A command that acts d after its sample: over a hold the force is off by h ψ(σ) + e φ(σ), where h is the last change
// of the command, which is still to come, e what the amplifier lacked at the sample, e⁺ = q e + ψ(T) h, φ = e^{−σ/τ},
// ψ = 1 up to d and e^{−(σ−d)/τ} from there on. With the means of both over the hold and their covariances
//     R = S₀ + T Re{w H (mean ψ + mean φ · ψ(T) w/(1 − q w))},
//     Z² = T² |H|² (|√K_φφ (λ + ψ(T) w/(1 − q w))|² + K_ψψ − λ K_ψφ),   λ = K_ψφ/K_φφ
// Without a lag that is mean ψ = s = d/T and Z² = T² |H|² s (1 − s).
#pragma once

#include <optional>

#include "certify/arc_model.hpp"
#include "certify/estimator_factors.hpp"
#include "linear/real.hpp"

namespace dashpot::compiler {

// How a command that acts late changes a hold; all numbers are zero if it acts at once.
template <class Scalar>
struct LateWrite {
  Scalar kept = 0;         // ψ(T)
  Scalar share = 0;        // mean ψ
  Scalar later_share = 0;  // mean φ, which is p
  Scalar spread = 0;       // K_φφ, which is κ
  Scalar mixed = 0;        // λ
  Scalar apart = 0;        // K_ψψ − λ K_ψφ
};
LateWrite<Real> late_write(double hold, double delay, double lag);

class NeededDamping {
 public:
  // `estimator` is not used if the motor does not follow the estimate.
  NeededDamping(const MotorConstants& motor, const SampledLoop& loop, const EstimatorFactors& estimator);

  struct Bounds {
    double at_centre;  // lower bound of S at the arc's centre [N·s/m]
    double over_arc;   // upper bound of S on the arc; may be infinite on a wide arc
  };
  Bounds on(const Arc& arc) const;

  // Sum of the sizes of S's terms: nothing is known more finely than this, rounded [N·s/m].
  double scale() const { return scale_; }
  // Number of terms summed on an arc, with those of estimator and lag.
  std::size_t terms() const { return modes_.size() + 8; }
  double roundoff() const { return roundoff_; }  // of S, relative to the size of its terms

 private:
  struct Mode {
    double decay, loss;
    double position;  // T c [N·s/m]
    double velocity;  // e [N·s/m]
  };
  struct ModeSums {
    ArcModel position;   // Σ T c δ/(1 − a w)
    RealArcModel poles;  // Σ T c (½ + ½ (1 − a²)/D)
    ArcModel velocity;   // Σ e/(1 − a w)
  };
  void add_mode(const MotorMode& mode, double sample_period);
  ModeSums mode_sums(const Arc& arc) const;
  ArcModel estimate(const Arc& arc, const ModeSums& sums) const;  // Ĝ (g + Σ e w/(1 − a w))
  std::optional<ArcModel> pole_model(const Arc& arc, const EstimatorPole& pole) const;
  Bounds without_lag(const RealArcModel& needed, double radius) const;
  Bounds with_lag(const RealArcModel& R, const std::vector<ArcModel>& Z, double radius) const;
  Bounds with_late_write(const Arc& arc, const RealArcModel& prompt, const ArcModel& force,
                         const std::optional<ArcModel>& lag) const;

  std::vector<Mode> modes_;
  EstimatorFactors estimator_;
  bool follows_estimate_;
  unsigned delay_;
  std::vector<double> geometric_;
  double stiffness_;         // T k0 [N·s/m]
  double rest_;              // T (s − Σ c) [N·s/m]
  double rest_error_;        // of rest_
  double vanished_ = 0;      // T d of modes whose decay is zero [N·s/m]
  double velocity_gain_;     // g [N·s/m]
  double lag_decay_ = 0;     // q
  double lag_loss_ = 1;      // 1 − q
  double lag_share_ = 0;     // p
  double lag_spread_ = 0;    // √κ
  LateWrite<double> write_;  // with the roots of spread and apart
  double roundoff_, scale_;
};

}  // namespace dashpot::compiler
