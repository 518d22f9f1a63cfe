// Isotropic Kelvin field: the tool is drawn to the origin and damped, alike in all directions
//
// source: Gosline & Hayward 2009, Fig. 2c, in two directions; the values are chosen here
// port across: behind the map 'along'; b = 1 N·s/m by the rule 'paper'
// port out: behind the map 'wall'; b = 1 N·s/m by the rule 'paper'
// kinematics: five_bar; sine and cosine by polynomials that are off by less than 2e-16, of joints that stay within
//   their encoders' ranges
// scheme: exact at 10000 Hz, double; what the law remembers follows the measured position
// brakes: by the rule 'diagonal' each brake makes the damping of its joint, and the motors the forces by which one
//   joint's velocity acts on the other
// share: of the ports' damping the brakes make 106 % in the median over the workspace, 100 % at least, at (-11,
//   100.6) mm, averaged over all directions of motion
// passivity: certified for any motion in the workspace, as long as no motor is at its limit: the torques that the
//   motors hold from one sample to the next need 0.00428038 and 0.00428038 N·m·s/rad of damping at the joints;
//   after the joints' own damping and the brakes' share of the network's, 0.00421049 and 0.00421049 N·m·s/rad of
//   it are still missing, most at (0.9375, 70) mm
//   the motors make up to 0.1 and 0.1 N m; where the law asks for more, each makes what it can, nothing is proved,
//   and the hand may get energy: 'dashpot run' says in how many samples
//   0.00345047 and 0.00345047 N·m·s/rad of the needed damping are for torques computed from estimated velocities,
//   however late these are
//   0.000771214 and 0.000771214 N·m·s/rad of the needed damping are for the lag of the motors' amplifiers
//   in 100 % of the workspace, the damping that the motors make from velocity estimates stays passive for any
//   delay that both joints share
//   added to the brakes' commands: 0.00446149, 0.00446149 N m s/rad; felt at the tip as up to 3.62 N s/m more
// device: pantograph_2dof
// cost of output(): 68 additions, 78 multiplications, 2 selections, 0 guards against subnormal numbers
// cost of update(): 0 additions, 0 multiplications, 0 selections, 0 guards against subnormal numbers
// words: a port is a network of one axis behind a map w of the tool's position, which says how far the tool has
//   gone into what the network resists; B* is the damping that all ports ask for, as a matrix over the joints.
//   Passive means that the hand never gets more energy than it has put in; certified, that this is proved
//
// Written by dashpot 0.1.0 from a network with digest
// 891796bb1804f2b9e2fd5639d51c9ddbcd99cc9834cf0fe75acc324a0ae3ae4c. It belongs to whoever emitted
// it. Compile it with -ffp-contract=off where results are compared bit for bit.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/elementary.hpp>

namespace dashpot::generated {

class kelvin_field {
 public:
  using scalar = double;
  static constexpr int axes = 2;
  static constexpr int brakes = 2;
  static constexpr scalar sample_period = 0.0001;  // [s]
  static constexpr dashpot::motion port_motion = dashpot::motion::rotation;  // of the joints

  // The part of each brake's command that was added for passivity [N·m·s/rad].
  static constexpr scalar added_damping[brakes] = {0.0044614856021759405, 0.0044614856021759405};

  // What the servo loop compares with the device that it drives.
  struct certified_for {
    static constexpr bool any_device = false;
    static constexpr const char* device = "pantograph_2dof";
    static constexpr const char* device_digest = "1d81bf48c1147a31e2c4ee01df4b74bbb8c7b08f97922856005eb2f0de83a08e";
    static constexpr const char* estimator[axes] = {"butterworth", "butterworth"};
    static constexpr unsigned loop_delay = 0;  // [samples]
    static constexpr bool is_certified = true;
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
    // w of port across
    const scalar across_position = tip_x;
    // position of the tip, y
    const scalar tip_y = part_7 + (half * part_8 + part_6 * part_9);
    // w of port out
    const scalar out_position = tip_y - out_offset;
    across_last_position_ = dashpot::all_finite(across_position) ? across_position : 0;
    across_sampled_position_ = 0;
    out_last_position_ = dashpot::all_finite(out_position) ? out_position : 0;
    out_sampled_position_ = 0;
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
    // w of port across
    const scalar across_position = tip_x;
    // m = f − b u̇
    const scalar across_force = across_static_stiffness * across_position;
    const scalar part_16 = half * part_11;
    const scalar part_17 = part_7 * part_13;
    const scalar part_18 = part_16 + part_17;
    // position of the tip, y
    const scalar tip_y = part_10 + part_18;
    // w of port out
    const scalar out_position = tip_y - out_offset;
    // m = f − b u̇
    const scalar out_force = out_static_stiffness * out_position;
    const scalar part_19 = part_12 / part_13;
    const scalar part_20 = part_19 * (part_10 * part_15 + part_3 * part_18);
    const scalar part_21 = part_17 - part_16;
    // −∂x/∂q1
    const scalar x_by_q1 = part_20 * part_21;
    const scalar part_22 = part_8 + part_14;
    // −∂y/∂q1
    const scalar y_by_q1 = part_20 * part_22;
    // B* of joint 1
    const scalar wanted_11 = x_by_q1 * x_by_q1 + y_by_q1 * y_by_q1;
    const scalar part_23 = most_damping_1 - wanted_11 > 0 ? wanted_11 : most_damping_1;
    // D, what the brakes make of B*
    const scalar damping_1 = part_23 + added_damping_1;
    const scalar part_24 = part_19 * (part_9 * part_22 + part_6 * part_21);
    // −∂x/∂q2
    const scalar x_by_q2 = part_18 * part_24;
    // ∂y/∂q2
    const scalar y_by_q2 = part_15 * part_24;
    // B* of joint 2
    const scalar wanted_22 = x_by_q2 * x_by_q2 + y_by_q2 * y_by_q2;
    const scalar part_25 = most_damping_1 - wanted_22 > 0 ? wanted_22 : most_damping_1;
    const scalar damping_2 = added_damping_1 + part_25;
    // B* between the joints
    const scalar wanted_12 = x_by_q1 * x_by_q2 - y_by_q1 * y_by_q2;
    // τ = Σ ∂w/∂q M + (B* − D) v
    const scalar torque_1 = (wanted_11 - part_23) * v1 + wanted_12 * v2 - (x_by_q1 * across_force +
        y_by_q1 * out_force);
    const scalar torque_2 = y_by_q2 * out_force - x_by_q2 * across_force + (wanted_12 * v1 +
        v2 * (wanted_22 - part_25));
    sampled_ = false;
    if (!dashpot::all_finite(q1, q2, v1, v2, damping_1, damping_2, torque_1, torque_2)) return {{sampled_damping_1_, sampled_damping_2_}, {}};
    sampled_ = true;
    across_sampled_position_ = across_position;
    out_sampled_position_ = out_position;
    sampled_damping_1_ = damping_1;
    sampled_damping_2_ = damping_2;
    return {{damping_1, damping_2}, {torque_1, torque_2}};
  }

  // Advances the states to the next sample. Call it once after each output(), when the command has been sent.
  void update() noexcept {
    if (!sampled_) return;
    sampled_ = false;
    // u₋ = u
    across_last_position_ = across_sampled_position_;
    // u₋ = u
    out_last_position_ = out_sampled_position_;
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
    // w of port across
    const scalar across_position = tip_x;
    // m = f − b u̇
    const scalar across_force = across_static_stiffness * across_position;
    const scalar part_16 = half * part_11;
    const scalar part_17 = part_7 * part_13;
    const scalar part_18 = part_16 + part_17;
    // position of the tip, y
    const scalar tip_y = part_10 + part_18;
    // w of port out
    const scalar out_position = tip_y - out_offset;
    // m = f − b u̇
    const scalar out_force = out_static_stiffness * out_position;
    const scalar part_19 = part_12 / part_13;
    const scalar part_20 = part_19 * (part_10 * part_15 + part_3 * part_18);
    const scalar part_21 = part_17 - part_16;
    // −∂x/∂q1
    const scalar x_by_q1 = part_20 * part_21;
    const scalar part_22 = part_8 + part_14;
    // −∂y/∂q1
    const scalar y_by_q1 = part_20 * part_22;
    // B* of joint 1
    const scalar wanted_11 = x_by_q1 * x_by_q1 + y_by_q1 * y_by_q1;
    const scalar part_23 = most_damping_1 - wanted_11 > 0 ? wanted_11 : most_damping_1;
    // D, what the brakes make of B*
    const scalar damping_1 = part_23 + added_damping_1;
    const scalar part_24 = part_19 * (part_9 * part_22 + part_6 * part_21);
    // −∂x/∂q2
    const scalar x_by_q2 = part_18 * part_24;
    // ∂y/∂q2
    const scalar y_by_q2 = part_15 * part_24;
    // B* of joint 2
    const scalar wanted_22 = x_by_q2 * x_by_q2 + y_by_q2 * y_by_q2;
    const scalar part_25 = most_damping_1 - wanted_22 > 0 ? wanted_22 : most_damping_1;
    const scalar damping_2 = added_damping_1 + part_25;
    // B* between the joints
    const scalar wanted_12 = x_by_q1 * x_by_q2 - y_by_q1 * y_by_q2;
    // τ = Σ ∂w/∂q M + (B* − D) v
    const scalar torque_1 = (wanted_11 - part_23) * v1 + wanted_12 * v2 - (x_by_q1 * across_force +
        y_by_q1 * out_force);
    const scalar torque_2 = y_by_q2 * out_force - x_by_q2 * across_force + (wanted_12 * v1 +
        v2 * (wanted_22 - part_25));
    if (!dashpot::all_finite(q1, q2, v1, v2, damping_1, damping_2, torque_1, torque_2)) {
      sampled_ = false;
      return {{sampled_damping_1_, sampled_damping_2_}, {}};
    }
    sampled_damping_1_ = damping_1;
    sampled_damping_2_ = damping_2;
    // u₋ = u
    across_last_position_ = across_position;
    // u₋ = u
    out_last_position_ = out_position;
    sampled_ = false;
    return {{damping_1, damping_2}, {torque_1, torque_2}};
  }

  // No parameter of this network can be set while it runs.
  unsigned set(const parameters&) noexcept { return 0; }

  // Energy in the springs after the last update() [J].
  scalar stored_energy() const noexcept {
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar across_stored = across_half_static_stiffness * across_last_position_ * across_last_position_;
    // V = ½ k0 u² + Σ F_i²/(2 k_i)
    const scalar out_stored = out_half_static_stiffness * out_last_position_ * out_last_position_;
    // Σ V of all ports
    const scalar stored = across_stored + out_stored;
    return stored;
  }

 private:
  static constexpr scalar across_static_stiffness = 100.0;  // k0 [N/m]
  static constexpr scalar across_half_static_stiffness = 50.0;  // ½ k0 [N/m]
  static constexpr scalar out_static_stiffness = 100.0;  // k0 [N/m]
  static constexpr scalar out_half_static_stiffness = 50.0;  // ½ k0 [N/m]
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
  static constexpr scalar out_offset = 0.1;  // distance of the plane from the origin [m]
  static constexpr scalar most_damping_1 = 0.00953851439782406;  // largest damping of the brake, less what is added [N·m·s/rad]
  static constexpr scalar added_damping_1 = 0.0044614856021759405;  // added to the brake's command for passivity [N·m·s/rad]

  scalar across_last_position_ = 0.06299999990746864;  // u of the sample before [m]
  scalar across_sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar out_last_position_ = -0.026049002726895476;  // u of the sample before [m]
  scalar out_sampled_position_ = 0;  // port displacement u, at this sample [m]
  scalar sampled_damping_1_ = 0;  // damping of brake 1, at this sample [N·m·s/rad]
  scalar sampled_damping_2_ = 0;  // damping of brake 2, at this sample [N·m·s/rad]
  bool sampled_ = false;  // a finite sample waits for update()
};

}  // namespace dashpot::generated
