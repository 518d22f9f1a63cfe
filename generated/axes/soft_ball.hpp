// A ball of soft tissue that the tool pushes into and slides round
//
// source: a stiffness as that of gel phantoms, and a relaxation by a third within 0.2 s; the values are chosen
//   here
// port ball: behind the map 'ball', pushed and never pulled; b = 0.5 N·s/m by the rule 'paper'
// kinematics: five_bar; sine and cosine by polynomials that are off by less than 2e-16, of joints that stay within
//   their encoders' ranges
// scheme: exact at 10000 Hz, double; what the law remembers follows the measured position
// brakes: by the rule 'diagonal' each brake makes the damping of its joint, and the motors the forces by which one
//   joint's velocity acts on the other
// share: of the ports' damping the brakes make 109 % in the median over the workspace, 71.1 % at least, at (-1,
//   119.4) mm, averaged over all directions of motion
// passivity: not certified, since port 'ball': the end of the contact is computed from the estimated velocity, and
//   the amplifier lags: the torques that the motors hold from one sample to the next need 0.0446642 and 0.0446642
//   N·m·s/rad of damping at the joints; after the joints' own damping and the brakes' share of the network's,
//   0.0445944 and 0.0445944 N·m·s/rad of it are still missing, most at (-22.97, 120) mm
//   the motors make up to 0.1 and 0.1 N m; where the law asks for more, each makes what it can, nothing is proved,
//   and the hand may get energy: 'dashpot run' says in how many samples
//   0.00743716 and 0.00743716 N·m·s/rad of the needed damping are for torques computed from estimated velocities,
//   however late these are
//   0.0336727 and 0.0336727 N·m·s/rad of the needed damping are for the lag of the motors' amplifiers
//   in 100 % of the workspace, the damping that the motors make from velocity estimates stays passive for any
//   delay that both joints share
//   added to the brakes' commands: 0.01398, 0.01398 N m s/rad, all that they can give; felt at the tip as up to
//   11.3 N s/m more
// device: pantograph_2dof
// cost of output(): 78 additions, 91 multiplications, 9 selections, 1 guard against subnormal numbers
// cost of update(): 1 addition, 2 multiplications, 0 selections, 1 guard against subnormal numbers
// words: a port is a network of one axis behind a map w of the tool's position, which says how far the tool has
//   gone into what the network resists; B* is the damping that all ports ask for, as a matrix over the joints.
//   Passive means that the hand never gets more energy than it has put in; certified, that this is proved
//
// Written by dashpot 0.1.0 from a network with digest
// 92763b4e7d88c80643bd40e5f80871202c4447194ad7f18354069871e6f22289. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/elementary.hpp>

namespace dashpot::generated {

class soft_ball {
 public:
  using scalar = double;
  static constexpr int axes = 2;
  static constexpr int brakes = 2;
  static constexpr scalar sample_period = 0.0001;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::rotation;  // of the joints

  // The part of each brake's command that was added for passivity [N·m·s/rad].
  static constexpr scalar added_damping[brakes] = {0.013980000000000001, 0.013980000000000001};

  // What the servo loop compares with the device that it drives.
  struct certified_for {
    static constexpr bool any_device = false;
    static constexpr const char* device = "pantograph_2dof";
    static constexpr const char* device_digest = "1d81bf48c1147a31e2c4ee01df4b74bbb8c7b08f97922856005eb2f0de83a08e";
    static constexpr const char* estimator[axes] = {"butterworth", "butterworth"};
    static constexpr unsigned loop_delay = 0;  // [samples]
    static constexpr bool is_certified = false;
  };

  struct parameters {};

  // Starts at rest with the joints at `position` [rad]: only the springs that hold a force at rest are
  // loaded. A NaN or infinite position counts as 0.
  void reset(const scalar (&position)[axes] = {}) noexcept {
    const scalar q1 = dashpot::all_finite(position[0]) ? position[0] : 0;
    const scalar q2 = dashpot::all_finite(position[1]) ? position[1] : 0;
    // r = θ − a multiple of π/4
    const scalar rest_1 = q1 - eighth_turns_3 - eighth_turns_3_rest;
    // r²
    const scalar rest_squared_1 = rest_1 * rest_1;
    const scalar part_1 = rest_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 *
        (rest_squared_1 * (rest_squared_1 * (sine_term_6 - rest_squared_1 * sine_term_7) - sine_term_5) +
        sine_term_4) - sine_term_3) + sine_term_2) - sine_term_1) + sine_term_0);
    const scalar part_2 = rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 *
        (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * cosine_term_8 - cosine_term_7) +
        cosine_term_6) - cosine_term_5) + cosine_term_4) - cosine_term_3) + cosine_term_2) - cosine_term_1) + one;
    // −cos θ
    const scalar cosine_1 = root_of_half * (part_1 + part_2);
    const scalar part_3 = proximal_link * cosine_1;
    // r = θ − a multiple of π/4
    const scalar rest_2 = q2 - eighth_turns_1 - eighth_turns_1_rest;
    // r²
    const scalar rest_squared_2 = rest_2 * rest_2;
    const scalar part_4 = one + rest_squared_2 * (rest_squared_2 * (cosine_term_2 +
        rest_squared_2 * (rest_squared_2 * (cosine_term_4 + rest_squared_2 * (rest_squared_2 * (cosine_term_6 +
        rest_squared_2 * (cosine_term_8 *
        rest_squared_2 - cosine_term_7)) - cosine_term_5)) - cosine_term_3)) - cosine_term_1);
    const scalar part_5 = rest_2 * (sine_term_0 + rest_squared_2 * (rest_squared_2 * (sine_term_2 +
        rest_squared_2 * (rest_squared_2 * (sine_term_4 +
        rest_squared_2 * (rest_squared_2 * (sine_term_6 - sine_term_7 *
        rest_squared_2) - sine_term_5)) - sine_term_3)) - sine_term_1));
    // cos θ
    const scalar cosine_2 = root_of_half * (part_4 - part_5);
    const scalar part_6 = base + (part_3 + proximal_link * cosine_2);
    // sin θ
    const scalar sine_2 = root_of_half * (part_5 + part_4);
    // sin θ
    const scalar sine_1 = root_of_half * (part_2 - part_1);
    const scalar part_7 = proximal_link * sine_1;
    const scalar part_8 = proximal_link * sine_2 - part_7;
    const scalar part_9 = dashpot::square_root(distal_link_squared * (one / (part_6 * part_6 +
        part_8 * part_8)) - quarter);
    // position of the tip, x
    const scalar tip_x = half * part_6 - part_8 * part_9 - part_3 - half_base;
    // position of the tip, y
    const scalar tip_y = part_7 + (half * part_8 + part_6 * part_9);
    const scalar part_10 = tip_y - ball_centre_y;
    // w of port ball
    const scalar ball_position = ball_radius - dashpot::square_root(tip_x * tip_x + part_10 * part_10 +
        blunting_squared);
    // s = (u − u0)⁺
    const scalar ball_pushed_in = ball_position > 0 ? ball_position : ball_none;
    ball_surface_ = dashpot::all_finite(ball_pushed_in) ? ball_pushed_in : 0;
    ball_spring_3_damper_4_force_ = 0;
    ball_sampled_surface_change_ = 0;
    ball_sampled_surface_now_ = 0;
    sampled_damping_1_ = 0;
    sampled_damping_2_ = 0;
    sampled_ = false;
  }

  // The command for this sample: the joints' positions [rad] and estimates of their velocities
  // [rad/s]. After a non-finite input the states stay as they were, the brakes get their last command and
  // the motors none.
  dashpot::commands<scalar, axes, brakes> output(const scalar (&position)[axes],
                                                 const scalar (&velocity)[axes]) noexcept {
    const scalar q1 = position[0], q2 = position[1], v1 = velocity[0], v2 = velocity[1];
    // r = θ − a multiple of π/4
    const scalar rest_1 = q1 - eighth_turns_3 - eighth_turns_3_rest;
    // r²
    const scalar rest_squared_1 = rest_1 * rest_1;
    const scalar part_1 = rest_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 *
        (rest_squared_1 * (rest_squared_1 * (sine_term_6 - rest_squared_1 * sine_term_7) - sine_term_5) +
        sine_term_4) - sine_term_3) + sine_term_2) - sine_term_1) + sine_term_0);
    const scalar part_2 = rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 *
        (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * cosine_term_8 - cosine_term_7) +
        cosine_term_6) - cosine_term_5) + cosine_term_4) - cosine_term_3) + cosine_term_2) - cosine_term_1) + one;
    // −cos θ
    const scalar cosine_1 = root_of_half * (part_1 + part_2);
    const scalar part_3 = proximal_link * cosine_1;
    // r = θ − a multiple of π/4
    const scalar rest_2 = q2 - eighth_turns_1 - eighth_turns_1_rest;
    // r²
    const scalar rest_squared_2 = rest_2 * rest_2;
    const scalar part_4 = one + rest_squared_2 * (rest_squared_2 * (cosine_term_2 +
        rest_squared_2 * (rest_squared_2 * (cosine_term_4 + rest_squared_2 * (rest_squared_2 * (cosine_term_6 +
        rest_squared_2 * (cosine_term_8 *
        rest_squared_2 - cosine_term_7)) - cosine_term_5)) - cosine_term_3)) - cosine_term_1);
    const scalar part_5 = rest_2 * (sine_term_0 + rest_squared_2 * (rest_squared_2 * (sine_term_2 +
        rest_squared_2 * (rest_squared_2 * (sine_term_4 +
        rest_squared_2 * (rest_squared_2 * (sine_term_6 - sine_term_7 *
        rest_squared_2) - sine_term_5)) - sine_term_3)) - sine_term_1));
    // cos θ
    const scalar cosine_2 = root_of_half * (part_4 - part_5);
    const scalar part_6 = proximal_link * cosine_2;
    const scalar part_7 = base + (part_3 + part_6);
    const scalar part_8 = half * part_7;
    // sin θ
    const scalar sine_2 = root_of_half * (part_5 + part_4);
    const scalar part_9 = proximal_link * sine_2;
    // sin θ
    const scalar sine_1 = root_of_half * (part_2 - part_1);
    const scalar part_10 = proximal_link * sine_1;
    const scalar part_11 = part_9 - part_10;
    const scalar part_12 = one / (part_7 * part_7 + part_11 * part_11);
    const scalar part_13 = dashpot::square_root(distal_link_squared * part_12 - quarter);
    const scalar part_14 = part_11 * part_13;
    const scalar part_15 = part_8 - part_14;
    // position of the tip, x
    const scalar tip_x = part_15 - part_3 - half_base;
    const scalar part_16 = half * part_11;
    const scalar part_17 = part_7 * part_13;
    const scalar part_18 = part_16 + part_17;
    // position of the tip, y
    const scalar tip_y = part_10 + part_18;
    const scalar part_19 = tip_y - ball_centre_y;
    const scalar part_20 = dashpot::square_root(tip_x * tip_x + part_19 * part_19 + blunting_squared);
    // w of port ball
    const scalar ball_position = ball_radius - part_20;
    const scalar part_21 = part_12 / part_13;
    const scalar part_22 = part_21 * (part_10 * part_15 + part_3 * part_18);
    const scalar part_23 = part_17 - part_16;
    // −∂x/∂q1
    const scalar x_by_q1 = part_22 * part_23;
    const scalar part_24 = one / part_20;
    const scalar part_25 = tip_x * part_24;
    const scalar part_26 = part_8 + part_14;
    // −∂y/∂q1
    const scalar y_by_q1 = part_22 * part_26;
    const scalar part_27 = part_19 * part_24;
    // ∂w/∂q1
    const scalar ball_by_q1 = x_by_q1 * part_25 + y_by_q1 * part_27;
    const scalar part_28 = part_21 * (part_9 * part_26 + part_6 * part_23);
    // −∂x/∂q2
    const scalar x_by_q2 = part_18 * part_28;
    // ∂y/∂q2
    const scalar y_by_q2 = part_15 * part_28;
    // ∂w/∂q2
    const scalar ball_by_q2 = x_by_q2 * part_25 - y_by_q2 * part_27;
    // ẇ = Σ ∂w/∂q v
    const scalar ball_velocity = ball_by_q1 * v1 + ball_by_q2 * v2;
    // Δ = u − s₋
    const scalar ball_approach = ball_position - ball_surface_;
    // k0 s₋ + S
    const scalar ball_held_force = ball_static_stiffness * ball_surface_ + ball_spring_3_damper_4_force_;
    // Δs where f = 0: −held force/g
    const scalar ball_surface_recovery = ball_recovery_compliance * ball_held_force;
    // Δs = Δ, but no lower than where f = 0
    const scalar ball_surface_change = ball_surface_recovery - ball_approach > 0 ? ball_surface_recovery :
        ball_approach;
    // gap = s − u
    const scalar ball_gap = ball_surface_change - ball_approach;
    // s = s₋ + Δs
    const scalar ball_surface_now = ball_gap > 0 ? dashpot::flush_below(threshold, ball_surface_ +
        ball_surface_change) : ball_position;
    // f′ = f − b∞ Δs/h
    const scalar ball_opposing = ball_static_stiffness * ball_surface_now +
        ball_step_stiffness * ball_surface_change + ball_spring_3_damper_4_force_;
    // −(f′ + b∞ v̂)
    const scalar ball_pull = ball_none - (ball_opposing + ball_feedthrough * ball_velocity);
    // above 0 where the tool is free
    const scalar ball_released = ball_pull > 0 ? ball_pull : ball_gap;
    // b = 0 of a free tool
    const scalar ball_brake = ball_released > 0 ? ball_none : ball_contact_damping;
    // m = f − b u̇ of a tool that touches
    const scalar ball_force = ball_released > 0 ? ball_none : ball_opposing;
    // B* of joint 1
    const scalar wanted_11 = ball_brake * (ball_by_q1 * ball_by_q1);
    const scalar part_29 = wanted_11 > 0 ? wanted_11 : nothing;
    const scalar part_30 = most_damping_1 - part_29 > 0 ? part_29 : most_damping_1;
    // D, what the brakes make of B*
    const scalar damping_1 = part_30 + added_damping_1;
    // B* of joint 2
    const scalar wanted_22 = ball_brake * (ball_by_q2 * ball_by_q2);
    const scalar part_31 = wanted_22 > 0 ? wanted_22 : nothing;
    const scalar part_32 = most_damping_1 - part_31 > 0 ? part_31 : most_damping_1;
    const scalar damping_2 = added_damping_1 + part_32;
    // B* between the joints
    const scalar wanted_12 = ball_brake * (ball_by_q1 * ball_by_q2);
    // τ = Σ ∂w/∂q M + (B* − D) v
    const scalar torque_1 = ball_by_q1 * ball_force + (v1 * (wanted_11 - part_30) + wanted_12 * v2);
    const scalar torque_2 = ball_by_q2 * ball_force + (wanted_12 * v1 + v2 * (wanted_22 - part_32));
    sampled_ = false;
    if (!dashpot::all_finite(q1, q2, v1, v2, damping_1, damping_2, torque_1, torque_2)) return {{sampled_damping_1_, sampled_damping_2_}, {}};
    sampled_ = true;
    ball_sampled_surface_change_ = ball_surface_change;
    ball_sampled_surface_now_ = ball_surface_now;
    sampled_damping_1_ = damping_1;
    sampled_damping_2_ = damping_2;
    return {{damping_1, damping_2}, {torque_1, torque_2}};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // F ← a (F + c Δu)
    ball_spring_3_damper_4_force_ = dashpot::relaxed(threshold, ball_spring_3_damper_4_decay,
        ball_spring_3_damper_4_force_, ball_spring_3_damper_4_gain * ball_sampled_surface_change_);
    // s₋ = s
    ball_surface_ = ball_sampled_surface_now_;
  }

  // output() and then update() in one function, with the same results to the last bit.
  dashpot::commands<scalar, axes, brakes> step(const scalar (&position)[axes],
                                               const scalar (&velocity)[axes]) noexcept {
    const scalar q1 = position[0], q2 = position[1], v1 = velocity[0], v2 = velocity[1];
    // r = θ − a multiple of π/4
    const scalar rest_1 = q1 - eighth_turns_3 - eighth_turns_3_rest;
    // r²
    const scalar rest_squared_1 = rest_1 * rest_1;
    const scalar part_1 = rest_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 *
        (rest_squared_1 * (rest_squared_1 * (sine_term_6 - rest_squared_1 * sine_term_7) - sine_term_5) +
        sine_term_4) - sine_term_3) + sine_term_2) - sine_term_1) + sine_term_0);
    const scalar part_2 = rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 *
        (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * cosine_term_8 - cosine_term_7) +
        cosine_term_6) - cosine_term_5) + cosine_term_4) - cosine_term_3) + cosine_term_2) - cosine_term_1) + one;
    // −cos θ
    const scalar cosine_1 = root_of_half * (part_1 + part_2);
    const scalar part_3 = proximal_link * cosine_1;
    // r = θ − a multiple of π/4
    const scalar rest_2 = q2 - eighth_turns_1 - eighth_turns_1_rest;
    // r²
    const scalar rest_squared_2 = rest_2 * rest_2;
    const scalar part_4 = one + rest_squared_2 * (rest_squared_2 * (cosine_term_2 +
        rest_squared_2 * (rest_squared_2 * (cosine_term_4 + rest_squared_2 * (rest_squared_2 * (cosine_term_6 +
        rest_squared_2 * (cosine_term_8 *
        rest_squared_2 - cosine_term_7)) - cosine_term_5)) - cosine_term_3)) - cosine_term_1);
    const scalar part_5 = rest_2 * (sine_term_0 + rest_squared_2 * (rest_squared_2 * (sine_term_2 +
        rest_squared_2 * (rest_squared_2 * (sine_term_4 +
        rest_squared_2 * (rest_squared_2 * (sine_term_6 - sine_term_7 *
        rest_squared_2) - sine_term_5)) - sine_term_3)) - sine_term_1));
    // cos θ
    const scalar cosine_2 = root_of_half * (part_4 - part_5);
    const scalar part_6 = proximal_link * cosine_2;
    const scalar part_7 = base + (part_3 + part_6);
    const scalar part_8 = half * part_7;
    // sin θ
    const scalar sine_2 = root_of_half * (part_5 + part_4);
    const scalar part_9 = proximal_link * sine_2;
    // sin θ
    const scalar sine_1 = root_of_half * (part_2 - part_1);
    const scalar part_10 = proximal_link * sine_1;
    const scalar part_11 = part_9 - part_10;
    const scalar part_12 = one / (part_7 * part_7 + part_11 * part_11);
    const scalar part_13 = dashpot::square_root(distal_link_squared * part_12 - quarter);
    const scalar part_14 = part_11 * part_13;
    const scalar part_15 = part_8 - part_14;
    // position of the tip, x
    const scalar tip_x = part_15 - part_3 - half_base;
    const scalar part_16 = half * part_11;
    const scalar part_17 = part_7 * part_13;
    const scalar part_18 = part_16 + part_17;
    // position of the tip, y
    const scalar tip_y = part_10 + part_18;
    const scalar part_19 = tip_y - ball_centre_y;
    const scalar part_20 = dashpot::square_root(tip_x * tip_x + part_19 * part_19 + blunting_squared);
    // w of port ball
    const scalar ball_position = ball_radius - part_20;
    const scalar part_21 = part_12 / part_13;
    const scalar part_22 = part_21 * (part_10 * part_15 + part_3 * part_18);
    const scalar part_23 = part_17 - part_16;
    // −∂x/∂q1
    const scalar x_by_q1 = part_22 * part_23;
    const scalar part_24 = one / part_20;
    const scalar part_25 = tip_x * part_24;
    const scalar part_26 = part_8 + part_14;
    // −∂y/∂q1
    const scalar y_by_q1 = part_22 * part_26;
    const scalar part_27 = part_19 * part_24;
    // ∂w/∂q1
    const scalar ball_by_q1 = x_by_q1 * part_25 + y_by_q1 * part_27;
    const scalar part_28 = part_21 * (part_9 * part_26 + part_6 * part_23);
    // −∂x/∂q2
    const scalar x_by_q2 = part_18 * part_28;
    // ∂y/∂q2
    const scalar y_by_q2 = part_15 * part_28;
    // ∂w/∂q2
    const scalar ball_by_q2 = x_by_q2 * part_25 - y_by_q2 * part_27;
    // ẇ = Σ ∂w/∂q v
    const scalar ball_velocity = ball_by_q1 * v1 + ball_by_q2 * v2;
    // Δ = u − s₋
    const scalar ball_approach = ball_position - ball_surface_;
    // k0 s₋ + S
    const scalar ball_held_force = ball_static_stiffness * ball_surface_ + ball_spring_3_damper_4_force_;
    // Δs where f = 0: −held force/g
    const scalar ball_surface_recovery = ball_recovery_compliance * ball_held_force;
    // Δs = Δ, but no lower than where f = 0
    const scalar ball_surface_change = ball_surface_recovery - ball_approach > 0 ? ball_surface_recovery :
        ball_approach;
    // gap = s − u
    const scalar ball_gap = ball_surface_change - ball_approach;
    // s = s₋ + Δs
    const scalar ball_surface_now = ball_gap > 0 ? dashpot::flush_below(threshold, ball_surface_ +
        ball_surface_change) : ball_position;
    // f′ = f − b∞ Δs/h
    const scalar ball_opposing = ball_static_stiffness * ball_surface_now +
        ball_step_stiffness * ball_surface_change + ball_spring_3_damper_4_force_;
    // −(f′ + b∞ v̂)
    const scalar ball_pull = ball_none - (ball_opposing + ball_feedthrough * ball_velocity);
    // above 0 where the tool is free
    const scalar ball_released = ball_pull > 0 ? ball_pull : ball_gap;
    // b = 0 of a free tool
    const scalar ball_brake = ball_released > 0 ? ball_none : ball_contact_damping;
    // m = f − b u̇ of a tool that touches
    const scalar ball_force = ball_released > 0 ? ball_none : ball_opposing;
    // B* of joint 1
    const scalar wanted_11 = ball_brake * (ball_by_q1 * ball_by_q1);
    const scalar part_29 = wanted_11 > 0 ? wanted_11 : nothing;
    const scalar part_30 = most_damping_1 - part_29 > 0 ? part_29 : most_damping_1;
    // D, what the brakes make of B*
    const scalar damping_1 = part_30 + added_damping_1;
    // B* of joint 2
    const scalar wanted_22 = ball_brake * (ball_by_q2 * ball_by_q2);
    const scalar part_31 = wanted_22 > 0 ? wanted_22 : nothing;
    const scalar part_32 = most_damping_1 - part_31 > 0 ? part_31 : most_damping_1;
    const scalar damping_2 = added_damping_1 + part_32;
    // B* between the joints
    const scalar wanted_12 = ball_brake * (ball_by_q1 * ball_by_q2);
    // τ = Σ ∂w/∂q M + (B* − D) v
    const scalar torque_1 = ball_by_q1 * ball_force + (v1 * (wanted_11 - part_30) + wanted_12 * v2);
    const scalar torque_2 = ball_by_q2 * ball_force + (wanted_12 * v1 + v2 * (wanted_22 - part_32));
    if (!dashpot::all_finite(q1, q2, v1, v2, damping_1, damping_2, torque_1, torque_2)) {
      sampled_ = false;
      return {{sampled_damping_1_, sampled_damping_2_}, {}};
    }
    sampled_damping_1_ = damping_1;
    sampled_damping_2_ = damping_2;
    // F ← a (F + c Δu)
    ball_spring_3_damper_4_force_ = dashpot::relaxed(threshold, ball_spring_3_damper_4_decay,
        ball_spring_3_damper_4_force_, ball_spring_3_damper_4_gain * ball_surface_change);
    // s₋ = s
    ball_surface_ = ball_surface_now;
    sampled_ = false;
    return {{damping_1, damping_2}, {torque_1, torque_2}};
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // F²/(2k)
    const scalar ball_spring_3_damper_4_energy = ball_spring_3_damper_4_energy_weight *
        ball_spring_3_damper_4_force_ * ball_spring_3_damper_4_force_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar ball_stored = ball_half_static_stiffness * ball_surface_ * ball_surface_ +
        ball_spring_3_damper_4_energy;
    // Σ V of all ports
    const scalar stored = ball_stored;
    return stored;
  }

 private:
  static constexpr scalar threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
  static constexpr scalar ball_static_stiffness = 200.0;  // k0 [N/m]
  static constexpr scalar ball_none = 0.0;  // no force on a free tool [N]
  static constexpr scalar ball_recovery_compliance = -0.0001886801351353414;  // −1/g [m/N]
  static constexpr scalar ball_step_stiffness = 99.97500416614588;  // Σ c_i, stiffness of all modes within a sample [N/m]
  static constexpr scalar ball_feedthrough = 0.5;  // b∞ [N·s/m]
  static constexpr scalar ball_contact_damping = 0.5;  // b while the tool touches [N·s/m]
  static constexpr scalar ball_spring_3_damper_4_gain = 99.92502915885578;  // a c [N/m]
  static constexpr scalar ball_spring_3_damper_4_decay = 0.9995001249791693;  // a = e^{−λh} [1]
  static constexpr scalar ball_half_static_stiffness = 100.0;  // ½ k0 [N/m]
  static constexpr scalar ball_spring_3_damper_4_energy_weight = 0.005005002500833542;  // 1/(2 k a²) [m/N]
  static constexpr scalar ball_radius = 0.03;  // radius of the circle [m]
  static constexpr scalar half = 0.5;  // 1/2 [1]
  static constexpr scalar base = 0.025;  // distance of the motor axes [m]
  static constexpr scalar proximal_link = 0.063;  // length of the link at the motor [m]
  static constexpr scalar root_of_half = 0.7071067811865476;  // √½ [1]
  static constexpr scalar eighth_turns_3 = 2.3561944901011884;  // a multiple of π/4, rounded [rad]
  static constexpr scalar eighth_turns_3_rest = 9.115650759759289e-11;  // what rounding took from that multiple of π/4 [rad]
  static constexpr scalar sine_term_6 = 1.6048168318165643e-10;  // coefficient of the polynomial in r² [1/rad^12]
  static constexpr scalar sine_term_7 = 7.374387503862757e-13;  // coefficient of the polynomial in r² [1/rad^14]
  static constexpr scalar sine_term_5 = 2.505188194671259e-08;  // coefficient of the polynomial in r² [1/rad^10]
  static constexpr scalar sine_term_4 = 2.7557316609073673e-06;  // coefficient of the polynomial in r² [1/rad^8]
  static constexpr scalar sine_term_3 = 0.00019841269824861897;  // coefficient of the polynomial in r² [1/rad^6]
  static constexpr scalar sine_term_2 = 0.008333333333282756;  // coefficient of the polynomial in r² [1/rad^4]
  static constexpr scalar sine_term_1 = 0.16666666666666072;  // coefficient of the polynomial in r² [1/rad^2]
  static constexpr scalar sine_term_0 = 0.9999999999999999;  // coefficient of the polynomial in r² [1]
  static constexpr scalar cosine_term_8 = 4.608977003001797e-14;  // coefficient of the polynomial in r² [1/rad^16]
  static constexpr scalar cosine_term_7 = 1.1462901901757276e-11;  // coefficient of the polynomial in r² [1/rad^14]
  static constexpr scalar cosine_term_6 = 2.0876561839933163e-09;  // coefficient of the polynomial in r² [1/rad^12]
  static constexpr scalar cosine_term_5 = 2.755731639102575e-07;  // coefficient of the polynomial in r² [1/rad^10]
  static constexpr scalar cosine_term_4 = 2.4801587277414926e-05;  // coefficient of the polynomial in r² [1/rad^8]
  static constexpr scalar cosine_term_3 = 0.001388888888877299;  // coefficient of the polynomial in r² [1/rad^6]
  static constexpr scalar cosine_term_2 = 0.04166666666666388;  // coefficient of the polynomial in r² [1/rad^4]
  static constexpr scalar cosine_term_1 = 0.4999999999999997;  // coefficient of the polynomial in r² [1/rad^2]
  static constexpr scalar one = 1.0;  // 1 [1]
  static constexpr scalar eighth_turns_1 = 0.7853981633670628;  // a multiple of π/4, rounded [rad]
  static constexpr scalar eighth_turns_1_rest = 3.038550253253096e-11;  // what rounding took from that multiple of π/4 [rad]
  static constexpr scalar distal_link_squared = 0.005625;  // square of the length of the link at the tip [m²]
  static constexpr scalar quarter = 0.25;  // 1/4 [1]
  static constexpr scalar half_base = 0.0125;  // half the distance of the motor axes [m]
  static constexpr scalar ball_centre_y = 0.14;  // y of the circle's centre [m]
  static constexpr scalar blunting_squared = 1.e-18;  // keeps the distance above zero [m²]
  static constexpr scalar most_damping_1 = 1.9999999999999185e-05;  // largest damping of the brake, less what is added [N·m·s/rad]
  static constexpr scalar nothing = 0.0;  // 0 [1]
  static constexpr scalar added_damping_1 = 0.013980000000000001;  // added to the brake's command for passivity [N·m·s/rad]

  scalar ball_surface_ = 0;  // s, how far the surface is pushed in [m]
  scalar ball_spring_3_damper_4_force_ = 0;  // force of the mode, decayed to the next sample [N]
  scalar ball_sampled_surface_change_ = 0;  // Δs since the sample before, at this sample [m]
  scalar ball_sampled_surface_now_ = 0;  // s, at this sample [m]
  scalar sampled_damping_1_ = 0;  // damping of brake 1, at this sample [N·m·s/rad]
  scalar sampled_damping_2_ = 0;  // damping of brake 2, at this sample [N·m·s/rad]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
