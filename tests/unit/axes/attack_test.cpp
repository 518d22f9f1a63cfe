// Motions that are chosen to take energy out of held forces of two axes: none does with the damping that is proved, and
// with nine tenths of it some do.
#include <gtest/gtest.h>

#include <complex>

#include "arms.hpp"
#include "axes/brakes.hpp"
#include "axes/curvature.hpp"
#include "axes/motor_norms.hpp"
#include "axes/workspace_bound.hpp"
#include "certify/motor_limits.hpp"
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

Case random_case(Random& random, double step, double tolerance, int delay = 0, bool relaxes = true) {
  Case one{every_arm[random.index(every_arm.size())], {}, {1, 1}, {}};
  if (one.arm.kind != Kinematics::cartesian)
    one.weight = {one.arm.proximal * one.arm.proximal, one.arm.distal * one.arm.distal};
  std::vector<PortLoad> loads;
  for (std::size_t i = 0; i < 2; ++i) {
    const PortMap map = random_map(random);
    Network network{map, random.log_uniform(100, 1000), {}, {}, {}};
    PortLoad load{map};
    if (relaxes && random.chance(0.3)) {
      network.kept.push_back(std::exp(-period * random.log_uniform(1, 1000)));
      network.gain.push_back(random.log_uniform(10, 100));
      load.relaxing = network.gain[0];  // what an update adds is never more than gain·(w − an average of past w)
    }
    load.grounded = network.grounded;
    load.held = network.hold();
    one.networks.push_back(network);
    loads.push_back(load);
  }
  const double reach = step * (1 + delay);
  one.needed = needed_damping(one.arm, room, loads, {period, delay, {reach, reach}}, one.weight, {}, tolerance);
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
  // The energy that one step would create: by how much storage rises beyond the work done.
  double created(const Pair<double>& by) const {
    Attack next = *this;
    std::vector<Network> kept = case_.networks;
    next.move(by);
    const double after = next.stored();
    case_.networks = kept;
    return after - stored() - work(by);
  }

  Pair<double> torque() const {
    const Pose<double> at = pose(case_.arm, q_);
    Pair<double> sum{0, 0};
    for (const Network& network : case_.networks) {
      sum = sum + network.total() * at_joints(at, depth(network.map, at.tip).gradient);
    }
    return sum;
  }

 private:
  double depth_of(const Network& network, const Pair<double>& q) const {
    return depth(network.map, pose(case_.arm, q).tip).value;
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

// Torques that act n samples late.
class LateAttack : public Attack {
 public:
  LateAttack(Case& one, double damping, const Pair<double>& at, int delay)
      : Attack(one, damping, at), told_(std::size_t(delay) + 1, torque()) {}

  double work(const Pair<double>& by) const { return Attack::work(by) + lateness(by); }
  double created(const Pair<double>& by) const { return Attack::created(by) - lateness(by); }
  void move(const Pair<double>& by) {
    Attack::move(by);
    told_.push_back(torque()), told_.erase(told_.begin());
  }

 private:
  double lateness(const Pair<double>& by) const { return dot(told_.front() - told_.back(), by); }

  std::vector<Pair<double>> told_;  // of the last samples, the one that acts first
};

// A small motion to and fro about a place, so many times in `length` samples, that asks for most there. What is to be
// paid of motions that turn by θ in a sample is, with the forces' answer G(z) to displacements,
//
//     ½ T Re{(1 − 1/z) z⁻ⁿ G(z)}/(1 − cos θ),        z = e^{jθ},        G = Σ [(k0 + Σ c (z − 1)/(z − a)) g gᵀ + k0 w
//     H],
//
// and where relaxations are at rest no other small motion asks for more.
struct Swing {
  double needed = 0;  // x of x W
  Pair<double> joints{};
  std::size_t times = 1;
  Pair<double> way{1, 0};

  static constexpr std::size_t length = 64;

  Pair<double> step(std::size_t k, double size) const {
    return size * std::cos(2 * pi * double(times) * (double(k) + 0.5) / double(length)) * way;
  }
};

// The largest λ of m v = λ W v, with v.
std::pair<double, Pair<double>> largest(const Symmetric<double>& m, const Pair<double>& weight) {
  const double most = eigenvalues(m, {weight[0], 0, weight[1]})[1];
  // Both rows of m − λ W are across v; the longer one is far from 0.
  const Pair<double> first{m.xx - most * weight[0], m.xy}, second{m.xy, m.yy - most * weight[1]};
  const Pair<double> across = length_squared(first) > length_squared(second) ? first : second;
  return {most, turned((1 / std::hypot(across[0], across[1])) * across)};
}

Swing hardest_swing_at(const Pair<double>& q, const Case& one, int delay) {
  const Pose<double> at = pose(one.arm, q);
  const Pair<Symmetric<double>> bends = curvature(one.arm, q);
  Swing hardest;
  for (std::size_t times = 1; times <= Swing::length / 2; ++times) {
    const double angle = 2 * pi * double(times) / double(Swing::length);
    const std::complex<double> z = std::polar(1.0, angle), held = (1.0 - 1.0 / z) * std::pow(z, -delay);
    Symmetric<double> sum{0, 0, 0};
    for (const Network& network : one.networks) {
      const Depth<double> there = depth(network.map, at.tip);
      std::complex<double> answer = network.grounded;
      for (std::size_t i = 0; i < network.kept.size(); ++i)
        answer += network.gain[i] * (z - 1.0) / (z - network.kept[i]);
      const Symmetric<double> hessian = at_joints(at, bends, there.gradient, bend(network.map, at.tip));
      sum = sum + (held * answer).real() * outer(at_joints(at, there.gradient)) +
            (held.real() * network.grounded * there.value) * hessian;
    }
    const auto [most, way] = largest(sum, one.weight);
    const double needed = period / 2 * most / (1 - std::cos(angle));
    if (needed > hardest.needed) hardest = {needed, q, times, way};
  }
  return hardest;
}

// At one of 81 places, from where small motions stay in the room.
Swing hardest_swing(const Case& one, int delay) {
  Swing hardest;
  for (const Place& place : places_in(one.arm, {Interval(-3.9e-3, 3.9e-3), Interval(88.1e-3, 91.9e-3)}, 9)) {
    const Swing there = hardest_swing_at(place.joints, one, delay);
    if (there.needed > hardest.needed) hardest = there;
  }
  return hardest;
}

// With what is proved for late torques: the swing that asks for most, steps at random, and of eight steps the one that
// would create most, large and small. From rest on the storage rises by no more than the work.
TEST(Attack, LateTorquesGiveNothingAtTheBound) {
  Random random(54);
  const std::size_t cases = repetitions(12, 600);
  for (std::size_t i = 0; i < cases; ++i) {
    const int delay = 1 + int(random.index(3));
    const double step = random.log_uniform(1e-5, 1e-3);
    const Case found = random_case(random, step, 0.02, delay);
    ASSERT_TRUE(std::isfinite(found.needed.proved));
    const Swing swing = hardest_swing(found, delay);
    for (int motion = 0; motion < 8; ++motion) {
      Case one = found;
      LateAttack attack(one, found.needed.proved, swing.joints, delay);
      double risen = 0, paid = attack.stored();
      for (std::size_t k = 0; k < 256; ++k) {
        const bool wanders = random.chance(0.15 * (motion / 2));
        Pair<double> by = wanders ? random_step(random, step) : swing.step(k, motion % 2 == 0 ? step : 0.005 * step);
        for (int other = 0; motion % 3 == 2 && other < 8; ++other) {
          const Pair<double> candidate = random_step(random, step);
          if (attack.is_inside(candidate) && attack.created(candidate) > attack.created(by)) by = candidate;
        }
        if (!attack.is_inside(by)) by = -1.0 * by;
        if (!attack.is_inside(by)) continue;
        risen += attack.created(by), paid += std::abs(attack.work(by));
        attack.move(by);
        ASSERT_LE(risen, 1e-12 * paid) << "case " << i << ", motion " << motion << ", step " << k;
      }
    }
  }
}

// The swing that asks for most, where the certificate says that most is needed, with nine tenths of that. Of 200
// networks of springs alone 98 % give more than they stored, and of such where three in ten relax 81 %: what relaxes
// asks for most in faster motions than late springs do, and both are counted in full.
TEST(Attack, NineTenthsAreNotEnoughForLateTorques) {
  Random random(55);
  const std::size_t cases = repetitions(40, 200);
  for (const bool relaxes : {false, true}) {
    std::size_t gained = 0;
    for (std::size_t i = 0; i < cases; ++i) {
      const int delay = 1 + int(random.index(2));
      Case one = random_case(random, 1e-6, 0.02, delay, relaxes);
      const Swing swing = hardest_swing_at(one.needed.joints, one, delay);
      LateAttack attack(one, 0.9 * one.needed.proved, swing.joints, delay);
      double work = 0, before = 0;
      for (std::size_t k = 0; k < 20 * Swing::length; ++k) {
        if (k == 18 * Swing::length) work = 0, before = attack.stored();
        const Pair<double> by = swing.step(k, 1e-6);
        work += attack.work(by);
        attack.move(by);
      }
      gained += work < attack.stored() - before - 1e-12 * before && work < 0 ? 1 : 0;
    }
    EXPECT_GE(gained, cases * (relaxes ? 15 : 19) / 20);
    RecordProperty(relaxes ? "gained" : "gained_by_springs", int(gained));
  }
}

// A field alike in all directions, of which brakes make the diagonal and motors the rest from the mean of the last
// differences, n samples late and behind an amplifier that lags by τ.
struct FieldCase {
  Arm arm;
  Pair<double> weight;
  double field, lag;
  std::size_t taken, late;  // differences in the mean, samples of delay
  double size;              // ‖R‖
};

const std::vector<Brake> on_both_joints{{{1, 0}}, {{0, 1}}};

// Alike in all directions and everywhere [N·s/m].
ViscousField uniform(double damping) {
  ViscousField field;
  field.at_knot = {{{{damping, 0}, {0, damping}}}};
  return field;
}

FieldCase random_field_case(Random& random) {
  FieldCase one{
      every_arm[random.index(4)], {1, 1}, random.log_uniform(0.1, 10), 0, 1 + random.index(5), random.index(3), 0};
  one.weight = {one.arm.proximal * one.arm.proximal, one.arm.distal * one.arm.distal};
  if (random.chance(0.5)) one.lag = period * random.log_uniform(0.1, 5);
  one.size =
      largest_remainder(one.arm, room, {}, uniform(one.field), on_both_joints, BrakeRule::diagonal, one.weight).most;
  return one;
}

// Work that motors and a damping x W take from a hand that moves the joints evenly over each hold; the brakes are off.
class FieldAttack {
 public:
  FieldAttack(const FieldCase& one, double damping, const Pair<double>& at)
      : case_(one), damping_(damping), q_(at), steps_(one.taken + one.late, Pair<double>{0, 0}) {}

  double move(const Pair<double>& by) {
    const Pair<double> told = torque(), lacking = given_ - told;
    double left = 0, held = 0;  // of what is lacking at the end of a hold, and of its mean over it
    if (case_.lag > 0) {
      left = std::exp(-period / case_.lag);
      held = case_.lag / period * (1 - left);
    }
    given_ = told + left * lacking;
    const double heat = damping_ * (case_.weight[0] * by[0] * by[0] + case_.weight[1] * by[1] * by[1]) / period;
    q_ = q_ + by;
    steps_.insert(steps_.begin(), by);
    steps_.pop_back();
    return dot(told + held * lacking, by) + heat;
  }
  bool is_inside(const Pair<double>& by) const {
    const Pair<double> tip = pose(case_.arm, q_ + by).tip;
    return room[0].holds(tip[0]) && room[1].holds(tip[1]);
  }

 private:
  Pair<double> torque() const {
    const Symmetric<double> wanted = at_joints(pose(case_.arm, q_), Symmetric<double>{case_.field, 0, case_.field});
    const Symmetric<double> rest = wanted - made_by(on_both_joints, diagonal(on_both_joints, wanted));
    Pair<double> rate{0, 0};
    for (std::size_t i = 0; i < case_.taken; ++i)
      rate = rate + (1 / (period * double(case_.taken))) * steps_[case_.late + i];
    return {rest.xx * rate[0] + rest.xy * rate[1], rest.xy * rate[0] + rest.yy * rate[1]};
  }

  const FieldCase& case_;
  double damping_;
  Pair<double> q_, given_{0, 0};
  std::vector<Pair<double>> steps_;
};

// The energy taken in by a motion and the rest that follows it, and what it would be with no damping added.
TEST(Attack, EstimatesGiveNothingAtTheBound) {
  Random random(52);
  const std::size_t cases = repetitions(12, 200);
  std::size_t gained = 0;
  for (std::size_t i = 0; i < cases; ++i) {
    const FieldCase one = random_field_case(random);
    ASSERT_TRUE(std::isfinite(one.size) && one.size > 0);
    bool gains = false;
    for (std::size_t turn = 1; turn <= 8; ++turn) {  // to and fro every so many samples, in a direction R turns most
      for (const double sign : {1.0, -1.0}) {
        const Pair<double> by{1e-5, sign * 1e-5 * std::sqrt(one.weight[0] / one.weight[1])};
        const Pair<double> start =
            *joints_at(one.arm, random_tip(random, {Interval(-3e-3, 3e-3), Interval(89e-3, 91e-3)}));
        FieldAttack proved(one, one.size, start), half(one, 0.4 * one.size, start);
        double work = 0, heat = 0, with_half = 0;
        for (std::size_t k = 0; k < 400; ++k) {
          const Pair<double> now =
              random.chance(0.05) ? random_step(random, 1e-5) : (k / turn % 2 == 0 ? by : -1.0 * by);
          const Pair<double> way = proved.is_inside(now) ? now : -1.0 * now;
          const double taken = proved.move(way);
          work += taken, heat += std::abs(taken), with_half += half.move(way);
          ASSERT_GE(work, -1e-12 * heat) << "case " << i << ", step " << k;
        }
        gains = gains || with_half < 0;
      }
    }
    gained += gains ? 1 : 0;
  }
  EXPECT_GE(gained, cases / 4);  // 0.4 of it is too little: not where R is small at the place, or hardly late
  RecordProperty("gained", int(gained));
}

// Springs behind amplifiers that lag, and what that costs beside the bound: L Σ (S ‖g gᵀ‖ + ½ |M| ‖H‖).
TEST(Attack, LaggingAmplifiersGiveNothingAtTheBound) {
  Random random(53);
  const std::size_t cases = repetitions(12, 200);
  std::size_t gained = 0;
  for (std::size_t i = 0; i < cases; ++i) {
    Case one = random_case(random, 1e-5, 0.08);
    const double lag = period * random.log_uniform(0.1, 5), left = std::exp(-period / lag);
    compiler::SampledLoop loop;
    loop.sample_period = period, loop.amplifier_lag = lag;
    double springs = 0;
    for (const Network& network : one.networks) {
      PortLoad load{network.map};
      load.grounded = network.grounded, load.held = network.hold();
      load.relaxing = network.gain.empty() ? 0 : network.gain[0];
      springs += load.held * largest_gradient(one.arm, room, load.map, one.weight).most +
                 largest_turning(one.arm, room, load, one.weight).most / 2;
    }
    const double besides = compiler::time_of_lag(loop) * springs;
    bool gains = false;
    for (std::size_t turn = 1; turn <= 32; turn *= 2) {
      const double angle = random.uniform(0, pi);
      const Pair<double> by{1e-5 * std::cos(angle) / std::sqrt(one.weight[0] / one.weight[1]), 1e-5 * std::sin(angle)};
      for (const double damping : {one.needed.proved + besides, one.needed.proved}) {
        Attack attack(one, damping, one.needed.joints);
        Pair<double> lacking{0, 0}, told = attack.torque();
        const double before = attack.stored();
        double work = 0, paid = before;
        for (std::size_t k = 0; k < 512; ++k) {
          const Pair<double> way = k / turn % 2 == 0 ? by : -1.0 * by;
          lacking = lacking + (told - attack.torque()), told = attack.torque();
          const double taken = attack.work(way) + lag / period * (1 - left) * dot(lacking, way);
          work += taken, paid += std::abs(taken);
          lacking = left * lacking;
          attack.move(way);
          if (damping > one.needed.proved) {
            ASSERT_LE(attack.stored() - before - work, 1e-12 * paid) << "case " << i << ", step " << k;
          } else {
            gains = gains || attack.stored() - before - work > 1e-9 * paid;
          }
        }
      }
    }
    gained += gains ? 1 : 0;
  }
  EXPECT_GE(gained, cases / 2);  // with nothing for the lag
  RecordProperty("gained", int(gained));
}

}  // namespace
}  // namespace dashpot::testing
