// Motions that are chosen to take energy out of held forces of two axes: none does with the damping that is proved, and
// with nine tenths of it some do.
#include <gtest/gtest.h>

#include "arms.hpp"
#include "axes/brakes.hpp"
#include "axes/workspace_bound.hpp"
#include "support/repetitions.hpp"

namespace dashpot::testing {
namespace {

constexpr double period = 1e-3;

// F = k0 w + Σ F_i, F_i ← a_i F_i + c_i Δw, and the storage of the hold certificate (theory, 6a): V = ½k0w² + Σ
// F_i²/2c_i.
struct Network {
  PortMap map;
  double grounded;
  std::vector<double> kept, gain, force;
  double depth = 0;

  double hold() const {
    double sum = grounded / 2;
    for (std::size_t i = 0; i < kept.size(); ++i) sum += gain[i] / (1 + kept[i]);
    return sum;
  }
  void start(double w) { depth = w, force.assign(kept.size(), 0.0); }
  void move(double w) {
    for (std::size_t i = 0; i < kept.size(); ++i) force[i] = kept[i] * force[i] + gain[i] * (w - depth);
    depth = w;
  }
  double total() const {
    double sum = grounded * depth;
    for (const double f : force) sum += f;
    return sum;
  }
  double stored() const {
    double sum = 0.5 * grounded * depth * depth;
    for (std::size_t i = 0; i < force.size(); ++i) sum += force[i] * force[i] / (2 * gain[i]);
    return sum;
  }
};

struct Case {
  Arm arm;
  std::vector<Network> networks;
  Pair<double> weight;
  NeededDamping needed;
};

const Box room{Interval(-4e-3, 4e-3), Interval(88e-3, 92e-3)};

PortMap random_map(Random& random) {
  const double angle = random.uniform(0, 2 * pi), far = random.uniform(15e-3, 60e-3);
  const Pair<double> direction{std::cos(angle), std::sin(angle)};
  if (random.chance(0.4)) return along(direction);
  return ball(Pair<double>{0, 90e-3} + far * direction, random.uniform(0.5, 1.5) * far);
}

Case random_case(Random& random, double step, double tolerance) {
  Case one{every_arm[random.index(every_arm.size())], {}, {1, 1}, {}};
  if (one.arm.kind != Kinematics::cartesian)
    one.weight = {one.arm.proximal * one.arm.proximal, one.arm.distal * one.arm.distal};
  std::vector<PortLoad> loads;
  for (std::size_t i = 0; i < 2; ++i) {
    const PortMap map = random_map(random);
    Network network{map, random.log_uniform(100, 1000), {}, {}, {}};
    PortLoad load{map};
    if (random.chance(0.3)) {
      network.kept.push_back(std::exp(-period * random.log_uniform(1, 1000)));
      network.gain.push_back(random.log_uniform(10, 100));
      load.relaxing = network.gain[0];  // what an update adds is never more than gain·(w − an average of past w)
    }
    load.grounded = network.grounded;
    load.held = network.hold();
    one.networks.push_back(network);
    loads.push_back(load);
  }
  one.needed = needed_damping(one.arm, room, loads, {period, 0, {step, step}}, one.weight, {}, tolerance);
  return one;
}

class Attack {
 public:
  Attack(Case& one, double damping, const Pair<double>& at) : case_(one), damping_(damping), q_(at) {
    for (Network& network : case_.networks) network.start(depth_of(network, q_));
  }

  // Motors and dampers take torque·Δq + x ΔqᵀWΔq/T from the hand.
  double work(const Pair<double>& by) const {
    const double heat = damping_ * (case_.weight[0] * by[0] * by[0] + case_.weight[1] * by[1] * by[1]) / period;
    return dot(torque(), by) + heat;
  }
  double stored() const {
    double sum = 0;
    for (const Network& network : case_.networks) sum += network.stored();
    return sum;
  }
  bool is_inside(const Pair<double>& by) const {
    const Pair<double> tip = pose(case_.arm, q_ + by).tip;
    return room[0].holds(tip[0]) && room[1].holds(tip[1]);
  }
  void move(const Pair<double>& by) {
    q_ = q_ + by;
    for (Network& network : case_.networks) network.move(depth_of(network, q_));
  }
  // Beyond work and storage of one step: what would have come from nowhere.
  double created(const Pair<double>& by) const {
    Attack next = *this;
    std::vector<Network> kept = case_.networks;
    next.move(by);
    const double after = next.stored();
    case_.networks = kept;
    return after - stored() - work(by);
  }

 private:
  double depth_of(const Network& network, const Pair<double>& q) const {
    return depth(network.map, pose(case_.arm, q).tip).value;
  }
  Pair<double> torque() const {
    const Pose<double> at = pose(case_.arm, q_);
    Pair<double> sum{0, 0};
    for (const Network& network : case_.networks) {
      sum = sum + network.total() * at_joints(at, depth(network.map, at.tip).gradient);
    }
    return sum;
  }

  Case& case_;
  double damping_;
  Pair<double> q_;
};

Pair<double> random_step(Random& random, double step) {
  const Pair<double> by{random.uniform(-step, step), random.uniform(-step, step)};
  return random.chance(0.5)
             ? by
             : Pair<double>{by[0] > 0 ? step : -step, random.chance(0.5) ? by[1] : (by[1] > 0 ? step : -step)};
}

double step_of(const Case& one) { return one.arm.kind == Kinematics::cartesian ? 1e-4 : 1e-3; }

// At every step of every motion: storage rises by no more than the work done. Greedy motions take of eight steps the
// one that would create most; others go back and forth where the need is largest.
TEST(Attack, NothingIsCreatedAtTheBound) {
  Random random(50);
  const std::size_t steps = repetitions(3000, 60000), each = 500;
  for (std::size_t done = 0; done < steps; done += each) {
    Case one = random_case(random, 1e-3, 0.3);
    ASSERT_TRUE(std::isfinite(one.needed.proved));
    const double step = step_of(one);
    const bool greedy = random.chance(0.6);
    Attack attack(one, one.needed.proved, *joints_at(one.arm, {0, 90e-3}));
    Pair<double> last = random_step(random, step);
    for (std::size_t k = 0; k < each; ++k) {
      Pair<double> by = greedy ? random_step(random, step) : (k % 20 < 10 ? -1.0 * last : random_step(random, step));
      for (int other = 0; greedy && other < 8; ++other) {
        const Pair<double> candidate = random_step(random, step);
        if (attack.is_inside(candidate) && attack.created(candidate) > attack.created(by)) by = candidate;
      }
      if (!attack.is_inside(by)) by = -1.0 * by;
      if (!attack.is_inside(by)) continue;
      ASSERT_LE(attack.created(by), 1e-12 * (attack.stored() + std::abs(attack.work(by))))
          << "step " << k << " of attack " << done / each;
      attack.move(by);
      last = by;
    }
  }
}

// Back and forth where most is needed, in the direction that needs it: with 0.9 of what is proved at least four in five
// networks give more than they stored.
TEST(Attack, NineTenthsAreNotEnough) {
  Random random(51);
  const int cases = int(repetitions(10, 60));
  int gained = 0;
  for (int i = 0; i < cases; ++i) {
    Case one = random_case(random, 1e-5, 0.08);
    bool wins = false;
    for (int direction = 0; direction < 24 && !wins; ++direction) {
      const double angle = pi * direction / 24;
      const Pair<double> by{1e-5 * std::cos(angle) / std::sqrt(one.weight[0] / one.weight[1]), 1e-5 * std::sin(angle)};
      Attack attack(one, 0.9 * one.needed.proved, one.needed.joints);
      const auto swing = [&](int times) {
        double work = 0;
        for (int k = 0; k < times; ++k) {
          const Pair<double> way = k % 2 == 0 ? by : -1.0 * by;
          work += attack.work(way);
          attack.move(way);
        }
        return work;
      };
      swing(200);
      const double before = attack.stored(), work = swing(200);
      // Whole swings leave the storage as it was; what they take they take for ever.
      wins = work < attack.stored() - before - 1e-12 * before && work < 0;
    }
    gained += wins ? 1 : 0;
  }
  EXPECT_GE(gained, cases * 8 / 10);
  RecordProperty("gained", gained);
}

}  // namespace
}  // namespace dashpot::testing
