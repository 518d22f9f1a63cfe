// Constant-velocity Kalman filter in its steady state, which is an α–β filter (Kalata 1984; cf. Bélanger et al. 1998
// for encoders). Acceleration is white from sample to sample with deviation σ_a, Q = σ_a² [[T⁴/4, T³/2], [T³/2, T²]],
// and the encoder's rounding is white with σ_y² = R = Δ²/12:
//     Λ = σ_a T²/σ_y,  r = (4 + Λ − √(8Λ + Λ²))/4,  α = 1 − r²,  β = 2(2 − α) − 4√(1 − α) = 2(1 − r)²
//     x̂ ← x̂ + T v̂,  e = y − x̂,  x̂ ← x̂ + α e,  v̂ ← v̂ + (β/T) e
// Linear, recursive; delay T (α/β − ½). Its gain exceeds 1 whatever the tuning: 1/√(1 − Λ²/64) up to Λ = 4√2, Λ/4
// beyond.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/elementary.hpp>
#include <dashpot/estimators/pulse_transfer.hpp>

namespace dashpot {

template <class Scalar>
class kalman {
 public:
  // `acceleration` σ_a [m/s²] or [rad/s²] > 0; `step` Δ of the encoder [m] or [rad] > 0; `sample_period` T [s] > 0.
  constexpr kalman(double acceleration, double step, double sample_period) noexcept
      : sample_period_(sample_period),
        manoeuvre_(acceleration * sample_period * sample_period * square_root(12.0) / step),
        root_(4 / (4 + manoeuvre_ + square_root(8 * manoeuvre_ + manoeuvre_ * manoeuvre_))),
        period_(static_cast<Scalar>(sample_period)),
        position_leak_(static_cast<Scalar>(root_ * root_)),
        velocity_gain_(static_cast<Scalar>(beta() / sample_period)) {}

  void reset(Scalar position) noexcept {
    previous_position_ = position;
    innovation_ = velocity_ = 0;
  }

  // Finite position [m] or [rad] → velocity [m/s] or [rad/s].
  // x̂ is not kept: before the prediction it is y_{k−1} − r² e_{k−1}, and e alone keeps its digits far from zero.
  Scalar update(Scalar position) noexcept {
    const Scalar innovation = (position - previous_position_) + position_leak_ * innovation_ - period_ * velocity_;
    previous_position_ = position;
    innovation_ = flush_below(smallest, innovation);
    velocity_ = flush_below(smallest, velocity_ + velocity_gain_ * innovation);
    return velocity_;
  }

  constexpr double alpha() const noexcept { return 1 - root_ * root_; }
  constexpr double leak() const noexcept { return root_ * root_; }  // 1 − α, without cancellation
  constexpr double beta() const noexcept { return 2 * (1 - root_) * (1 - root_); }
  constexpr double manoeuvre_index() const noexcept { return manoeuvre_; }  // Λ

  // α/β − ½ = (1 + r)/(2(1 − r)) − ½ = r/(1 − r) samples [s]
  constexpr double delay() const noexcept { return sample_period_ * root_ / (1 - root_); }

  // From |A(e^{jθ})|² = |1 − (2−α−β) e^{−jθ} + r² e^{−2jθ}|², least at 1 − cos θ = Λ²/16, or at Nyquist.
  constexpr double max_gain() const noexcept {
    const double square = manoeuvre_ * manoeuvre_;
    return square < 32 ? 1 / square_root(1 - square / 64) : manoeuvre_ / 4;
  }

  // (β/T)(1 − z⁻¹) / (1 − (2 − α − β) z⁻¹ + (1 − α) z⁻²)
  constexpr pulse_transfer<2> transfer() const noexcept {
    const double r = root_;
    return {{beta() / sample_period_, -beta() / sample_period_, 0}, {1, 1 + r * r - 4 * r, r * r}, 1, 2};
  }

 private:
  static constexpr Scalar smallest = Scalar(1e-30);  // [m], [m/s] …; far below any motion, far above subnormals
  double sample_period_;                             // T [s]
  double manoeuvre_;                                 // Λ
  double root_;                                      // r
  Scalar period_;                                    // T [s]
  Scalar position_leak_;                             // 1 − α = r²
  Scalar velocity_gain_;                             // β/T [1/s]
  Scalar previous_position_ = 0;                     // y_{k−1} [m] or [rad]
  Scalar innovation_ = 0;                            // e [m] or [rad]
  Scalar velocity_ = 0;                              // v̂ [m/s] or [rad/s]
};

}  // namespace dashpot
