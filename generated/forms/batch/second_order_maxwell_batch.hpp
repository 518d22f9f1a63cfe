// General viscoelastic solid, Fig. 2e: many points at once
//
// source: Gosline & Hayward 2009, Fig. 5
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly
// brake: makes b = 11 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series, B1
//   dissipates 100 % of the energy at low frequency, so that the brake makes its 5 N s/m; in series, B2 dissipates
//   100 % of the energy at low frequency, so that the brake makes its 6 N s/m
// states: what the law remembers follows the measured position (position driven: on an ideal device position and
//   velocity do equally well)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: certified for any motion, samples at 1000 Hz: needs 10.9819 N·s/m, the most at 8.53085 Hz; 11 N·s/m
//   is guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion the law gives out no more work than stored_energy() decreases by; rounding changes the
//   force by at most 2e-13 of the sum of its terms' magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 4 additions, 3 multiplications, 0 guards against subnormal numbers
// cost of update(): 3 additions, 4 multiplications, 2 guards against subnormal numbers; 6 numbers kept between
//   samples
// rounding: the force of a mode is off by at most 2e-13 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// af2735eee93eb33a8f9a4a4f82c0acd10271a91cc25bb6eaf3dfce559e6694af. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/vector.hpp>

namespace dashpot::generated {

// Many points, each with a network of its own. The results of every point are, to the last bit, those of a
// second_order_maxwell with the same samples, whatever the number of points and the registers of the machine.
class second_order_maxwell_batch {
 public:
  using scalar = double;
  static constexpr scalar sample_period = 0.001;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;
  static constexpr scalar damping = 11.0;  // b, the brake's part, of every point

  // How many scalars are kept for each point, and how many points make a block. In a block the scalars lie state by
  // state, so that memory is read and written in one stream.
  static constexpr int states = 3;
  static constexpr int block = 64 / static_cast<int>(sizeof(scalar));

  // Scalars of storage that `points` points need.
  static constexpr long long storage_size(long long points) noexcept { return (points + block - 1) / block * block * states; }

  // `storage` has room for storage_size(points) scalars and outlives this; it is best aligned to 64 bytes.
  second_order_maxwell_batch(scalar* storage, long long points) noexcept : storage_(storage), points_(points) { reset(); }

  long long points() const noexcept { return points_; }

  // All points at rest at `position` [m]; a NaN or infinite one counts as 0.
  void reset(scalar position = 0) noexcept {
    for (long long point = 0; point < points_; ++point) reset_point(point, position);
  }

  void reset_point(long long point, [[maybe_unused]] scalar position = 0) noexcept {
    [[maybe_unused]] scalar* const state = state_of(point);
    position = dashpot::all_finite(position, position, position) ? position : scalar(0);
    put(state, 0, position);
    put(state, 1, 0.0);
    put(state, 2, 0.0);
  }

  // The commands for this sample of all points: positions [m] and velocities [m/s] to
  // forces. Changes no state: pass the same samples to update().
  void output(const scalar* positions, const scalar* velocities, scalar* forces) const noexcept {
    run<true, false>(positions, velocities, forces);
  }

  // Advances the states to the next sample. A point whose sample is not finite stays as it was.
  void update(const scalar* positions, const scalar* velocities) noexcept {
    run<false, true>(positions, velocities, nullptr);
  }

  // output() and update() in one pass through the memory: 5 scalars read and 4 written a point.
  void step(const scalar* positions, const scalar* velocities, scalar* forces) noexcept {
    run<true, true>(positions, velocities, forces);
  }

  // Energy in the springs of the point [J].
  scalar stored_energy(long long point) const noexcept {
    using vector = dashpot::vector<scalar, 1>;
    [[maybe_unused]] const scalar* const state = state_of(point);
    const vector last_position_ = vector::at(state, 0 * block);
    const vector B2_K2_force_ = vector::at(state, 1 * block);
    const vector B1_K1_force_ = vector::at(state, 2 * block);
    // F²/(2k)
    const vector B2_K2_energy = B2_K2_energy_weight * B2_K2_force_ * B2_K2_force_;
    const vector B1_K1_energy = B1_K1_energy_weight * B1_K1_force_ * B1_K1_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const vector stored = half_static_stiffness * last_position_ * last_position_ + (B2_K2_energy + B1_K1_energy);
    return stored[0];
  }

 private:
  scalar* state_of(long long point) const noexcept { return storage_ + point / block * block * states + point % block; }

  // Through volatile: compilers turn a plain loop into a call of memset, which may not be there.
  static void put(volatile scalar* state, int number, scalar value) noexcept { state[number * block] = value; }

  template <bool gives_commands, bool advances>
  void run(const scalar* positions, const scalar* velocities, scalar* forces) const noexcept {
    using vector = dashpot::vector<scalar, dashpot::vector_width<scalar, 2 * block>>;
    long long point = 0;
    for (; point + block <= points_; point += block)
      DASHPOT_UNROLL
      for (int i = 0; i < block; i += vector::width)
        points_from<vector, gives_commands, advances>(point + i, positions, velocities, forces);
    for (; point < points_; ++point)
      points_from<dashpot::vector<scalar, 1>, gives_commands, advances>(point, positions, velocities, forces);
  }

  // `point` and those that follow it in a register.
  template <class vector, bool gives_commands, bool advances>
  void points_from(long long point, const scalar* positions, const scalar* velocities, scalar* forces) const noexcept {
    [[maybe_unused]] scalar* const state = state_of(point);
    const vector position = vector::at(positions, point), velocity = vector::at(velocities, point);
    vector last_position_ = vector::at(state, 0 * block);  // u of the sample before [m]
    vector B2_K2_force_ = vector::at(state, 1 * block);  // force of the mode, decayed to the next sample [N]
    vector B1_K1_force_ = vector::at(state, 2 * block);  // force of the mode, decayed to the next sample [N]
    const vector relaxed_force_ = (B2_K2_force_ + B1_K1_force_);  // S = Σ a_i F_i
    // Δu = u − u₋
    const vector position_change = position - last_position_;
    // m = f − b u̇
    const vector force = relaxed_force_ + static_stiffness * position + (step_stiffness * position_change +
        velocity_gain * velocity);
    const vector sampled = vector::all_finite(position, velocity, force);
    if constexpr (gives_commands) {
      vector::put(forces, point, vector::where(sampled, force, scalar(0)));
    }
    if constexpr (advances) {
      const vector sampled_position_change_ = position_change;
      const vector sampled_position_ = position;
      // F ← a (F + c Δu)
      B2_K2_force_ = B2_K2_gain * sampled_position_change_ +
          B2_K2_decay * vector::flush_below(threshold, B2_K2_force_);
      B1_K1_force_ = B1_K1_gain * sampled_position_change_ +
          B1_K1_decay * vector::flush_below(threshold, B1_K1_force_);
      // u₋ = u
      last_position_ = sampled_position_;
      vector::put(state, 0 * block, vector::where(sampled, last_position_, vector::at(state, 0 * block)));
      vector::put(state, 1 * block, vector::where(sampled, B2_K2_force_, vector::at(state, 1 * block)));
      vector::put(state, 2 * block, vector::where(sampled, B1_K1_force_, vector::at(state, 2 * block)));
    }
  }

  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar static_stiffness = 5.0;  // k0 [N/m]
  static constexpr scalar step_stiffness = 21.977282807459243;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar velocity_gain = -11.0;  // b∞ − b [N·s/m]
  static constexpr scalar B2_K2_gain = 9.975032378492145;  // a c [N/m]
  static constexpr scalar B1_K1_gain = 11.956880536422767;  // a c [N/m]
  static constexpr scalar B2_K2_decay = 0.9983347214509387;  // a = e^{−λh} [1]
  static constexpr scalar B1_K1_decay = 0.9976028776973818;  // a = e^{−λh} [1]
  static constexpr scalar half_static_stiffness = 2.5;  // ½ k0 [N/m]
  static constexpr scalar B2_K2_energy_weight = 0.050166944753343795;  // 1/(2 k a²) [m/N]
  static constexpr scalar B1_K1_energy_weight = 0.041867147435589155;  // 1/(2 k a²) [m/N]

  scalar* storage_;
  long long points_;
};

// The same with storage of its own, for a number of points that is known beforehand.
template <int size>
struct second_order_maxwell_batch_storage {
  static constexpr long long needed = second_order_maxwell_batch::storage_size(size);
  alignas(64) double values[needed > 0 ? static_cast<decltype(sizeof(0))>(needed) : 1];
};

template <int size>
class second_order_maxwell_points : private second_order_maxwell_batch_storage<size>, public second_order_maxwell_batch {
 public:
  second_order_maxwell_points() noexcept : second_order_maxwell_batch(this->values, size) {}
  second_order_maxwell_points(const second_order_maxwell_points&) = delete;
  second_order_maxwell_points& operator=(const second_order_maxwell_points&) = delete;
};

}  // namespace dashpot::generated
