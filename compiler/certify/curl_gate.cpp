#include "certify/curl_gate.hpp"

#include <algorithm>
#include <cmath>

#include "axes/best_first.hpp"
#include "axes/weighed.hpp"
#include "axes/workspace_bound.hpp"
#include "certify/estimator_factors.hpp"

namespace dashpot::compiler {
namespace {

using axes::Pair;
using axes::Symmetric;

constexpr int gate_places_a_side = 40;     // parts of the workspace along each side, for choosing ω and for reports
constexpr double for_rounding = 1e-6;      // share of the allowances kept back for rounding, enough for float32 too
constexpr double share_in_reserve = 0.02;  // share of the least allowance

// [[p, r + σ], [r − σ, s]] in the coordinates of the two brakes.
template <typename S>
axes::JointField<S> along_brakes(const AxesDevice& device, const Pair<S>& joints, const axes::ViscousField& viscous) {
  const axes::JointField<S> there = axes::at_joints(axes::pose(device.arm, joints), viscous);
  const Pair<Pair<double>> dual = axes::dual(device.brakes[0].along, device.brakes[1].along);
  const auto [p, r, s] = axes::along_brakes(dual, Symmetric<S>{there.p, there.r, there.s});
  return {p, r, s, S(axes::dot(axes::turned(dual[0]), dual[1])) * there.sigma};
}

// What the brakes make of it by the rule `diagonal`.
template <typename S>
Pair<S> made_of(const axes::JointField<S>& field, const AxesDevice& device, const std::vector<double>& added) {
  using std::max;
  return {within_brake(max(field.p, S(0)), device.brakes[0].brake, added[0]),
          within_brake(max(field.s, S(0)), device.brakes[1].brake, added[1])};
}

// The box to look at: the workspace. Without one the tip itself is measured; the field then takes all its values over
// its knots.
axes::Box room_of(const AxesDevice& device, const axes::ViscousField& viscous) {
  if (device.workspace[0].width() > 0 || viscous.is_uniform()) return device.workspace;
  axes::Box room;
  for (std::size_t i = 0; i < 2; ++i)
    room[i] = {viscous.start[i], viscous.start[i] + double(viscous.knots[i] - 1) * viscous.spacing[i]};
  return room;
}

std::vector<axes::Place> gate_places(const AxesDevice& device, const axes::ViscousField& viscous) {
  const axes::Box room = room_of(device, viscous);
  if (room[0].width() == 0) return {{{0, 0}, 1}};
  return axes::places_in(device.arm, room, gate_places_a_side);
}

// A lower bound of the least allowance over the workspace, at least nine tenths of it.
double least_allowance(const Pair<double>& factor, const AxesDevice& device, const std::vector<double>& added,
                       const axes::ViscousField& viscous) {
  double attained = axes::infinity;
  const auto least_over = [&](const axes::Box& tip) {
    const std::optional<Pair<axes::Sloped>> joints = axes::enclosed_joints(device.arm, axes::variables(tip));
    if (!joints) return 0.0;
    const Pair<axes::Sloped> made = made_of(along_brakes(device, *joints, viscous), device, added);
    return std::min(factor[0] * made[0].value.low, factor[1] * made[1].value.low);
  };
  const auto measured = [&](const axes::Box& tip) {
    attained = std::min(attained, least_over(axes::constant<axes::Interval>(axes::middle_of(tip))));
    return -least_over(tip);
  };
  const double bound = axes::best_first(room_of(device, viscous), axes::most_boxes, measured,
                                        [&](double worst) { return attained + worst <= 0.1 * attained; });
  return std::max(-bound, 0.0);
}

bool have_one_estimator(const AxesDevice& device) {
  const velocity_description &one = device.joints[0].velocity, &other = device.joints[1].velocity;
  return one.estimator == other.estimator && one.window == other.window && one.order == other.order &&
         one.cutoff == other.cutoff && one.acceleration == other.acceleration &&
         device.joints[0].encoder.step == device.joints[1].encoder.step;
}

}  // namespace

bool are_along_joints(const AxesDevice& device) {
  return std::all_of(device.brakes.begin(), device.brakes.end(),
                     [](const AlongBrake& brake) { return brake.along[0] == 0 || brake.along[1] == 0; });
}

double share_at_speed(const AlongBrake& brake, const AxesDevice& device) {
  double fastest = 0;
  for (std::size_t i = 0; i < 2; ++i) fastest += std::abs(brake.along[i]) * device.joints[i].encoder.max_speed;
  const double turn = brake.brake.critical_speed > 0 ? fastest / brake.brake.critical_speed : 0;
  return 1 / (1 + turn * turn);
}

double assured_share(const AlongBrake& brake, const AxesDevice& device) {
  return (1 - brake.brake.tolerance) * share_at_speed(brake, device);
}

SampledLoop loop_of_joint(const device_description& joint) {
  SampledLoop loop;
  loop.has_device = true;
  loop.sample_period = joint.loop.sample_period;
  loop.delay_samples = joint.loop.delay_samples;
  loop.jitter = joint.loop.jitter;
  loop.write_earliest = joint.loop.write_earliest;
  loop.write_latest = joint.loop.write_latest;
  loop.amplifier_lag = joint.motor.amplifier_lag;
  loop.velocity = joint.velocity;
  loop.joint_encoder_step = joint.encoder.step;
  return loop;
}

std::string why_no_gate(const AxesDevice& device, axes::BrakeRule rule) {
  if (rule != axes::BrakeRule::diagonal) return "by this rule the brakes do not make the diagonal of the field";
  if (device.brakes.size() != 2) return "there are more than two brakes";
  for (const AlongBrake& brake : device.brakes)
    if (!brake.brake.follows_at_once()) return "the brakes follow their commands late";
  for (const device_description& joint : device.joints) {
    if (joint.motor.amplifier_lag > 0) return "the motors follow their commands late";
    if (!estimate_memory(loop_of_joint(joint)))
      return "it is not known for how long the velocity estimator remembers a motion";
  }
  if (!are_along_joints(device) && !have_one_estimator(device)) return "the joints' velocity estimators differ";
  return "";
}

std::optional<axes::CurlGate> curl_gate(const AxesDevice& device, const std::vector<double>& added,
                                        const axes::ViscousField& viscous) {
  axes::CurlGate gate;
  double age = 0;
  for (const device_description& joint : device.joints) {
    const EstimateMemory memory = *estimate_memory(loop_of_joint(joint));
    gate.gain = std::max(gate.gain, memory.gain);
    // If commands act late, the movement between two samples may also happen under the command before.
    const double delay = double(device.loop().delay_samples) + (device.loop().write_latest > 0 ? 1 : 0);
    age = std::max(age, memory.age + memory.gain * delay);
  }
  std::vector<Pair<double>> dampings;
  for (const axes::Place& place : gate_places(device, viscous))
    dampings.push_back(made_of(along_brakes(device, place.joints, viscous), device, added));
  const double omega = axes::gate_ratio(dampings);
  const double holds = device.loop().sample_period / loop_of_joint(device.joints[0]).longest_hold();
  const double each = 2 * holds * (1 - for_rounding);
  gate.factor = {each / omega * assured_share(device.brakes[0], device),
                 each * omega * assured_share(device.brakes[1], device)};
  const double least = least_allowance(gate.factor, device, added, viscous);
  if (!(least > 0)) return std::nullopt;
  gate.recovery = share_in_reserve * least / std::max(age, share_in_reserve);
  gate.reserve = gate.recovery * age * (1 + for_rounding);
  return gate;
}

GatePassage gate_passage(const axes::CurlGate& gate, const AxesDevice& device, const std::vector<double>& added,
                         const axes::ViscousField& viscous) {
  GatePassage passage{0, 1, {0, 0}};
  double area = 0;
  for (const axes::Place& place : gate_places(device, viscous)) {
    const axes::JointField<double> field = along_brakes(device, place.joints, viscous);
    const Pair<double> made = made_of(field, device, added);
    const double allowed = std::min(gate.factor[0] * made[0], gate.factor[1] * made[1]) - gate.reserve;
    const double wanted = std::max(std::abs(field.r), std::abs(field.sigma));
    const double share = std::min(1.0, std::max(allowed, 0.0) / (2 * gate.gain * wanted));
    if (share < passage.least) passage.least = share, passage.least_at = axes::pose(device.arm, place.joints).tip;
    passage.mean += place.area * share, area += place.area;
  }
  passage.mean /= area;
  return passage;
}

}  // namespace dashpot::compiler
