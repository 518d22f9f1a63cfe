// What a simulated arm is put through: who holds it, and what goes wrong.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <dashpot/arm_description.hpp>
#include <dashpot/simulated/sample_fault.hpp>
#include <dashpot/simulated/scenario.hpp>

namespace dashpot::simulated {

struct tip_motion {
  double position[2] = {};  // [m]
  double velocity[2] = {};  // [m/s]
};

// Must neither throw nor allocate when called. `time` ≥ 0 [s].
using tip_path = std::function<tip_motion(double time)>;

struct joints_motion {
  double position[arm_axes] = {};  // [rad] or [m]
  double velocity[arm_axes] = {};  // [rad/s] or [m/s]
};
using joints_path = std::function<joints_motion(double time)>;  // as tip_path

// A mass at the tip, and stiffness and damping towards where the user means to be; both symmetric, in x and y, and
// positive semidefinite, so that the hand is passive.
struct planar_hand {
  double mass = 0;                                                // [kg]
  double stiffness[2][2] = {};                                    // [N/m]
  double damping[2][2] = {};                                      // [N·s/m]
  double release_time = std::numeric_limits<double>::infinity();  // lets go of the tip, mass and all [s]
};

planar_hand planar(double mass, double damping, double stiffness);  // alike in all directions [kg], [N·s/m], [N/m]
bool is_passive(const planar_hand& user);

struct arm_scenario {
  planar_hand user;
  tip_path intended;                      // of the user; empty: stays where the tip starts
  joints_path prescribed;                 // the joints follow it, whatever that takes; nothing else moves them
  double initial_position[2] = {};        // of the joints [rad] or [m]; a prescribed motion has its own
  double initial_velocity[2] = {};        // [rad/s] or [m/s]
  brake_gain gain = brake_gain::nominal;  // of all brakes; drawn: each for itself
  std::uint64_t seed = 0;                 // of jitter, drawn gains, sensor and amplifier noise
  unsigned substeps = 0;                  // integration steps a period; 0: chosen so that every rate is resolved
  std::vector<sample_fault> faults;       // `jump` strikes the first joint
};

}  // namespace dashpot::simulated
