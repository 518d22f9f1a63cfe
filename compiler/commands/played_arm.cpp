#include "commands/played_arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dashpot/actuator.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/led_device.hpp>
#include <dashpot/simulated/simulated_arm.hpp>
#include <nlohmann/json.hpp>

#include "commands/run_loop.hpp"
#include "law/evaluate.hpp"
#include "network/arm_description.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

using axes::Pair;

class ArmPath {
 public:
  explicit ArmPath(const JointMotion& motion)
      : joints_{RecordedPath(motion.clock, motion.position[0]), RecordedPath(motion.clock, motion.position[1])} {}

  const RecordedPath& joint(std::size_t j) const { return joints_[j]; }
  double end() const { return joints_[0].end(); }
  simulated::joints_motion point(double time) const {
    simulated::joints_motion at;
    for (std::size_t j = 0; j < arm_axes; ++j) {
      const simulated::motion_point one = joints_[j].point(time);
      at.position[j] = one.position, at.velocity[j] = one.velocity;
    }
    return at;
  }

 private:
  RecordedPath joints_[arm_axes];
};

// How far a port is pushed while the joints go straight: bent, and so cut into pieces of a duration at most.
class PortPath : public Path {
 public:
  PortPath(const ArmPath& joints, const JointMotion& motion, const axes::Arm& arm, const axes::PortMap& map,
           double longest_piece)
      : joints_(joints), rows_(motion.clock.time.size()), arm_(arm), map_(map) {
    pieces_ = std::max<std::size_t>(1, std::size_t(std::ceil(motion.clock.period.value_or(0) / longest_piece - 1e-6)));
  }

  double at(std::size_t piece) const override {
    const std::size_t row = piece / pieces_;
    const double begin = joints_.joint(0).at(row);
    if (row + 1 == rows_) return begin;
    return begin + (joints_.joint(0).at(row + 1) - begin) * double(piece % pieces_) / double(pieces_);
  }

  std::size_t piece(double time) const override {
    const std::size_t row = joints_.joint(0).piece(time);
    if (row + 1 == rows_ || time < 0) return row * pieces_;
    const double begin = joints_.joint(0).at(row), length = joints_.joint(0).at(row + 1) - begin;
    const double place = std::floor((time - begin) / length * double(pieces_) + 1e-6);
    return row * pieces_ + std::size_t(std::clamp(place, 0.0, double(pieces_ - 1)));
  }

  simulated::motion_point point(double time) const override {
    const simulated::joints_motion here = joints_.point(time);
    const auto pose = axes::pose(arm_, Pair<double>{here.position[0], here.position[1]});
    const auto depth = axes::depth(map_, pose.tip);
    const Pair<double> gradient = axes::at_joints(pose, depth.gradient);
    return {depth.value, gradient[0] * here.velocity[0] + gradient[1] * here.velocity[1]};
  }

 private:
  const ArmPath& joints_;
  std::size_t rows_, pieces_;
  const axes::Arm& arm_;
  const axes::PortMap& map_;
};

// Σ g_i F_i + Jᵀ A J q̇ along a motion: what all ports and the field oppose to it at the joints. No brake takes part,
// nor what is added for passivity.
class ArmForce {
 public:
  ArmForce(const AxesCompilation& c, const ArmPath& joints, const JointMotion& motion) : c_(c), joints_(joints) {
    for (std::size_t i = 0; i < c.ports.size(); ++i)
      paths_.push_back(std::make_unique<PortPath>(joints, motion, c.device.arm, c.network.ports[i].map,
                                                  ReferenceForce::finest_period(c.ports[i])));
  }

  // False, reported, where a port does not compile.
  bool prepare(Diagnostics& diagnostics) {
    for (std::size_t i = 0; i < c_.ports.size(); ++i) {
      auto reference = ReferenceForce::of(c_.ports[i], c_.choices_of_ports[i], diagnostics);
      if (!reference) return false;
      references_.push_back(std::move(*reference));
      // Ports have no tunables.
      forces_.push_back(references_.back().along(*paths_[i], ValueColumns(c_.ports[i], Motion(), diagnostics)));
    }
    return true;
  }

  void answer(PlayedSample& sample) {
    const simulated::joints_motion here = joints_.point(sample.time);
    const Pair<double> v{here.velocity[0], here.velocity[1]};
    const auto pose = axes::pose(c_.device.arm, Pair<double>{here.position[0], here.position[1]});
    const auto field = axes::at_joints(pose, c_.network.field);
    Pair<double> torque{field.p * v[0] + (field.r + field.sigma) * v[1],
                        (field.r - field.sigma) * v[0] + field.s * v[1]};
    for (std::size_t i = 0; i < forces_.size(); ++i) {
      const double force = forces_[i]->force_at(sample.time);
      const Pair<double> gradient = axes::at_joints(pose, axes::depth(c_.network.ports[i].map, pose.tip).gradient);
      for (std::size_t j = 0; j < arm_axes; ++j) torque[j] += gradient[j] * force;
    }
    for (std::size_t j = 0; j < arm_axes; ++j) {
      sample.velocity[j] = v[j];
      sample.closed_form[j] = torque[j];
      sample.tip[j] = pose.tip[j];
    }
    at_tip(pose, sample.closed_form, sample.closed_form_at_tip);
    at_tip(pose, sample.felt_force, sample.felt_at_tip);
  }

 private:
  // The force f at the tip with Jᵀ f = torque.
  static void at_tip(const axes::Pose<double>& pose, const double (&torque)[2], double (&force)[2]) {
    const auto& [first, second] = pose.column;
    const double determinant = first[0] * second[1] - first[1] * second[0];
    force[0] = (torque[0] * second[1] - torque[1] * first[1]) / determinant;
    force[1] = (torque[1] * first[0] - torque[0] * second[0]) / determinant;
  }

  const AxesCompilation& c_;
  const ArmPath& joints_;
  std::vector<std::unique_ptr<PortPath>> paths_;
  std::vector<ReferenceForce> references_;
  std::vector<std::unique_ptr<NetworkForce>> forces_;
};

unsigned lead_in(const arm_description& arm) {
  unsigned samples = 0;
  for (unsigned j = 0; j < arm_axes; ++j) samples = std::max(samples, lead_in_samples(joint_of(arm, j)));
  for (unsigned i = 0; i < arm.brake_count; ++i) samples = std::max(samples, lead_in_samples(brake_of(arm, i)));
  return samples;
}

simulated::arm_scenario scene_along(const ArmPath& path, double lead_in, std::uint64_t seed) {
  simulated::arm_scenario scene;
  scene.prescribed = [&path, lead_in](double time) { return path.point(time - lead_in); };
  scene.seed = seed;
  return scene;
}

template <class Scalar>
class ArmPlayer : public Player {
 public:
  ArmPlayer(const AxesCompilation& c, const ArmPath& path, std::uint64_t seed)
      : arm_(arm_description_of(c.device)),
        lead_in_(lead_in(arm_) * arm_.loop().sample_period),
        device_(arm_, scene_along(path, lead_in_, seed)),
        law_(c.law) {
    std::vector<Scalar> start;
    for (unsigned j = 0; j < arm_axes; ++j) {
      const double position = path.joint(j).point(0).position;
      start.push_back(static_cast<Scalar>(position));
      estimators_.push_back(estimator_of(arm_.joints[j]));
      estimators_.back().reset(position);
      motors_.emplace_back(joint_of(arm_, j), arm_.motion());
    }
    for (unsigned i = 0; i < arm_.brake_count; ++i) brakes_.emplace_back(brake_of(arm_, i), arm_.motion());
    law_.reset(start);
    stored_at_start_ = double(law_.stored_energy());
  }

  std::optional<PlayedSample> next() override {
    arm_sample sample{};
    device_.read(sample);
    const simulated::arm_view before = device_.truth();
    const double since = before.time - lead_in_;
    PlayedSample played;
    played.time = std::abs(since) < 1e-9 * lead_in_ ? 0 : since;
    std::vector<Scalar> position, velocity;
    for (unsigned j = 0; j < arm_axes; ++j) {
      position.push_back(static_cast<Scalar>(sample.position[j]));
      velocity.push_back(static_cast<Scalar>(estimators_[j].update(sample.of_joint(j))));
      played.position[j] = before.position[j];
      played.estimate[j] = double(velocity.back());
    }
    drive(law_.step(position, velocity), played);
    if (played.time < 0) return std::nullopt;
    const simulated::arm_view after = device_.truth_from_now_on();
    for (unsigned j = 0; j < arm_axes; ++j) played.felt_force[j] = (felt(before, j) + felt(after, j)) / 2;
    look_at(device_.ledger());
    return played;
  }

 private:
  void drive(const JointCommand<Scalar>& wanted, PlayedSample& played) {
    arm_actuation demand;
    for (unsigned j = 0; j < arm_axes; ++j) {
      played.motor_force[j] = double(wanted.torque[j]);
      const actuator_output<double> output = motors_[j].drive({0, played.motor_force[j]}, 0);
      demand.motor_torque[j] = output.motor_torque;
      played.is_limited = played.is_limited || output.motor_saturated();
    }
    for (unsigned i = 0; i < arm_.brake_count; ++i) {
      played.damping[i] = double(wanted.damping[i]);
      demand.brake_damping[i] = brakes_[i].drive({played.damping[i], 0}, 0).brake_damping;
    }
    device_.write(demand);
  }

  double felt(const simulated::arm_view& view, unsigned joint) const {
    return simulated::opposed_by_actuators(arm_, view, joint);
  }

  arm_description arm_;
  double lead_in_;  // [s]
  simulated_arm device_;
  std::vector<any_estimator<double>> estimators_;
  std::vector<actuator<double>> motors_, brakes_;
  Evaluation<Scalar> law_;
};

// False, reported, where the arm cannot follow.
bool is_in_reach(const AxesCompilation& c, const JointMotion& motion, Diagnostics& diagnostics) {
  axes::Box led;
  for (std::size_t row = 0; row < motion.rows.size(); ++row) {
    const Pair<double> q{motion.position[0][row], motion.position[1][row]};
    const Pair<double> tip = axes::pose(c.device.arm, q).tip;
    if (!std::isfinite(tip[0]) || !std::isfinite(tip[1])) {
      diagnostics.report<DiagnosticCode::cannot_start_device>(
          motion.rows[row], c.device.name,
          fmt::format("its links do not meet with the joints at {:.4g} and {:.4g} {}", q[0], q[1],
                      port_units(c.device.joint_motion()).position));
      return false;
    }
    for (std::size_t i = 0; i < 2; ++i)
      led[i] = row == 0 ? axes::Interval(tip[i]) : axes::hull(led[i], axes::Interval(tip[i]));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const axes::Interval& within = c.device.workspace[i];
    if (within.low < within.high && (led[i].low < within.low || led[i].high > within.high))
      diagnostics.report<DiagnosticCode::motion_beyond_encoder>(motion.clock.kind_span, 1e3 * led[i].low,
                                                                1e3 * led[i].high, 1e3 * within.low, 1e3 * within.high,
                                                                i == 0 ? "mm in x of the tip" : "mm in y of the tip");
  }
  return true;
}

}  // namespace

std::optional<PlayedMotion> play(const AxesCompilation& c, const JointMotion& motion, std::uint64_t seed,
                                 Diagnostics& diagnostics) {
  const arm_description arm = arm_description_of(c.device);
  const ArmPath path(motion);
  for (unsigned j = 0; j < arm_axes; ++j)
    if (!has_speeds(path.joint(j), diagnostics)) return std::nullopt;
  if (!is_in_reach(c, motion, diagnostics)) return std::nullopt;
  for (unsigned j = 0; j < arm_axes; ++j)
    warn_of_speed(path.joint(j), arm.joints[j].encoder.max_speed, fmt::format("joint {}", j + 1),
                  port_units(arm.motion()).velocity, motion.clock.kind_span, diagnostics);
  if (const char* refusal = simulated_arm::refusal(arm, scene_along(path, 0, seed))) {
    diagnostics.report<DiagnosticCode::cannot_start_device>({}, c.device.name, std::string(refusal));
    return std::nullopt;
  }
  ArmForce force(c, path, motion);
  if (!force.prepare(diagnostics)) return std::nullopt;
  const auto run = [&](auto player) {
    return played_by(
        player, [&force](PlayedSample& sample) { force.answer(sample); }, arm_axes, arm.brake_count, path.end(),
        arm.loop().sample_period, diagnostics);
  };
  if (c.law.scalar == ScalarType::float32) return run(ArmPlayer<float>(c, path, seed));
  return run(ArmPlayer<double>(c, path, seed));
}

std::string csv_of(const PlayedMotion& played, const AxesCompilation&) {
  std::string text = "time,q1,q2,estimate_1,estimate_2,felt_torque_1,felt_torque_2,closed_form_1,closed_form_2";
  for (unsigned i = 0; i < played.brakes; ++i) text += fmt::format(",damping_{}", i + 1);
  text += ",torque_1,torque_2,tip_x,tip_y,felt_x,felt_y,closed_form_x,closed_form_y\n";
  for (const PlayedSample& s : played.samples) {
    text += fmt::format("{}", s.time);
    const auto add = [&text](const auto& values, unsigned count) {
      for (unsigned k = 0; k < count; ++k) text += fmt::format(",{}", values[k]);
    };
    for (const auto* pair : {&s.position, &s.estimate, &s.felt_force, &s.closed_form}) add(*pair, arm_axes);
    add(s.damping, played.brakes);
    for (const auto* pair : {&s.motor_force, &s.tip, &s.felt_at_tip, &s.closed_form_at_tip}) add(*pair, arm_axes);
    text += "\n";
  }
  return text;
}

std::string to_text(const PlayedMotion& p, const AxesCompilation& c) {
  const PortUnits units = port_units(c.device.joint_motion());
  std::string text = fmt::format("{} on {}: {} samples at {:.6g} Hz, brakes by the rule {}\n", c.network.name,
                                 c.device.name, p.samples.size(), c.rate, name_of(c.rule));
  for (unsigned i = 0; i < p.brakes; ++i)
    text += fmt::format("brake {} is told ", i + 1) +
            text_of_brake(p.mean_damping[i], p.most_damping[i], c.certificate.added[i], units.damping) + "\n";
  for (unsigned j = 0; j < arm_axes; ++j)
    text += fmt::format("the network's force on joint {}: rms {:.4g} {}, peak {:.4g} {}\n", j + 1,
                        p.errors[j].rms_force, units.force, p.errors[j].peak_force, units.force);
  text += fmt::format("and at the tip: rms {:.4g} N, peak {:.4g} N\n", p.at_tip.rms_force, p.at_tip.peak_force);
  text += text_of_limits(p);
  for (unsigned j = 0; j < arm_axes; ++j)
    text += fmt::format("error of what joint {} feels: ", j + 1) + text_of_error(p.errors[j], units.force) + "\n";
  return text + "felt error at the tip: " + text_of_error(p.at_tip, "N") + "\n" + text_of_energy(p);
}

std::string to_json(const PlayedMotion& p, const AxesCompilation& c, const std::string& file) {
  using Json = nlohmann::ordered_json;
  Json brakes = Json::array(), joints = Json::array();
  for (unsigned i = 0; i < p.brakes; ++i)
    brakes.push_back(
        {{"mean", p.mean_damping[i]}, {"most", p.most_damping[i]}, {"for_passivity", c.certificate.added[i]}});
  for (const ForceError& error : p.errors)
    joints.push_back({{"force", json_of_force(error)}, {"error", json_of_error(error)}});
  const Json all = {{"name", c.network.name},
                    {"device", c.device.name},
                    {"rate", c.rate},
                    {"samples", p.samples.size()},
                    {"rule", name_of(c.rule)},
                    {"brakes", brakes},
                    {"limited_samples", p.limited},
                    {"joints", joints},
                    {"tip", {{"force", json_of_force(p.at_tip)}, {"error", json_of_error(p.at_tip)}}},
                    {"energy", json_of_energy(p)},
                    {"file", file}};
  return all.dump(2) + "\n";
}

}  // namespace dashpot::compiler
