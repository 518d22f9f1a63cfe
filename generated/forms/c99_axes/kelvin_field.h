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
// it. C99, and C++; compile it with -ffp-contract=off where results are compared bit for bit.
#ifndef DASHPOT_GENERATED_kelvin_field_H
#define DASHPOT_GENERATED_kelvin_field_H

// <dashpot/command.h>, so that this file is all that is needed.
// What an update law in C returns every sample, and the arithmetic that it shares with the law in C++. C99 and C++;
// includes nothing. The sign convention is that of <dashpot/command.hpp>: the network opposes the tool with the force
// f = damping·u̇ + force, positive against +u.
#ifndef DASHPOT_COMMAND_H
#define DASHPOT_COMMAND_H

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "dashpot needs IEEE arithmetic: finite checks and compensated sums do not survive -ffast-math"
#endif

// Of a law in float both numbers are floats, widened without rounding.
typedef struct dashpot_command {
  double damping;  // brake damping [N·s/m], or [N·m·s/rad] in rotation; never negative
  double force;    // motor force opposing +u [N], or torque [N·m] in rotation
} dashpot_command;

// 1 where all three are finite, else 0: x − x is 0 for a finite x and NaN for the others, and NaN alone differs from
// itself.
static inline int dashpot_all_finite(double a, double b, double c) {
  const double nothing = ((a - a) + (b - b)) + (c - c);
  return (nothing == nothing) ? 1 : 0;
}
static inline int dashpot_all_finitef(float a, float b, float c) {
  const float nothing = ((a - a) + (b - b)) + (c - c);
  return (nothing == nothing) ? 1 : 0;
}

// Zero for a magnitude below `threshold`, the value itself otherwise: keeps decaying states out of the subnormal range.
static inline double dashpot_flush_below(double threshold, double value) {
  return ((value > threshold) || (value < -threshold)) ? value : 0.0;
}
static inline float dashpot_flush_belowf(float threshold, float value) {
  return ((value > threshold) || (value < -threshold)) ? value : 0.0f;
}

// `value` within ± `limit`, which is not negative: what a slip holds of the force that acts on it.
static inline double dashpot_clamp_to(double limit, double value) {
  const double below = (value < limit) ? value : limit;
  return (below > -limit) ? below : -limit;
}
static inline float dashpot_clamp_tof(float limit, float value) {
  const float below = (value < limit) ? value : limit;
  return (below > -limit) ? below : -limit;
}

// How far a tool at `position` has pushed in a surface that lies at `at`, unloaded; 0 before it.

#endif

// √x to the nearest number, and 0 for x ≤ 0. Infinity stays infinity. By one instruction where the processor has it, else
// by the same steps for every x.
static inline double kelvin_field_square_root(double x) {
# if defined(__GNUC__) && defined(__SSE2__) && !defined(__AVX__) && !defined(__FRAMAC__)
  if (!(x > 0)) return 0;
  __asm__("sqrtsd %0, %0" : "+x"(x));
  return x;
# elif defined(__GNUC__) && defined(__ARM_FP) && !defined(__aarch64__) && !defined(__FRAMAC__) && (__ARM_FP & 8)
  if (!(x > 0)) return 0;
  __asm__("vsqrt.f64 %P0, %P0" : "+w"(x));
  return x;
# else
  // Powers of two that take any number to between 1 and 4.
  static const double halves[] = {1.157920892373162e+77, 1.157920892373162e+77, 3.402823669209385e+38, 1.8446744073709552e+19, 4294967296.0, 65536.0, 256.0, 16.0, 4.0, 2.0};
  double scale = 1;
  if (!(x > 0)) return 0;
  if ((x - x) != 0) return x;
  for (int i = 0; i < (int)(sizeof halves / sizeof halves[0]); ++i) {
    const double half = halves[i];
    const int is_large = (x / half) >= half, is_small = !is_large && ((x * half) < (4 / half));
    if (is_large) x = x / half / half;
    if (is_small) x = x * half * half;
    scale = is_large ? scale * half : (is_small ? scale / half : scale);
  }
  // The chord through (1, 1) and (4, 2) is at most 6 % wrong; each of Newton's steps squares the relative error.
  double root = (x + 2) / 3;
  for (int step = 0; step < 4; ++step) root = (root + x / root) / 2;
  // Off by a last place at most. x − root² is exact, from products of half of the digits (Dekker 1971), and a multiple
  // of the last place squared, as root times the last place is; half way between two roots there is none.
  const double spread = 134217729.0 * root, high = spread - (spread - root), low = root - high, square = root * root;
  const double rest = (x - square) - ((((high * high) - square) + (2 * high * low)) + (low * low));
  const double nearest = root * 2.220446049250313e-16;
  if (rest > nearest) root = root + 2.220446049250313e-16;
  else if (rest <= -nearest) root = root - 2.220446049250313e-16;
  return scale * root;
# endif
}

enum { kelvin_field_axes = 2, kelvin_field_brakes = 2 };

// A damping for each brake, along the direction of joint velocities that the device's description states, and a torque
// for each motor, opposing a positive motion of its joint.
typedef struct kelvin_field_commands {
  double damping[kelvin_field_brakes];  // never negative [N·m·s/rad]
  double torque[kelvin_field_axes];  // [N·m]
} kelvin_field_commands;

typedef struct kelvin_field {
  double across_last_position;  // u of the sample before [m]
  double across_sampled_position;  // port displacement u, at this sample [m]
  double out_last_position;  // u of the sample before [m]
  double out_sampled_position;  // port displacement u, at this sample [m]
  double sampled_damping_1;  // damping of brake 1, at this sample [N·m·s/rad]
  double sampled_damping_2;  // damping of brake 2, at this sample [N·m·s/rad]
  int sampled;  // 1 while a finite sample waits for kelvin_field_update()
} kelvin_field;

// What a servo loop compares with the device that it drives. An empty digest: no device was named, any will do.
static inline double kelvin_field_sample_period(void) { return 0.0001; }  // [s]
static inline int kelvin_field_is_rotation(void) { return 1; }  // of the joints
static inline const char *kelvin_field_device(void) { return "pantograph_2dof"; }
static inline const char *kelvin_field_device_digest(void) { return "1d81bf48c1147a31e2c4ee01df4b74bbb8c7b08f97922856005eb2f0de83a08e"; }
static inline const char *kelvin_field_estimator(int joint) {
  static const char *const names[kelvin_field_axes] = {"butterworth", "butterworth"};
  return ((joint >= 0) && (joint < kelvin_field_axes)) ? names[joint] : "";
}
static inline unsigned kelvin_field_loop_delay(void) { return 0u; }  // [samples]
static inline int kelvin_field_is_certified(void) { return 1; }  // on that device, or on an ideal one

// The part of each brake's command that was added for passivity [N·m·s/rad].
static inline double kelvin_field_added_damping(int brake) {
  static const double added[kelvin_field_brakes] = {0.0044614856021759405, 0.0044614856021759405};
  return ((brake >= 0) && (brake < kelvin_field_brakes)) ? added[brake] : 0;
}

// Starts at rest with the joints at `position` [rad], one entry a joint: only the springs that hold a
// force at rest are loaded. A NaN or infinite position counts as 0.
static inline void kelvin_field_reset(kelvin_field *self, const double *position) {
  const double half = 0.5;  // 1/2 [1]
  const double base = 0.025;  // distance of the motor axes [m]
  const double proximal_link = 0.063;  // length of the link at the motor [m]
  const double root_of_half = 0.7071067811865476;  // √½ [1]
  const double eighth_turns_3 = 2.3561944901011884;  // a multiple of π/4, rounded [rad]
  const double eighth_turns_3_rest = 9.115650759759289e-11;  // what rounding took from that multiple of π/4 [rad]
  const double sine_term_6 = 1.6048168318165643e-10;  // coefficient of the polynomial in r² [1/rad^12]
  const double sine_term_7 = 7.374387503862757e-13;  // coefficient of the polynomial in r² [1/rad^14]
  const double sine_term_5 = 2.505188194671259e-08;  // coefficient of the polynomial in r² [1/rad^10]
  const double sine_term_4 = 2.7557316609073673e-06;  // coefficient of the polynomial in r² [1/rad^8]
  const double sine_term_3 = 0.00019841269824861897;  // coefficient of the polynomial in r² [1/rad^6]
  const double sine_term_2 = 0.008333333333282756;  // coefficient of the polynomial in r² [1/rad^4]
  const double sine_term_1 = 0.16666666666666072;  // coefficient of the polynomial in r² [1/rad^2]
  const double sine_term_0 = 0.9999999999999999;  // coefficient of the polynomial in r² [1]
  const double cosine_term_8 = 4.608977003001797e-14;  // coefficient of the polynomial in r² [1/rad^16]
  const double cosine_term_7 = 1.1462901901757276e-11;  // coefficient of the polynomial in r² [1/rad^14]
  const double cosine_term_6 = 2.0876561839933163e-09;  // coefficient of the polynomial in r² [1/rad^12]
  const double cosine_term_5 = 2.755731639102575e-07;  // coefficient of the polynomial in r² [1/rad^10]
  const double cosine_term_4 = 2.4801587277414926e-05;  // coefficient of the polynomial in r² [1/rad^8]
  const double cosine_term_3 = 0.001388888888877299;  // coefficient of the polynomial in r² [1/rad^6]
  const double cosine_term_2 = 0.04166666666666388;  // coefficient of the polynomial in r² [1/rad^4]
  const double cosine_term_1 = 0.4999999999999997;  // coefficient of the polynomial in r² [1/rad^2]
  const double one = 1.0;  // 1 [1]
  const double eighth_turns_1 = 0.7853981633670628;  // a multiple of π/4, rounded [rad]
  const double eighth_turns_1_rest = 3.038550253253096e-11;  // what rounding took from that multiple of π/4 [rad]
  const double distal_link_squared = 0.005625;  // square of the length of the link at the tip [m²]
  const double quarter = 0.25;  // 1/4 [1]
  const double half_base = 0.0125;  // half the distance of the motor axes [m]
  const double out_offset = 0.1;  // distance of the plane from the origin [m]
  const double q1 = (dashpot_all_finite(position[0], position[0], position[0]) != 0) ? position[0] : 0.0;
  const double q2 = (dashpot_all_finite(position[1], position[1], position[1]) != 0) ? position[1] : 0.0;
  // r = θ − a multiple of π/4
  const double rest_1 = q1 - eighth_turns_3 - eighth_turns_3_rest;
  // r²
  const double rest_squared_1 = rest_1 * rest_1;
  const double part_1 = rest_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 *
      (rest_squared_1 * (rest_squared_1 * (sine_term_6 - rest_squared_1 * sine_term_7) - sine_term_5) +
      sine_term_4) - sine_term_3) + sine_term_2) - sine_term_1) + sine_term_0);
  const double part_2 = rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 *
      (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * cosine_term_8 - cosine_term_7) +
      cosine_term_6) - cosine_term_5) + cosine_term_4) - cosine_term_3) + cosine_term_2) - cosine_term_1) + one;
  // −cos θ
  const double cosine_1 = root_of_half * (part_1 + part_2);
  const double part_3 = proximal_link * cosine_1;
  // r = θ − a multiple of π/4
  const double rest_2 = q2 - eighth_turns_1 - eighth_turns_1_rest;
  // r²
  const double rest_squared_2 = rest_2 * rest_2;
  const double part_4 = one + rest_squared_2 * (rest_squared_2 * (cosine_term_2 +
      rest_squared_2 * (rest_squared_2 * (cosine_term_4 + rest_squared_2 * (rest_squared_2 * (cosine_term_6 +
      rest_squared_2 * (cosine_term_8 *
      rest_squared_2 - cosine_term_7)) - cosine_term_5)) - cosine_term_3)) - cosine_term_1);
  const double part_5 = rest_2 * (sine_term_0 + rest_squared_2 * (rest_squared_2 * (sine_term_2 +
      rest_squared_2 * (rest_squared_2 * (sine_term_4 +
      rest_squared_2 * (rest_squared_2 * (sine_term_6 - sine_term_7 *
      rest_squared_2) - sine_term_5)) - sine_term_3)) - sine_term_1));
  // cos θ
  const double cosine_2 = root_of_half * (part_4 - part_5);
  const double part_6 = base + (part_3 + proximal_link * cosine_2);
  // sin θ
  const double sine_2 = root_of_half * (part_5 + part_4);
  // sin θ
  const double sine_1 = root_of_half * (part_2 - part_1);
  const double part_7 = proximal_link * sine_1;
  const double part_8 = proximal_link * sine_2 - part_7;
  const double part_9 = kelvin_field_square_root(distal_link_squared * (one / (part_6 * part_6 +
      part_8 * part_8)) - quarter);
  // position of the tip, x
  const double tip_x = half * part_6 - part_8 * part_9 - part_3 - half_base;
  // w of port across
  const double across_position = tip_x;
  // position of the tip, y
  const double tip_y = part_7 + (half * part_8 + part_6 * part_9);
  // w of port out
  const double out_position = tip_y - out_offset;
  self->across_last_position = (dashpot_all_finite(across_position, across_position, across_position) != 0) ? across_position : 0.0;
  self->across_sampled_position = 0.0;
  self->out_last_position = (dashpot_all_finite(out_position, out_position, out_position) != 0) ? out_position : 0.0;
  self->out_sampled_position = 0.0;
  self->sampled_damping_1 = 0.0;
  self->sampled_damping_2 = 0.0;
  self->sampled = 0;
}

// Starts at rest with the joints at 0. Call it before all other functions.
static inline void kelvin_field_init(kelvin_field *self) {
  const double origin[2] = {0};
  kelvin_field_reset(self, origin);
  self->sampled = 0;
}

// The command for this sample: the joints' positions [rad] and estimates of their velocities
// [rad/s]. After a non-finite input the states stay as they were, the brakes get their last command and the
// motors none.
static inline kelvin_field_commands kelvin_field_output(kelvin_field *self, const double *position, const double *velocity) {
  kelvin_field_commands command;
  const double across_static_stiffness = 100.0;  // k0 [N/m]
  const double out_static_stiffness = 100.0;  // k0 [N/m]
  const double half = 0.5;  // 1/2 [1]
  const double base = 0.025;  // distance of the motor axes [m]
  const double proximal_link = 0.063;  // length of the link at the motor [m]
  const double root_of_half = 0.7071067811865476;  // √½ [1]
  const double eighth_turns_3 = 2.3561944901011884;  // a multiple of π/4, rounded [rad]
  const double eighth_turns_3_rest = 9.115650759759289e-11;  // what rounding took from that multiple of π/4 [rad]
  const double sine_term_6 = 1.6048168318165643e-10;  // coefficient of the polynomial in r² [1/rad^12]
  const double sine_term_7 = 7.374387503862757e-13;  // coefficient of the polynomial in r² [1/rad^14]
  const double sine_term_5 = 2.505188194671259e-08;  // coefficient of the polynomial in r² [1/rad^10]
  const double sine_term_4 = 2.7557316609073673e-06;  // coefficient of the polynomial in r² [1/rad^8]
  const double sine_term_3 = 0.00019841269824861897;  // coefficient of the polynomial in r² [1/rad^6]
  const double sine_term_2 = 0.008333333333282756;  // coefficient of the polynomial in r² [1/rad^4]
  const double sine_term_1 = 0.16666666666666072;  // coefficient of the polynomial in r² [1/rad^2]
  const double sine_term_0 = 0.9999999999999999;  // coefficient of the polynomial in r² [1]
  const double cosine_term_8 = 4.608977003001797e-14;  // coefficient of the polynomial in r² [1/rad^16]
  const double cosine_term_7 = 1.1462901901757276e-11;  // coefficient of the polynomial in r² [1/rad^14]
  const double cosine_term_6 = 2.0876561839933163e-09;  // coefficient of the polynomial in r² [1/rad^12]
  const double cosine_term_5 = 2.755731639102575e-07;  // coefficient of the polynomial in r² [1/rad^10]
  const double cosine_term_4 = 2.4801587277414926e-05;  // coefficient of the polynomial in r² [1/rad^8]
  const double cosine_term_3 = 0.001388888888877299;  // coefficient of the polynomial in r² [1/rad^6]
  const double cosine_term_2 = 0.04166666666666388;  // coefficient of the polynomial in r² [1/rad^4]
  const double cosine_term_1 = 0.4999999999999997;  // coefficient of the polynomial in r² [1/rad^2]
  const double one = 1.0;  // 1 [1]
  const double eighth_turns_1 = 0.7853981633670628;  // a multiple of π/4, rounded [rad]
  const double eighth_turns_1_rest = 3.038550253253096e-11;  // what rounding took from that multiple of π/4 [rad]
  const double distal_link_squared = 0.005625;  // square of the length of the link at the tip [m²]
  const double quarter = 0.25;  // 1/4 [1]
  const double half_base = 0.0125;  // half the distance of the motor axes [m]
  const double out_offset = 0.1;  // distance of the plane from the origin [m]
  const double most_damping_1 = 0.00953851439782406;  // largest damping of the brake, less what is added [N·m·s/rad]
  const double added_damping_1 = 0.0044614856021759405;  // added to the brake's command for passivity [N·m·s/rad]
  const double q1 = position[0];
  const double q2 = position[1];
  const double v1 = velocity[0];
  const double v2 = velocity[1];
  // r = θ − a multiple of π/4
  const double rest_1 = q1 - eighth_turns_3 - eighth_turns_3_rest;
  // r²
  const double rest_squared_1 = rest_1 * rest_1;
  const double part_1 = rest_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 *
      (rest_squared_1 * (rest_squared_1 * (sine_term_6 - rest_squared_1 * sine_term_7) - sine_term_5) +
      sine_term_4) - sine_term_3) + sine_term_2) - sine_term_1) + sine_term_0);
  const double part_2 = rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * (rest_squared_1 *
      (rest_squared_1 * (rest_squared_1 * (rest_squared_1 * cosine_term_8 - cosine_term_7) +
      cosine_term_6) - cosine_term_5) + cosine_term_4) - cosine_term_3) + cosine_term_2) - cosine_term_1) + one;
  // −cos θ
  const double cosine_1 = root_of_half * (part_1 + part_2);
  const double part_3 = proximal_link * cosine_1;
  // r = θ − a multiple of π/4
  const double rest_2 = q2 - eighth_turns_1 - eighth_turns_1_rest;
  // r²
  const double rest_squared_2 = rest_2 * rest_2;
  const double part_4 = one + rest_squared_2 * (rest_squared_2 * (cosine_term_2 +
      rest_squared_2 * (rest_squared_2 * (cosine_term_4 + rest_squared_2 * (rest_squared_2 * (cosine_term_6 +
      rest_squared_2 * (cosine_term_8 *
      rest_squared_2 - cosine_term_7)) - cosine_term_5)) - cosine_term_3)) - cosine_term_1);
  const double part_5 = rest_2 * (sine_term_0 + rest_squared_2 * (rest_squared_2 * (sine_term_2 +
      rest_squared_2 * (rest_squared_2 * (sine_term_4 +
      rest_squared_2 * (rest_squared_2 * (sine_term_6 - sine_term_7 *
      rest_squared_2) - sine_term_5)) - sine_term_3)) - sine_term_1));
  // cos θ
  const double cosine_2 = root_of_half * (part_4 - part_5);
  const double part_6 = proximal_link * cosine_2;
  const double part_7 = base + (part_3 + part_6);
  const double part_8 = half * part_7;
  // sin θ
  const double sine_2 = root_of_half * (part_5 + part_4);
  const double part_9 = proximal_link * sine_2;
  // sin θ
  const double sine_1 = root_of_half * (part_2 - part_1);
  const double part_10 = proximal_link * sine_1;
  const double part_11 = part_9 - part_10;
  const double part_12 = one / (part_7 * part_7 + part_11 * part_11);
  const double part_13 = kelvin_field_square_root(distal_link_squared * part_12 - quarter);
  const double part_14 = part_11 * part_13;
  const double part_15 = part_8 - part_14;
  // position of the tip, x
  const double tip_x = part_15 - part_3 - half_base;
  // w of port across
  const double across_position = tip_x;
  // m = f − b u̇
  const double across_force = across_static_stiffness * across_position;
  const double part_16 = half * part_11;
  const double part_17 = part_7 * part_13;
  const double part_18 = part_16 + part_17;
  // position of the tip, y
  const double tip_y = part_10 + part_18;
  // w of port out
  const double out_position = tip_y - out_offset;
  // m = f − b u̇
  const double out_force = out_static_stiffness * out_position;
  const double part_19 = part_12 / part_13;
  const double part_20 = part_19 * (part_10 * part_15 + part_3 * part_18);
  const double part_21 = part_17 - part_16;
  // −∂x/∂q1
  const double x_by_q1 = part_20 * part_21;
  const double part_22 = part_8 + part_14;
  // −∂y/∂q1
  const double y_by_q1 = part_20 * part_22;
  // B* of joint 1
  const double wanted_11 = x_by_q1 * x_by_q1 + y_by_q1 * y_by_q1;
  const double part_23 = (most_damping_1 - wanted_11 > 0) ? wanted_11 : most_damping_1;
  // D, what the brakes make of B*
  const double damping_1 = part_23 + added_damping_1;
  const double part_24 = part_19 * (part_9 * part_22 + part_6 * part_21);
  // −∂x/∂q2
  const double x_by_q2 = part_18 * part_24;
  // ∂y/∂q2
  const double y_by_q2 = part_15 * part_24;
  // B* of joint 2
  const double wanted_22 = x_by_q2 * x_by_q2 + y_by_q2 * y_by_q2;
  const double part_25 = (most_damping_1 - wanted_22 > 0) ? wanted_22 : most_damping_1;
  const double damping_2 = added_damping_1 + part_25;
  // B* between the joints
  const double wanted_12 = x_by_q1 * x_by_q2 - y_by_q1 * y_by_q2;
  // τ = Σ ∂w/∂q M + (B* − D) v
  const double torque_1 = (wanted_11 - part_23) * v1 + wanted_12 * v2 - (x_by_q1 * across_force +
      y_by_q1 * out_force);
  const double torque_2 = y_by_q2 * out_force - x_by_q2 * across_force + (wanted_12 * v1 +
      v2 * (wanted_22 - part_25));
  self->sampled = dashpot_all_finite(q1, q2, v1) & dashpot_all_finite(v2, damping_1,
      damping_2) & dashpot_all_finite(torque_1, torque_2, torque_2);
  if (self->sampled != 0) {
    self->across_sampled_position = across_position;
    self->out_sampled_position = out_position;
    self->sampled_damping_1 = damping_1;
    self->sampled_damping_2 = damping_2;
    command.damping[0] = damping_1;
    command.damping[1] = damping_2;
    command.torque[0] = torque_1;
    command.torque[1] = torque_2;
  } else {
    command.damping[0] = self->sampled_damping_1;
    command.damping[1] = self->sampled_damping_2;
    command.torque[0] = 0.0;
    command.torque[1] = 0.0;
  }
  return command;
}

// Advances the states to the next sample. Call it once after each kelvin_field_output(), when the command has been sent.
static inline void kelvin_field_update(kelvin_field *self) {
  if (self->sampled != 0) {
    // u₋ = u
    self->across_last_position = self->across_sampled_position;
    // u₋ = u
    self->out_last_position = self->out_sampled_position;
    self->sampled = 0;
  }
}

// output() and then update() in one call.
static inline kelvin_field_commands kelvin_field_step(kelvin_field *self, const double *position, const double *velocity) {
  const kelvin_field_commands command = kelvin_field_output(self, position, velocity);
  kelvin_field_update(self);
  return command;
}

// Energy in the springs after the last update() [J].
static inline double kelvin_field_stored_energy(const kelvin_field *self) {
  const double across_half_static_stiffness = 50.0;  // ½ k0 [N/m]
  const double out_half_static_stiffness = 50.0;  // ½ k0 [N/m]
  // V = ½ k0 u² + Σ F_i²/(2 k_i)
  const double across_stored = across_half_static_stiffness * self->across_last_position *
      self->across_last_position;
  // V = ½ k0 u² + Σ F_i²/(2 k_i)
  const double out_stored = out_half_static_stiffness * self->out_last_position * self->out_last_position;
  // Σ V of all ports
  const double stored = across_stored + out_stored;
  return stored;
}

#endif
