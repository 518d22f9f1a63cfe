// General viscoelastic solid, Fig. 2e
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
// it. C99, and C++; compile it with -ffp-contract=off where results are compared bit for bit.
#ifndef DASHPOT_GENERATED_second_order_maxwell_H
#define DASHPOT_GENERATED_second_order_maxwell_H

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

typedef struct second_order_maxwell {
  double last_position;  // u of the sample before [m]
  double relaxed_force;  // sum of the modes' forces, decayed to the next sample [N]
  double B2_K2_force;  // force of the mode, decayed to the next sample [N]
  double B1_K1_force;  // force of the mode, decayed to the next sample [N]
  double sampled_position_change;  // Δu since the sample before, at this sample [m]
  double sampled_position;  // port displacement u, at this sample [m]
  int sampled;  // 1 while a finite sample waits for second_order_maxwell_update()
} second_order_maxwell;

// What a servo loop compares with the device that it drives. An empty digest: no device was named, any will do.
static inline double second_order_maxwell_sample_period(void) { return 0.001; }  // [s]
static inline int second_order_maxwell_is_rotation(void) { return 0; }
static inline const char *second_order_maxwell_device(void) { return "ideal"; }
static inline const char *second_order_maxwell_device_digest(void) { return ""; }
static inline const char *second_order_maxwell_estimator(void) { return "exact"; }
static inline unsigned second_order_maxwell_loop_delay(void) { return 0u; }  // [samples]
static inline int second_order_maxwell_is_certified(void) { return 1; }  // on that device, or on an ideal one

// The part of the brake's command that was added for passivity: it is felt in addition to the network.
static inline double second_order_maxwell_added_damping(void) { return 0.0; }

static inline int second_order_maxwell_parameter_count(void) { return 0; }
static inline const char * second_order_maxwell_parameter_name(int i) {
  (void)i;
  return "";
}
static inline const char * second_order_maxwell_parameter_unit(int i) {
  (void)i;
  return "";
}
static inline double second_order_maxwell_parameter_value(int i) {
  (void)i;
  return 0;
}
static inline double second_order_maxwell_parameter_min(int i) {
  (void)i;
  return 0;
}
static inline double second_order_maxwell_parameter_max(int i) {
  (void)i;
  return 0;
}

// Starts at rest at `position` [m]: only the springs that hold a force at rest are loaded, from 0. A
// NaN or infinite position counts as 0. Parameters stay as they are; in a structure that was all zero they become those
// of the network's file.
static inline void second_order_maxwell_reset(second_order_maxwell *self, double position) {
  self->last_position = (dashpot_all_finite(position, position, position) != 0) ? position : 0.0;
  self->relaxed_force = 0.0;
  self->B2_K2_force = 0.0;
  self->B1_K1_force = 0.0;
  self->sampled_position_change = 0.0;
  self->sampled_position = 0.0;
  self->sampled = 0;
}

// Starts at rest at 0, with the parameters' values of the network's file. Call it before all other functions.
static inline void second_order_maxwell_init(second_order_maxwell *self) {
  second_order_maxwell_reset(self, 0);
  self->sampled = 0;
}

// The command for this sample: port position [m] and an estimate of its velocity [m/s].
// After a non-finite input the states stay as they were and the motor's force is 0.
static inline dashpot_command second_order_maxwell_output(second_order_maxwell *self, double position, double velocity) {
  dashpot_command command;
  const double damping = 11.0;  // b, the brake's part
  const double static_stiffness = 5.0;  // k0 [N/m]
  const double step_stiffness = 21.977282807459243;  // Σ c_i, stiffness of all modes within a sample [N/m]
  const double velocity_gain = -11.0;  // b∞ − b [N·s/m]
  // Δu = u − u₋
  const double position_change = position - self->last_position;
  // m = f − b u̇
  const double force = self->relaxed_force + static_stiffness * position + (step_stiffness * position_change +
      velocity_gain * velocity);
  self->sampled = dashpot_all_finite(position, velocity, force);
  if (self->sampled != 0) {
    self->sampled_position_change = position_change;
    self->sampled_position = position;
    command.damping = damping;
    command.force = force;
  } else {
    command.damping = damping;
    command.force = 0.0;
  }
  return command;
}

// Advances the states to the next sample. Call it once after each second_order_maxwell_output(), when the command has been sent.
static inline void second_order_maxwell_update(second_order_maxwell *self) {
  if (self->sampled != 0) {
    const double threshold = 6.223015277861142e-61;  // smaller forces become zero: no state is subnormal
    const double B2_K2_gain = 9.975032378492145;  // a c [N/m]
    const double B1_K1_gain = 11.956880536422767;  // a c [N/m]
    const double B2_K2_decay = 0.9983347214509387;  // a = e^{−λh} [1]
    const double B1_K1_decay = 0.9976028776973818;  // a = e^{−λh} [1]
    // F ← a (F + c Δu)
    self->B2_K2_force = B2_K2_gain * self->sampled_position_change +
        B2_K2_decay * dashpot_flush_below(threshold, self->B2_K2_force);
    self->B1_K1_force = B1_K1_gain * self->sampled_position_change +
        B1_K1_decay * dashpot_flush_below(threshold, self->B1_K1_force);
    // S = Σ a_i F_i
    self->relaxed_force = self->B2_K2_force + self->B1_K1_force;
    // u₋ = u
    self->last_position = self->sampled_position;
    self->sampled = 0;
  }
}

// output() and then update() in one call.
static inline dashpot_command second_order_maxwell_step(second_order_maxwell *self, double position, double velocity) {
  const dashpot_command command = second_order_maxwell_output(self, position, velocity);
  second_order_maxwell_update(self);
  return command;
}

// While positions stay within ± 10 m and velocities within ± 100 m/s, a law that starts at rest at 0
// keeps to this box, and from it no operation overflows: 1 where its states are there.
static inline int second_order_maxwell_is_within(const second_order_maxwell *self) {
  return
      (self->last_position >= -10.00001) && (self->last_position <= 10.00001)
      && (self->relaxed_force >= -219560.89280754214) && (self->relaxed_force <= 219560.89280754214)
      && (self->B2_K2_force >= -119800.4058755066) && (self->B2_K2_force <= 119800.4058755066)
      && (self->B1_K1_force >= -99760.48693203554) && (self->B1_K1_force <= 99760.48693203554)
      && (self->sampled_position_change >= -20.00002) && (self->sampled_position_change <= 20.00002)
      && (self->sampled_position >= -10.00001) && (self->sampled_position <= 10.00001);
}

// The value of a parameter now, counted from 0.
static inline double second_order_maxwell_parameter(const second_order_maxwell *self, int i) {
  (void)self;
  (void)i;
  return 0;
}

// Sets all parameters, in their order. Call it right after the step of a sample, and take the command from the output
// of that sample without another update: in a loop that is not late the motor then holds the old force no longer, and a
// spring that changes injects no energy. Bit i of the result: parameter i was beyond its range and is now at its bound,
// or it was NaN and has not changed. An update that is still due is done first, with the old parameters.
static inline unsigned second_order_maxwell_set_values(second_order_maxwell *self, const double *wanted) {
  (void)self;
  (void)wanted;
  return 0u;
}

// The share of all forces in the network that the last output kept so that the motor can follow.
static inline double second_order_maxwell_kept_share(const second_order_maxwell *self) {
  (void)self;
  return 1;
}

// Energy in the springs after the last update() [J].
static inline double second_order_maxwell_stored_energy(const second_order_maxwell *self) {
  const double half_static_stiffness = 2.5;  // ½ k0 [N/m]
  const double B2_K2_energy_weight = 0.050166944753343795;  // 1/(2 k a²) [m/N]
  const double B1_K1_energy_weight = 0.041867147435589155;  // 1/(2 k a²) [m/N]
  // F²/(2k)
  const double B2_K2_energy = B2_K2_energy_weight * self->B2_K2_force * self->B2_K2_force;
  const double B1_K1_energy = B1_K1_energy_weight * self->B1_K1_force * self->B1_K1_force;
  // V = ½ k0 u² + Σ F_i²/(2 k_i)
  const double stored = half_static_stiffness * self->last_position * self->last_position + (B2_K2_energy +
      B1_K1_energy);
  return stored;
}

#endif
