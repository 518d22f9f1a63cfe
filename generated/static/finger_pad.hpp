// Pad of a finger on a stiff plate, three parts side by side
//
// source: A made-up example of several ports: Hertz contact of a pad that begins 1 mm in, a skin whose damping has
//   a curve of its own, and a guide that rubs with a force in newtons, whatever the curves do.
// valid: displacement -0.006 to 0.006 m, rate 0 to 0.2 m/s, frequency 0.1 to 20 Hz
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, except in
//   samples in which a slip or a contact changes
// port pad
//   static curve: power 1.5, 2 N at 0.005 m, at rest; the network is stretched by w(u) instead of the position u,
//   and u in the lines below stands for that w: f = w' F(w), b = w'^2 b_w, with 0 <= w' <= 1.118; the curve's
//   force is off by at most 0.047 % of the largest, and w' by 14 % of its largest
//   brake: makes b = 0 N·s/m of damping, and the motor the rest of the force; by the rule 'faithful': without a
//   device 'faithful' is the paper's rule: in series, damper_3 dissipates 100 % of the energy at low frequency, so
//   that the brake makes its 20 N s/m; with the contact no more than the feedthrough damping, so that the motor
//   compensates nothing
//   states: what the law remembers follows the measured position (position driven, as a network with a contact
//   always is)
//   contact: at 0.001 m; brake and motor 0 while the tool is free
//   late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// port skin
//   static curve: power 2, 1 N at 0.005 m, at once; the network is stretched by w(u) instead of the position u,
//   and u in the lines below stands for that w: f = w' F(w), b = w'^2 b_w, with 0 <= w' <= 1.095; the curve's
//   force is off by at most 0.0036 % of the largest, and w' by 2.3 % of its largest
//   brake: makes b = 3 N·s/m of damping, and the motor the rest of the force; by the rule 'faithful': without a
//   device 'faithful' is the paper's rule: in series, damper_2 dissipates 100 % of the energy at low frequency, so
//   that the brake makes its 3 N s/m
//   states: what the law remembers follows the measured position (position driven, as a network with a static
//   curve always is)
//   late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// port guide
//   brake: makes b = 2 N·s/m of damping and, in the parts with slips, what the next lines give, and the motor the
//   rest of the force; by the rule 'faithful': without a device 'faithful' is the paper's rule: dampers at the
//   tool in parallel add
//   slip rule of slip_3: velocity-free, while slips slide, no damper acts beyond those at the tool; b = 0 N·s/m
//   stuck, 0 sliding
//   states: what the law remembers follows the measured position (position driven: on an ideal device position and
//   velocity do equally well)
//   late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: port 'pad': a static curve's steepness changes while the tool moves, and no device
//   states how fast that is
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 35 additions, 22 multiplications, 1 guard against subnormal numbers
// cost of update(): 2 additions, 4 multiplications, 3 guards against subnormal numbers; 14 numbers kept between
//   samples
// rounding: the force of a mode is off by at most 3.4e-14 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// 66e4a5a3f05e89417619d2d068a45b94e6ea144b32d1b93524152e6a0cac47a4. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::generated {

class finger_pad {
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
    if (!dashpot::all_finite(position)) position = 0;
    // x = u − u0
    const scalar pad_depth = position - pad_surface_at;
    // |x|
    const scalar pad_distance = pad_depth > 0 ? pad_depth : pad_centre - pad_depth;
    const scalar pad_in_cells = dashpot::clamp_to(pad_last_cell, pad_distance * pad_cells_per_length);
    const scalar pad_cell = pad_in_cells > 0 ? pad_in_cells : pad_centre;
    // d = |x| − x_i
    const scalar pad_within = pad_distance - pad_cell_begins[static_cast<int>(pad_cell)];
    // map_e d
    const scalar pad_map_cubic = pad_map_e[static_cast<int>(pad_cell)] * pad_within;
    // map_c + map_e d
    const scalar pad_map_bend = pad_map_c[static_cast<int>(pad_cell)] + pad_map_cubic;
    // |w| = map_a + d (map_b + d map_bend)
    const scalar pad_mapped_size = pad_map_a[static_cast<int>(pad_cell)] +
        pad_within * (pad_map_b[static_cast<int>(pad_cell)] + pad_within * pad_map_bend);
    // w with the sign of x
    const scalar pad_mapped = pad_depth > 0 ? pad_mapped_size : pad_centre - pad_mapped_size;
    // s = (u − u0)⁺
    const scalar pad_pushed_in = pad_mapped > 0 ? pad_mapped : pad_none;
    // |x|
    const scalar skin_distance = position > 0 ? position : skin_centre - position;
    const scalar skin_in_cells = dashpot::clamp_to(skin_last_cell, skin_distance * skin_cells_per_length);
    const scalar skin_cell = skin_in_cells > 0 ? skin_in_cells : skin_centre;
    // d = |x| − x_i
    const scalar skin_within = skin_distance - skin_cell_begins[static_cast<int>(skin_cell)];
    // map_e d
    const scalar skin_map_cubic = skin_map_e[static_cast<int>(skin_cell)] * skin_within;
    // map_c + map_e d
    const scalar skin_map_bend = skin_map_c[static_cast<int>(skin_cell)] + skin_map_cubic;
    // |w| = map_a + d (map_b + d map_bend)
    const scalar skin_mapped_size = skin_map_a[static_cast<int>(skin_cell)] +
        skin_within * (skin_map_b[static_cast<int>(skin_cell)] + skin_within * skin_map_bend);
    // w with the sign of x
    const scalar skin_mapped = position > 0 ? skin_mapped_size : skin_centre - skin_mapped_size;
    pad_surface_ = dashpot::all_finite(pad_pushed_in) ? pad_pushed_in : 0;
    pad_spring_2_damper_3_force_ = 0;
    pad_sampled_surface_change_ = 0;
    pad_sampled_surface_now_ = 0;
    skin_last_position_ = dashpot::all_finite(skin_mapped) ? skin_mapped : 0;
    skin_spring_1_damper_2_force_ = 0;
    skin_sampled_position_change_ = 0;
    skin_sampled_position_ = 0;
    guide_last_position_ = dashpot::all_finite(position, position, position) ? position : 0;
    guide_spring_2_spring_force_2_ = 0;
    guide_sampled_position_change_ = 0;
    guide_sampled_slip_3_slip_2_ = 0;
    guide_sampled_position_ = 0;
    sampled_brake_command_ = 2.0;
    sampled_ = false;
  }

  // The command for this sample: port position [m] and an estimate of its velocity [m/s].
  // After a non-finite input the states stay as they were and the motor's force is 0.
  dashpot::command<scalar> output(scalar position, scalar velocity) noexcept {
    // x = u − u0
    const scalar pad_depth = position - pad_surface_at;
    // |x|
    const scalar pad_distance = pad_depth > 0 ? pad_depth : pad_centre - pad_depth;
    const scalar pad_in_cells = dashpot::clamp_to(pad_last_cell, pad_distance * pad_cells_per_length);
    const scalar pad_cell = pad_in_cells > 0 ? pad_in_cells : pad_centre;
    // d = |x| − x_i
    const scalar pad_within = pad_distance - pad_cell_begins[static_cast<int>(pad_cell)];
    // map_e d
    const scalar pad_map_cubic = pad_map_e[static_cast<int>(pad_cell)] * pad_within;
    // map_c + map_e d
    const scalar pad_map_bend = pad_map_c[static_cast<int>(pad_cell)] + pad_map_cubic;
    // |w| = map_a + d (map_b + d map_bend)
    const scalar pad_mapped_size = pad_map_a[static_cast<int>(pad_cell)] +
        pad_within * (pad_map_b[static_cast<int>(pad_cell)] + pad_within * pad_map_bend);
    // w with the sign of x
    const scalar pad_mapped = pad_depth > 0 ? pad_mapped_size : pad_centre - pad_mapped_size;
    // w′ = map_b + d (2 map_bend + map_e d)
    const scalar pad_tangent = pad_map_b[static_cast<int>(pad_cell)] + pad_within * (pad_map_bend + pad_map_bend +
        pad_map_cubic);
    // Δ = u − s₋
    const scalar pad_approach = pad_mapped - pad_surface_;
    // k0 s₋ + S
    const scalar pad_held_force = pad_static_stiffness * pad_surface_ + pad_spring_2_damper_3_force_;
    // Δs where f = 0: −held force/g
    const scalar pad_surface_recovery = pad_recovery_compliance * pad_held_force;
    // Δs = Δ, but no lower than where f = 0
    const scalar pad_surface_change = pad_surface_recovery - pad_approach > 0 ? pad_surface_recovery : pad_approach;
    // gap = s − u
    const scalar pad_gap = pad_surface_change - pad_approach;
    // s = s₋ + Δs
    const scalar pad_surface_now = pad_gap > 0 ? dashpot::flush_below(threshold, pad_surface_ +
        pad_surface_change) : pad_mapped;
    // f′ = f − b∞ Δs/h
    const scalar pad_opposing = pad_static_stiffness * pad_surface_now + pad_step_stiffness * pad_surface_change +
        pad_spring_2_damper_3_force_;
    // −(f′ + b∞ v̂)
    const scalar pad_pull = pad_none - pad_opposing;
    // above 0 where the tool is free
    const scalar pad_released = pad_pull > 0 ? pad_pull : pad_gap;
    // m = f − b u̇ of a tool that touches
    const scalar pad_mapped_force = pad_released > 0 ? pad_none : pad_opposing;
    // m = w′ M
    const scalar pad_force = pad_tangent * pad_mapped_force;
    // |x|
    const scalar skin_distance = position > 0 ? position : skin_centre - position;
    const scalar skin_in_cells = dashpot::clamp_to(skin_last_cell, skin_distance * skin_cells_per_length);
    const scalar skin_cell = skin_in_cells > 0 ? skin_in_cells : skin_centre;
    // d = |x| − x_i
    const scalar skin_within = skin_distance - skin_cell_begins[static_cast<int>(skin_cell)];
    // map_e d
    const scalar skin_map_cubic = skin_map_e[static_cast<int>(skin_cell)] * skin_within;
    // map_c + map_e d
    const scalar skin_map_bend = skin_map_c[static_cast<int>(skin_cell)] + skin_map_cubic;
    // |w| = map_a + d (map_b + d map_bend)
    const scalar skin_mapped_size = skin_map_a[static_cast<int>(skin_cell)] +
        skin_within * (skin_map_b[static_cast<int>(skin_cell)] + skin_within * skin_map_bend);
    // w with the sign of x
    const scalar skin_mapped = position > 0 ? skin_mapped_size : skin_centre - skin_mapped_size;
    // w′ = map_b + d (2 map_bend + map_e d)
    const scalar skin_tangent = skin_map_b[static_cast<int>(skin_cell)] + skin_within * (skin_map_bend +
        skin_map_bend + skin_map_cubic);
    // ẇ = w′ u̇
    const scalar skin_mapped_velocity = skin_tangent * velocity;
    // Δu = u − u₋
    const scalar skin_position_change = skin_mapped - skin_last_position_;
    // m = f − b u̇
    const scalar skin_mapped_force = skin_spring_1_damper_2_force_ + (skin_step_stiffness * skin_position_change +
        skin_velocity_gain * skin_mapped_velocity);
    // m = w′ M
    const scalar skin_force = skin_tangent * skin_mapped_force;
    // w′²
    const scalar skin_tangent_squared = skin_tangent * skin_tangent;
    // b = w′² b_w
    const scalar skin_brake_command = skin_tangent_squared * skin_mapped_damping;
    // Δu = u − u₋
    const scalar guide_position_change = position - guide_last_position_;
    // trial = force of the slip if it held
    const scalar guide_slip_3_trial_2 = guide_slip_3_trial_by_change_2 * guide_position_change +
        guide_spring_2_spring_force_2_;
    // slip = clamp(trial, ±Y)
    const scalar guide_slip_3_slip_2 = dashpot::clamp_to(guide_slip_3_yield_2, guide_slip_3_trial_2);
    // m = f − b u̇
    const scalar guide_force = guide_slip_3_slip_2;
    // b = Σ b of all ports
    const scalar brake_command = skin_brake_command + steady_damping;
    // m = Σ m of all ports
    const scalar force = pad_force + skin_force + guide_force;
    sampled_ = false;
    if (!dashpot::all_finite(position, force)) return {sampled_brake_command_, 0};
    sampled_ = true;
    pad_sampled_surface_change_ = pad_surface_change;
    pad_sampled_surface_now_ = pad_surface_now;
    skin_sampled_position_change_ = skin_position_change;
    skin_sampled_position_ = skin_mapped;
    guide_sampled_position_change_ = guide_position_change;
    guide_sampled_slip_3_slip_2_ = guide_slip_3_slip_2;
    guide_sampled_position_ = position;
    sampled_brake_command_ = brake_command;
    return {brake_command, force};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // F ← a (F + c Δu)
    pad_spring_2_damper_3_force_ = dashpot::relaxed(threshold, pad_spring_2_damper_3_decay,
        pad_spring_2_damper_3_force_, pad_spring_2_damper_3_gain * pad_sampled_surface_change_);
    // s₋ = s
    pad_surface_ = pad_sampled_surface_now_;
    // F ← a (F + c Δu)
    skin_spring_1_damper_2_force_ = dashpot::relaxed(threshold, skin_spring_1_damper_2_decay,
        skin_spring_1_damper_2_force_, skin_spring_1_damper_2_gain * skin_sampled_position_change_);
    // u₋ = u
    skin_last_position_ = skin_sampled_position_;
    // F ← F + k δ
    guide_spring_2_spring_force_2_ = dashpot::flush_below(threshold, guide_sampled_slip_3_slip_2_);
    // u₋ = u
    guide_last_position_ = guide_sampled_position_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::command<scalar> step(scalar position, scalar velocity) noexcept {
    // x = u − u0
    const scalar pad_depth = position - pad_surface_at;
    // |x|
    const scalar pad_distance = pad_depth > 0 ? pad_depth : pad_centre - pad_depth;
    const scalar pad_in_cells = dashpot::clamp_to(pad_last_cell, pad_distance * pad_cells_per_length);
    const scalar pad_cell = pad_in_cells > 0 ? pad_in_cells : pad_centre;
    // d = |x| − x_i
    const scalar pad_within = pad_distance - pad_cell_begins[static_cast<int>(pad_cell)];
    // map_e d
    const scalar pad_map_cubic = pad_map_e[static_cast<int>(pad_cell)] * pad_within;
    // map_c + map_e d
    const scalar pad_map_bend = pad_map_c[static_cast<int>(pad_cell)] + pad_map_cubic;
    // |w| = map_a + d (map_b + d map_bend)
    const scalar pad_mapped_size = pad_map_a[static_cast<int>(pad_cell)] +
        pad_within * (pad_map_b[static_cast<int>(pad_cell)] + pad_within * pad_map_bend);
    // w with the sign of x
    const scalar pad_mapped = pad_depth > 0 ? pad_mapped_size : pad_centre - pad_mapped_size;
    // w′ = map_b + d (2 map_bend + map_e d)
    const scalar pad_tangent = pad_map_b[static_cast<int>(pad_cell)] + pad_within * (pad_map_bend + pad_map_bend +
        pad_map_cubic);
    // Δ = u − s₋
    const scalar pad_approach = pad_mapped - pad_surface_;
    // k0 s₋ + S
    const scalar pad_held_force = pad_static_stiffness * pad_surface_ + pad_spring_2_damper_3_force_;
    // Δs where f = 0: −held force/g
    const scalar pad_surface_recovery = pad_recovery_compliance * pad_held_force;
    // Δs = Δ, but no lower than where f = 0
    const scalar pad_surface_change = pad_surface_recovery - pad_approach > 0 ? pad_surface_recovery : pad_approach;
    // gap = s − u
    const scalar pad_gap = pad_surface_change - pad_approach;
    // s = s₋ + Δs
    const scalar pad_surface_now = pad_gap > 0 ? dashpot::flush_below(threshold, pad_surface_ +
        pad_surface_change) : pad_mapped;
    // f′ = f − b∞ Δs/h
    const scalar pad_opposing = pad_static_stiffness * pad_surface_now + pad_step_stiffness * pad_surface_change +
        pad_spring_2_damper_3_force_;
    // −(f′ + b∞ v̂)
    const scalar pad_pull = pad_none - pad_opposing;
    // above 0 where the tool is free
    const scalar pad_released = pad_pull > 0 ? pad_pull : pad_gap;
    // m = f − b u̇ of a tool that touches
    const scalar pad_mapped_force = pad_released > 0 ? pad_none : pad_opposing;
    // m = w′ M
    const scalar pad_force = pad_tangent * pad_mapped_force;
    // |x|
    const scalar skin_distance = position > 0 ? position : skin_centre - position;
    const scalar skin_in_cells = dashpot::clamp_to(skin_last_cell, skin_distance * skin_cells_per_length);
    const scalar skin_cell = skin_in_cells > 0 ? skin_in_cells : skin_centre;
    // d = |x| − x_i
    const scalar skin_within = skin_distance - skin_cell_begins[static_cast<int>(skin_cell)];
    // map_e d
    const scalar skin_map_cubic = skin_map_e[static_cast<int>(skin_cell)] * skin_within;
    // map_c + map_e d
    const scalar skin_map_bend = skin_map_c[static_cast<int>(skin_cell)] + skin_map_cubic;
    // |w| = map_a + d (map_b + d map_bend)
    const scalar skin_mapped_size = skin_map_a[static_cast<int>(skin_cell)] +
        skin_within * (skin_map_b[static_cast<int>(skin_cell)] + skin_within * skin_map_bend);
    // w with the sign of x
    const scalar skin_mapped = position > 0 ? skin_mapped_size : skin_centre - skin_mapped_size;
    // w′ = map_b + d (2 map_bend + map_e d)
    const scalar skin_tangent = skin_map_b[static_cast<int>(skin_cell)] + skin_within * (skin_map_bend +
        skin_map_bend + skin_map_cubic);
    // ẇ = w′ u̇
    const scalar skin_mapped_velocity = skin_tangent * velocity;
    // Δu = u − u₋
    const scalar skin_position_change = skin_mapped - skin_last_position_;
    // m = f − b u̇
    const scalar skin_mapped_force = skin_spring_1_damper_2_force_ + (skin_step_stiffness * skin_position_change +
        skin_velocity_gain * skin_mapped_velocity);
    // m = w′ M
    const scalar skin_force = skin_tangent * skin_mapped_force;
    // w′²
    const scalar skin_tangent_squared = skin_tangent * skin_tangent;
    // b = w′² b_w
    const scalar skin_brake_command = skin_tangent_squared * skin_mapped_damping;
    // Δu = u − u₋
    const scalar guide_position_change = position - guide_last_position_;
    // trial = force of the slip if it held
    const scalar guide_slip_3_trial_2 = guide_slip_3_trial_by_change_2 * guide_position_change +
        guide_spring_2_spring_force_2_;
    // slip = clamp(trial, ±Y)
    const scalar guide_slip_3_slip_2 = dashpot::clamp_to(guide_slip_3_yield_2, guide_slip_3_trial_2);
    // m = f − b u̇
    const scalar guide_force = guide_slip_3_slip_2;
    // b = Σ b of all ports
    const scalar brake_command = skin_brake_command + steady_damping;
    // m = Σ m of all ports
    const scalar force = pad_force + skin_force + guide_force;
    if (!dashpot::all_finite(position, force)) {
      sampled_ = false;
      return {sampled_brake_command_, 0};
    }
    sampled_brake_command_ = brake_command;
    // F ← a (F + c Δu)
    pad_spring_2_damper_3_force_ = dashpot::relaxed(threshold, pad_spring_2_damper_3_decay,
        pad_spring_2_damper_3_force_, pad_spring_2_damper_3_gain * pad_surface_change);
    // s₋ = s
    pad_surface_ = pad_surface_now;
    // F ← a (F + c Δu)
    skin_spring_1_damper_2_force_ = dashpot::relaxed(threshold, skin_spring_1_damper_2_decay,
        skin_spring_1_damper_2_force_, skin_spring_1_damper_2_gain * skin_position_change);
    // u₋ = u
    skin_last_position_ = skin_mapped;
    // F ← F + k δ
    guide_spring_2_spring_force_2_ = dashpot::flush_below(threshold, guide_slip_3_slip_2);
    // u₋ = u
    guide_last_position_ = position;
    sampled_ = false;
    return {brake_command, force};
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // F²/(2k)
    const scalar pad_spring_2_damper_3_energy = pad_spring_2_damper_3_energy_weight * pad_spring_2_damper_3_force_ *
        pad_spring_2_damper_3_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar pad_stored = pad_half_static_stiffness * pad_surface_ * pad_surface_ +
        pad_spring_2_damper_3_energy;
    // F²/(2k)
    const scalar skin_spring_1_damper_2_energy = skin_spring_1_damper_2_energy_weight *
        skin_spring_1_damper_2_force_ * skin_spring_1_damper_2_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar skin_stored = skin_spring_1_damper_2_energy;
    // F²/(2k)
    const scalar guide_spring_2_spring_energy_2 = guide_spring_2_compliance_2 * guide_spring_2_spring_force_2_ *
        guide_spring_2_spring_force_2_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar guide_stored = guide_spring_2_spring_energy_2;
    // V of all ports
    const scalar stored = pad_stored + skin_stored + guide_stored;
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar pad_static_stiffness = 400.0;  // k0 [N/m]
  static constexpr scalar pad_none = 0.0;  // no force on a free tool [N]
  static constexpr scalar pad_recovery_compliance = -0.0016694398148327846;  // −1/g [m/N]
  static constexpr scalar pad_step_stiffness = 199.00332501663894;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar pad_spring_2_damper_3_gain = 197.02320884825502;  // a c [N/m]
  static constexpr scalar pad_spring_2_damper_3_decay = 0.9900498337491681;  // a = e^{−λh} [1]
  static constexpr scalar pad_half_static_stiffness = 200.0;  // ½ k0 [N/m]
  static constexpr scalar pad_spring_2_damper_3_energy_weight = 0.0025505033500668895;  // 1/(2 k a²) [m/N]
  static constexpr scalar pad_surface_at = 0.001;  // where the unloaded surface lies [m]
  static constexpr scalar pad_centre = 0.0;  // centre of the map [m]
  static constexpr scalar pad_cells_per_length = 6400.0;  // cells of the map per length [1/m]
  static constexpr scalar pad_last_cell = 32.0;  // number of the map's last cell [1]
  // where each cell begins [m]
  static constexpr scalar pad_cell_begins[33] = {0.0, 0.00015625, 0.0003125, 0.00046875, 0.000625, 0.00078125,
      0.0009375, 0.00109375, 0.00125, 0.00140625, 0.0015625, 0.00171875, 0.001875, 0.00203125, 0.0021875,
      0.00234375, 0.0025, 0.00265625, 0.0028125, 0.00296875, 0.003125, 0.00328125, 0.0034375, 0.00359375, 0.00375,
      0.00390625, 0.0040625, 0.00421875, 0.004375, 0.00453125, 0.0046875, 0.00484375, 0.005};
  // coefficient of d³ in each cell [1/m²]
  static constexpr scalar pad_map_e[33] = {-11552572.7019614, -312991.0219491911, -123446.29039552307,
      -67851.37270936777, -43536.00476938172, -30582.695174279703, -22804.403836186673, -17739.885624102928,
      -14243.56006516885, -11720.355011553926, -9834.91399216829, -8385.938048924203, -7246.354516388986,
      -6332.5735448471805, -5587.687548618897, -4971.810709764659, -4456.281037401161, -4020.051040914028,
      -3647.3687284143793, -3326.2459579694987, -3047.4219211698646, -2803.646389486735, -2589.1744157695,
      -2399.4038667280647, -2230.6112956179036, -2079.7567062370854, -1944.337345420697, -1822.2768950209659,
      -1711.8405636526813, -1611.5693603828533, -1520.2287360956227, -1436.7680996435786, 0.0};
  // coefficient of d² in each cell [1/m]
  static constexpr scalar pad_map_c[33] = {4211.875464256761, 357.970415534616, 219.77114384752517,
      163.5282227208473, 132.2506931012247, 112.06728352624496, 97.84355666794643, 87.21637420284293,
      78.9384559860928, 72.28592838099873, 66.80824113666826, 62.209460419241275, 58.28672217575743,
      54.89603987543194, 51.93222218704483, 49.31652463507494, 46.98875906446505, 44.90208376320872,
      43.01946502083371, 41.31121402355666, 39.75323478470279, 38.32575371640236, 37.01238253092589,
      35.79941630029057, 34.675300307014844, 33.63021995828584, 32.65578170877276, 31.74476216639947,
      30.890908892174615, 30.088780824656382, 29.333619386554034, 28.621243572912263, 0.0};
  // w where each cell begins [m]
  static constexpr scalar pad_map_a[33] = {0.0, 5.87594233294749e-05, 0.00013975424859373687,
      0.000231995250179989, 0.0003323934935590618, 0.00043932916030496025, 0.0005517808043217585,
      0.0006690369053662136, 0.0007905694150420948, 0.0009159687596708867, 0.0010449067265256595,
      0.0011771136106964789, 0.0013123633168427187, 0.0014504632020431948, 0.0015912468961218067,
      0.0017345690730287936, 0.0018803015465431968, 0.002028330292004393, 0.002178553132241672,
      0.0023308779105031194, 0.0024852210273970336, 0.002641506254575889, 0.002799663762013592,
      0.0029596293123772747, 0.003121343587715863, 0.0032847516220848223, 0.0034498023198387935,
      0.0036164480438375434, 0.003784644261188097, 0.003954349236703709, 0.004125523766219032,
      0.004298130943416143, 0.00447213595499958};
  // w′ where each cell begins [1]
  static constexpr scalar pad_map_b[33] = {0.0, 0.4700753866357992, 0.5590169943749475, 0.6186540004799707,
      0.6647869871181236, 0.7029266564879364, 0.735707739095678, 0.7646136061328155, 0.7905694150420948,
      0.8141944530407882, 0.8359253812205275, 0.8560826259610755, 0.8749088778951458, 0.8925927397188892,
      0.9092839406410324, 0.9251035056153566, 0.9401507732715984, 0.9545083727079496, 0.9682458365518543,
      0.9814222781065766, 0.9940884109588133, 1.006288096981291, 1.0180595498231242, 1.0294362825660086,
      1.0404478625719542, 1.051120519067143, 1.0614776368734749, 1.0715401611370499, 1.0813269317680276,
      1.090854961849299, 1.1001396709917417, 1.1091950821719079, 1.118033988749895};
  static constexpr scalar skin_step_stiffness = 285.48774589212127;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar skin_velocity_gain = -3.0;  // b∞ − b [N·s/m]
  static constexpr scalar skin_spring_1_damper_2_gain = 258.3199948739331;  // a c [N/m]
  static constexpr scalar skin_spring_1_damper_2_decay = 0.9048374180359596;  // a = e^{−λh} [1]
  static constexpr scalar skin_spring_1_damper_2_energy_weight = 0.002035671263600283;  // 1/(2 k a²) [m/N]
  static constexpr scalar skin_centre = 0.0;  // centre of the map [m]
  static constexpr scalar skin_cells_per_length = 5333.333333333333;  // cells of the map per length [1/m]
  static constexpr scalar skin_last_cell = 32.0;  // number of the map's last cell [1]
  // where each cell begins [m]
  static constexpr scalar skin_cell_begins[33] = {0.0, 0.0001875, 0.000375, 0.0005625000000000001, 0.00075,
      0.0009375, 0.0011250000000000001, 0.0013125, 0.0015, 0.0016875, 0.001875, 0.0020625, 0.0022500000000000003,
      0.0024375, 0.002625, 0.0028125, 0.003, 0.0031875000000000002, 0.003375, 0.0035625, 0.00375, 0.0039375,
      0.004125, 0.0043125, 0.0045000000000000005, 0.0046875, 0.004875, 0.0050625, 0.00525, 0.0054375000000000005,
      0.005625, 0.0058125, 0.006};
  // coefficient of d³ in each cell [1/m²]
  static constexpr scalar skin_map_e[33] = {-1836080.9937575902, -130486.25863413925, -58953.03913531227,
      -35322.31770183238, -24154.779246330458, -17848.75623680434, -13880.260907251526, -11192.70316979955,
      -9273.372879640752, -7846.356679192936, -6751.301635317907, -5889.293123391566, -5196.340026059957,
      -4629.400058538697, -4158.565842073671, -3762.4768520153993, -3425.512318840752, -3136.012340481385,
      -2885.115812927568, -2665.980889634868, -2473.2496775323098, -2302.672934382106, -2150.842010898061,
      -2014.994165674672, -1892.8690156402272, -1782.6012262897275, -1682.6392798190177, -1591.6832723156524,
      -1508.6367754074442, -1432.5692163774554, -1362.6862110438417, -1298.305970647037, 0.0};
  // coefficient of d² in each cell [1/m]
  static constexpr scalar skin_map_c[33] = {1032.7955589886444, 250.5982240867509, 180.71098991650098,
      148.30276984236897, 128.69851105363747, 115.23048837970143, 105.2528614407592, 97.48133231900263,
      91.20798792492275, 86.00661118850832, 81.60331888483162, 77.8130685354351, 74.50576113502309,
      71.58691242253033, 68.98603048449141, 66.64931459191834, 64.53489705189322, 62.609643801916576,
      60.84694428627238, 59.2251483991619, 57.72643795314932, 56.33599680094188, 55.04139050513307,
      53.832095776238134, 52.6991387475566, 51.63481354081593, 50.63246087966353, 49.686292176484045,
      48.791248452418465, 47.94288622306823, 47.13728446370927, 46.37096820208713, 0.0};
  // w where each cell begins [m]
  static constexpr scalar skin_map_a[33] = {0.0, 2.4206145913796357e-05, 6.846531968814576e-05,
      0.00012577882373436316, 0.00019364916731037085, 0.0002706329386826371, 0.00035575623676894265,
      0.0004483040960107324, 0.0005477225575051661, 0.0006535659396725016, 0.0007654655446197432,
      0.0008831097397832276, 0.0010062305898749053, 0.0011345945035562265, 0.001267995465291576, 0.00140625,
      0.0015491933384829668, 0.001696676438658827, 0.0018485636315799356, 0.0020047307331659283,
      0.0021650635094610966, 0.002329456414595474, 0.0024978115421304308, 0.0026700377455197146,
      0.0028460498941515412, 0.0030257682392245445, 0.0032091178694463687, 0.0033960282408278058,
      0.0035864327680858593, 0.0037802684676488257, 0.00397747564417433, 0.004177997613989266,
      0.004381780460041329};
  // w′ where each cell begins [1]
  static constexpr scalar skin_map_b[33] = {0.0, 0.19364916731037085, 0.27386127875258304, 0.33541019662496846,
      0.3872983346207417, 0.4330127018922193, 0.4743416490252569, 0.51234753829798, 0.5477225575051661,
      0.5809475019311126, 0.6123724356957945, 0.6422616289332564, 0.6708203932499369, 0.698212002188447,
      0.724568837309472, 0.75, 0.7745966692414834, 0.7984359711335656, 0.8215838362577491, 0.8440971508067066,
      0.8660254037844386, 0.8874119674649424, 0.9082951062292475, 0.9287087810503355, 0.9486832980505138,
      0.9682458365518543, 0.9874208829065749, 1.0062305898749053, 1.02469507659596, 1.0428326807307104,
      1.0606601717798212, 1.0781929326423911, 1.0954451150103321};
  static constexpr scalar skin_mapped_damping = 3.0;  // b_w, b behind the map [N·s/m]
  static constexpr scalar guide_slip_3_trial_by_change_2 = 2000.0;  // factor of the change of position [N/m]
  static constexpr scalar guide_slip_3_yield_2 = 0.2;  // Y [N]
  static constexpr scalar guide_spring_2_compliance_2 = 0.00025;  // 1/(2 k) [m/N]
  static constexpr scalar steady_damping = 2.0;  // b of the ports whose brake does not change [N·s/m]

  scalar pad_surface_ = 0;  // s, how far the surface is pushed in [m]
  scalar pad_spring_2_damper_3_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar pad_sampled_surface_change_ = 0;  // Δs since the sample before, at this sample [m]
  scalar pad_sampled_surface_now_ = 0;  // s, at this sample [m]
  scalar skin_last_position_ = 0;  // u of the sample before [m]
  scalar skin_spring_1_damper_2_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar skin_sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar skin_sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar guide_last_position_ = 0;  // u of the sample before [m]
  scalar guide_spring_2_spring_force_2_ = 0;  // force of the spring [N]
  scalar guide_sampled_position_change_ = 0;  // Δu since the sample before, at this sample [m]
  scalar guide_sampled_slip_3_slip_2_ = 0;  // the slip's force, at this sample [N]
  scalar guide_sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_brake_command_ = 2.0;  // b, at this sample [N·s/m]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
