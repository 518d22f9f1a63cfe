#include "arm_run.hpp"

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/simulated/simulated_arm.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "chosen.hpp"
#include "network/arm_description.hpp"
#include "network/axes_device.hpp"
#include "source/source_file.hpp"
#include "syntax/parse_axes.hpp"

namespace dashpot::paper {
namespace {

// The force at the tip that makes these torques, Jᵀf = τ.
void at_tip(const arm_pose& pose, const double (&torque)[2], double (&force)[2]) {
  const double(&j)[2][2] = pose.tip.jacobian;
  const double determinant = j[0][0] * j[1][1] - j[0][1] * j[1][0];
  force[0] = (j[1][1] * torque[0] - j[1][0] * torque[1]) / determinant;
  force[1] = (j[0][0] * torque[1] - j[0][1] * torque[0]) / determinant;
}

class ArmRun {
 public:
  ArmRun(const arm_description& arm, const simulated::arm_scenario& scene, ArmLaw& law)
      : arm_(arm),
        device_(arm, scene),
        estimators_{estimator_of(arm.joints[0]), estimator_of(arm.joints[1])},
        law_(law) {}

  ArmTrace over(double duration) {
    const long last = std::lround(duration / arm_.loop().sample_period);
    ArmTrace trace;
    for (long k = 0; k <= last; ++k) trace.push_back(step(k == 0));
    return trace;
  }

 private:
  static any_estimator<double> estimator_of(const device_description& joint) {
    return any_estimator<double>(joint.velocity, joint.loop.sample_period, joint.encoder.step);
  }

  ArmSample step(bool first) {
    arm_sample reading;
    device_.read(reading);
    double velocity[2];
    for (unsigned j = 0; j < arm_axes; ++j) {
      if (first) estimators_[j].reset(reading.position[j]);
      velocity[j] = estimators_[j].update(reading.of_joint(j));
    }
    if (first) law_.reset(reading.position);
    ArmSample sample;
    sample.commanded = law_.output(reading.position, velocity);
    const simulated::arm_view before = device_.truth();
    arm_actuation demand;
    for (unsigned i = 0; i < 2; ++i) {
      demand.motor_torque[i] = -sample.commanded.torque[i];
      demand.brake_damping[i] = sample.commanded.damping[i];
    }
    device_.write(demand);
    law_.update();
    tell(before, device_.truth_from_now_on(), sample);
    return sample;
  }

  void tell(const simulated::arm_view& before, const simulated::arm_view& after, ArmSample& sample) const {
    sample.time = before.time;
    double torque[2];
    for (unsigned i = 0; i < 2; ++i) {
      sample.tip[i] = before.tip_position[i], sample.tip_velocity[i] = before.tip_velocity[i];
      torque[i] = (felt(before, i) + felt(after, i)) / 2;
    }
    at_tip(pose_of(arm_.geometry, before.position, before.velocity), torque, sample.force);
    sample.taken = device_.ledger().brake - device_.ledger().motor;
  }

  double felt(const simulated::arm_view& view, unsigned joint) const {
    return simulated::opposed_by_actuators(arm_, view, joint);
  }

  arm_description arm_;
  simulated_arm device_;
  any_estimator<double> estimators_[arm_axes];
  ArmLaw& law_;
};

const ArmSample& sample_at(const ArmTrace& trace, double time) {
  return *std::min_element(trace.begin(), trace.end(), [&](const ArmSample& a, const ArmSample& b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  });
}

}  // namespace

ArmTrace run_law(const arm_description& arm, const simulated::arm_scenario& scene, double duration, ArmLaw& law) {
  return ArmRun(arm, scene, law).over(duration);
}

arm_description arm_of(const std::string& name) {
  compiler::Diagnostics diagnostics;
  const auto file = compiler::read_source(DASHPOT_PAPER_DEVICES "/" + name + ".json", diagnostics);
  const auto decl = file ? compiler::parse_axes_device(*file, diagnostics) : std::nullopt;
  const auto device = decl ? compiler::build_axes_device(*decl, diagnostics) : std::nullopt;
  if (!device) throw std::runtime_error("cannot read device " + name);
  return compiler::arm_description_of(*device);
}

arm_description ideal_plane(double sample_period) {
  arm_description arm = compiler::arm_description_of(compiler::ideal_axes_device(sample_period));
  for (device_description& joint : arm.joints) joint.velocity = true_velocity();
  for (unsigned i = 0; i < arm.brake_count; ++i) {
    arm.brakes[i].brake.kind = brake_kind::eddy_current;
    arm.brakes[i].brake.max_damping = 100;  // more than is asked for
  }
  arm.inertia[0][0] = arm.inertia[1][1] = 1;  // its motion is prescribed: of no effect
  return arm;
}

double mean_power(const ArmTrace& trace, double from, double to) {
  const ArmSample &first = sample_at(trace, from), &last = sample_at(trace, to);
  return (last.taken - first.taken) / (last.time - first.time);
}

double least_taken(const ArmTrace& trace) {
  double least = 0;
  for (const ArmSample& sample : trace) least = std::min(least, sample.taken);
  return least;
}

}  // namespace dashpot::paper
