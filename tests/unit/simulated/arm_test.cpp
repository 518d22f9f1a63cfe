#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include <dashpot/simulated/simulated_arm.hpp>

namespace dashpot {
namespace {

using simulated::arm_scenario;
using simulated::sample_fault;
using simulated::sample_fault_kind;

constexpr double masses[2] = {0.02, 0.015}, l1 = 0.063, l2 = 0.075, base = 0.025;
constexpr double held_torque[2] = {0.004, -0.003}, demanded_damping[2] = {2e-4, 1e-4}, lag = 0.003, coil_lag = 0.004;
constexpr double along[2][2] = {{1, -1}, {0.5, 1}};

arm_description arm_of(arm_kind kind) {
  arm_description arm;
  arm.geometry = {kind, l1, l2, kind == arm_kind::five_bar ? base : 0, {}, {}};
  for (device_description& joint : arm.joints) {
    joint.motion = kind == arm_kind::cartesian ? motion::translation : motion::rotation;
    joint.loop.sample_period = 0.001;
    joint.motor.amplifier_lag = lag;
    joint.mechanics.damping = 3e-5;
  }
  arm.brake_count = 2;
  for (unsigned i = 0; i < 2; ++i) {
    std::memcpy(arm.brakes[i].along, along[i], sizeof along[i]);
    arm.brakes[i].brake.kind = brake_kind::eddy_current;
    arm.brakes[i].brake.max_damping = 1;
    arm.brakes[i].brake.coil_lag = coil_lag;
  }
  if (kind == arm_kind::cartesian) {
    const double inertia[2][2] = {{0.03, 0.004}, {0.004, 0.02}};
    std::memcpy(arm.inertia, inertia, sizeof inertia);
  } else {
    std::memcpy(arm.link_masses, masses, sizeof masses);
  }
  return arm;
}

// In the middle of the workspace, moving, held by an uneven hand on its way along an ellipse.
constexpr double hand_mass = 0.1, pull[2][2] = {{60, 20}, {20, 40}}, drag[2][2] = {{0.8, -0.2}, {-0.2, 0.5}};

simulated::tip_motion meant_at(double t, const double (&centre)[2]) {
  return {{centre[0] + 0.01 * std::sin(12 * t), centre[1] + 0.006 * std::cos(9 * t)},
          {0.12 * std::cos(12 * t), -0.054 * std::sin(9 * t)}};
}

arm_scenario scene_of(arm_kind kind, double velocity = 1) {
  arm_scenario scene;
  const double q[4][2] = {{0.7, 1.4}, {0.6, 1.9}, {2.2, 0.9}, {0.01, 0.09}};
  for (unsigned j = 0; j < 2; ++j) {
    scene.initial_position[j] = q[static_cast<unsigned>(kind)][j];
    scene.initial_velocity[j] = (kind == arm_kind::cartesian ? 0.1 : 1) * velocity * (j == 0 ? 1.5 : -0.8);
  }
  scene.user.mass = hand_mass;
  std::memcpy(scene.user.stiffness, pull, sizeof pull);
  std::memcpy(scene.user.damping, drag, sizeof drag);
  const arm_point tip = pose_of(arm_of(kind).geometry, scene.initial_position, scene.initial_velocity).tip;
  const std::array<double, 2> there{tip.position[0], tip.position[1]};
  scene.intended = [there](double t) {
    const double centre[2] = {there[0], there[1]};
    return meant_at(t, centre);
  };
  return scene;
}

// --- The same physics written another way: all points in Cartesian coordinates, links as constraints with multipliers,
// and the classical method of Runge and Kutta. Two points for arms of one chain, three for a five-bar.

using numbers = std::vector<double>;

numbers solve(std::vector<numbers> a, numbers b) {
  const std::size_t n = b.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < n; ++r)
      if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
    std::swap(a[c], a[pivot]), std::swap(b[c], b[pivot]);
    for (std::size_t r = c + 1; r < n; ++r) {
      const double factor = a[r][c] / a[c][c];
      for (std::size_t k = c; k < n; ++k) a[r][k] -= factor * a[c][k];
      b[r] -= factor * b[c];
    }
  }
  for (std::size_t c = n; c-- > 0;) {
    for (std::size_t k = c + 1; k < n; ++k) b[c] -= a[c][k] * b[k];
    b[c] /= a[c][c];
  }
  return b;
}

class point_arm {
 public:
  point_arm(arm_kind kind, const arm_scenario& scene) : kind_(kind), bar_(kind == arm_kind::five_bar) {
    const arm_pose pose = pose_of(arm_of(kind).geometry, scene.initial_position, scene.initial_velocity);
    std::vector<arm_point> points{pose.elbow[0]};
    if (bar_) points.push_back(pose.elbow[1]);
    points.push_back(pose.tip);
    for (const arm_point& point : points)
      for (unsigned i = 0; i < 2; ++i) {
        x_.push_back(point.position[i]);
        v_.push_back(point.jacobian[i][0] * scene.initial_velocity[0] +
                     point.jacobian[i][1] * scene.initial_velocity[1]);
      }
    centre_[0] = pose.tip.position[0], centre_[1] = pose.tip.position[1];
  }

  void run(double duration, unsigned steps) {
    const double h = duration / steps;
    for (unsigned k = 0; k < steps; ++k) {
      const double t = k * h;
      const numbers a1 = acceleration(t, x_, v_);
      const numbers v2 = plus(v_, h / 2, a1), a2 = acceleration(t + h / 2, plus(x_, h / 2, v_), v2);
      const numbers v3 = plus(v_, h / 2, a2), a3 = acceleration(t + h / 2, plus(x_, h / 2, v2), v3);
      const numbers v4 = plus(v_, h, a3), a4 = acceleration(t + h, plus(x_, h, v3), v4);
      for (std::size_t i = 0; i < x_.size(); ++i) {
        x_[i] += h / 6 * (v_[i] + 2 * v2[i] + 2 * v3[i] + v4[i]);
        v_[i] += h / 6 * (a1[i] + 2 * a2[i] + 2 * a3[i] + a4[i]);
      }
    }
  }

  double tip(unsigned i) const { return x_[x_.size() - 2 + i]; }
  double tip_velocity(unsigned i) const { return v_[v_.size() - 2 + i]; }

 private:
  static numbers plus(numbers a, double factor, const numbers& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
    return a;
  }

  // A link's rate of turning is the cross product of its vector with its velocity, over its squared length.
  struct link {
    double along[2], moving[2], length;
    unsigned from, to;  // points; 99: ground
    double rate() const { return (along[0] * moving[1] - along[1] * moving[0]) / (length * length); }
  };

  std::vector<link> links(const numbers& x, const numbers& v) const {
    std::vector<link> all;
    const auto add = [&](unsigned from, unsigned to, double length, double ground) {
      link one{{}, {}, length, from, to};
      for (unsigned i = 0; i < 2; ++i) {
        one.along[i] = x[2 * to + i] - (from == 99 ? (i == 0 ? ground : 0) : x[2 * from + i]);
        one.moving[i] = v[2 * to + i] - (from == 99 ? 0 : v[2 * from + i]);
      }
      all.push_back(one);
    };
    const unsigned tip = bar_ ? 2 : 1;
    add(99, 0, l1, bar_ ? -base / 2 : 0), add(0, tip, l2, 0);
    if (bar_) add(99, 1, l1, base / 2), add(1, tip, l2, 0);
    return all;
  }

  numbers acceleration(double t, const numbers& x, const numbers& v) const {
    const std::vector<link> all = links(x, v);
    const std::size_t n = x.size(), size = n + all.size();
    std::vector<numbers> matrix(size, numbers(size));
    numbers right(size);
    for (std::size_t c = 0; c < all.size(); ++c) {
      const link& one = all[c];
      const double mass = one.length == l1 ? masses[0] : masses[1];
      for (unsigned i = 0; i < 2; ++i) {
        const std::size_t to = 2 * one.to + i, from = 2 * one.from + i;
        matrix[to][to] += mass / 3;
        matrix[n + c][to] = matrix[to][n + c] = one.along[i];
        if (one.from != 99) {
          matrix[from][from] += mass / 3;
          matrix[from][to] += mass / 6, matrix[to][from] += mass / 6;
          matrix[n + c][from] = matrix[from][n + c] = -one.along[i];
        }
        right[n + c] -= one.moving[i] * one.moving[i];
      }
    }
    // Joint rates, their torques, and what a torque on a link is at its ends: a couple.
    const unsigned driven[2] = {0, bar_ ? 2u : 1u};
    double q[2] = {all[0].rate(), all[driven[1]].rate()};
    if (kind_ == arm_kind::serial) q[1] -= q[0];
    double torque[2];
    for (unsigned j = 0; j < 2; ++j) torque[j] = held_torque[j] * -std::expm1(-t / lag) - 3e-5 * q[j];
    for (unsigned i = 0; i < 2; ++i) {
      const double rise = -std::expm1(-t / coil_lag);
      const double brake = demanded_damping[i] * rise * rise * (along[i][0] * q[0] + along[i][1] * q[1]);
      for (unsigned j = 0; j < 2; ++j) torque[j] -= brake * along[i][j];
    }
    if (kind_ == arm_kind::serial) torque[0] -= torque[1];  // the second motor stands on the first link
    for (unsigned j = 0; j < 2; ++j) {
      const link& one = all[driven[j]];
      const double couple = torque[j] / (one.length * one.length);
      right[2 * one.to] -= couple * one.along[1], right[2 * one.to + 1] += couple * one.along[0];
      if (one.from == 99) continue;
      right[2 * one.from] += couple * one.along[1], right[2 * one.from + 1] -= couple * one.along[0];
    }
    const simulated::tip_motion meant = meant_at(t, centre_);
    for (unsigned i = 0; i < 2; ++i) {
      matrix[n - 2 + i][n - 2 + i] += hand_mass;
      for (unsigned k = 0; k < 2; ++k)
        right[n - 2 + i] +=
            pull[i][k] * (meant.position[k] - x[n - 2 + k]) + drag[i][k] * (meant.velocity[k] - v[n - 2 + k]);
    }
    numbers solved = solve(matrix, right);
    solved.resize(n);
    return solved;
  }

  arm_kind kind_;
  bool bar_;
  numbers x_, v_;
  double centre_[2];
};

// `periods` of 1 ms under one command.
simulated_arm run(arm_kind kind, unsigned periods, unsigned substeps, double friction = 0) {
  arm_description arm = arm_of(kind);
  for (device_description& joint : arm.joints) joint.mechanics.coulomb_friction = friction;
  arm_scenario scene = scene_of(kind);
  scene.substeps = substeps;
  simulated_arm device(arm, scene);
  arm_sample sample;
  for (unsigned k = 0; k <= periods; ++k) {
    device.read(sample);
    if (k == 0) device.write({{held_torque[0], held_torque[1]}, {demanded_damping[0], demanded_damping[1], 0, 0}});
  }
  return device;
}

constexpr arm_kind all_kinds[] = {arm_kind::serial, arm_kind::parallelogram, arm_kind::five_bar, arm_kind::cartesian};

class LinkedArm : public testing::TestWithParam<arm_kind> {};
class Arm : public testing::TestWithParam<arm_kind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, LinkedArm,
                         testing::Values(arm_kind::serial, arm_kind::parallelogram, arm_kind::five_bar));
INSTANTIATE_TEST_SUITE_P(Kinds, Arm, testing::ValuesIn(all_kinds));

// In another formulation, by another method: 0.2 s at steps that leave both below 1e-10.
TEST_P(LinkedArm, MovesAsItsPointsDoUnderConstraints) {
  const simulated_arm device = run(GetParam(), 200, 16);
  point_arm reference(GetParam(), scene_of(GetParam()));
  reference.run(0.2, 8000);
  for (unsigned i = 0; i < 2; ++i) {
    EXPECT_NEAR(device.truth().tip_position[i], reference.tip(i), 1e-9 * l1);
    EXPECT_NEAR(device.truth().tip_velocity[i], reference.tip_velocity(i), 1e-9);
  }
}

TEST_P(Arm, ConvergesWithTheFourthPowerOfTheStep) {
  const simulated_arm exact = run(GetParam(), 50, 64);
  const auto off = [&](unsigned substeps) {
    const simulated_arm device = run(GetParam(), 50, substeps);
    return std::hypot(device.truth().position[0] - exact.truth().position[0],
                      device.truth().position[1] - exact.truth().position[1]);
  };
  const double order = std::log2(off(1) / off(2));
  EXPECT_NEAR(order, 4, 0.25);
  EXPECT_LT(off(4), 1e-9);
}

double exchanged(const simulated::energy_ledger& ledger) {
  return std::abs(ledger.hand) + std::abs(ledger.motor) + ledger.brake + ledger.friction + ledger.damping;
}

// With steps chosen by the plant itself, friction and all.
TEST_P(Arm, PutsInWhatIsKineticOrDissipated) {
  const double friction = GetParam() == arm_kind::cartesian ? 0.02 : 5e-4;
  const simulated_arm device = run(GetParam(), 500, 0, friction);
  const simulated::energy_ledger& ledger = device.ledger();
  EXPECT_GT(ledger.friction, 1e-6);
  EXPECT_GT(ledger.brake, 1e-7);
  EXPECT_LT(std::abs(ledger.imbalance()), 1e-8 * exchanged(ledger));
}

// Where nothing turns the inertia, the ledger closes to rounding, whatever the step.
TEST(CartesianArm, ClosesItsLedgerToRounding) {
  const simulated_arm device = run(arm_kind::cartesian, 500, 1);
  EXPECT_LT(std::abs(device.ledger().imbalance()), 1e-12 * exchanged(device.ledger()));
}

// 0.1 m/s against 0.02 N on 0.02 kg and 0.05 m/s against 0.03 N on 0.03 kg, uncoupled: each stops after v²m/2f, at its
// own time, to the bit at rest.
TEST(CartesianArm, StopsWhereFrictionHasTakenItsEnergy) {
  arm_description arm = arm_of(arm_kind::cartesian);
  arm.inertia[0][0] = 0.02, arm.inertia[1][1] = 0.03, arm.inertia[0][1] = arm.inertia[1][0] = 0;
  const double friction[2] = {0.02, 0.03};
  for (unsigned j = 0; j < 2; ++j) {
    arm.joints[j].mechanics = {};
    arm.joints[j].mechanics.coulomb_friction = friction[j];
  }
  arm_scenario scene;
  scene.initial_velocity[0] = 0.1, scene.initial_velocity[1] = -0.05;
  simulated_arm device(arm, scene);
  arm_sample sample;
  for (int k = 0; k <= 60; ++k) device.read(sample);
  EXPECT_EQ(device.truth().velocity[1], 0);
  EXPECT_GT(device.truth().velocity[0], 0.03);
  for (int k = 0; k <= 60; ++k) device.read(sample);
  EXPECT_EQ(device.truth().velocity[0], 0);
  EXPECT_NEAR(device.truth().position[0], 0.005, 1e-15);
  EXPECT_NEAR(device.truth().position[1], -0.00125, 1e-15);
  EXPECT_NEAR(device.ledger().friction, 1e-4 + 3.75e-5, 1e-16);
}

// A motor below the friction moves nothing; a coupled inertia lets the other joint's motion tear a joint loose.
TEST(CartesianArm, SticksUntilItIsTornLoose) {
  arm_description arm = arm_of(arm_kind::cartesian);
  for (device_description& joint : arm.joints) {
    joint.mechanics = {};
    joint.motor.amplifier_lag = 0;
  }
  arm.joints[1].mechanics.coulomb_friction = 0.1;
  const auto after = [&](double torque) {
    simulated_arm device(arm);
    arm_sample sample;
    device.read(sample);
    device.write({{torque, 0}, {}});
    for (int k = 0; k < 10; ++k) device.read(sample);
    return device.truth();
  };
  // The first joint alone accelerates with τ/m11, and drags the second with m12/m11 τ: 0.1 N at τ = 0.75 N.
  EXPECT_TRUE(after(0.749).stuck[1]);
  EXPECT_EQ(after(0.749).position[1], 0);
  EXPECT_NEAR(after(0.749).velocity[0], 0.01 * 0.749 / 0.03, 1e-12);
  EXPECT_FALSE(after(0.751).stuck[1]);
  EXPECT_LT(after(0.751).velocity[1], 0);
}

// Sampled, a spring of stiffness K needs KT/2 of damping at each joint: with it, motors and brakes have taken all that
// the spring's energy does not account for.
TEST_P(Arm, GivesNothingAwayUnderAPassiveLaw) {
  const double stiffness = GetParam() == arm_kind::cartesian ? 200 : 0.5, period = 0.001;
  arm_description arm = arm_of(GetParam());
  arm_scenario scene = scene_of(GetParam());
  for (unsigned j = 0; j < 2; ++j) {
    arm.joints[j].motor.amplifier_lag = 0;
    arm.brakes[j].brake.coil_lag = 0;
    arm.brakes[j].along[0] = j == 0, arm.brakes[j].along[1] = j == 1;
  }
  simulated_arm device(arm, scene);
  arm_sample sample;
  double least = 0, least_without = 0;
  for (int k = 0; k < 2000; ++k) {
    device.read(sample);
    double stored = 0;
    arm_actuation command;
    for (unsigned j = 0; j < 2; ++j) {
      const double pressed = sample.position[j] - scene.initial_position[j];
      stored += stiffness * pressed * pressed / 2;
      command.motor_torque[j] = -stiffness * pressed;
      command.brake_damping[j] = stiffness * period / 2;
    }
    device.write(command);
    const double taken = -device.ledger().motor - stored;
    least = std::min(least, taken + device.ledger().brake), least_without = std::min(least_without, taken);
  }
  EXPECT_GE(least, -1e-12);
  EXPECT_LT(least_without, -1e-7);
}

// If this failed, joints that are led along a prescribed motion would be elsewhere, or the work of leading them would
// be miscounted.
TEST(SimulatedArm, FollowsAPrescribedMotionAndPaysForIt) {
  arm_description arm = arm_of(arm_kind::five_bar);
  for (device_description& joint : arm.joints) joint.mechanics.coulomb_friction = 1e-3, joint.motor.amplifier_lag = 0;
  for (arm_brake& one : arm.brakes) one.brake.coil_lag = 0;
  arm_scenario scene;
  const double start[2] = {2.2, 0.9}, speed[2] = {0.2, -0.3};
  scene.prescribed = [&](double time) -> simulated::joints_motion {
    return {{start[0] + speed[0] * time, start[1] + speed[1] * time}, {speed[0], speed[1]}};
  };
  simulated_arm device(arm, scene);
  arm_sample sample;
  const arm_actuation demand{{held_torque[0], held_torque[1]}, {demanded_damping[0], demanded_damping[1]}};
  for (int k = 0; k < 501; ++k) device.read(sample), device.write(demand);
  double brakes = 0, motors = 0, joints = 0;  // power, which is constant [W]
  for (unsigned j = 0; j < 2; ++j) {
    EXPECT_NEAR(device.truth().position[j], start[j] + speed[j] * 0.5, 1e-12);
    EXPECT_EQ(device.truth().velocity[j], speed[j]);
    const double rate = along[j][0] * speed[0] + along[j][1] * speed[1];
    brakes += demanded_damping[j] * rate * rate;
    motors += held_torque[j] * speed[j];
    joints += 3e-5 * speed[j] * speed[j] + 1e-3 * std::abs(speed[j]);
  }
  EXPECT_NEAR(device.ledger().brake, 0.5 * brakes, 1e-15);
  EXPECT_NEAR(device.ledger().motor, 0.5 * motors, 1e-15);
  EXPECT_NEAR(device.ledger().hand, 0.5 * (brakes - motors + joints) + device.ledger().kinetic, 1e-15);
  EXPECT_EQ(device.truth_from_now_on().motor_torque[0], held_torque[0]);
  device.write({{0.01, 0}, {0, 3e-4}});
  EXPECT_EQ(device.truth().motor_torque[0], held_torque[0]);
  EXPECT_EQ(device.truth_from_now_on().motor_torque[0], 0.01);
  EXPECT_NEAR(device.truth_from_now_on().brake_damping[1], 3e-4, 1e-18);
}

TEST(SimulatedArm, QuantisesEachJointAndTellsWhatItApplies) {
  arm_description arm = arm_of(arm_kind::five_bar);
  arm.joints[0].encoder.step = 1e-4;
  arm.joints[1].encoder.step = 1e-3;
  arm.joints[0].motor.max_torque = 0.01;
  for (device_description& joint : arm.joints) joint.loop.delay_samples = 2;
  simulated_arm device(arm, scene_of(arm_kind::five_bar));
  arm_sample sample;
  for (int k = 0; k < 20; ++k) {
    ASSERT_EQ(device.read(sample), device_status::ok);
    device.write({{1, -1}, {2, 3, 0, 0}});
    for (unsigned j = 0; j < 2; ++j) {
      const double step = arm.joints[j].encoder.step, true_position = device.truth().position[j];
      EXPECT_EQ(sample.position[j], std::floor(true_position / step) * step);
      EXPECT_EQ(sample.counts[j], static_cast<std::int64_t>(std::floor(true_position / step)));
    }
  }
  EXPECT_TRUE(sample.report.told);
  EXPECT_EQ(sample.report.commands_ago, 1u);
  EXPECT_EQ(sample.report.applied.motor_torque[0], 0.01);
  EXPECT_EQ(sample.report.applied.motor_torque[1], -1);
  EXPECT_EQ(sample.report.applied.brake_damping[1], 1);
}

TEST(SimulatedArm, IsTheSameFromTheSameSeedAndAnotherFromAnother) {
  const auto last = [](std::uint64_t seed) {
    arm_description arm = arm_of(arm_kind::five_bar);
    for (device_description& joint : arm.joints) joint.loop.jitter = 2e-4, joint.motor.noise = 1e-4;
    for (arm_brake& brake : arm.brakes) brake.brake.tolerance = 0.1;
    arm_scenario scene = scene_of(arm_kind::five_bar);
    scene.seed = seed;
    scene.gain = simulated::brake_gain::drawn;
    simulated_arm device(arm, scene);
    arm_sample sample;
    for (int k = 0; k < 50; ++k) {
      device.read(sample);
      device.write({{}, {1e-3, 1e-3, 0, 0}});
    }
    EXPECT_NE(device.truth().brake_damping[0], device.truth().brake_damping[1]);
    return sample.position[0];
  };
  EXPECT_EQ(last(1), last(1));
  EXPECT_NE(last(1), last(2));
}

TEST(SimulatedArm, LosesAndSpoilsSamplesOnRequestAndReplacesWildCommands) {
  arm_scenario scene = scene_of(arm_kind::serial);
  scene.faults = {{sample_fault_kind::lost, 1, 1, 0}, {sample_fault_kind::not_a_number, 2, 1, 0}};
  simulated_arm device(arm_of(arm_kind::serial), scene);
  arm_sample sample;
  EXPECT_EQ(device.read(sample), device_status::ok);
  EXPECT_EQ(device.write({{std::nan(""), 0}, {}}), device_status::fault);
  EXPECT_EQ(device.read(sample), device_status::no_data);
  EXPECT_EQ(device.read(sample), device_status::ok);
  EXPECT_TRUE(std::isnan(sample.position[0]));
  EXPECT_FALSE(std::isnan(sample.position[1]));
  EXPECT_EQ(device.truth().motor_torque[0], 0);
}

TEST(SimulatedArm, RefusesWhatMakesNoSimulation) {
  const auto reason = [](const arm_description& arm, const arm_scenario& scene) {
    const char* words = simulated_arm::refusal(arm, scene);
    return std::string(words ? words : "");
  };
  const arm_scenario scene = scene_of(arm_kind::five_bar);
  EXPECT_EQ(reason(arm_of(arm_kind::five_bar), scene), "");
  arm_description light = arm_of(arm_kind::five_bar);
  light.link_masses[1] = 0;
  EXPECT_NE(reason(light, scene).find("\"link_masses\""), std::string::npos);
  arm_scenario active = scene;
  active.user.stiffness[0][1] = active.user.stiffness[1][0] = 100;
  EXPECT_EQ(reason(arm_of(arm_kind::five_bar), active), "the hand is not passive");
  arm_scenario beyond = scene;
  beyond.initial_position[0] = 3.1, beyond.initial_position[1] = 0;
  EXPECT_EQ(reason(arm_of(arm_kind::five_bar), beyond), "the arm does not reach where it starts");
  EXPECT_THROW(simulated_arm(light, scene), std::invalid_argument);
}

// A hand that lets go leaves the arm to itself: its own dissipation alone is left.
TEST(SimulatedArm, IsLetGoOfAtTheInstantThatIsAskedFor) {
  arm_scenario scene = scene_of(arm_kind::five_bar);
  scene.user.release_time = 0.0105;
  simulated_arm device(arm_of(arm_kind::five_bar), scene);
  arm_sample sample;
  for (int k = 0; k <= 11; ++k) device.read(sample);
  const double hand = device.ledger().hand;
  for (int k = 0; k <= 50; ++k) device.read(sample);
  EXPECT_EQ(device.ledger().hand, hand);
  EXPECT_LT(std::abs(device.ledger().imbalance()), 1e-9 * exchanged(device.ledger()));
}

}  // namespace
}  // namespace dashpot
