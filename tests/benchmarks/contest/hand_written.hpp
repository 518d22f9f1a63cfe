// The best that we can write by hand for one network: constants normalised, the command in two fused multiplications
// behind its inputs, the subnormal guard on the old state, where it waits for nothing, or of many states in turn, and
// vectors of the target's width. `Lanes` is how many doubles a vector holds.
#pragma once

#include "guards.hpp"
#include "maxwell_networks.hpp"
#include "small_networks.hpp"

namespace dashpot::contest {

template <int Lanes>
struct vectors {
  using values [[gnu::vector_size(8 * Lanes)]] = double;
  using bits [[gnu::vector_size(8 * Lanes)]] = long long;
};

// `product`, which has F for a factor, and 0 for a force F below the threshold.
template <int Lanes>
inline typename vectors<Lanes>::values guarded(typename vectors<Lanes>::values force,
                                               typename vectors<Lanes>::values product) noexcept {
  using values = typename vectors<Lanes>::values;
  using bits = typename vectors<Lanes>::bits;
  const values magnitude = values(bits(force) & 0x7fffffffffffffff);
  return values((magnitude > threshold) & bits(product));
}

// a b + c, in one instruction where there is one: which product is fused decides what waits for what.
inline double fused(double a, double b, double c) noexcept {
#ifdef __FMA__
  return __builtin_fma(a, b, c);
#else
  return a * b + c;
#endif
}

// driven + decay · state, the guard in a branch that is never taken: the sum does not wait for it.
inline double after(double state, double decay, double driven) noexcept {
  const double next = driven + decay * state;
  return __builtin_expect(state > threshold || state < -threshold, true) ? next : driven;
}

template <class Network, int Lanes>
class hand_maxwell {
  static constexpr int size = Network::size;
  static constexpr int sums = size / Lanes < 4 ? size / Lanes : 4;  // in flight at a time
  static constexpr bool takes_turns = size > 8;  // a guard comes to each state in time, `sums` vectors a sample
  static_assert(size % (sums * Lanes) == 0);
  using values = typename vectors<Lanes>::values;

 public:
  command<double> step(double position, double velocity) noexcept {
    const command<double> now = output(position, velocity);
    if (is_taken_) advance(velocity);
    return now;
  }

  // m = S + K0 u + G v
  command<double> output(double position, double velocity) noexcept {
    const double force =
        relaxed_force_ + (Network::static_stiffness * position + constants_of<Network>.velocity_gain * velocity);
    is_taken_ = is_finite(force);
    velocity_ = velocity;
    return {constants_of<Network>.brake, is_taken_ ? force : 0};
  }

  void update() noexcept {
    if (is_taken_) advance(velocity_);
  }

 private:
  // F ← a F + g v,  S = Σ F
  void advance(double velocity) noexcept {
    const auto& decay = reinterpret_cast<const values(&)[size / Lanes]>(constants_of<Network>.decay);
    const auto& drive = reinterpret_cast<const values(&)[size / Lanes]>(constants_of<Network>.drive);
    if (takes_turns) {
      for (int j = 0; j < sums; ++j) force_[turn_ + j] = guarded<Lanes>(force_[turn_ + j], force_[turn_ + j]);
      turn_ = turn_ + sums < size / Lanes ? turn_ + sums : 0;
    }
    values sum[sums] = {};
    for (int i = 0; i < size / Lanes; i += sums)
      for (int j = 0; j < sums; ++j) {
        const values product = decay[i + j] * force_[i + j];
        force_[i + j] = (takes_turns ? product : guarded<Lanes>(force_[i + j], product)) + drive[i + j] * velocity;
        sum[j] += force_[i + j];
      }
    for (int j = 1; j < sums; ++j) sum[0] += sum[j];
    relaxed_force_ = 0;
    for (int j = 0; j < Lanes; ++j) relaxed_force_ += sum[0][j];
  }

  alignas(64) values force_[size / Lanes] = {};
  double relaxed_force_ = 0;  // S [N]
  double velocity_ = 0;       // v of the sample that waits for update() [m/s]
  int turn_ = 0;              // first vector that is guarded next
  bool is_taken_ = false;
};

// Fig. 5 whole: two states are one vector of two, and its sum is never stored. No split: nothing is left to put off.
class hand_fig_5 {
  using values = vectors<2>::values;

 public:
  command<double> step(double position, double velocity) noexcept {
    const auto& k = constants_of<fig_5>;
    const double force = (force_[0] + force_[1]) + fig_5::static_stiffness * position + k.velocity_gain * velocity;
    if (!is_finite(force)) return {k.brake, 0};
    force_ = guarded<2>(force_, values{k.decay[0], k.decay[1]} * force_) + values{k.drive[0], k.drive[1]} * velocity;
    return {k.brake, force};
  }

 private:
  values force_ = {};
};

// The same without vectors, its sum kept: nothing waits longer than it has to.
class hand_fig_5_scalar {
 public:
  command<double> step(double position, double velocity) noexcept {
    const auto& k = constants_of<fig_5>;
    const double force = sum_ + (fig_5::static_stiffness * position + k.velocity_gain * velocity);
    if (!is_finite(force)) return {k.brake, 0};
    first_ = after(first_, k.decay[0], k.drive[0] * velocity);
    second_ = after(second_, k.decay[1], k.drive[1] * velocity);
    sum_ = first_ + second_;
    return {k.brake, force};
  }

 private:
  double sum_ = 0, first_ = 0, second_ = 0;
};

// (10) and (11) normalised: x ← α u + β v + γ x,  m = A u + B v + C x. The state x is a displacement: in a network that
// has crept far, its rounding errors are those of the displacement.
class hand_kelvin {
  static constexpr double per_step = two_kelvins::damping[0] / period;                          // B1/h [N/m]
  static constexpr double stiffness = two_kelvins::stiffness[0];                                // K1 [N/m]
  static constexpr double rate = (two_kelvins::damping[0] + two_kelvins::damping[1]) / period;  // [N/m]
  static constexpr double whole = stiffness + two_kelvins::stiffness[1] + rate;                 // [N/m]
  static constexpr double alpha = stiffness / whole, beta = two_kelvins::damping[0] / whole, gamma = rate / whole;

 public:
  command<double> step(double position, double velocity) noexcept {
    constexpr double by_position = stiffness - (stiffness + per_step) * alpha;
    constexpr double by_velocity = -(stiffness + per_step) * beta;
    constexpr double by_state = per_step - (stiffness + per_step) * gamma;
    const double force = fused(by_state, x_, fused(by_position, position, by_velocity * velocity));
    if (!is_finite(force)) return {two_kelvins::damping[0], 0};
    x_ = after(x_, gamma, fused(alpha, position, beta * velocity));
    return {two_kelvins::damping[0], force};
  }

 private:
  double x_ = 0;  // [m]
};

// The same law with a force for a state, F = C (x − r u) with r u where x comes to rest: F ← γ F − γ C r Δu + C β v and
// m = F + K u − C r Δu + B v. Its rounding errors are those of the force that is left, however far the network has
// crept: this is the form that dashpot emits.
class hand_kelvin_forces {
  static constexpr double k1 = two_kelvins::stiffness[0], k2 = two_kelvins::stiffness[1];  // [N/m]
  static constexpr double b1 = two_kelvins::damping[0];                                    // [N·s/m]
  static constexpr double rate = (b1 + two_kelvins::damping[1]) / period, whole = k1 + k2 + rate;
  static constexpr double gamma = rate / whole, beta = b1 / whole, at_rest = k1 / (k1 + k2);
  static constexpr double of_state = b1 / period - (k1 + b1 / period) * gamma;  // C
  static constexpr double by_change = -of_state * at_rest, by_velocity = -(k1 + b1 / period) * beta;

 public:
  command<double> step(double position, double velocity) noexcept {
    const double change = position - last_position_;
    const double force =
        fused(k1 * k2 / (k1 + k2), position, force_) + fused(by_change, change, by_velocity * velocity);
    if (!is_finite(force)) return {b1, 0};
    force_ = after(force_, gamma, fused(gamma * by_change, change, of_state * beta * velocity));
    last_position_ = position;
    return {b1, force};
  }

 private:
  double force_ = 0, last_position_ = 0;  // [N], [m]
};

// Fig. 10: t = F + K Δu, F = clamp(t, ±Y); b tells whether t was beyond.
class hand_needle {
 public:
  command<double> step(double position, double velocity) noexcept {
    const double trial = awake(force_) + needle::stiffness * (position - last_position_);
    const double below = trial < needle::yield_force ? trial : needle::yield_force;
    const double force = below > -needle::yield_force ? below : -needle::yield_force;
    if (!is_finite(trial) || !is_finite(velocity)) return {needle::damping[0], 0};
    force_ = force;
    last_position_ = position;
    return {trial != force ? needle::damping[0] + needle::damping[1] : needle::damping[0], force};
  }

 private:
  double force_ = 0, last_position_ = 0;
};

// The same by branches: where one of them is foreseen, the next sample need not wait for this one's force.
class hand_needle_branches {
 public:
  command<double> step(double position, double velocity) noexcept {
    const double trial = force_ + needle::stiffness * (position - last_position_);
    if (!is_finite(trial) || !is_finite(velocity)) return {needle::damping[0], 0};
    last_position_ = position;
    if (trial > needle::yield_force) return slide(needle::yield_force);
    if (trial < -needle::yield_force) return slide(-needle::yield_force);
    force_ = awake(trial);
    return {needle::damping[0], trial};
  }

 private:
  command<double> slide(double force) noexcept {
    force_ = force;
    return {needle::damping[0] + needle::damping[1], force};
  }

  double force_ = 0, last_position_ = 0;
};

}  // namespace dashpot::contest
