#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>
#include <dashpot/simulated/simulated_arm.hpp>

#include "kelvin_field.hpp"
#include "log_text.hpp"
#include "soft_ball.hpp"

namespace dashpot::tests::arms {
namespace {

using estimators = any_estimator<double>[arm_axes];
using law = generated::kelvin_field;

// pantograph_2dof.json without its lags and friction, where positions tell all of the energy.
arm_description pantograph() {
  arm_description arm;
  arm.geometry = {arm_kind::five_bar, 0.063, 0.075, 0.025, {-0.04, 0.07}, {0.04, 0.12}};
  for (device_description& joint : arm.joints) {
    joint.motion = motion::rotation;
    joint.loop.sample_period = 1e-4;
    joint.encoder.max_speed = 30;
    joint.velocity.estimator = estimator_kind::butterworth;
    joint.velocity.order = 2;
    joint.velocity.cutoff = 200;
    joint.motor.max_torque = 0.1;
    joint.motor.saturation_allowed = 0.2;
    joint.mechanics.damping = 5e-5;
  }
  arm.brake_count = 2;
  for (unsigned i = 0; i < 2; ++i) {
    arm.brakes[i].along[i] = 1;
    arm.brakes[i].brake.kind = brake_kind::eddy_current;
    arm.brakes[i].brake.max_damping = 0.014;
    arm.brakes[i].brake.safe_damping = 0.002;
  }
  arm.link_masses[0] = 0.02, arm.link_masses[1] = 0.015;
  return arm;
}

// From where the tip is at (1, 97) mm, about it, in an ellipse.
simulated::arm_scenario ellipse(double size = 0.01) {
  simulated::arm_scenario scene;
  scene.initial_position[0] = 2.2, scene.initial_position[1] = 0.95;
  const arm_point tip = pose_of(pantograph().geometry, scene.initial_position, scene.initial_velocity).tip;
  const double x = tip.position[0], y = tip.position[1];
  scene.user = simulated::planar(0.2, 3, 200);
  scene.intended = [x, y, size](double t) -> simulated::tip_motion {
    return {{x + size * std::sin(6 * t), y + 0.5 * size * std::sin(4 * t)},
            {6 * size * std::cos(6 * t), 2 * size * std::cos(4 * t)}};
  };
  return scene;
}

template <class Model>
struct run_of {
  arm_servo_summary summary;
  std::string log, table;
  std::vector<arm_telemetry_record> records;
  simulated::energy_ledger ledger;
};

using change = std::function<void(arm_servo_options&)>;

template <class Model, class Device>
run_of<Model> run_on(Device& device, Model& model, const arm_description& arm, double duration, const change& also) {
  const auto estimator_of = [&arm](unsigned j) {
    return any_estimator<double>(arm.joints[j].velocity, arm.loop().sample_period, arm.joints[j].encoder.step);
  };
  estimators both{estimator_of(0), estimator_of(1)};
  log_text log, table;
  run_of<Model> result;
  arm_servo_options options;
  options.identity = {generated::kelvin_field::certified_for::device,
                      generated::kelvin_field::certified_for::device_digest};
  options.duration = duration;
  options.telemetry_capacity = 256;
  options.outputs = {table.file(), log.file(),
                     [&result](const arm_telemetry_record& record) { result.records.push_back(record); }};
  also(options);
  result.summary = servo_loop(model, device, both, options, simulated_clock{}).run();
  result.log = log.text();
  result.table = table.text();
  return result;
}

template <class Model>
run_of<Model> run(
    Model& model, const arm_description& arm, const simulated::arm_scenario& scene, double duration,
    const change& also = [](arm_servo_options&) {}) {
  simulated_arm device(arm, scene);
  run_of<Model> result = run_on(device, model, arm, duration, also);
  result.ledger = device.ledger();
  return result;
}

run_of<law> run(
    const arm_description& arm, const simulated::arm_scenario& scene, double duration,
    const change& also = [](arm_servo_options&) {}) {
  law model;
  return run(model, arm, scene, duration, also);
}

// What passes into motors and brakes: with no lag between them and the loop, the loop's own account of the motors is
// exact and that of the brakes a bound from below, which steady motion keeps close.
TEST(ArmLoop, RunsALawOfTwoAxesAndAccountsForItsEnergy) {
  const run_of<law> ran = run(pantograph(), ellipse(), 1);
  EXPECT_EQ(ran.summary.faults.total(), 0u);
  EXPECT_EQ(ran.summary.periods, 10'000u);
  EXPECT_TRUE(ran.summary.left_safe);
  const double taken = ran.ledger.brake - ran.ledger.motor;
  EXPECT_GT(ran.ledger.brake, 1e-5);
  EXPECT_LE(ran.summary.energy, taken + 1e-12);
  EXPECT_LT(taken - ran.summary.energy, 0.02 * ran.ledger.brake);
  EXPECT_GT(ran.summary.highest_tip[0] - ran.summary.lowest_tip[0], 0.002);
  EXPECT_GT(ran.summary.largest_torques[0], 0);
  EXPECT_GT(ran.summary.largest_dampings[1], 0);
}

// What the hand did not get from the loop it cannot have got: never below zero, encoders and lags of the real device.
TEST(ArmLoop, TakesMoreThanItGivesOnTheWholeDevice) {
  arm_description arm = pantograph();
  for (device_description& joint : arm.joints) {
    joint.loop.jitter = 5e-5;
    joint.encoder.step = 6.283185307179586 / 65536;
    joint.motor.amplifier_lag = 2e-4;
    joint.mechanics.coulomb_friction = 1e-3;
  }
  for (arm_brake& brake : arm.brakes) {
    brake.brake.residual_damping = 2e-5;
    brake.brake.tolerance = 0.05;
    brake.brake.coil_lag = 2e-3;
    brake.brake.critical_speed = 400;
  }
  generated::soft_ball ball;
  simulated::arm_scenario scene = ellipse(0.02);
  scene.gain = simulated::brake_gain::lowest;
  const run_of<generated::soft_ball> ran = run(ball, arm, scene, 1);
  EXPECT_EQ(ran.summary.faults.total(), 0u) << ran.log;
  EXPECT_GT(ran.summary.largest_torques[0], 1e-3);  // it has touched the ball
  EXPECT_GT(ran.ledger.brake - ran.ledger.motor, 0);
  EXPECT_LE(ran.summary.energy, ran.ledger.brake - ran.ledger.motor);
}

TEST(ArmLoop, IsTheSameEveryTimeAndNamesAColumnForEachJointAndBrake) {
  const run_of<law> first = run(pantograph(), ellipse(), 0.02), second = run(pantograph(), ellipse(), 0.02);
  EXPECT_EQ(first.table, second.table);
  EXPECT_EQ(
      first.table.substr(0, first.table.find('\n')),
      "time [s],period,state,fault,fresh,lateness [ns],response [ns],q1 [rad],q2 [rad],v1 [rad/s],v2 [rad/s],"
      "damping_1 [N m s/rad],damping_2 [N m s/rad],torque_1 [N m],torque_2 [N m],motor_torque_1 [N m],"
      "motor_torque_2 [N m],brake_damping_1 [N m s/rad],brake_damping_2 [N m s/rad],stored_energy [J],energy [J]");
  arm_telemetry_record record;
  record.time = 0.5, record.period = 5000, record.state = servo_state::running, record.fresh = true;
  record.position[0] = 1, record.position[1] = 2, record.velocity[0] = 3, record.velocity[1] = 4;
  record.damping[0] = 5, record.torque[0] = 6, record.torque[1] = 7;
  record.sent = {{8, 9}, {10, 11, 0, 0}};
  record.stored_energy = 12, record.energy = 13;
  EXPECT_EQ(csv_row(record, {motion::rotation, 1}), "0.5,5000,running,none,1,0,0,1,2,3,4,5,6,7,8,9,10,12,13\n");
}

// Every joint's command, against the law called by hand with what the log tells of the samples.
TEST(ArmLoop, SendsWhatTheLawCommands) {
  arm_description arm = pantograph();
  for (device_description& joint : arm.joints) joint.motor.max_torque = 2e-4;
  arm.brakes[1].brake.max_damping = 1e-3;
  const run_of<law> ran = run(arm, ellipse(), 0.05);
  ASSERT_EQ(ran.records.size(), 500u);
  law model;
  model.reset(ran.records.front().position);
  std::uint64_t clipped = 0;
  for (const arm_telemetry_record& record : ran.records) {
    const auto wanted = model.step(record.position, record.velocity);
    for (unsigned j = 0; j < arm_axes; ++j) {
      EXPECT_EQ(record.torque[j], wanted.torque[j]);
      EXPECT_EQ(record.sent.motor_torque[j], std::fmin(std::fmax(-wanted.torque[j], -2e-4), 2e-4));
      clipped += std::fabs(wanted.torque[j]) > 2e-4 ? 1u : 0u;
    }
    EXPECT_EQ(record.sent.brake_damping[0], wanted.damping[0]);
    EXPECT_EQ(record.sent.brake_damping[1], std::fmin(wanted.damping[1], 1e-3));
  }
  EXPECT_GT(clipped, 0u);
  EXPECT_NEAR(static_cast<double>(ran.summary.motor_clipped), static_cast<double>(clipped), 2);
  EXPECT_EQ(ran.summary.brake_clipped, 500u);
}

simulated::arm_scenario with(simulated::sample_fault fault) {
  simulated::arm_scenario scene = ellipse();
  scene.faults = {fault};
  return scene;
}

void expect_safe(const run_of<law>& ran, fault kind, const std::string& words) {
  EXPECT_EQ(ran.summary.faults.of(kind), 1u) << ran.log;
  EXPECT_NE(ran.log.find(words), std::string::npos) << ran.log;
  EXPECT_EQ(ran.summary.state, servo_state::safe);
  const arm_actuation& sent = ran.records.back().sent;
  for (unsigned i = 0; i < 2; ++i) {
    EXPECT_EQ(sent.motor_torque[i], 0);
    EXPECT_EQ(sent.brake_damping[i], 0.002);
  }
  EXPECT_TRUE(ran.summary.safe_confirmed);
}

TEST(ArmLoop, GoesSafeAndNamesTheJoint) {
  using simulated::sample_fault_kind;
  expect_safe(run(pantograph(), with({sample_fault_kind::not_a_number, 50, 1, 0}), 0.01), fault::position_not_finite,
              "position not finite: joint 1: the device reads nan");
  expect_safe(run(pantograph(), with({sample_fault_kind::disconnected, 50, 1, 0}), 0.01), fault::device_error,
              "device error: the device answers 'disconnected'");
  expect_safe(run(pantograph(), with({sample_fault_kind::lost, 50, 10, 0}), 0.01), fault::no_data,
              "no data: 4 periods without a fresh sample, at most 3");
  arm_description slow = pantograph();
  slow.joints[1].encoder.max_speed = 0.05;
  slow.joints[1].encoder.step = 1e-3;  // no jump
  expect_safe(run(slow, ellipse(), 0.2), fault::overspeed, "overspeed: joint 2: ");
  arm_description narrow = pantograph();
  narrow.joints[1].encoder.range_low = 0.94, narrow.joints[1].encoder.range_high = 0.96;
  expect_safe(run(narrow, ellipse(), 0.5), fault::position_out_of_range, "position out of range: joint 2: ");
  arm_description weak = pantograph();
  weak.joints[0].motor.max_torque = 1e-5;
  weak.joints[0].motor.saturation_allowed = 0.001;
  expect_safe(run(weak, ellipse(), 0.2), fault::motor_saturated, "motor saturated: joint 1: ");
}

// Tells once something else than what it applies.
struct misreporting_arm : simulated_arm {
  misreporting_arm(const arm_description& arm, double& (*told)(arm_actuation&), double value)
      : simulated_arm(arm, ellipse()), told(told), value(value) {}

  device_status read(arm_sample& sample) noexcept {
    const device_status status = simulated_arm::read(sample);
    if (++reads == 50) told(sample.report.applied) = value;
    return status;
  }

  double& (*told)(arm_actuation&);
  double value;
  unsigned reads = 0;
};

TEST(ArmLoop, GoesSafeWhereAReportIsNotFinite) {
  const auto run_with = [](double& (*told)(arm_actuation&), double value) {
    misreporting_arm device(pantograph(), told, value);
    law model;
    return run_on(device, model, pantograph(), 0.01, [](arm_servo_options&) {});
  };
  const auto torque_2 = [](arm_actuation& applied) -> double& { return applied.motor_torque[1]; };
  const auto damping_1 = [](arm_actuation& applied) -> double& { return applied.brake_damping[0]; };
  EXPECT_NE(run_with(torque_2, HUGE_VAL).log.find("report not finite: joint 2: the device says that it applies inf"),
            std::string::npos);
  EXPECT_NE(run_with(damping_1, HUGE_VAL).log.find("report not finite: brake 1: the device says that it applies inf"),
            std::string::npos);
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (const run_of<law>& ran : {run_with(torque_2, value), run_with(damping_1, value)}) {
      EXPECT_EQ(ran.summary.faults.total(), 1u) << ran.log;
      EXPECT_EQ(ran.summary.state, servo_state::safe);
      EXPECT_TRUE(std::isfinite(ran.summary.energy));
    }
  }
}

// A law of an arm is certified within the workspace alone.
TEST(ArmLoop, GoesSafeWhereTheTipLeavesTheWorkspace) {
  arm_description arm = pantograph();
  const double x = pose_of(arm.geometry, ellipse().initial_position, ellipse().initial_velocity).tip.position[0];
  arm.geometry.workspace_high[0] = x + 0.001;
  const run_of<law> ran = run(arm, ellipse(), 0.5);
  expect_safe(ran, fault::position_out_of_range, "position out of range: the tip's x: ");
  EXPECT_NE(ran.log.find(" m is beyond "), std::string::npos) << ran.log;
  EXPECT_LE(ran.summary.highest_tip[0], x + 0.001);
}

// Three periods without a sample: the estimators are led over the gap, and no energy is claimed that was not taken.
TEST(ArmLoop, HoldsItsCommandOverAGap) {
  arm_description arm = pantograph();
  for (arm_brake& brake : arm.brakes) brake.brake.coil_lag = 2e-3;
  simulated::arm_scenario scene = ellipse();
  for (std::uint64_t first = 10; first < 900; first += 7)
    scene.faults.push_back({simulated::sample_fault_kind::lost, first, 3, 0});
  const run_of<law> ran = run(arm, scene, 0.1);
  EXPECT_EQ(ran.summary.faults.total(), 0u) << ran.log;
  EXPECT_EQ(ran.summary.held, 3 * scene.faults.size());
  EXPECT_LE(ran.summary.energy, ran.ledger.brake - ran.ledger.motor + 1e-12);
}

struct made_for_three_brakes : law {
  static constexpr int brakes = 3;
  commands<scalar, axes, 3> output(const scalar (&position)[axes], const scalar (&velocity)[axes]) noexcept {
    const auto two = law::output(position, velocity);
    return {{two.damping[0], two.damping[1], 0}, {two.torque[0], two.torque[1]}};
  }
};

struct not_certified : law {
  struct certified_for : law::certified_for {
    static constexpr bool is_certified = false;
  };
};

TEST(ArmLoop, LeavesADeviceAloneThatTheLawIsNotMadeFor) {
  const auto verdict = [](
                           const arm_description& arm, const change& also = [](arm_servo_options&) {}) {
    return run(arm, ellipse(), 0.001, also).summary.verdict;
  };
  const change asks_for_certified = [](arm_servo_options& o) { o.require_certified = true; };
  EXPECT_EQ(verdict(pantograph(), asks_for_certified), admission::admitted);
  not_certified lacking;
  EXPECT_EQ(run(lacking, pantograph(), ellipse(), 0.001).summary.verdict, admission::admitted_uncertified);
  EXPECT_EQ(run(lacking, pantograph(), ellipse(), 0.001, asks_for_certified).summary.verdict, admission::not_certified);
  EXPECT_EQ(verdict(pantograph(), [](arm_servo_options& o) { o.identity.digest = "another"; }),
            admission::other_digest);
  EXPECT_EQ(verdict(pantograph(), [](arm_servo_options& o) { o.identity.name = "another"; }), admission::other_device);
  arm_description other = pantograph();
  other.joints[1].velocity.estimator = estimator_kind::backward_difference;
  EXPECT_EQ(verdict(other), admission::other_estimator);
  EXPECT_NE(run(other, ellipse(), 0.001).log.find("with estimator 'butterworth', this loop uses 'backward_difference'"),
            std::string::npos);
  arm_description late = pantograph();
  for (device_description& joint : late.joints) joint.loop.delay_samples = 1;
  EXPECT_EQ(verdict(late), admission::other_delay);
  made_for_three_brakes three;
  const auto ran = run(three, pantograph(), ellipse(), 0.001);
  EXPECT_EQ(ran.summary.verdict, admission::other_brakes);
  EXPECT_NE(ran.log.find("model commands 3 brakes, device 'pantograph_2dof' has 2"), std::string::npos);
  EXPECT_EQ(ran.summary.periods, 0u);
}

}  // namespace
}  // namespace dashpot::tests::arms
