// A polymer around a needle, over 21 decades of time
//
// source: Master curve from NREL/pyvisco (BSD-3-Clause), its rows up to 1e19 s. Fitted by dashpot fit to
//   time_user_master_to_1e19s.csv; along a needle of radius 0.0005 m, moduli read as Young's modulus: stiffness =
//   modulus times 0.0139825 m
// valid: frequency 1.59e-20 to 56.5 Hz
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly
// brake: makes b = 9.792702982160179e+24 N·s/m of damping, and the motor the rest of the force; by the rule
//   'paper': in series, B1 dissipates 100 % of the energy at low frequency, so that the brake makes its 1.858e+07
//   N s/m; in series, B2 dissipates 100 % of the energy at low frequency, so that the brake makes its 1.779e+11 N
//   s/m; in series, B3 dissipates 100 % of the energy at low frequency, so that the brake makes its 1.216e+16 N
//   s/m; in series, B4 dissipates 100 % of the energy at low frequency, so that the brake makes its 4.297e+19 N
//   s/m; and 3 more series connections likewise
// states: what the law remembers follows the measured position (position driven: on an ideal device position and
//   velocity do equally well)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: to be passive for any motion, samples at 1000 Hz, the law needs 9.7927e+24 N·s/m, the
//   most at 7.11478e-06 Hz; 9.7927e+24 N·s/m is guaranteed; the brake's command would have to be 3.91708e+16 N·s/m
//   larger
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion the law gives out no more work than stored_energy() decreases by; rounding changes the
//   force by at most 7.2e-11 of the sum of its terms' magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 4 additions, 3 multiplications, 0 guards against subnormal numbers
// cost of update(): 41 additions, 14 multiplications, 14 guards against subnormal numbers; 18 numbers kept between
//   samples
// rounding: in compensated form the force of a mode is off by at most 7.2e-11 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// 78da512619a90884fafef2d18d67318526d8a1a49060a67bd92c916e18d81f8c. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class polymer {
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
    relaxed_force_ = 0;
    B7_K7_force_ = 0;
    B6_K6_force_ = 0;
    B5_K5_force_ = 0;
    B4_K4_force_ = 0;
    B3_K3_force_ = 0;
    B2_K2_force_ = 0;
    B1_K1_force_ = 0;
    B7_K7_error_ = 0;
    B6_K6_error_ = 0;
    B5_K5_error_ = 0;
    B4_K4_error_ = 0;
    B3_K3_error_ = 0;
    B2_K2_error_ = 0;
    B1_K1_error_ = 0;
    sampled_position_change_ = 0;
    sampled_position_ = 0;
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
    // y = (a c Δu − α F) + e
    // B7, K7
    const scalar B7_K7_increment = B7_K7_gain * sampled_position_change_ - B7_K7_loss * B7_K7_force_ + B7_K7_error_;
    // B6, K6
    const scalar B6_K6_increment = B6_K6_gain * sampled_position_change_ - B6_K6_loss * B6_K6_force_ + B6_K6_error_;
    // B5, K5
    const scalar B5_K5_increment = B5_K5_gain * sampled_position_change_ - B5_K5_loss * B5_K5_force_ + B5_K5_error_;
    // B4, K4
    const scalar B4_K4_increment = B4_K4_gain * sampled_position_change_ - B4_K4_loss * B4_K4_force_ + B4_K4_error_;
    // B3, K3
    const scalar B3_K3_increment = B3_K3_gain * sampled_position_change_ - B3_K3_loss * B3_K3_force_ + B3_K3_error_;
    // B2, K2
    const scalar B2_K2_increment = B2_K2_gain * sampled_position_change_ - B2_K2_loss * B2_K2_force_ + B2_K2_error_;
    // B1, K1
    const scalar B1_K1_increment = B1_K1_gain * sampled_position_change_ - B1_K1_loss * B1_K1_force_ + B1_K1_error_;
    // t = F + y
    const scalar B7_K7_next = B7_K7_force_ + B7_K7_increment;
    const scalar B6_K6_next = B6_K6_force_ + B6_K6_increment;
    const scalar B5_K5_next = B5_K5_force_ + B5_K5_increment;
    const scalar B4_K4_next = B4_K4_force_ + B4_K4_increment;
    const scalar B3_K3_next = B3_K3_force_ + B3_K3_increment;
    const scalar B2_K2_next = B2_K2_force_ + B2_K2_increment;
    const scalar B1_K1_next = B1_K1_force_ + B1_K1_increment;
    // e = y − (t − F)
    B7_K7_error_ = dashpot::flush_below(threshold, B7_K7_increment - (B7_K7_next - B7_K7_force_));
    B6_K6_error_ = dashpot::flush_below(threshold, B6_K6_increment - (B6_K6_next - B6_K6_force_));
    B5_K5_error_ = dashpot::flush_below(threshold, B5_K5_increment - (B5_K5_next - B5_K5_force_));
    B4_K4_error_ = dashpot::flush_below(threshold, B4_K4_increment - (B4_K4_next - B4_K4_force_));
    B3_K3_error_ = dashpot::flush_below(threshold, B3_K3_increment - (B3_K3_next - B3_K3_force_));
    B2_K2_error_ = dashpot::flush_below(threshold, B2_K2_increment - (B2_K2_next - B2_K2_force_));
    B1_K1_error_ = dashpot::flush_below(threshold, B1_K1_increment - (B1_K1_next - B1_K1_force_));
    // F = t
    B7_K7_force_ = dashpot::flush_below(threshold, B7_K7_next);  // B7, K7
    B6_K6_force_ = dashpot::flush_below(threshold, B6_K6_next);  // B6, K6
    B5_K5_force_ = dashpot::flush_below(threshold, B5_K5_next);  // B5, K5
    B4_K4_force_ = dashpot::flush_below(threshold, B4_K4_next);  // B4, K4
    B3_K3_force_ = dashpot::flush_below(threshold, B3_K3_next);  // B3, K3
    B2_K2_force_ = dashpot::flush_below(threshold, B2_K2_next);  // B2, K2
    B1_K1_force_ = dashpot::flush_below(threshold, B1_K1_next);  // B1, K1
    // S = Σ a_i F_i
    relaxed_force_ = B7_K7_force_ + B6_K6_force_ + B5_K5_force_ + B4_K4_force_ + B3_K3_force_ + B2_K2_force_ +
        B1_K1_force_;
    // u₋ = u
    last_position_ = sampled_position_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // Δu = u − u₋
    const scalar position_change = position - last_position_;
    // m = f − b u̇
    const scalar force = relaxed_force_ + static_stiffness * position + (step_stiffness * position_change +
        velocity_gain * velocity);
    if (!dashpot::all_finite(force)) {
      sampled_ = false;
      return {damping, 0};
    }
    // y = (a c Δu − α F) + e
    // B7, K7
    const scalar B7_K7_increment = B7_K7_gain * position_change - B7_K7_loss * B7_K7_force_ + B7_K7_error_;
    // B6, K6
    const scalar B6_K6_increment = B6_K6_gain * position_change - B6_K6_loss * B6_K6_force_ + B6_K6_error_;
    // B5, K5
    const scalar B5_K5_increment = B5_K5_gain * position_change - B5_K5_loss * B5_K5_force_ + B5_K5_error_;
    // B4, K4
    const scalar B4_K4_increment = B4_K4_gain * position_change - B4_K4_loss * B4_K4_force_ + B4_K4_error_;
    // B3, K3
    const scalar B3_K3_increment = B3_K3_gain * position_change - B3_K3_loss * B3_K3_force_ + B3_K3_error_;
    // B2, K2
    const scalar B2_K2_increment = B2_K2_gain * position_change - B2_K2_loss * B2_K2_force_ + B2_K2_error_;
    // B1, K1
    const scalar B1_K1_increment = B1_K1_gain * position_change - B1_K1_loss * B1_K1_force_ + B1_K1_error_;
    // t = F + y
    const scalar B7_K7_next = B7_K7_force_ + B7_K7_increment;
    const scalar B6_K6_next = B6_K6_force_ + B6_K6_increment;
    const scalar B5_K5_next = B5_K5_force_ + B5_K5_increment;
    const scalar B4_K4_next = B4_K4_force_ + B4_K4_increment;
    const scalar B3_K3_next = B3_K3_force_ + B3_K3_increment;
    const scalar B2_K2_next = B2_K2_force_ + B2_K2_increment;
    const scalar B1_K1_next = B1_K1_force_ + B1_K1_increment;
    // e = y − (t − F)
    B7_K7_error_ = dashpot::flush_below(threshold, B7_K7_increment - (B7_K7_next - B7_K7_force_));
    B6_K6_error_ = dashpot::flush_below(threshold, B6_K6_increment - (B6_K6_next - B6_K6_force_));
    B5_K5_error_ = dashpot::flush_below(threshold, B5_K5_increment - (B5_K5_next - B5_K5_force_));
    B4_K4_error_ = dashpot::flush_below(threshold, B4_K4_increment - (B4_K4_next - B4_K4_force_));
    B3_K3_error_ = dashpot::flush_below(threshold, B3_K3_increment - (B3_K3_next - B3_K3_force_));
    B2_K2_error_ = dashpot::flush_below(threshold, B2_K2_increment - (B2_K2_next - B2_K2_force_));
    B1_K1_error_ = dashpot::flush_below(threshold, B1_K1_increment - (B1_K1_next - B1_K1_force_));
    // F = t
    B7_K7_force_ = dashpot::flush_below(threshold, B7_K7_next);  // B7, K7
    B6_K6_force_ = dashpot::flush_below(threshold, B6_K6_next);  // B6, K6
    B5_K5_force_ = dashpot::flush_below(threshold, B5_K5_next);  // B5, K5
    B4_K4_force_ = dashpot::flush_below(threshold, B4_K4_next);  // B4, K4
    B3_K3_force_ = dashpot::flush_below(threshold, B3_K3_next);  // B3, K3
    B2_K2_force_ = dashpot::flush_below(threshold, B2_K2_next);  // B2, K2
    B1_K1_force_ = dashpot::flush_below(threshold, B1_K1_next);  // B1, K1
    // S = Σ a_i F_i
    relaxed_force_ = B7_K7_force_ + B6_K6_force_ + B5_K5_force_ + B4_K4_force_ + B3_K3_force_ + B2_K2_force_ +
        B1_K1_force_;
    // u₋ = u
    last_position_ = position;
    sampled_ = false;
    return {damping, force};
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // F²/(2k)
    const scalar B7_K7_energy = B7_K7_energy_weight * B7_K7_force_ * B7_K7_force_;  // B7, K7
    const scalar B6_K6_energy = B6_K6_energy_weight * B6_K6_force_ * B6_K6_force_;  // B6, K6
    const scalar B5_K5_energy = B5_K5_energy_weight * B5_K5_force_ * B5_K5_force_;  // B5, K5
    const scalar B4_K4_energy = B4_K4_energy_weight * B4_K4_force_ * B4_K4_force_;  // B4, K4
    const scalar B3_K3_energy = B3_K3_energy_weight * B3_K3_force_ * B3_K3_force_;  // B3, K3
    const scalar B2_K2_energy = B2_K2_energy_weight * B2_K2_force_ * B2_K2_force_;  // B2, K2
    const scalar B1_K1_energy = B1_K1_energy_weight * B1_K1_force_ * B1_K1_force_;  // B1, K1
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar stored = half_static_stiffness * last_position_ * last_position_ + (B7_K7_energy + B6_K6_energy +
        B5_K5_energy + B4_K4_energy + B3_K3_energy + B2_K2_energy + B1_K1_energy);
    return stored;
  }

 private:
  static constexpr scalar damping = 9.792702982160179e+24;  // b, the brake's part
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar static_stiffness = 6648000.0;  // k0 [N/m]
  static constexpr scalar step_stiffness = 15679966.95745401;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar velocity_gain = -9.792702982160179e+24;  // b∞ − b [N·s/m]
  static constexpr scalar B7_K7_gain = 3182000.0;  // a c [N/m]
  static constexpr scalar B6_K6_gain = 3567000.0;  // a c [N/m]
  static constexpr scalar B5_K5_gain = 2859000.0;  // a c [N/m]
  static constexpr scalar B4_K4_gain = 1788000.0;  // a c [N/m]
  static constexpr scalar B3_K3_gain = 1719999.9999996352;  // a c [N/m]
  static constexpr scalar B2_K2_gain = 1455999.9821253289;  // a c [N/m]
  static constexpr scalar B1_K1_gain = 1107900.8928638084;  // a c [N/m]
  static constexpr scalar B7_K7_loss = 3.4079468780122097e-22;  // α = 1 − a [1]
  static constexpr scalar B6_K6_loss = 8.004937163375223e-21;  // α = 1 − a [1]
  static constexpr scalar B5_K5_loss = 2.841948310139165e-19;  // α = 1 − a [1]
  static constexpr scalar B4_K4_loss = 4.16104258785199e-17;  // α = 1 − a [1]
  static constexpr scalar B3_K3_loss = 1.4144736842104262e-13;  // α = 1 − a [1]
  static constexpr scalar B2_K2_loss = 8.184373209903184e-09;  // α = 1 − a [1]
  static constexpr scalar B1_K1_loss = 5.9632236997435736e-05;  // α = 1 − a [1]
  static constexpr scalar half_static_stiffness = 3324000.0;  // ½ k0 [N/m]
  static constexpr scalar B7_K7_energy_weight = 1.5713387806411062e-07;  // 1/(2 k a²) [m/N]
  static constexpr scalar B6_K6_energy_weight = 1.4017381553125876e-07;  // 1/(2 k a²) [m/N]
  static constexpr scalar B5_K5_energy_weight = 1.7488632388947184e-07;  // 1/(2 k a²) [m/N]
  static constexpr scalar B4_K4_energy_weight = 2.796420581655481e-07;  // 1/(2 k a²) [m/N]
  static constexpr scalar B3_K3_energy_weight = 2.906976744186869e-07;  // 1/(2 k a²) [m/N]
  static constexpr scalar B2_K2_energy_weight = 3.434065990277289e-07;  // 1/(2 k a²) [m/N]
  static constexpr scalar B1_K1_energy_weight = 4.5131736242908583e-07;  // 1/(2 k a²) [m/N]

  scalar relaxed_force_ = 0;  // sum of the modes' forces, decayed to the next sample [N]
  scalar B7_K7_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar B6_K6_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar B5_K5_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar B4_K4_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar B3_K3_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar B2_K2_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar B1_K1_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar B7_K7_error_ = 0;  // rounding error of the force, carried along [N]
  scalar B6_K6_error_ = 0;  // rounding error of the force, carried along [N]
  scalar B5_K5_error_ = 0;  // rounding error of the force, carried along [N]
  scalar B4_K4_error_ = 0;  // rounding error of the force, carried along [N]
  scalar B3_K3_error_ = 0;  // rounding error of the force, carried along [N]
  scalar B2_K2_error_ = 0;  // rounding error of the force, carried along [N]
  scalar B1_K1_error_ = 0;  // rounding error of the force, carried along [N]
  scalar sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar last_position_ = 0;  // u of the sample before [m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
