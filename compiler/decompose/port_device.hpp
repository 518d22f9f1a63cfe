// A device as the network's port sees it: dampings and velocities at the tool, estimator as a transfer function.
#pragma once

#include <complex>
#include <dashpot/estimators/any_estimator.hpp>
#include <optional>
#include <string_view>

#include "network/device.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

class PortDevice {
 public:
  static PortDevice ideal() { return PortDevice(); }

  // Behind a static curve the network acts through a lever. The device is taken as it is at the steepest place, where
  // it has least force, least damping and the coarsest steps. Refuses: a rotary device without an arm radius under a
  // translational network, and the reverse.
  static std::optional<PortDevice> of(const Device& device, const Network& network, Diagnostics& diagnostics);

  // Another device in the place of this one: of the same motion, and the same arm.
  PortDevice replaced_by(const Device& device) const;

  bool is_ideal() const { return !device_; }
  const device_description& description() const;             // for an ideal device: nothing late, nothing limited
  double damping_scale() const { return damping_scale_; }    // from the joint to the tool
  double position_scale() const { return position_scale_; }  // likewise
  double steepest() const { return steepest_; }              // largest w′ of a static curve; else 1
  // A damping at the tool as a law behind the static curve sees it, where that is steepest [N·s/m].
  double behind_curve(double damping) const { return damping / (steepest_ * steepest_); }
  std::optional<double> max_damping() const;  // at the tool [N·s/m]; empty: any
  double tolerance() const;                   // ε of the brake [1]
  double assured_share() const;               // (1 − ε)/(1 + (v_max/v_c)²) [1]
  double residual_damping() const;            // of the brake at zero current, at the tool [N·s/m]
  double band_low() const;                    // [rad/s]
  double band_high() const;                   // [rad/s]
  double reference_frequency() const;         // [rad/s]; 0: the limit ω → 0

  // G(jω) = V̂/U̇ of the estimator; a pure delay where the estimator is not linear. 1 for an ideal device.
  std::complex<double> velocity_response(double angular_frequency) const;
  // A(jω) between the motor's command and its force: whole samples of loop delay and the amplifier's lag; not the hold.
  std::complex<double> motor_response(double angular_frequency) const;
  double encoder_step() const;  // at the tool [m] or [rad]; 0 for an ideal device
  bool estimator_is_linear() const;
  bool divides_by_varying_interval() const;    // whether the estimate divides by a time between samples that varies
  bool estimate_sums_to_displacement() const;  // so that velocity-driven slow modes do not drift
  // How many samples an estimate reaches back from the hold in which it acts; empty if it never forgets, is not linear
  // or divides by intervals that vary.
  std::optional<unsigned> estimate_memory() const;
  double largest_estimator_gain() const;  // max |G|; infinite where it is not linear
  double sample_period() const;           // [s]
  double longest_hold() const;            // h and the longest lateness of a sample, T_max [s]
  double amplifier_lag() const;           // [s]
  bool acts_late() const;                 // whether commands act later than at the instants of their samples
  double coil_lag() const;                // [s]
  double coil_slew() const;               // of √b [√(N·s/m)/s]; 0: unlimited
  std::string_view estimator_name() const;
  std::optional<double> velocity_noise() const;  // rms of the estimate under quantisation [m/s]; empty: not linear

  // Seen from the end of a lever that moves `ratio` times as far.
  PortDevice behind_lever(double ratio) const;
  // The device at the tool itself, in front of a static curve.
  PortDevice at_tool() const;

 private:
  using Estimator = any_estimator<double>;
  Estimator estimator() const;
  void take(const Device& device);

  std::optional<Device> device_;
  double damping_scale_ = 1;  // from the joint to the tool
  double position_scale_ = 1;
  double steepest_ = 1;
  double noise_power_gain_ = 0;  // of a linear estimator of the position
};

}  // namespace dashpot::compiler
