// A device in numbers for loops in C: <dashpot/device_description.hpp> with the same names, and whether a law may drive
// it. C99 and C++; includes nothing. All in SI and in the joint's own coordinate: [rad], [N·m] where motion is
// rotation, [m], [N] where it is translation.
#ifndef DASHPOT_DEVICE_DESCRIPTION_H
#define DASHPOT_DEVICE_DESCRIPTION_H

enum { dashpot_motion_translation, dashpot_motion_rotation };
enum { dashpot_quantiser_floor, dashpot_quantiser_round };
enum { dashpot_brake_kind_none, dashpot_brake_kind_eddy_current, dashpot_brake_kind_shorted_motor };
enum {
  dashpot_estimator_kind_backward_difference,
  dashpot_estimator_kind_least_squares,
  dashpot_estimator_kind_butterworth,
  dashpot_estimator_kind_inverse_time,
  dashpot_estimator_kind_foaw,
  dashpot_estimator_kind_kalman,
  dashpot_estimator_kind_super_twisting,
  dashpot_estimator_kind_tracking_differentiator,
  dashpot_estimator_kind_sensor,
  dashpot_estimator_kind_interval_difference
};

typedef struct dashpot_loop_description {
  double sample_period;  // [s]
  double jitter;         // longest lateness of a sample [s]
  unsigned delay_samples;
  double write_earliest, write_latest;  // beyond these, from read to effective write, at least and at most [s]
  double band_low, band_high;           // band in which errors are judged [Hz]
  double reference_frequency;           // where shares of dissipation are compared [Hz]; 0: the limit ω → 0
  unsigned missed_deadlines_allowed;    // in a row, before the loop goes safe
} dashpot_loop_description;

typedef struct dashpot_encoder_description {
  double step;                   // [rad] or [m] a count; 0: ideal
  int rounding;                  // dashpot_quantiser_…
  double range_low, range_high;  // [rad] or [m]; low == high: unlimited
  double max_speed;              // [rad/s] or [m/s]; 0: unlimited
} dashpot_encoder_description;

typedef struct dashpot_velocity_description {
  int estimator;         // dashpot_estimator_kind_…
  unsigned window;       // samples
  unsigned order;        // 2 or 4
  double cutoff;         // [Hz]
  int best_fit;          // FOAW: best fit instead of end fit
  double acceleration;   // [rad/s²] or [m/s²]
  double filter_factor;  // tracking differentiator: filter horizon in samples
  double noise;          // sensor: rms [rad/s] or [m/s]
  double bandwidth;      // sensor: first-order bandwidth [Hz]; 0: unlimited
} dashpot_velocity_description;

typedef struct dashpot_motor_description {
  double torque_constant;     // [N·m/A] or [N/A]; 0: not stated
  double max_torque;          // [N·m] or [N]; 0: unlimited
  double amplifier_lag;       // first order [s]
  double slew;                // [N·m/s] or [N/s]; 0: unlimited
  double saturation_allowed;  // longest uninterrupted saturation [s]; 0: unlimited
  double noise;               // of the amplifier: rms [N·m] or [N]
} dashpot_motor_description;

typedef struct dashpot_brake_description {
  int kind;                            // dashpot_brake_kind_…
  double max_damping;                  // [N·m·s/rad] or [N·s/m]
  double damping_per_current_squared;  // κ in b = κ i² [N·m·s/(rad·A²)] or [N·s/(m·A²)]; 0: not stated
  double residual_damping;             // left at zero current, same unit as max_damping
  double tolerance;                    // ε: the true damping lies within (1 ± ε) of the commanded one
  double coil_lag;                     // first order on the current [s]
  double slew;                         // of the current [A/s]; 0: unlimited
  double critical_speed;               // v_c in b/(1 + (v/v_c)²) [rad/s] or [m/s]; 0: unlimited
  double safe_damping;                 // commanded after a fault, same unit as max_damping
} dashpot_brake_description;

typedef struct dashpot_structural_mode {
  double frequency;      // [Hz]; 0: rigid
  double damping_ratio;  // [1]
  double mass;           // on the tool's side, part of the inertia [kg·m²] or [kg]
} dashpot_structural_mode;

typedef struct dashpot_mechanics_description {
  double inertia;           // all of it [kg·m²] or [kg]
  double damping;           // own viscous damping [N·m·s/rad] or [N·s/m]
  double coulomb_friction;  // [N·m] or [N]
  dashpot_structural_mode mode;
  double backlash;  // width of the dead zone of the mode's spring [rad] or [m]
} dashpot_mechanics_description;

typedef struct dashpot_device {
  const char* name;       // that of the file
  const char* digest;     // of the file's bytes
  const char* estimator;  // the name of velocity.estimator
  int motion;             // dashpot_motion_…
  double arm_radius;      // between joint and tool [m]; 0: the network acts on the joint coordinate itself
  dashpot_loop_description loop;
  dashpot_encoder_description encoder;
  dashpot_velocity_description velocity;
  dashpot_motor_description motor;
  dashpot_brake_description brake;
  dashpot_mechanics_description mechanics;
} dashpot_device;

static inline int dashpot_same_text(const char* one, const char* other) {
  while ((*one != '\0') && (*one == *other)) {
    ++one;
    ++other;
  }
  return (*one == *other) ? 1 : 0;
}

// What stands against a law on this device, as the servo loop in C++ decides it; an empty text where nothing does. A
// law that was compiled without a device may drive any, and nothing is certified of that; one that is not certified may
// drive its own: <law>_is_certified() tells, and a loop that requires a certificate asks for it too. Periods are equal
// when they agree in single precision, which is all that a law in float can state.
static inline const char* dashpot_refusal_of(const dashpot_device* device, double sample_period, int is_rotation,
                                             const char* name, const char* digest, const char* estimator,
                                             unsigned loop_delay) {
  if (!(device->loop.sample_period > 0.0)) return "the device states no sample period";
  if ((float)sample_period < (float)device->loop.sample_period ||
      (float)sample_period > (float)device->loop.sample_period)
    return "the law is made for another rate";
  if (((is_rotation != 0) != (device->motion == dashpot_motion_rotation)) &&
      !((device->motion == dashpot_motion_rotation) && (device->arm_radius > 0.0)))
    return "the law is made for another motion, and no arm radius converts it";
  if (*digest == '\0') return "";
  if (dashpot_same_text(name, device->name) == 0) return "the law is certified for another device";
  if (dashpot_same_text(digest, device->digest) == 0) return "the law is certified for another file of this device";
  if (dashpot_same_text(estimator, device->estimator) == 0) return "the law is certified with another estimator";
  if (loop_delay != device->loop.delay_samples) return "the law is certified for another delay";
  return "";
}

// Of the law called `law` in <law.h>; `device` points to a dashpot_device.
#define DASHPOT_REFUSAL(law, device)                                                               \
  dashpot_refusal_of((device), (double)law##_sample_period(), law##_is_rotation(), law##_device(), \
                     law##_device_digest(), law##_estimator(), law##_loop_delay())

#endif
