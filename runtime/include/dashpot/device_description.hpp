// A device in numbers, as the device file states them (architecture, section 3), all in SI and in the joint's own
// coordinate: [rad], [N·m] where motion is rotation, [m], [N] where it is translation. Plain data, no heap, so that
// compiler, servo loop, simulation and firmware share one description.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot {

enum class quantiser : unsigned char { floor, round };

enum class brake_kind : unsigned char { none, eddy_current, shorted_motor };

enum class estimator_kind : unsigned char {
  backward_difference,      // window
  least_squares,            // window
  butterworth,              // order, cutoff
  inverse_time,             //
  foaw,                     // window (longest), best_fit
  kalman,                   // acceleration (standard deviation)
  super_twisting,           // acceleration (bound)
  tracking_differentiator,  // acceleration (bound), filter_factor
  sensor,                   // noise, bandwidth
  interval_difference,      //
};

// What any loop can be asked for. A device file that states more is refused.
inline constexpr unsigned most_delay_samples = 64;            // the bounds of a certificate take longer with each
inline constexpr unsigned most_missed_deadlines = 1'000'000;  // more counts as this many

struct loop_description {
  double sample_period = 0.001;           // [s]
  double jitter = 0;                      // longest lateness of a sample [s]
  unsigned delay_samples = 0;             // whole samples between read and effective write
  double write_earliest = 0;              // beyond these, from read to effective write, at least [s]
  double write_latest = 0;                // and at most [s]
  double band_low = 0.1;                  // band in which errors are judged [Hz]
  double band_high = 30;                  // [Hz]
  double reference_frequency = 0;         // where shares of dissipation are compared [Hz]; 0: the limit ω → 0
  unsigned missed_deadlines_allowed = 3;  // in a row, before the loop goes safe
};

struct encoder_description {
  double step = 0;  // [rad] or [m] a count; 0: ideal
  quantiser rounding = quantiser::floor;
  double range_low = 0;   // [rad] or [m]; low == high: unlimited
  double range_high = 0;  // [rad] or [m]
  double max_speed = 0;   // [rad/s] or [m/s]; 0: unlimited
};

struct velocity_description {
  estimator_kind estimator = estimator_kind::backward_difference;
  unsigned window = 1;       // samples
  unsigned order = 2;        // 2 or 4
  double cutoff = 0;         // [Hz]
  bool best_fit = false;     // FOAW: best fit instead of end fit
  double acceleration = 0;   // [rad/s²] or [m/s²]
  double filter_factor = 1;  // tracking differentiator: filter horizon in samples
  double noise = 0;          // sensor: rms [rad/s] or [m/s]
  double bandwidth = 0;      // sensor: first-order bandwidth [Hz]; 0: unlimited
};

struct motor_description {
  double torque_constant = 0;     // [N·m/A] or [N/A]; 0: not stated
  double max_torque = 0;          // [N·m] or [N]; 0: unlimited
  double amplifier_lag = 0;       // first order [s]
  double slew = 0;                // of the torque or force [N·m/s] or [N/s]; 0: unlimited
  double saturation_allowed = 0;  // longest uninterrupted saturation [s]; 0: unlimited
  double noise = 0;               // of the amplifier: rms, drawn anew each sample [N·m] or [N]
};

struct brake_description {
  brake_kind kind = brake_kind::none;
  double max_damping = 0;                  // [N·m·s/rad] or [N·s/m]
  double damping_per_current_squared = 0;  // κ in b = κ i² [N·m·s/(rad·A²)] or [N·s/(m·A²)]; 0: not stated
  double residual_damping = 0;             // left at zero current, same unit as max_damping
  double tolerance = 0;                    // ε: the true damping lies within (1 ± ε) of the commanded one
  double coil_lag = 0;                     // first order on the current [s]
  double slew = 0;                         // of the current [A/s]; 0: unlimited
  double critical_speed = 0;               // v_c in b/(1 + (v/v_c)²) [rad/s] or [m/s]; 0: unlimited
  double safe_damping = 0;                 // commanded after a fault, same unit as max_damping

  constexpr bool follows_at_once() const noexcept { return !(coil_lag > 0) && !(slew > 0); }
};

// The tool's side of a structure that gives: motor, brake, encoder, friction and damping are on the shaft, `mass` of
// the inertia, the hand and end-stops on the tool's side of a spring and damper. Frequency and damping ratio are those
// of the two sides swinging against each other with nothing else acting on them.
struct structural_mode {
  double frequency = 0;      // [Hz]; 0: rigid
  double damping_ratio = 0;  // [1]
  double mass = 0;           // on the tool's side, part of the inertia [kg·m²] or [kg]
};

struct mechanics_description {
  double inertia = 0;           // all of it [kg·m²] or [kg]
  double damping = 0;           // own viscous damping [N·m·s/rad] or [N·s/m]
  double coulomb_friction = 0;  // [N·m] or [N]
  structural_mode mode = {};
  double backlash = 0;  // width of the dead zone of the mode's spring [rad] or [m]
};

struct device_description {
  dashpot::motion motion = dashpot::motion::translation;
  double arm_radius = 0;  // between joint and tool [m]; 0: the network acts on the joint coordinate itself
  loop_description loop;
  encoder_description encoder;
  velocity_description velocity;
  motor_description motor;
  brake_description brake;
  mechanics_description mechanics;
};

}  // namespace dashpot
