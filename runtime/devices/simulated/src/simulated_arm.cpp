#include <dashpot/simulated/simulated_arm.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <dashpot/simulated/draw.hpp>

namespace dashpot {

using simulated::arm_scenario;
using simulated::planar_hand;
using simulated::sample_fault;

namespace simulated {
namespace {

bool is_semidefinite(const double (&m)[2][2]) noexcept {
  const double rounding = 1e-12 * (std::abs(m[0][0]) + std::abs(m[1][1]));
  return std::abs(m[0][1] - m[1][0]) <= rounding && m[0][0] >= 0 && m[1][1] >= 0 &&
         m[0][0] * m[1][1] - m[0][1] * m[1][0] >= -rounding * rounding;
}

}  // namespace

planar_hand planar(double mass, double damping, double stiffness) {
  planar_hand user;
  user.mass = mass;
  for (unsigned i = 0; i < 2; ++i) user.damping[i][i] = damping, user.stiffness[i][i] = stiffness;
  return user;
}

bool is_passive(const planar_hand& user) {
  return user.mass >= 0 && is_semidefinite(user.stiffness) && is_semidefinite(user.damping);
}

}  // namespace simulated

namespace {

const arm_scenario& checked(const arm_description& arm, const arm_scenario& scene) {
  if (const char* reason = simulated_arm::refusal(arm, scene)) throw std::invalid_argument(reason);
  return scene;
}

bool has_inertia(const arm_description& arm) noexcept {
  if (arm.geometry.kind != arm_kind::cartesian && arm.link_masses[1] > 0) return true;
  const double(&m)[2][2] = arm.inertia;
  return m[0][0] > 0 && m[0][0] * m[1][1] > m[0][1] * m[1][0];
}

}  // namespace

const char* simulated_arm::refusal(const arm_description& arm, const arm_scenario& scene) noexcept {
  const loop_description& loop = arm.loop();
  if (!(loop.sample_period > 0)) return "the sample period is not positive";
  if (!(loop.jitter >= 0 && loop.jitter < loop.sample_period))
    return "the jitter is not shorter than the sample period: samples would overtake each other";
  if (!has_inertia(arm))
    return arm.geometry.kind == arm_kind::cartesian
               ? "a simulation needs its inertia: \"inertia\" in \"mechanics\" of the device file"
               : "a simulation needs its inertia: \"inertia\" or \"link_masses\" in \"mechanics\" of the device file";
  if (!is_passive(scene.user)) return "the hand is not passive";
  simulated::joints_motion start;
  std::copy_n(scene.initial_position, arm_axes, start.position);
  if (scene.prescribed) start = scene.prescribed(0);
  const arm_point tip = pose_of(arm.geometry, start.position, start.velocity).tip;
  if (!all_finite(tip.position[0], tip.position[1])) return "the arm does not reach where it starts";
  return has_early_sample(scene.faults) ? "a late sample cannot come early" : nullptr;
}

simulated_arm::simulated_arm(const arm_description& arm, arm_scenario scene)
    : description_(arm),
      scene_(std::move(scene)),
      plant_(arm, checked(arm, scene_)),
      sensors_{{joint_of(arm, 0), plant_.shaft(0)}, {joint_of(arm, 1), plant_.shaft(1)}},
      line_(arm.loop().delay_samples + 1) {}

device_status simulated_arm::read(arm_sample& sample) noexcept {
  if (started_) go_on();
  started_ = true;
  take_sample();
  const sample_fault* fault = fault_at(scene_.faults, clock_.index());
  return deliver(fault, newest_, delivered_, sample, [&](arm_sample& spoilt) {
    simulated::spoil(*fault, sensors_[0], spoilt.position[0], spoilt.counts[0]);
  });
}

void simulated_arm::go_on() noexcept {
  const simulated::sample_clock::step step = clock_.advance(description_.loop(), scene_.seed, scene_.faults);
  for (unsigned j = 0; j < arm_axes; ++j) {
    const double noise = description_.joints[j].motor.noise;
    if (noise > 0)
      plant_.disturb(
          j, noise * draw_normal(scene_.seed, simulated::draw_stream::motor_noise, arm_axes * clock_.index() + j));
  }
  const double wait = clock_.until_write(description_.loop(), scene_.seed, step.duration), rest = step.duration - wait;
  if (wait > 0) plant_.advance(wait, step.end - rest, before_, sensors_);
  if (rest > 0 || wait == 0) plant_.advance(rest, step.end, line_.back().command, sensors_);
  before_ = line_.back().command;
  for (std::size_t slot = line_.size() - 1; slot > 0; --slot) line_[slot] = line_[slot - 1];
}

void simulated_arm::take_sample() noexcept {
  for (unsigned j = 0; j < arm_axes; ++j) {
    const simulated::shaft_motion shaft = plant_.shaft(j);
    const velocity_description& sensor = description_.joints[j].velocity;
    newest_.position[j] = sensors_[j].quantised(shaft.position);
    newest_.counts[j] = sensors_[j].counts(shaft.position);
    newest_.velocity[j] = sensors_[j].sensed_velocity();
    if (sensor.estimator == estimator_kind::sensor && sensor.noise > 0)
      newest_.velocity[j] +=
          sensor.noise * draw_normal(scene_.seed, simulated::draw_stream::sensor_noise, arm_axes * clock_.index() + j);
    newest_.timestamp_ns = simulated::nanoseconds(shaft.time);
    newest_.edge_time_ns[j] = simulated::nanoseconds(sensors_[j].newest_edge());
  }
  newest_.sequence = static_cast<std::uint32_t>(clock_.index());
  newest_.report = report();
}

// As a board tells it: within what motors and brakes can do.
arm_report simulated_arm::report() const noexcept {
  const numbered& newest = line_.back();
  if (newest.number == 0) return {};
  arm_report told{true, written_ - newest.number, newest.command};
  for (unsigned j = 0; j < arm_axes; ++j) {
    const double most = description_.joints[j].motor.max_torque;
    if (most > 0) told.applied.motor_torque[j] = std::clamp(newest.command.motor_torque[j], -most, most);
  }
  for (unsigned i = 0; i < most_arm_brakes; ++i) {
    const brake_description brake = brake_of(description_, i).brake;
    const double most = brake.kind == brake_kind::none ? 0 : brake.max_damping;
    told.applied.brake_damping[i] = std::clamp(newest.command.brake_damping[i], 0.0, most);
  }
  return told;
}

device_status simulated_arm::write(const arm_actuation& demand) noexcept {
  bool sane = true;
  for (const double torque : demand.motor_torque) sane = sane && all_finite(torque);
  for (const double damping : demand.brake_damping) sane = sane && all_finite(damping);
  arm_actuation taken = demand;
  if (!sane) taken = safe_actuation(description_);
  line_.front() = {taken, ++written_};
  return sane ? device_status::ok : device_status::fault;
}

}  // namespace dashpot
