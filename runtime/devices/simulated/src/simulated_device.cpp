#include <dashpot/simulated/simulated_device.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <dashpot/simulated/draw.hpp>

namespace dashpot {

using simulated::sample_fault;
using simulated::scenario;

namespace {

const scenario& checked(const device_description& device, const scenario& scene) {
  if (const char* reason = simulated_device::refusal(device, scene)) throw std::invalid_argument(reason);
  return scene;
}

using any_plant = std::variant<simulated::plant, simulated::compliant_plant>;

any_plant plant_of(const device_description& device, const scenario& scene) {
  if (device.mechanics.mode.frequency > 0) return simulated::compliant_plant(device, scene);
  return simulated::plant(device, scene);
}

bool is_rigid(const std::optional<simulated::end_stop>& stop) { return stop && std::isinf(stop->stiffness); }

// Of a structure that gives.
const char* refusal_of_mode(const mechanics_description& mechanics, const scenario& scene) noexcept {
  if (!(mechanics.mode.frequency > 0))
    return mechanics.backlash > 0 ? "backlash needs a structural mode, whose spring it lets go" : nullptr;
  if (!(mechanics.mode.mass > 0 && mechanics.mode.mass < mechanics.inertia))
    return "the mode's mass is not a part of the inertia";
  if (scene.prescribed)
    return "a prescribed motion of the tool does not say how a structure that gives moves the shaft";
  if (is_rigid(scene.low) || is_rigid(scene.high))
    return "a rigid end-stop is not simulated at a tool whose structure gives: give it a stiffness";
  return nullptr;
}

}  // namespace

const char* simulated_device::refusal(const device_description& device, const scenario& scene) noexcept {
  if (!(device.loop.sample_period > 0)) return "the sample period is not positive";
  if (!(device.loop.jitter >= 0 && device.loop.jitter < device.loop.sample_period)) {
    return "the jitter is not shorter than the sample period: samples would overtake each other";
  }
  if (!(device.mechanics.inertia > 0)) {
    return "a simulation needs its inertia: \"inertia\" in \"mechanics\" of the device file";
  }
  if (!can_drive(device, tool_motion(device, scene)))
    return "the network does not move as the joint, and no arm radius relates them";
  if (scene.prescribed && !scene.intended) return "a prescribed motion is not given";
  if (scene.prescribed && (scene.low || scene.high)) return "a prescribed motion does not heed end-stops";
  if (scene.low && scene.initial_position < scene.low->position) return "the tool starts below the lower end-stop";
  if (scene.high && scene.initial_position > scene.high->position) return "the tool starts above the upper end-stop";
  if (!simulated::is_passive(scene.user)) return "the hand is not passive";
  if (const char* reason = refusal_of_mode(device.mechanics, scene)) return reason;
  return has_early_sample(scene.faults) ? "a late sample cannot come early" : nullptr;
}

simulated_device::simulated_device(const device_description& device, scenario scene)
    : description_(device),
      scene_(std::move(scene)),
      plant_(plant_of(device, checked(device, scene_))),
      sensors_(device, shaft()),
      line_(device.loop.delay_samples + 1) {}

device_status simulated_device::read(device_sample& sample) noexcept {
  if (started_) go_on();
  started_ = true;
  take_sample();
  const sample_fault* fault = fault_at(scene_.faults, clock_.index());
  return deliver(fault, newest_, delivered_, sample,
                 [&](device_sample& spoilt) { simulated::spoil(*fault, sensors_, spoilt.position, spoilt.counts); });
}

void simulated_device::go_on() noexcept {
  const simulated::sample_clock::step step = clock_.advance(description_.loop, scene_.seed, scene_.faults);
  const double wait = clock_.until_write(description_.loop, scene_.seed, step.duration), rest = step.duration - wait;
  std::visit(
      [&](auto& plant) {
        if (description_.motor.noise > 0)
          plant.disturb(description_.motor.noise *
                        draw_normal(scene_.seed, simulated::draw_stream::motor_noise, clock_.index()));
        if (wait > 0) plant.advance(wait, step.end - rest, before_, sensors_);
        if (rest > 0 || wait == 0) plant.advance(rest, step.end, line_.back().command, sensors_);
      },
      plant_);
  before_ = line_.back().command;
  for (std::size_t slot = line_.size() - 1; slot > 0; --slot) line_[slot] = line_[slot - 1];
}

void simulated_device::take_sample() noexcept {
  const simulated::shaft_motion shaft = this->shaft();
  newest_.position = sensors_.quantised(shaft.position);
  newest_.counts = sensors_.counts(shaft.position);
  newest_.velocity = sensors_.sensed_velocity();
  if (description_.velocity.estimator == estimator_kind::sensor && description_.velocity.noise > 0) {
    newest_.velocity +=
        description_.velocity.noise * draw_normal(scene_.seed, simulated::draw_stream::sensor_noise, clock_.index());
  }
  newest_.timestamp_ns = simulated::nanoseconds(shaft.time);
  newest_.edge_time_ns = simulated::nanoseconds(sensors_.newest_edge());
  newest_.sequence = static_cast<std::uint32_t>(clock_.index());
  newest_.report = report();
}

// As a board tells it: within what motor and brake can do.
device_report simulated_device::report() const noexcept {
  const numbered& newest = line_.back();
  if (newest.number == 0) return {};
  const double torque = description_.motor.max_torque, wanted = newest.command.motor_torque;
  const double damping = description_.brake.kind == brake_kind::none ? 0 : description_.brake.max_damping;
  return {true,
          written_ - newest.number,
          {torque > 0 ? std::clamp(wanted, -torque, torque) : wanted,
           std::clamp(newest.command.brake_damping, 0.0, damping)}};
}

device_status simulated_device::write(const actuation& demand) noexcept {
  const bool sane = all_finite(demand.motor_torque, demand.brake_damping, 0.0);
  line_.front() = {sane ? demand : actuation{0, description_.brake.safe_damping}, ++written_};
  return sane ? device_status::ok : device_status::fault;
}

}  // namespace dashpot
