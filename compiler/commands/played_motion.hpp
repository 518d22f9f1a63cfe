// A recorded motion on the described device: what a hand that makes it would feel, against the network itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands/motion_csv.hpp"
#include "emit/emission.hpp"

namespace dashpot::compiler {

// One sample of the device's loop, at the tool, in SI.
struct PlayedSample {
  double time;        // of the sample, jitter and all [s]
  double position;    // where the tool is [m] or [rad]
  double estimate;    // of its velocity, that the law is given [m/s] or [rad/s]
  double felt_force;  // by motor and brake, opposing +u: the mean of just before the sample and just after [N] or [N·m]
  double closed_form;  // what the network opposes to the motion itself
  double damping;      // the law's command [N·s/m] or [N·m·s/rad]
  double motor_force;  // the same [N] or [N·m]
  bool is_limited;     // the motor could not make it, or the law has let go of force so that it can
};

struct PlayedMotion {
  std::vector<PlayedSample> samples;
  double rms_error = 0, peak_error = 0;  // of the felt force [N] or [N·m]
  double rms_force = 0, peak_force = 0;  // of the closed form
  double energy = 0;                     // that motor and brake took from the tool since the motion began [J]
  double lowest_energy = 0;              // the least of it at any sample; below 0: they had given more than taken [J]
  double stored_at_start = 0;            // what the network holds at the first position, that it may give out first [J]
  double mean_damping = 0, most_damping = 0;  // that the brake was told [N·s/m] or [N·m·s/rad]
  std::size_t limited = 0;                    // samples whose force the motor could not make, or the law let go of
};

// In: a compiled network and its device, a motion of any uniform rate, straight between its rows. The tool is led along
// it, whatever force that takes, from rest at its first position, and the simulated device of runtime/ does what it
// does: encoder, estimator, delay, amplifier, coil, limits, jitter drawn with `seed`. A linear network's force is its
// closed form; another's that of its own steps on an ideal device 32 times as often. Refuses: a device that makes no
// simulation, columns that do not fit, what does not compile.
std::optional<PlayedMotion> play(const Compilation& compilation, const Choices& choices, const Motion& motion,
                                 std::uint64_t seed, Diagnostics& diagnostics);

std::string csv_of(const PlayedMotion& played);
std::string to_text(const PlayedMotion& played, const Compilation& compilation);
std::string to_json(const PlayedMotion& played, const Compilation& compilation, const std::string& file);

}  // namespace dashpot::compiler
