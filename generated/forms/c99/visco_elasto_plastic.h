// A needle that sticks and slides, Fig. 10
//
// source: Gosline & Hayward 2009, Fig. 10 and (21); the paper prints no values, these are chosen here
// scheme: exact at 1000 Hz, double: a motion that is straight between two samples is answered exactly, except in
//   samples in which a slip or a contact changes
// brake: makes b = 2.5 N·s/m of damping and, in the parts with slips, what the next lines give, and the motor the
//   rest of the force; by the rule 'faithful': without a device 'faithful' is the paper's rule: dampers at the
//   tool in parallel add
// slip rule of Y: steady, of the slip rules with an error of up to 5 %, the one with the largest mean damping of
//   the brake, 3.3 N s/m; its error is 2.04e-05 %; b = 0.8 N·s/m stuck, 0.8 sliding
// states: what the law remembers follows the measured position (position driven: on an ideal device position and
//   velocity do equally well)
// late velocity: with an exact brake the law is passive at any delay of the velocity estimate, sampling aside,
//   which 'passivity' covers
// passivity: certified for any motion, whichever slips slide or stick and whether the tool touches or not, any
//   brake that makes at least the commanded damping: needs 1.3 N·s/m by a proof sample by sample, for commands
//   that are held for up to 0.001 s; 3.3 N·s/m is guaranteed
//   without a device an ideal one is assumed, with the difference of two samples for the velocity, and no damping
//   is added for passivity
// energy: over any motion no part gives out more work than it has stored, and slips and contacts only dissipate
//   energy; rounding changes the force by at most 1.4e-15 of the sum of its terms' magnitudes
// device: none is named: exact brake, no delay, and as velocity the difference of the last two positions over the
//   period. Pass that velocity: a smoother estimate comes later, and the certificate does not cover it
// cost of output(): 5 additions, 3 multiplications, 0 guards against subnormal numbers
// cost of update(): 1 addition, 1 multiplication, 1 guard against subnormal numbers; 6 numbers kept between
//   samples
// rounding: the force of a mode is off by at most 5.6e-16 of its peak
// words: passive means that the hand never gets more energy than it has put in; certified, that this is proved. A
//   mode is a spring in series with a damper, whose force dies away
//
// Written by dashpot 0.1.0 from a network with digest
// 641bd9a185539eb5b87be22748db07e1bc3e1f20f78caf1bfff209cfd4314851. It belongs to whoever emitted
// it. C99, and C++; compile it with -ffp-contract=off where results are compared bit for bit.
#ifndef DASHPOT_GENERATED_visco_elasto_plastic_H
#define DASHPOT_GENERATED_visco_elasto_plastic_H

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

typedef struct visco_elasto_plastic {
  double last_position;  // u of the sample before [m]
  double K_spring_force;  // force of the spring [N]
  double sampled_position_change;  // Δu since the sample before, at this sample [m]
  double sampled_Y_trial;  // force of the slip if it held, at this sample [N]
  double sampled_Y_excess;  // what the slip does not hold, at this sample [N]
  double sampled_position;  // port displacement u, at this sample [m]
  int sampled;  // 1 while a finite sample waits for visco_elasto_plastic_update()
} visco_elasto_plastic;

// What a servo loop compares with the device that it drives. An empty digest: no device was named, any will do.
static inline double visco_elasto_plastic_sample_period(void) { return 0.001; }  // [s]
static inline int visco_elasto_plastic_is_rotation(void) { return 0; }
static inline const char *visco_elasto_plastic_device(void) { return "ideal"; }
static inline const char *visco_elasto_plastic_device_digest(void) { return ""; }
static inline const char *visco_elasto_plastic_estimator(void) { return "exact"; }
static inline unsigned visco_elasto_plastic_loop_delay(void) { return 0u; }  // [samples]
static inline int visco_elasto_plastic_is_certified(void) { return 1; }  // on that device, or on an ideal one

// The part of the brake's command that was added for passivity: it is felt in addition to the network.
static inline double visco_elasto_plastic_added_damping(void) { return 0.0; }

static inline int visco_elasto_plastic_parameter_count(void) { return 0; }
static inline const char * visco_elasto_plastic_parameter_name(int i) {
  (void)i;
  return "";
}
static inline const char * visco_elasto_plastic_parameter_unit(int i) {
  (void)i;
  return "";
}
static inline double visco_elasto_plastic_parameter_value(int i) {
  (void)i;
  return 0;
}
static inline double visco_elasto_plastic_parameter_min(int i) {
  (void)i;
  return 0;
}
static inline double visco_elasto_plastic_parameter_max(int i) {
  (void)i;
  return 0;
}

// Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
// NaN or infinite position counts as 0. Parameters stay as they are; in a structure that was all zero they become those
// of the network's file.
static inline void visco_elasto_plastic_reset(visco_elasto_plastic *self, double position) {
  self->last_position = (dashpot_all_finite(position, position, position) != 0) ? position : 0.0;
  self->K_spring_force = 0.0;
  self->sampled_position_change = 0.0;
  self->sampled_Y_trial = 0.0;
  self->sampled_Y_excess = 0.0;
  self->sampled_position = 0.0;
  self->sampled = 0;
}

// Starts at rest at 0, with the parameters' values of the network's file. Call it before all other functions.
static inline void visco_elasto_plastic_init(visco_elasto_plastic *self) {
  visco_elasto_plastic_reset(self, 0);
  self->sampled = 0;
}

// The command for this sample: port position [m] and an estimate of its velocity [m/s].
// After a non-finite input the states stay as they were and the motor's force is 0.
static inline dashpot_command visco_elasto_plastic_output(visco_elasto_plastic *self, double position, double velocity) {
  dashpot_command command;
  const double damping = 3.3;  // b, the brake's part
  const double Y_trial_by_change = 1000.0;  // factor of the change of position [N/m]
  const double Y_yield = 0.5;  // Y [N]
  const double Y_force_by_excess = 0.5555555555555556;  // factor of the excess [1]
  const double slips_compensation = 0.7999991999992;  // β, damping of the brake that the motor takes back [N·s/m]
  // Δu = u − u₋
  const double position_change = position - self->last_position;
  // trial = force of the slip if it held
  const double Y_trial = Y_trial_by_change * position_change + self->K_spring_force;
  // slip = clamp(trial, ±Y)
  const double Y_slip = dashpot_clamp_to(Y_yield, Y_trial);
  // excess = trial − slip
  const double Y_excess = Y_trial - Y_slip;
  // m = f − b u̇
  const double force = Y_trial - Y_force_by_excess * Y_excess - slips_compensation * velocity;
  self->sampled = dashpot_all_finite(position, velocity, force);
  if (self->sampled != 0) {
    self->sampled_position_change = position_change;
    self->sampled_Y_trial = Y_trial;
    self->sampled_Y_excess = Y_excess;
    self->sampled_position = position;
    command.damping = damping;
    command.force = force;
  } else {
    command.damping = damping;
    command.force = 0.0;
  }
  return command;
}

// Advances the states to the next sample. Call it once after each visco_elasto_plastic_output(), when the command has been sent.
static inline void visco_elasto_plastic_update(visco_elasto_plastic *self) {
  if (self->sampled != 0) {
    const double threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
    const double Y_K_spring_by_excess = 0.5555555555555556;  // factor of the excess [1]
    // F ← F + k δ
    self->K_spring_force = dashpot_flush_below(threshold,
        self->sampled_Y_trial - Y_K_spring_by_excess * self->sampled_Y_excess);
    // u₋ = u
    self->last_position = self->sampled_position;
    self->sampled = 0;
  }
}

// output() and then update() in one call.
static inline dashpot_command visco_elasto_plastic_step(visco_elasto_plastic *self, double position, double velocity) {
  const dashpot_command command = visco_elasto_plastic_output(self, position, velocity);
  visco_elasto_plastic_update(self);
  return command;
}

// While positions stay within ± 10 m and velocities within ± 100 m/s, a law that starts at rest at 0
// keeps to this box, and from it no operation overflows: 1 where its states are there.
static inline int visco_elasto_plastic_is_within(const visco_elasto_plastic *self) {
  return
      (self->last_position >= -10.00001) && (self->last_position <= 10.00001)
      && (self->K_spring_force >= -16000.521136406403) && (self->K_spring_force <= 16000.521136406403)
      && (self->sampled_position_change >= -20.00002) && (self->sampled_position_change <= 20.00002)
      && (self->sampled_Y_trial >= -36000.54755628937) && (self->sampled_Y_trial <= 36000.54755628937)
      && (self->sampled_Y_excess >= -36001.04755678937) && (self->sampled_Y_excess <= 36001.04755678937)
      && (self->sampled_position >= -10.00001) && (self->sampled_position <= 10.00001);
}

// The value of a parameter now, counted from 0.
static inline double visco_elasto_plastic_parameter(const visco_elasto_plastic *self, int i) {
  (void)self;
  (void)i;
  return 0;
}

// Sets all parameters, in their order. Call it right after the step of a sample, and take the command from the output
// of that sample without another update: in a loop that is not late the motor then holds the old force no longer, and a
// spring that changes injects no energy. Bit i of the result: parameter i was beyond its range and is now at its bound,
// or it was NaN and has not changed. An update that is still due is done first, with the old parameters.
static inline unsigned visco_elasto_plastic_set_values(visco_elasto_plastic *self, const double *wanted) {
  (void)self;
  (void)wanted;
  return 0u;
}

// The share of all forces in the network that the last output kept so that the motor can follow.
static inline double visco_elasto_plastic_kept_share(const visco_elasto_plastic *self) {
  (void)self;
  return 1;
}

// Energy in the springs after the last update() [J].
static inline double visco_elasto_plastic_stored_energy(const visco_elasto_plastic *self) {
  const double K_compliance = 0.0005;  // 1/(2 k) [m/N]
  // F²/(2k)
  const double K_spring_energy = K_compliance * self->K_spring_force * self->K_spring_force;
  // V = ½ k0 u² + Σ F_i²/(2 k_i)
  const double stored = K_spring_energy;
  return stored;
}

#endif
