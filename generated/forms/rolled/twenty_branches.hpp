// More branches than straight-line code is written for
//
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly
// brake: makes b = 6.629 N·s/m of damping, and the motor the rest of the force; by the rule 'paper': in series,
//   damper_2 dissipates 100 % of the energy at low frequency, so that the brake makes its 1.666 N s/m; in series,
//   damper_4 dissipates 100 % of the energy at low frequency, so that the brake makes its 0.909 N s/m; in series,
//   damper_6 dissipates 100 % of the energy at low frequency, so that the brake makes its 0.625 N s/m; in series,
//   damper_8 dissipates 100 % of the energy at low frequency, so that the brake makes its 0.476 N s/m; and 16 more
//   series connections likewise
// states: what the law remembers follows the measured position (position driven: on an ideal device position and
//   velocity do equally well)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: certified for any motion, samples at 1000 Hz: needs 6.24683 N·s/m, the most at 40.8013 Hz; 6.629
//   N·s/m is guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion the law gives out no more work than stored_energy() decreases by; rounding changes the
//   force by at most 5.6e-13 of the sum of its terms' magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 4 additions, 3 multiplications, 0 guards against subnormal numbers
// cost of update(): 39 additions, 40 multiplications, 8 guards against subnormal numbers; 24 numbers kept between
//   samples
// loops: laid out for registers of 16 bytes; sums in 8 parts, the same bits on every machine
// rounding: the force of a mode is off by at most 5.6e-13 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// 8e43bc2c575c8e1cd6925df0c03a595836473389d0c53eeb857e9ecafad28b04. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/vector.hpp>

namespace dashpot::generated {

class twenty_branches {
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
    static constexpr bool is_certified = true;
  };

  struct parameters {};

  // Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
  // NaN or infinite position counts as 0.
  void reset(scalar position = 0) noexcept {
    last_position_ = dashpot::all_finite(position, position, position) ? position : 0;
    relaxed_force_ = 0;
    clear(mode_force_);
    sampled_position_change_ = 0;
    sampled_position_ = 0;
    mode_force_turn_ = 0;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // m = f − b u̇
    const scalar force = relaxed_force_ + static_stiffness * position + (step_stiffness * position_change +
        velocity_gain * velocity);
    sampled_ = false;
    if (!dashpot::all_finite(force)) return {damping, 0};
    sampled_ = true;
    sampled_position_change_ = position_change;
    sampled_position_ = position;
    return {damping, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    using vector = dashpot::vector<scalar, dashpot::vector_width<scalar, 8>, 16>;
    // |F| below the threshold: F ← 0, of 8 modes a sample in turn
    DASHPOT_UNROLL
    for (int j = 0, first = mode_force_turn_; j < 8; j += vector::width)
      vector::put(mode_force_, first + j, vector::flush_below(threshold, vector::at(mode_force_, first + j)));
    mode_force_turn_ += 8;
    mode_force_turn_ = mode_force_turn_ < 24 ? mode_force_turn_ : 0;
    dashpot::partial_sums<vector, 8> lane;
    const vector sampled_position_change = sampled_position_change_;
    for (int i = 0; i < 24; i += 8)
      DASHPOT_UNROLL
      for (int j = i; j < i + 8; j += vector::width) {
        // F ← a (F + c Δu)
        vector::put(mode_force_, j, vector::at(mode_gain, j) * sampled_position_change +
            vector::at(mode_decay, j) * vector::at(mode_force_, j));
        lane.add(j - i, vector::at(mode_force_, j));
      }
    // S = Σ a_i F_i
    relaxed_force_ = lane.total();
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
    for (int i = 0; i < 24; i += 8)
      DASHPOT_UNROLL
      for (int j = i; j < i + 8; j += vector::width) {
        // F²/(2k)
        const vector mode_energy = vector::at(mode_energy_weight, j) * vector::at(mode_force_, j) *
            vector::at(mode_force_, j);
        lane.add(j - i, mode_energy);
      }
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = half_static_stiffness * last_position_ * last_position_ + lane.total();
    return stored;
  }

 private:
  // Through volatile: compilers turn a plain loop into a call of memset, which may not be there.
  template <unsigned size>
  static void clear(volatile scalar (&states)[size]) noexcept {
    for (unsigned i = 0; i < size; ++i) states[i] = 0;
  }

  static constexpr scalar damping = 6.629;  // b, the brake's part
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar static_stiffness = 7.0;  // k0 [N/m]
  static constexpr scalar step_stiffness = 199.30365657408584;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar velocity_gain = -6.629;  // b∞ − b [N·s/m]
  // a c [N/m]
  alignas(16) static constexpr scalar mode_gain[24] = {0.9991000600570155, 1.9934106222244374, 2.978480433050734,
      3.9499078971136554, 4.903325883866855, 5.8347045226329755, 6.739802491278719, 7.6148781541944395,
      8.457759191325112, 9.264250310342275, 10.027765163558726, 10.747820811644033, 11.428601273252138,
      12.05493309411688, 12.639675463986757, 13.173032130062479, 13.657386212240935, 14.066574015262535,
      14.465851713278887, 14.796666209843202};
  // a = e^{−λh} [1]
  alignas(16) static constexpr scalar mode_decay[24] = {0.9993999400120102, 0.9978021986878473,
      0.9952115015900972, 0.9916318482011999, 0.9870635709816842, 0.9815389907568776, 0.9750458746941981,
      0.9676142137097603, 0.9593736509553527, 0.9502592772880621, 0.9400729946885681, 0.929024998115866,
      0.9175091602020665, 0.9048374180359596, 0.8918085345622607, 0.8780240439500775, 0.8636810580212285,
      0.8477770294963396, 0.8330244315177237, 0.8170784211407314};
  static constexpr scalar half_static_stiffness = 3.5;  // ½ k0 [N/m]
  // 1/(2 k a²) [m/N]
  alignas(16) static constexpr scalar mode_energy_weight[24] = {0.5006006005284275, 0.2511025340493813,
      0.16827437130176248, 0.1271185937761999, 0.10263837135705618, 0.08649751713977645, 0.07513146649415968,
      0.06675373015170442, 0.06036037398822283, 0.05537143359878789, 0.051434457706104456, 0.04827629784849771,
      0.04568838789558418, 0.04362152707714892, 0.041911721235910165, 0.04053565583601803, 0.0394288665911734,
      0.03864863934491891, 0.037922846277870015, 0.037446611637797944};

  scalar relaxed_force_ = 0;  // sum of the modes' forces, decayed to the next sample [N]
  alignas(16) scalar mode_force_[24] = {};  // force of the mode, decayed to the next sample [N]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  int mode_force_turn_ = 0;  // first place of mode_force_ that is guarded next
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
