#include "certify/needed_damping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dashpot::compiler {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Phasor phasor(std::complex<double> number) { return {number.real(), number.imag()}; }
constexpr double slack = 1 + 1e-12;  // covers the rounding of the bounds themselves

// (1 + q)/2 − (1 − q)/y = Σ_{k≥2} (−y)^k (k − 1)/(2 (k + 1)!), q = e^{−y}
double lag_spread(double y, double q) {
  if (y > 0.5) return (1 + q) / 2 - (1 - q) / y;
  double sum = 0, term = -y / 2;  // (−y)^k/(k + 1)! at k = 1
  for (int k = 2; k < 24; ++k) {
    term *= -y / (k + 1);
    sum += term * (k - 1) / 2;
  }
  return sum;
}

}  // namespace

LateWrite<Real> late_write(double hold, double delay, double lag) {
  const Real s = Real(delay) / Real(hold);
  if (delay == 0) return {};
  if (lag == 0) return {0, s, 0, 0, 0, s * (1 - s)};
  const Real x = Real(hold) / Real(lag), y = Real(delay) / Real(lag), until = exp(-y), kept = exp(y - x), q = exp(-x);
  const Real share = s + (1 - kept) / x, later = (1 - q) / x, spread = (1 - q * q) / (2 * x) - later * later;
  const Real both = ((1 - until) + (until - kept * q) / 2) / x - share * later, mixed = both / spread;
  const Real apart = s + (1 - kept * kept) / (2 * x) - share * share - mixed * both;
  return {kept, share, later, spread, mixed, apart > 0 ? apart : Real(0)};
}

NeededDamping::NeededDamping(const MotorConstants& motor, const SampledLoop& loop, const EstimatorFactors& estimator)
    : estimator_(estimator),
      follows_estimate_(motor.follows_estimate()),
      delay_(loop.delay_samples),
      geometric_(loop.delay_samples + 1, 1.0),
      stiffness_(loop.sample_period * motor.static_stiffness),
      rest_(loop.sample_period * motor.step_stiffness),
      velocity_gain_(motor.velocity_gain) {
  for (const MotorMode& mode : motor.modes) add_mode(mode, loop.sample_period);
  if (loop.amplifier_lag > 0) {
    const double y = loop.sample_period / loop.amplifier_lag;
    lag_decay_ = std::exp(-y);
    lag_loss_ = -std::expm1(-y);
    lag_share_ = lag_loss_ / y;
    lag_spread_ = std::sqrt(lag_share_ * lag_spread(y, lag_decay_)) * (1 + 1e-13);
  }
  // With a lag, the hold of punctual samples; else the longest hold, which then scales everything.
  if (loop.write_latest > 0) {
    const double hold = loop.amplifier_lag > 0 ? loop.sample_period : loop.longest_hold();
    const LateWrite<Real> write = late_write(hold, loop.write_latest, loop.amplifier_lag);
    write_ = {to_double(write.kept),         to_double(write.share), to_double(write.later_share),
              to_double(sqrt(write.spread)), to_double(write.mixed), to_double(sqrt(write.apart))};
  }
  scale_ = stiffness_ * (1 + delay_) + std::abs(rest_) + std::abs(velocity_gain_);
  for (const Mode& mode : modes_)
    scale_ += std::abs(mode.position) * (1 + delay_) + std::abs(mode.velocity) / mode.loss;
  const double roundings = 200.0 + delay_ + double(modes_.size()) + double(estimator_.taps.size());
  roundoff_ = roundings * 0x1p-52;
  rest_error_ = roundoff_ * loop.sample_period * std::abs(motor.step_stiffness);
}

void NeededDamping::add_mode(const MotorMode& mode, double sample_period) {
  constexpr double vanishing = 1e-200;
  if (mode.decay < vanishing) {
    vanished_ += sample_period * mode.position_drive;
    return;
  }
  const double position = sample_period * (mode.position_drive / mode.decay);
  rest_ -= position;
  modes_.push_back({mode.decay, mode.loss, position, mode.velocity_drive});
}

NeededDamping::ModeSums NeededDamping::mode_sums(const Arc& arc) const {
  const Phasor delta = arc.difference(), w = arc.backward(), turning = {-w.imaginary, w.real};  // δ, w, δ′ = jw
  const double least = arc.least_difference(), largest = std::min(arc.largest_difference(), 1.0);
  const double centre_square = delta.real * delta.real + delta.imaginary * delta.imaginary,
               least_square = least * least;
  ModeSums sums;
  for (const Mode& mode : modes_) {
    const double a = mode.decay, loss = mode.loss;
    const double nearest = loss * loss + a * least_square,
                 distance = loss * loss + a * centre_square;  // of D = |1 − a w|²
    const double inverse = 1 / std::sqrt(nearest);
    const Phasor phi = Phasor{loss + a * delta.real, a * delta.imaginary}.inverse();  // 1/(1 − a w)
    const Phasor steps = phi * phi * turning;                                         // −φ′/a
    const double square = inverse * inverse;
    if (mode.velocity != 0) {
      const ArcModel pole = {phi, -a * steps, inverse, a * square, a * square + 2 * a * a * square * inverse};
      sums.velocity += mode.velocity * pole;
    }
    if (mode.position == 0) continue;
    const double poisson = loss * (2 - loss) / 2;  // ½ (1 − a²)
    const double steep = 2 * poisson * a * square * square;
    sums.position += mode.position * ArcModel{delta * phi, loss * steps, arc.largest_difference() * inverse,
                                              loss * square, loss * square + 2 * a * loss * square * inverse};
    sums.poles = sums.poles + mode.position * RealArcModel{0.5 + poisson / distance,
                                                           -2 * poisson * a * delta.imaginary / (distance * distance),
                                                           0.5 + poisson * square, steep * largest,
                                                           steep * (1 + 4 * a * largest * largest * square)};
  }
  return sums;
}

// 1/(1 − p w) of a complex pole, or κ (1 + w)/(1 − p w), whose slope along w is κ (1 + p)/(1 − p w)². The denominator
// is 1 − p + p δ, and near Nyquist 1 + p − p σ. The distance to the pole shrinks by no more than |p| times the arc's
// radius.
std::optional<ArcModel> NeededDamping::pole_model(const Arc& arc, const EstimatorPole& pole) const {
  const Phasor p = phasor(pole.pole), w = arc.backward();
  const Phasor denominator = w.real > 0 ? phasor(pole.loss) + p * arc.difference() : phasor(pole.rest) - p * arc.sum();
  const double size = p.magnitude(), nearest = (denominator.magnitude() - size * arc.radius()) * (1 - 1e-13);
  if (!(nearest > 0)) return std::nullopt;
  const Phasor phi = denominator.inverse(), turning = {-w.imaginary, w.real};  // jw
  const double inverse = 1 / nearest, square = inverse * inverse;
  const Phasor along = pole.has_zero() ? phasor(pole.gain * pole.rest) : p;
  const double steep = along.magnitude();
  const double second = steep * square + 2 * steep * size * square * inverse;
  const Phasor slope = -1.0 * (along * turning * phi * phi);
  if (!pole.has_zero()) return ArcModel{phi, slope, inverse, steep * square, second};
  const Phasor gain = phasor(pole.gain);
  return ArcModel{gain * arc.sum() * phi, slope, gain.magnitude() * arc.largest_sum() * inverse, steep * square,
                  second};
}

ArcModel NeededDamping::estimate(const Arc& arc, const ModeSums& sums) const {
  ArcModel gain = polynomial_model(arc, estimator_.taps);
  for (const EstimatorPole& pole : estimator_.poles) {
    const std::optional<ArcModel> factor = pole_model(arc, pole);
    if (!factor) {
      gain.size = infinite;
      return gain;
    }
    gain = gain * *factor;
  }
  return gain * (ArcModel::constant(velocity_gain_) + power_model(arc, 1) * sums.velocity);
}

NeededDamping::Bounds NeededDamping::on(const Arc& arc) const {
  const ModeSums sums = mode_sums(arc);
  const ArcModel geometric = polynomial_model(arc, geometric_);  // Σ_{j≤n} wʲ
  const ArcModel late = power_model(arc, delay_ + 1);            // wⁿ⁺¹
  ArcModel rest = ArcModel::constant(rest_);
  rest.size += rest_error_ / roundoff_;
  if (vanished_ != 0) rest += vanished_ * power_model(arc, 1);
  ArcModel estimated;
  if (follows_estimate_) estimated = estimate(arc, sums);
  if (!std::isfinite(estimated.size)) return {-infinite, infinite};
  const RealArcModel springs =
      real_part(stiffness_ * (geometric + ArcModel::constant(-0.5)) + sums.position * geometric);
  const RealArcModel needed = springs + -1.0 * sums.poles + -1.0 * real_part(late * (rest + estimated));
  if (lag_share_ == 0 && write_.share == 0) return without_lag(needed, arc.radius());

  const ArcModel force = power_model(arc, delay_) * (ArcModel::constant(stiffness_) + sums.position +
                                                     difference_model(arc) * (rest + estimated));  // T H
  std::optional<ArcModel> lag;
  if (lag_share_ > 0) {
    lag = pole_model(arc, {lag_decay_, lag_loss_, 1 + lag_decay_, 0});
    if (!lag) return {-infinite, infinite};
  }
  if (write_.share > 0) return with_late_write(arc, needed, force, lag);
  const ArcModel lagged = force * *lag;
  const RealArcModel late_part = lag_share_ * real_part(power_model(arc, 1) * lagged);
  return with_lag(needed + late_part, {lag_spread_ * lagged}, arc.radius());
}

NeededDamping::Bounds NeededDamping::with_late_write(const Arc& arc, const RealArcModel& prompt, const ArcModel& force,
                                                     const std::optional<ArcModel>& lag) const {
  ArcModel share = ArcModel::constant(write_.share);
  std::vector<ArcModel> Z = {write_.apart * force};
  if (lag) {
    const ArcModel lacking = write_.kept * (power_model(arc, 1) * *lag);  // e/h
    share += write_.later_share * lacking;
    Z.push_back(write_.spread * (force * (ArcModel::constant(write_.mixed) + lacking)));
  }
  return with_lag(prompt + real_part(power_model(arc, 1) * (force * share)), Z, arc.radius());
}

NeededDamping::Bounds NeededDamping::without_lag(const RealArcModel& needed, double radius) const {
  const double error = roundoff_ * needed.size;
  const double reach =
      (std::abs(needed.slope) + roundoff_ * needed.steepness) * radius + needed.second / 2 * radius * radius;
  return {needed.value - error, needed.value + (error + reach) * slack};
}

// With V = (R, Z₁, Z₂): S = ½ (R + |V|), |V|″ ≤ |V′|²/|V| + |V″|, and |V| falls by no more than |V′| times the radius.
// Where that says nothing: S grows with R and with every |Z|.
NeededDamping::Bounds NeededDamping::with_lag(const RealArcModel& R, const std::vector<ArcModel>& Z,
                                              double radius) const {
  const auto length_of = [&](double real, const auto& of) {
    for (const ArcModel& one : Z) real = std::hypot(real, of(one));
    return real;
  };
  double size = R.size, steep = R.steepness, product = R.value * R.slope;
  for (const ArcModel& one : Z) {
    size += one.size;
    steep += one.steepness;
    product += one.value.real * one.slope.real;
    product += one.value.imaginary * one.slope.imaginary;
  }
  const double length = length_of(R.value, [](const ArcModel& one) { return one.value.magnitude(); });
  const double steepness = length_of(R.steepness, [](const ArcModel& one) { return one.steepness; });
  const double second = length_of(R.second, [](const ArcModel& one) { return one.second; });
  const double error = roundoff_ * size, value = (R.value + length) / 2;
  const double shortest = length - steepness * radius - error;
  const double R_reach = (std::abs(R.slope) + roundoff_ * R.steepness) * radius + R.second / 2 * radius * radius;
  const auto farthest = [&](const ArcModel& one) {
    const double reach =
        (one.slope.magnitude() + roundoff_ * one.steepness) * radius + one.second / 2 * radius * radius;
    return one.value.magnitude() + reach;
  };
  const double highest_R = R.value + R_reach;
  double over_arc = (highest_R + length_of(highest_R, farthest)) / 2;
  if (shortest > 0) {
    const double slope =
        std::abs(R.slope + product / length) / 2 + roundoff_ * steep + steepness * 2 * error / shortest;
    const double bend = (R.second + second + steepness * steepness / shortest) / 2;
    over_arc = std::min(over_arc, value + slope * radius + bend / 2 * radius * radius);
  }
  return {value - error, over_arc + error * slack + 1e-15 * std::abs(over_arc)};
}

}  // namespace dashpot::compiler
