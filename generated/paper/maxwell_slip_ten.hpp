// Presliding friction of ten springs with slips, which yield one after the other, every 0.1 mm
//
// source: beyond Gosline & Hayward 2009, whose Fig. 10 has one; values chosen here
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, except in
//   samples in which a slip or a contact changes
// brake: makes the damping that the next lines give for each slip, and the motor the rest of the force
// slip rule of Y1; Y2; Y3; Y4 and 6 more: velocity-free, while slips slide, no damper acts beyond those at the
//   tool; b = 0 N·s/m stuck, 0 sliding
// states: what the law remembers follows the measured position (position driven: on an ideal device position and
//   velocity do equally well)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: to be passive for any motion, whichever slips slide or stick and whether the tool
//   touches or not, any brake that makes at least the commanded damping, the law needs 0.775 N·s/m by a proof
//   sample by sample, for commands that are held for up to 0.001 s; 0 N·s/m is guaranteed; the brake's command
//   would have to be 0.775 N·s/m larger
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion no part gives out more work than it has stored, and slips and contacts only dissipate
//   energy; rounding changes the force by at most 3.9e-15 of the sum of its terms' magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 20 additions, 10 multiplications, 0 guards against subnormal numbers
// cost of update(): 0 additions, 0 multiplications, 10 guards against subnormal numbers; 23 numbers kept between
//   samples
// loops: laid out for registers of 16 bytes; sums in 8 parts, the same bits on every machine
// rounding: the force of a mode is off by at most 5.6e-16 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// a2b38b672b92e39ce23cec96185e5176750ca00e8becc81f0dd2493cf7f6d267. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/vector.hpp>

namespace dashpot::generated {

class maxwell_slip_ten {
 public:
  using scalar = double;
  static constexpr scalar sample_period = 0.001;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::translation;

  // The part of the brake's command that was added for passivity: it is felt in addition to the network.
  static constexpr scalar added_damping = 0.0;

  // What the servo loop compares with the device that it drives.
  struct certified_for {
    static constexpr bool any_device = true;
    static constexpr const char* device = "ideal";
    static constexpr const char* device_digest = "";
    static constexpr const char* estimator = "exact";
    static constexpr unsigned loop_delay = 0;  // [samples]
    static constexpr bool is_certified = false;
  };

  struct parameters {};

  // Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
  // NaN or infinite position counts as 0.
  void reset(scalar position = 0) noexcept {
    last_position_ = dashpot::all_finite(position, position, position) ? position : 0;
    clear(K1_spring_force_);
    sampled_position_change_ = 0;
    clear(sampled_Y1_slip_);
    sampled_position_ = 0;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    using vector = dashpot::vector<scalar, dashpot::vector_width<scalar, 8>, 16>;
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    scalar Y1_slip[16];
    dashpot::partial_sums<vector, 8> lane;
    for (int i = 0; i < 16; i += 8)
      DASHPOT_UNROLL
      for (int j = i; j < i + 8; j += vector::width) {
        // trial = force of the slip if it held
        const vector Y1_trial = vector::at(Y1_trial_by_change, j) * position_change +
            vector::at(K1_spring_force_, j);
        vector::put(Y1_slip, j, vector::clamp_to(vector::at(Y1_yield, j), Y1_trial));  // slip = clamp(trial, ±Y)
        lane.add(j - i, vector::at(Y1_slip, j));
      }
    const scalar Y1_force_sum = lane.total();
    // m = f − b u̇
    const scalar force = Y1_force_sum;
    sampled_ = false;
    if (!dashpot::all_finite(position, velocity, force)) return {damping, 0};
    sampled_ = true;
    sampled_position_change_ = position_change;
    for (int i = 0; i < 16; i += 8)
      DASHPOT_UNROLL
      for (int j = i; j < i + 8; j += vector::width) {
        vector::put(sampled_Y1_slip_, j, vector::at(Y1_slip, j));
      }
    sampled_position_ = position;
    return {damping, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    using vector = dashpot::vector<scalar, dashpot::vector_width<scalar, 8>, 16>;
    for (int i = 0; i < 16; i += 8)
      DASHPOT_UNROLL
      for (int j = i; j < i + 8; j += vector::width) {
        // F ← F + k δ
        vector::put(K1_spring_force_, j, vector::flush_below(threshold, vector::at(sampled_Y1_slip_, j)));
      }
    // u₋ = u
    last_position_ = sampled_position_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    const dashpot::command<scalar> now = output(position, velocity);
    update();
    return now;
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    using vector = dashpot::vector<scalar, dashpot::vector_width<scalar, 8>, 16>;
    dashpot::partial_sums<vector, 8> lane;
    for (int i = 0; i < 16; i += 8)
      DASHPOT_UNROLL
      for (int j = i; j < i + 8; j += vector::width) {
        // F²/(2k)
        const vector K1_spring_energy = vector::at(K1_compliance, j) * vector::at(K1_spring_force_, j) *
            vector::at(K1_spring_force_, j);
        lane.add(j - i, K1_spring_energy);
      }
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = lane.total();
    return stored;
  }

 private:
  // Through volatile: compilers turn a plain loop into a call of memset, which may not be there.
  template <unsigned size>
  static void clear(volatile scalar (&states)[size]) noexcept {
    for (unsigned i = 0; i < size; ++i) states[i] = 0;
  }

  static constexpr scalar damping = 0.0;  // b, the brake's part
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  // factor of the change of position [N/m]
  alignas(16) static constexpr scalar Y1_trial_by_change[16] = {200.0, 190.0, 180.0, 170.0, 160.0, 150.0, 140.0,
      130.0, 120.0, 110.0};
  // Y [N]
  alignas(16) static constexpr scalar Y1_yield[16] = {0.02, 0.038, 0.054, 0.068, 0.08, 0.09, 0.098, 0.104, 0.108,
      0.11};
  // 1/(2 k) [m/N]
  alignas(16) static constexpr scalar K1_compliance[16] = {0.0025, 0.002631578947368421, 0.002777777777777778,
      0.0029411764705882353, 0.003125, 0.0033333333333333335, 0.0035714285714285713, 0.0038461538461538464,
      0.004166666666666667, 0.004545454545454545};

  alignas(16) scalar K1_spring_force_[16] = {};  // force of the spring [N]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  alignas(16) scalar sampled_Y1_slip_[16] = {};  // the slip's force, at this sample [N]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
