#include "network/arm_description.hpp"

namespace dashpot::compiler {
namespace {

arm_kind arm_kind_of(axes::Kinematics kind) {
  switch (kind) {
    case axes::Kinematics::serial: return arm_kind::serial;
    case axes::Kinematics::parallelogram: return arm_kind::parallelogram;
    case axes::Kinematics::five_bar: return arm_kind::five_bar;
    case axes::Kinematics::cartesian: break;
  }
  return arm_kind::cartesian;
}

}  // namespace

arm_description arm_description_of(const AxesDevice& device) {
  arm_description arm;
  arm.geometry.kind = arm_kind_of(device.arm.kind);
  arm.geometry.proximal = device.arm.proximal;
  arm.geometry.distal = device.arm.distal;
  arm.geometry.base = device.arm.base;
  const JointMechanics& mechanics = device.mechanics;
  for (unsigned j = 0; j < arm_axes; ++j) {
    arm.geometry.workspace_low[j] = device.workspace[j].low;
    arm.geometry.workspace_high[j] = device.workspace[j].high;
    arm.joints[j] = device.joints[j];
    arm.joints[j].mechanics.damping = mechanics.damping[j];
    arm.joints[j].mechanics.coulomb_friction = mechanics.coulomb_friction[j];
    arm.link_masses[j] = mechanics.link_masses[j];
  }
  if (!(mechanics.link_masses[1] > 0)) {
    arm.inertia[0][0] = mechanics.inertia.xx, arm.inertia[1][1] = mechanics.inertia.yy;
    arm.inertia[0][1] = arm.inertia[1][0] = mechanics.inertia.xy;
  }
  arm.brake_count = static_cast<unsigned>(device.brakes.size());
  for (unsigned i = 0; i < arm.brake_count; ++i) {
    for (unsigned j = 0; j < arm_axes; ++j) arm.brakes[i].along[j] = device.brakes[i].along[j];
    arm.brakes[i].brake = device.brakes[i].brake;
  }
  return arm;
}

}  // namespace dashpot::compiler
