// A device of two axes in SI: an arm, two joints with encoder, estimator and motor each, and brakes along constant
// directions of joint velocities.
#pragma once

#include <dashpot/device_description.hpp>

#include <optional>
#include <string>
#include <vector>

#include "axes/workspace.hpp"
#include "network/device.hpp"
#include "source/diagnostic.hpp"
#include "syntax/axes_decl.hpp"

namespace dashpot::compiler {

struct AlongBrake {
  axes::Pair<double> along;  // acts on along·q̇, as written [1]
  brake_description brake;   // in the joints' unit
};

struct JointMechanics {
  axes::Symmetric<double> inertia{0, 0, 0};  // at the joints [kg·m²] or [kg]; of `link_masses` where those are stated
  axes::Pair<double> link_masses{0, 0};      // of uniform links, proximal and distal [kg]; 0 where not stated
  axes::Pair<double> damping{0, 0};          // of each joint [N·m·s/rad] or [N·s/m]
  axes::Pair<double> coulomb_friction{0, 0};  // [N·m] or [N]
};

struct AxesDevice {
  std::string name;
  std::string source;
  std::vector<std::string> assumed;
  std::string digest;
  axes::Arm arm;
  axes::Box workspace;                     // of the tip [m]
  std::vector<device_description> joints;  // loop, encoder, estimator and motor of each; the loop is the same
  std::vector<AlongBrake> brakes;
  JointMechanics mechanics;

  motion joint_motion() const { return joints.front().motion; }
  const loop_description& loop() const { return joints.front().loop; }
};

namespace axes {

// "serial", "parallelogram", "five_bar", "cartesian".
std::string_view name_of(Kinematics kind);

}  // namespace axes

// In: what the author wrote. Out: the device in SI. Refuses: what build_device() refuses of a joint or a brake; an arm
// that does not reach its workspace, or is singular there; brakes that make no damping in some direction; two of them
// missing, or more than four.
std::optional<AxesDevice> build_axes_device(const AxesDeviceDecl& decl, Diagnostics& diagnostics);

// Two joints that are the axes of the tool, each with an ideal brake, motor and encoder: what there is where no device
// is named.
AxesDevice ideal_axes_device(double sample_period);

}  // namespace dashpot::compiler
