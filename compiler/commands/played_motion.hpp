// A recorded motion on the described device: what a hand that makes it would feel, against the network itself.
#pragma once

#include <cstdint>
#include <dashpot/simulated/energy_ledger.hpp>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands/motion_csv.hpp"
#include "commands/network_force.hpp"
#include "emit/emission.hpp"

namespace dashpot::compiler {

// One sample of the device's loop: of one axis at the tool, of two at the joints, in SI. What is not there is 0.
struct PlayedSample {
  double time = 0;             // of the sample, jitter and all [s]
  double position[2] = {};     // where the tool is, or each joint [m] or [rad]
  double estimate[2] = {};     // of the velocity, that the law is given [m/s] or [rad/s]
  double felt_force[2] = {};   // by motors and brakes, opposing the motion: the mean of just before the sample and just
                               // after [N] or [N·m]
  double closed_form[2] = {};  // what the network opposes to the motion itself
  double damping[4] = {};      // the law's command to each brake [N·s/m] or [N·m·s/rad]
  double motor_force[2] = {};  // the same to each motor [N] or [N·m]
  bool is_limited = false;     // a motor could not make it, or the law has let go of force so that it can
  double tip[2] = {};          // of two axes: where the tip is [m]
  double velocity[2] = {};     // of the motion itself [m/s] or [rad/s]
  double felt_at_tip[2] = {};  // felt_force, as a force there [N]
  double closed_form_at_tip[2] = {};  // [N]
};

struct ForceError {
  double rms_error = 0, peak_error = 0;  // of what is felt [N] or [N·m]
  double rms_force = 0, peak_force = 0;  // of the network's own force
};

struct PlayedMotion {
  unsigned axes = 1, brakes = 1;
  std::vector<PlayedSample> samples;
  ForceError errors[2];        // of the tool, or of each joint
  ForceError at_tip;           // of two axes
  double energy = 0;           // that motors and brakes took from the tool since the motion began [J]
  double lowest_energy = 0;    // the least of it at any sample; below 0: they had given more than taken [J]
  double stored_at_start = 0;  // what the network holds at the first position, that it may give out first [J]
  double mean_damping[4] = {}, most_damping[4] = {};  // that each brake was told [N·s/m] or [N·m·s/rad]
  std::size_t limited = 0;  // samples whose force a motor could not make, or the law let go of
};

// A law on its device, in the order of a servo loop: read, estimate, step, drive, write.
class Player {
 public:
  virtual ~Player() = default;

  // Nothing before the motion begins. What the network opposes is left to the caller.
  virtual std::optional<PlayedSample> next() = 0;
  double stored_at_start() const { return stored_at_start_; }  // by the network, held at its first position [J]
  double energy() const { return energy_; }                    // taken from the tool since the motion began [J]

 protected:
  // At every sample of the motion.
  void look_at(const simulated::energy_ledger& ledger);

  double stored_at_start_ = 0;

 private:
  std::optional<double> taken_before_;
  double energy_ = 0;
};

// False, reported, where the tool or a joint would go from one row to the next at a speed beyond all numbers.
bool has_speeds(const RecordedPath& path, Diagnostics& diagnostics);

// Warns where the motion of `what` is faster than the device's `limit`, 0 where there is none, both in `unit`: the loop
// would take that for a fault.
void warn_of_speed(const RecordedPath& path, double limit, const std::string& what, const std::string& unit, Span span,
                   Diagnostics& diagnostics);

// In: what tells the motion's velocity and the network's own force at a sample, and how long the motion is [s].
// Refuses: forces whose squares are beyond all numbers, for these are summed up.
std::optional<PlayedMotion> played_by(Player& player, const std::function<void(PlayedSample&)>& answer, unsigned axes,
                                      unsigned brakes, double end, double period, Diagnostics& diagnostics);

// In: a compiled network and its device, a motion of any uniform rate, straight between its rows. The tool is led along
// it, whatever force that takes, from rest at its first position, and the simulated device of runtime/ does what it
// does: encoder, estimator, delay, amplifier, coil, limits, jitter drawn with `seed`. What is felt is compared with
// network_force.hpp. Refuses: a device that makes no simulation, columns that do not fit, what does not compile.
std::optional<PlayedMotion> play(const Compilation& compilation, const Choices& choices, const Motion& motion,
                                 std::uint64_t seed, Diagnostics& diagnostics);

std::string csv_of(const PlayedMotion& played);
std::string to_text(const PlayedMotion& played, const Compilation& compilation);
std::string to_json(const PlayedMotion& played, const Compilation& compilation, const std::string& file);

// Parts of what is told, whatever the number of axes.
std::string text_of_error(const ForceError& error, const std::string& unit);
std::string text_of_brake(double mean, double most, double for_passivity, const std::string& unit);
std::string text_of_limits(const PlayedMotion& played);
std::string text_of_energy(const PlayedMotion& played);
nlohmann::ordered_json json_of_force(const ForceError& error);
nlohmann::ordered_json json_of_error(const ForceError& error);
nlohmann::ordered_json json_of_energy(const PlayedMotion& played);

}  // namespace dashpot::compiler
