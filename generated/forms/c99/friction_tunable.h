// Presliding and Coulomb friction beside a viscous drag, all of which change while it runs
//
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, except in
//   samples in which a slip or a contact changes
// brake: makes b = 12 N·s/m of damping and, in the parts with slips, what the next lines give, and the motor the
//   rest of the force; by the rule 'faithful': without a device 'faithful' is the paper's rule: dampers at the
//   tool in parallel add
// slip rule of friction: velocity-free, parameters change while it runs; b is that of their default values; b = 0
//   N·s/m stuck, 0 sliding
// states: what the law remembers follows the measured position (position driven, so that a change of parameters
//   injects no energy)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: not certified: to be passive for any motion, whichever slips slide or stick and whether the tool
//   touches or not, any values within their ranges between changes, any brake that makes at least the commanded
//   damping, the law needs 2.5 N·s/m by a proof sample by sample, for commands that are held for up to 0.001 s; 0
//   N·s/m is guaranteed; the brake's command would have to be 2.5 N·s/m larger
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion, and for any values within their ranges, the law gives out no more work than
//   stored_energy() decreases by; rounding changes the force by at most 1.4e-15 of the sum of its terms'
//   magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// tunable: yield (0 to 5 N), presliding (200 to 5000 N/m), drag (0 to 40 N s/m)
//   set() itself injects no energy: raising a stiffness under load raises the force only as far as energy that
//   other springs release allows; but the motor still holds the force of the last sample, so call set() right
//   after step() and take the command from output() of the same sample
//   b [N·s/m] after set(): damper_3
// cost of output(): 7 additions, 4 multiplications, 0 guards against subnormal numbers
// cost of update(): 1 addition, 1 multiplication, 1 guard against subnormal numbers; 9 numbers kept between
//   samples
// cost of set(): 7 operations for the constants, 53 for the forces of springs and their energy
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved
//
// Written by dashpot 0.1.0 from a network with digest
// c86fcb8b7c393e3b623d21078d88e80af59e3eaf3833b10700b69af0c86379ba. It belongs to whoever emitted
// it. C99, and C++; compile it with -ffp-contract=off where results are compared bit for bit.
#ifndef DASHPOT_GENERATED_friction_tunable_H
#define DASHPOT_GENERATED_friction_tunable_H

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
static inline double friction_tunable_square_root(double x) {
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

typedef struct friction_tunable_range_of_parameter {
  double min;
  double max;
} friction_tunable_range_of_parameter;

// `value` becomes what is wanted of it, within its range; a NaN leaves it as it is. Returns 1 where
// that is not what was wanted, else 0.
static inline unsigned friction_tunable_take_value(const friction_tunable_range_of_parameter *range, double wanted, double *value) {
  if (wanted == wanted) *value = (wanted < range->min) ? range->min : ((wanted > range->max) ? range->max : wanted);
  return (*value == wanted) ? 0u : 1u;
}

static const friction_tunable_range_of_parameter friction_tunable_ranges[3] = {
    {0.0, 5.0},  // yield [N]
    {200.0, 5000.0},  // presliding [N/m]
    {0.0, 40.0},  // drag [N s/m]
};

// What may change while the law runs, to begin with as in the network's file.
typedef struct friction_tunable_parameters {
  double yield;  // 0 to 5 [N]
  double presliding;  // 200 to 5000 [N/m]
  double drag;  // 0 to 40 [N s/m]
} friction_tunable_parameters;

typedef struct friction_tunable {
  double held_force;  // force of the springs if the tool stays [N]
  double yield;  // parameter [N]
  double presliding;  // parameter [N/m]
  double drag;  // parameter [N s/m]
  double step_stiffness;  // stiffness of the springs over one sample [N/m]
  double spring_2_elongation;  // z, elongation of the spring [m]
  double spring_2_carried_stiffness;  // k after the last change of parameters [N/m]
  double spring_2_held;  // force if the block keeps its length [N]
  double tank;  // energy set free by changes of parameters, not yet spent [J]
  double friction_yield;  // Y [N]
  double spring_2_answer;  // g, stiffness of the block over one sample [N/m]
  double spring_2_given_way;  // δ for each newton that the slip does not hold [m/N]
  double steady_brake;  // b of the parts that no slip changes [N·s/m]
  double velocity_gain;  // b∞ − b [N·s/m]
  double last_position;  // u of the sample before [m]
  double last_brake;  // b of the sample before [N·s/m]
  double sampled_position;  // port displacement u, at this sample [m]
  double sampled_position_change;  // Δu since the sample before, at this sample [m]
  double sampled_spring_2_stretched;  // at this sample [m]
  int has_parameters;  // 1 once they are there: as in the file, or set
  int sampled;  // 1 while a finite sample waits for friction_tunable_update()
} friction_tunable;

// What a servo loop compares with the device that it drives. An empty digest: no device was named, any will do.
static inline double friction_tunable_sample_period(void) { return 0.001; }  // [s]
static inline int friction_tunable_is_rotation(void) { return 0; }
static inline const char *friction_tunable_device(void) { return "ideal"; }
static inline const char *friction_tunable_device_digest(void) { return ""; }
static inline const char *friction_tunable_estimator(void) { return "exact"; }
static inline unsigned friction_tunable_loop_delay(void) { return 0u; }  // [samples]
static inline int friction_tunable_is_certified(void) { return 0; }  // on that device, or on an ideal one

// The part of the brake's command that was added for passivity: it is felt in addition to the network.
static inline double friction_tunable_added_damping(void) { return 0.0; }

static inline int friction_tunable_parameter_count(void) { return 3; }
static inline const char * friction_tunable_parameter_name(int i) {
  if (i == 0) return "yield";
  if (i == 1) return "presliding";
  if (i == 2) return "drag";
  return "";
}
static inline const char * friction_tunable_parameter_unit(int i) {
  if (i == 0) return "N";
  if (i == 1) return "N/m";
  if (i == 2) return "N s/m";
  return "";
}
static inline double friction_tunable_parameter_value(int i) {
  if (i == 0) return 1.5;
  if (i == 1) return 2000.0;
  if (i == 2) return 12.0;
  return 0;
}
static inline double friction_tunable_parameter_min(int i) {
  if (i == 0) return 0.0;
  if (i == 1) return 200.0;
  if (i == 2) return 0.0;
  return 0;
}
static inline double friction_tunable_parameter_max(int i) {
  if (i == 0) return 5.0;
  if (i == 1) return 5000.0;
  if (i == 2) return 40.0;
  return 0;
}

// Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
// NaN or infinite position counts as 0. Parameters stay as they are; in a structure that was all zero they become those
// of the network's file.
static inline void friction_tunable_reset(friction_tunable *self, double position) {
  if (self->has_parameters != 1) {  // as in the network's file
    self->yield = 1.5;
    self->presliding = 2000.0;
    self->drag = 12.0;
    self->step_stiffness = 0.0;
    self->spring_2_carried_stiffness = 2000.0;
    self->friction_yield = 1.5;
    self->spring_2_answer = 2000.0;
    self->spring_2_given_way = -0.0005;
    self->steady_brake = 12.0;
    self->velocity_gain = 0.0;
    self->has_parameters = 1;
  }
  const double zero = 0.0;  // nothing [1]
  self->held_force = 0.0;
  self->spring_2_elongation = 0.0;
  self->spring_2_held = 0.0;
  self->tank = 0.0;
  self->last_position = (dashpot_all_finite(position, position, position) != 0) ? position : 0.0;
  self->last_brake = 12.0;
  self->sampled_position = 0.0;
  self->sampled_position_change = 0.0;
  self->sampled_spring_2_stretched = 0.0;
  // force if the tool stays
  self->held_force = zero;
  self->last_brake = self->steady_brake;
  self->sampled = 0;
}

// Starts at rest at 0, with the parameters' values of the network's file. Call it before all other functions.
static inline void friction_tunable_init(friction_tunable *self) {
  self->has_parameters = 0;
  friction_tunable_reset(self, 0);
  self->sampled = 0;
}

// The command for this sample: port position [m] and an estimate of its velocity [m/s].
// After a non-finite input the states stay as they were and the motor's force is 0.
static inline dashpot_command friction_tunable_output(friction_tunable *self, double position, double velocity) {
  dashpot_command command;
  // Δu = u − u₋
  const double position_change = position - self->last_position;
  // force of the slip if it held
  const double friction_trial = self->spring_2_answer * position_change + self->spring_2_held;
  // clamp(trial, ±Y)
  const double friction_force = dashpot_clamp_to(self->friction_yield, friction_trial);
  // excess = trial − force
  const double friction_excess = friction_trial - friction_force;
  // δ of the block
  const double spring_2_stretched = position_change + self->spring_2_given_way * friction_excess;
  // f
  const double slips_force = friction_force;
  // m = f − b u̇
  const double force = self->step_stiffness * position_change + self->held_force + slips_force +
      self->velocity_gain * velocity;
  // b
  const double brake = self->steady_brake;
  self->sampled = dashpot_all_finite(position, velocity, force);
  if (self->sampled != 0) {
    self->last_brake = brake;
    self->sampled_position = position;
    self->sampled_position_change = position_change;
    self->sampled_spring_2_stretched = spring_2_stretched;
    command.damping = brake;
    command.force = force;
  } else {
    command.damping = self->last_brake;
    command.force = 0.0;
  }
  return command;
}

// Advances the states to the next sample. Call it once after each friction_tunable_output(), when the command has been sent.
static inline void friction_tunable_update(friction_tunable *self) {
  if (self->sampled != 0) {
    const double threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
    const double zero = 0.0;  // nothing [1]
    // z ← z + δ
    self->spring_2_elongation = dashpot_flush_below(threshold, self->spring_2_elongation +
        self->sampled_spring_2_stretched);
    // force if the tool stays
    self->held_force = zero;
    // force if the block keeps its length
    self->spring_2_held = self->presliding * self->spring_2_elongation;
    // u₋ = u
    self->last_position = self->sampled_position;
    self->sampled = 0;
  }
}

// output() and then update() in one call.
static inline dashpot_command friction_tunable_step(friction_tunable *self, double position, double velocity) {
  const dashpot_command command = friction_tunable_output(self, position, velocity);
  friction_tunable_update(self);
  return command;
}

// The value of a parameter now, counted from 0.
static inline double friction_tunable_parameter(const friction_tunable *self, int i) {
  if (i == 0) return self->yield;
  if (i == 1) return self->presliding;
  if (i == 2) return self->drag;
  return 0;
}

// Sets all parameters, in their order. Call it right after the step of a sample, and take the command from the output
// of that sample without another update: in a loop that is not late the motor then holds the old force no longer, and a
// spring that changes injects no energy. Bit i of the result: parameter i was beyond its range and is now at its bound,
// or it was NaN and has not changed. An update that is still due is done first, with the old parameters.
static inline unsigned friction_tunable_set_values(friction_tunable *self, const double *wanted) {
  if (self->has_parameters != 1) { friction_tunable_init(self); }
  friction_tunable_update(self);
  unsigned clamped = 0u;
  clamped |= friction_tunable_take_value(&friction_tunable_ranges[0], wanted[0], &self->yield) << 0;
  clamped |= friction_tunable_take_value(&friction_tunable_ranges[1], wanted[1], &self->presliding) << 1;
  clamped |= friction_tunable_take_value(&friction_tunable_ranges[2], wanted[2], &self->drag) << 2;
  const double zero = 0.0;  // nothing [1]
  const double spring_2_least_answer = 0.0002980232238769531;  // smallest g, whatever the parameters are [N/m]
  const double friction_least_yield = 2.980232238769531e-07;  // smallest Y, whatever the parameters are [N]
  const double one = 1.0;  // one [1]
  const double two = 2.0;  // two [1]
  const double minus_one = -1.0;  // minus one [1]
  // g of all that joins tool and ground without a slip
  self->step_stiffness = zero;
  self->friction_yield = (self->yield - friction_least_yield > 0) ? self->yield : friction_least_yield;
  self->spring_2_answer = (self->presliding - spring_2_least_answer > 0) ? self->presliding :
      spring_2_least_answer;
  const double friction_moved_1 = one / self->spring_2_answer;
  self->spring_2_given_way = zero - friction_moved_1;
  // b: damper_3
  self->steady_brake = self->drag;
  // b∞ − b
  self->velocity_gain = self->drag - self->steady_brake;
  const double spring_2_force_before = self->spring_2_carried_stiffness * self->spring_2_elongation;
  // F, or F √(k′/k) where the new stiffness k′ is lower
  const double spring_2_force_kept = (self->spring_2_carried_stiffness - self->presliding > 0) ?
      ((self->presliding > 0) ? spring_2_force_before *
      friction_tunable_square_root(self->presliding / self->spring_2_carried_stiffness) : zero) :
      spring_2_force_before;
  const double spring_2_energy_before = (self->spring_2_carried_stiffness > 0) ? spring_2_force_before *
      (spring_2_force_before / self->spring_2_carried_stiffness) / two : zero;
  const double spring_2_energy_after = (self->presliding > 0) ? spring_2_force_before *
      (spring_2_force_before / self->presliding) / two : zero;
  self->tank = self->tank + ((self->presliding - self->spring_2_carried_stiffness > 0) ?
      spring_2_energy_before - spring_2_energy_after : zero) +
      ((self->presliding > 0) ? zero : spring_2_energy_before);
  const double spring_2_energy_held = (self->presliding > 0) ? spring_2_force_kept *
      (spring_2_force_kept / self->presliding) / two : zero;
  const double spring_2_energy_missing = spring_2_energy_after - spring_2_energy_held;
  const double spring_2_force_most = friction_tunable_square_root(two * self->presliding * (spring_2_energy_held +
      self->tank));
  const double spring_2_force_short = spring_2_force_kept - spring_2_force_before;
  const double spring_2_force_short_size = (spring_2_force_short > 0) ? spring_2_force_short :
      zero - spring_2_force_short;
  const double spring_2_falls_short = (self->presliding > 0) ? spring_2_force_short_size : zero;
  const double spring_2_energy_unpaid = spring_2_energy_missing - self->tank;
  // F as before, as far as the energy in the tank allows
  const double spring_2_force_after = (spring_2_falls_short > 0) ? ((spring_2_energy_unpaid > 0) ?
      ((spring_2_force_before > 0) ? spring_2_force_most : minus_one *
      spring_2_force_most) : spring_2_force_before) : spring_2_force_kept;
  self->tank = (spring_2_falls_short > 0) ? ((spring_2_energy_unpaid > 0) ? zero :
      self->tank - spring_2_energy_missing) : self->tank;
  const double spring_2_force_change = spring_2_force_after - spring_2_force_before;
  const double spring_2_force_change_size = (spring_2_force_change > 0) ? spring_2_force_change :
      zero - spring_2_force_change;
  const double spring_2_stiffness_change = self->presliding - self->spring_2_carried_stiffness;
  const double spring_2_stiffness_change_size = (spring_2_stiffness_change > 0) ? spring_2_stiffness_change :
      zero - spring_2_stiffness_change;
  const double spring_2_is_changed = spring_2_force_change_size + spring_2_stiffness_change_size;
  // z = F/k
  self->spring_2_elongation = (spring_2_is_changed > 0) ? ((self->presliding > 0) ?
      spring_2_force_after / self->presliding : zero) : self->spring_2_elongation;
  self->spring_2_carried_stiffness = self->presliding;
  // force if the tool stays
  self->held_force = zero;
  // force if the block keeps its length
  self->spring_2_held = self->presliding * self->spring_2_elongation;
  return clamped;
}

static inline friction_tunable_parameters friction_tunable_parameters_at_first(void) {
  const friction_tunable_parameters first = {1.5, 2000.0, 12.0};
  return first;
}

static inline unsigned friction_tunable_set(friction_tunable *self, const friction_tunable_parameters *wanted) {
  const double values[3] = {wanted->yield, wanted->presliding, wanted->drag};
  return friction_tunable_set_values(self, values);
}

// The share of all forces in the network that the last output kept so that the motor can follow.
static inline double friction_tunable_kept_share(const friction_tunable *self) {
  (void)self;
  return 1;
}

// Energy in the springs, and set free by changes of parameters, after the last update() [J].
static inline double friction_tunable_stored_energy(const friction_tunable *self) {
  const double half = 0.5;  // a half [1]
  // V + tank: in the springs, and set free by changes of parameters
  const double stored = self->tank +
      self->presliding * self->spring_2_elongation * self->spring_2_elongation * half;
  return stored;
}

#endif
