// What a law with slips is felt to do in a run: sines at both ends of the band at three amplitudes around yield, and a
// drag with reversals (theory, section 5).
//
// Felt is m + b u̇: on a device what the motor and the brake make of the commands, through encoder, estimator, whole
// samples of delay, hold, amplifier, coil and either end of the brake's tolerance; without one m + b Δu/h at the
// samples. The network's own force is that of the law in which the motor computes everything: without a device at the
// same rate, else at four times the rate, so that the hold is seen.
#pragma once

#include <string>
#include <vector>

#include "decompose/port_device.hpp"
#include "law/update_law.hpp"

namespace dashpot::compiler {

// A displacement of the tool at the instants of the network's own law.
struct TrialMotion {
  std::string name;              // "a sine of 5 Hz and ±0.001 m"
  std::vector<double> position;  // [m] or [rad]
};

// What a device tells the law of a motion.
struct SensedMotion {
  struct Sample {
    double position, velocity;  // [m], [m/s] or [rad], [rad/s]
  };

  double rest = 0;              // the position before the motion begins
  std::vector<Sample> samples;  // one each time that the law is run
  std::vector<double> speed;    // of the tool up to each instant [m/s] or [rad/s]
};

// What is felt at those instants, with the brake at the lower and, one after the other, at the upper end of its
// tolerance.
struct FeltForce {
  std::vector<double> weak, strong;  // [N] or [N·m]
  double dissipated = 0;             // Σ b u̇² of what the brake is told [W]
  double square_velocity = 0;        // Σ u̇² [m²/s²]
};

class SlipTrial {
 public:
  // In: laws in which the motor makes the whole force, `coarse` at the rate of the law to be tried and without a static
  // curve, `fine` at instants_a_sample() times that and behind the curve; the device at the tool. All outlive this.
  SlipTrial(const Network& network, const UpdateLaw& coarse, const UpdateLaw& fine, const PortDevice& device);

  static int instants_a_sample(const PortDevice& device) { return device.is_ideal() ? 1 : 4; }

  const std::vector<TrialMotion>& motions() const { return motions_; }
  const std::vector<double>& network_force(std::size_t motion) const { return forces_[motion].values; }
  double largest_network_force(std::size_t motion) const { return forces_[motion].largest; }
  double rms_network_force(std::size_t motion) const { return forces_[motion].rms; }
  FeltForce felt(const UpdateLaw& law, std::size_t motion) const;

 private:
  struct NetworkForce {
    std::vector<double> values;  // [N] or [N·m]
    double largest, rms;
  };

  const PortDevice& device_;
  double at_;
  std::vector<TrialMotion> motions_;
  std::vector<SensedMotion> sensed_;  // one a motion, on a device
  std::vector<NetworkForce> forces_;  // one a motion
};

// Largest and root mean square of what is felt less the network's force, over those of that force: of the worse end of
// the tolerance, the worst motion.
struct TrialError {
  double peak = 0, rms = 0;       // [1]
  std::vector<double> by_motion;  // the larger of both [1]

  double worst() const { return peak > rms ? peak : rms; }
};
TrialError trial_error(const SlipTrial& trial, const std::vector<FeltForce>& felt);

// The worst error of the laws between two given ones, for a felt force that is affine in the share of the second.
class ErrorBetween {
 public:
  ErrorBetween(const SlipTrial& trial, const std::vector<FeltForce>& first, const std::vector<FeltForce>& second);

  double at(double share) const;  // [1]

 private:
  // A sample's error in the force, at a share of 0 and of 1.
  struct Ends {
    double at(double share) const { return (1 - share) * first + share * second; }

    double first = 0, second = 0;
  };
  // Of one motion, with the brake at one end of its tolerance.
  struct Run {
    std::vector<Ends> peaks;                                  // all that are the largest at some share
    double first_square = 0, product = 0, second_square = 0;  // means over the samples
    double network_peak = 0, network_rms = 0;
  };

  // Where the sizes of two errors are equal.
  struct Meeting {
    double share, size;
  };

  // In: errors of all samples at a share of 0 and of 1, at least one.
  static std::vector<Ends> peaks_of(const std::vector<double>& first, const std::vector<double>& second);
  static std::vector<Meeting> meetings_of(const std::vector<Ends>& largest);  // at shares equally far apart
  static void keep_largest(std::vector<Ends>& errors, int parts);

  std::vector<Run> runs_;
};

}  // namespace dashpot::compiler
