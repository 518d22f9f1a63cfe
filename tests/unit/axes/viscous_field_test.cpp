// Viscous fields: what is refused, how they are split, and that the gate keeps the rest passive but little more does
// not.
#include <gtest/gtest.h>

#include <algorithm>

#include <dashpot/estimators/any_estimator.hpp>

#include "arms.hpp"
#include "axes/brakes.hpp"
#include "axes/viscous_field.hpp"
#include "certify/estimator_factors.hpp"
#include "support/repetitions.hpp"

namespace dashpot::testing {
namespace {

using Field = Matrix<double>;

double power(const Field& a, const Pair<double>& v) {
  return -(v[0] * (a[0][0] * v[0] + a[0][1] * v[1]) + v[1] * (a[1][0] * v[0] + a[1][1] * v[1]));
}

// A field that drives the tool is told with a direction and the power there; one that only turns it is not refused.
TEST(ViscousField, DrivingFieldsAreToldWithTheirPower) {
  EXPECT_FALSE(driving({{{5, -2}, {2, 5}}}));
  EXPECT_FALSE(driving({{{0, -2}, {2, 0}}}));
  EXPECT_FALSE(driving({{{1, 1}, {1, 1}}}));
  const auto pushes = driving({{{1, 3}, {3, 1}}});
  ASSERT_TRUE(pushes);
  EXPECT_NEAR(pushes->power, 2, 1e-15);  // (1, −1)/√2: 1 − 3
  EXPECT_NEAR(std::abs(pushes->direction[0] + pushes->direction[1]), 0, 1e-15);
  EXPECT_NEAR(driving({{{5, 0}, {0, -0.5}}})->direction[0], 0, 1e-15);
  EXPECT_NEAR(driving({{{-1, 0}, {0, -1}}})->power, 1, 1e-15);
  Random random(30);
  for (int i = 0; i < 500; ++i) {
    const Field a{{{random.uniform(-1, 1), random.uniform(-1, 1)}, {random.uniform(-1, 1), random.uniform(-1, 1)}}};
    const auto found = driving(a);
    double most = 0;
    for (double angle = 0; angle < pi; angle += 1e-3)
      most = std::max(most, power(a, {std::cos(angle), std::sin(angle)}));
    EXPECT_EQ(found.has_value(), most > 0);
    if (found) {
      EXPECT_NEAR(found->power, most, 1e-6);
      EXPECT_NEAR(power(a, found->direction), found->power, 1e-14);
    }
  }
}

// Round a circle of 20 mm [[500, −100], [100, 500]] N/m gives 200 N/m times its area.
TEST(ViscousField, CurlInPositionIsToldByTheLoop) {
  EXPECT_FALSE(curl_in_position({{{500, 100}, {100, 300}}}));
  const Field k{{{500, -100}, {100, 500}}};
  const std::optional<double> curl = curl_in_position(k);
  ASSERT_TRUE(curl);
  double work = 0;
  const int steps = 4000;
  const double radius = 20e-3, turn = 2 * pi / steps;
  for (int i = 0; i < steps; ++i) {
    const double x = radius * std::cos(i * turn), y = radius * std::sin(i * turn);
    work += (k[0][0] * x + k[0][1] * y) * -y * turn + (k[1][0] * x + k[1][1] * y) * x * turn;
  }
  EXPECT_NEAR(work, *curl * pi * radius * radius, 1e-12);
}

ViscousField random_field(Random& random) {
  ViscousField field{{-0.03, 0.07}, {0.02, 0.01}, {4, 3}, {}};
  for (int i = 0; i < 12; ++i)
    field.at_knot.push_back(
        {{{random.uniform(1, 2), random.uniform(-1, 1)}, {random.uniform(-1, 1), random.uniform(1, 2)}}});
  return field;
}

// Between knots a field is the mean of four, beyond them what is nearest, and an enclosure over a box holds all of it.
TEST(ViscousField, OverAGridItIsBilinear) {
  Random random(32);
  for (int i = 0; i < 100; ++i) {
    const ViscousField field = random_field(random);
    const auto weight = [&](std::size_t axis, std::size_t knot, double x) {
      const double place =
          std::clamp((x - field.start[axis]) / field.spacing[axis], 0.0, double(field.knots[axis] - 1));
      return std::max(0.0, 1 - std::abs(place - double(knot)));
    };
    const Box box{Interval(random.uniform(-0.05, 0.04)), Interval(random.uniform(0.06, 0.1))};
    const Box wide{Interval{box[0].low, box[0].low + random.uniform(0, 0.03)},
                   Interval{box[1].low, box[1].low + random.uniform(0, 0.02)}};
    const Matrix<Sloped> enclosed = field_at(field, variables(wide));
    for (int k = 0; k < 20; ++k) {
      const Pair<double> x{random.uniform(wide[0].low, wide[0].high), random.uniform(wide[1].low, wide[1].high)};
      Field due{};
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column)
          for (std::size_t entry = 0; entry < 4; ++entry)
            due[entry / 2][entry % 2] +=
                weight(0, column, x[0]) * weight(1, row, x[1]) * field.at_knot[4 * row + column][entry / 2][entry % 2];
      const Field there = field_at(field, x);
      for (std::size_t entry = 0; entry < 4; ++entry) {
        const double value = there[entry / 2][entry % 2];
        const Sloped& over = enclosed[entry / 2][entry % 2];
        EXPECT_NEAR(value, due[entry / 2][entry % 2], 1e-13);
        EXPECT_GE(value, over.value.low - 1e-13);
        EXPECT_LE(value, over.value.high + 1e-13);
        // From the middle it goes no further than its slopes say.
        Interval reached = over.middle;
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const double half = wide[axis].width() / 2;
          if (half > 0) reached = reached + over.slope[axis] * Interval((x[axis] - wide[axis].middle()) / half);
        }
        EXPECT_GE(value, reached.low - 1e-13);
        EXPECT_LE(value, reached.high + 1e-13);
      }
    }
  }
}

// At the joints the same force is made: [[p, r + σ], [r − σ, s]] = JᵀAJ, and a curl stays one: σ = ½(a12 − a21) det J.
TEST(ViscousField, JointsMakeTheFieldOfTheTip) {
  const Field a{{{5, -1}, {2, 3}}};
  Random random(31);
  for (int i = 0; i < 50; ++i) {
    const Pose<double> at = pose(five_bar_arm, *joints_at(five_bar_arm, random_tip(random)));
    const JointField<double> field = at_joints(at, a, false);
    const Pair<double> rate{random.uniform(-1, 1), random.uniform(-1, 1)};
    const Pair<double> v = rate[0] * at.column[0] + rate[1] * at.column[1];
    const Pair<double> torque =
        at_joints(at, Pair<double>{a[0][0] * v[0] + a[0][1] * v[1], a[1][0] * v[0] + a[1][1] * v[1]});
    EXPECT_NEAR(field.p * rate[0] + (field.r + field.sigma) * rate[1], torque[0], 1e-16);
    EXPECT_NEAR((field.r - field.sigma) * rate[0] + field.s * rate[1], torque[1], 1e-16);
    const double det = at.column[0][0] * at.column[1][1] - at.column[0][1] * at.column[1][0];
    EXPECT_NEAR(field.sigma, -1.5 * det, 1e-16);
  }
}

// A loop whose poses, and so dampings, couplings and curls, change at every sample. Of the work of brakes and motors
//
//     Σ_k (d_k,1 Δq_k+n+1,1² + d_k,2 Δq_k+n+1,2²)/T + g_k,1 v̂_k,2 Δq_k+n+1,1 + g_k,2 v̂_k,1 Δq_k+n+1,2
//
// with n samples of delay and v̂ of each joint a sum of its last differences over h, own weights for each, the least
// over all motions is an eigenvalue.
struct GatedLoop {
  std::vector<std::array<double, 2>> brake;
  std::vector<Pair<double>> coupling;         // g
  std::array<std::vector<double>, 2> weight;  // of the difference j samples ago
  std::size_t delay = 0;                      // n
  double shortest, longest;                   // periods [s]

  std::vector<std::vector<double>> work() const {
    const std::size_t steps = brake.size(), n = 2 * steps;
    std::vector<std::vector<double>> form(n, std::vector<double>(n));
    for (std::size_t k = 0; k < steps; ++k) {
      for (const std::size_t joint : {0u, 1u}) {
        form[2 * k + joint][2 * k + joint] += brake[k][joint] / longest;
        const std::size_t other = 1 - joint;
        const double gain = coupling[k][joint] / shortest;
        for (std::size_t j = 0; j < weight[other].size() && j + delay < k; ++j) {
          const std::size_t row = 2 * k + joint, column = 2 * (k - 1 - j - delay) + other;
          form[row][column] += 0.5 * gain * weight[other][j];
          form[column][row] += 0.5 * gain * weight[other][j];
        }
      }
    }
    return form;
  }
};

// Whether a symmetric matrix plus `slack` on its diagonal is positive definite: Cholesky's factors exist.
bool is_positive(std::vector<std::vector<double>> m, double slack) {
  for (std::size_t i = 0; i < m.size(); ++i) m[i][i] += slack;
  for (std::size_t i = 0; i < m.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) m[i][i] -= m[i][k] * m[i][k];
    if (!(m[i][i] > 0)) return false;
    m[i][i] = std::sqrt(m[i][i]);
    for (std::size_t j = i + 1; j < m.size(); ++j) {
      for (std::size_t k = 0; k < i; ++k) m[j][i] -= m[j][k] * m[i][k];
      m[j][i] /= m[i][i];
    }
  }
  return true;
}

constexpr double least_damping = 1e-3;  // of a brake of a random loop

// What an estimator's weights and the delay ask of a gate, and commands that act late; half of the least allowance is
// kept for limits that grow.
CurlGate gate_for(const GatedLoop& loop, double omega, bool is_late) {
  CurlGate gate;
  const double each = 2 * loop.shortest / loop.longest;
  gate.factor = {each / omega, each * omega};
  double age = 0;
  for (const std::vector<double>& weights : loop.weight) {
    double gain = 0, sum = 0;
    for (std::size_t j = 0; j < weights.size(); ++j) {
      gain += std::abs(weights[j]);
      sum += std::abs(weights[j]) * double(j + loop.delay + (is_late ? 1 : 0));
    }
    gate.gain = std::max(gate.gain, gain), age = std::max(age, sum);
  }
  gate.reserve = 0.5 * std::min(gate.factor[0], gate.factor[1]) * least_damping;
  gate.recovery = age > 0 ? gate.reserve / age : 1;
  if (age == 0) gate.reserve = 0;
  return gate;
}

// Couplings are as large as the gate lets them be, and `stretch` times that; wanted are some that it lets pass and some
// that it does not.
GatedLoop random_loop(Random& random, double stretch, bool is_late = false) {
  GatedLoop loop;
  loop.shortest = 1e-3, loop.longest = 1e-3 * random.uniform(1, 1.3);
  loop.delay = random.chance(0.5) ? 0 : random.between(1, 2);
  const std::size_t memory = random.between(1, 5);
  for (std::vector<double>& weights : loop.weight) {
    weights.assign(memory, 0.0);
    if (random.chance(0.3)) weights[random.index(memory)] = 1;
    else if (random.chance(0.5)) weights.assign(memory, 1 / double(memory));
    else
      for (double& one : weights) one = random.uniform(-0.2, 0.8);
  }
  const CurlGate gate = gate_for(loop, random.log_uniform(0.5, 2), is_late);
  const double largest = random.log_uniform(0.003, 0.03);
  Pair<double> left{0, 0};
  for (std::size_t k = 0; k < 60; ++k) {
    loop.brake.push_back({random.log_uniform(least_damping, 1e-2), random.log_uniform(least_damping, 1e-2)});
    const Gated<double> passed = gated(gate, Pair<double>{loop.brake[k][0], loop.brake[k][1]},
                                       random.uniform(-largest, largest), random.uniform(-largest, largest), left);
    loop.coupling.push_back(stretch * passed.coupling);
    left = passed.left;
  }
  return loop;
}

// No motion takes energy out of what the gate lets pass, and of twice as much some motion of some loop does.
TEST(Gate, KeepsEveryMotionPassive) {
  Random random(32);
  int beyond = 0;
  const int cases = int(repetitions(100, 5000));
  for (int i = 0; i < cases; ++i) {
    EXPECT_TRUE(is_positive(random_loop(random, 1).work(), 1e-12))
        << i;  // of 1 to 10 N·s/m over a period: 1e-12 of scale
    beyond += is_positive(random_loop(random, 2).work(), 0) ? 0 : 1;
  }
  EXPECT_GT(beyond, cases / 20);
}

// A field that stays passes whole where max(|r|, |σ|) ≤ √(p s), and 2 % beyond that it gives energy: nothing is given
// away.
TEST(Gate, ConstantPassiveFieldsPassUnlimited) {
  for (const auto& [r, sigma] : {Pair<double>{0, 2}, Pair<double>{2, 0}, Pair<double>{-2, 2}, Pair<double>{1.3, -2}}) {
    const JointField<double> field{4, r, 1, sigma};
    const double omega = gate_ratio({{field.p, field.s}});
    EXPECT_NEAR(omega, 2, 1e-12);
    CurlGate gate;
    gate.factor = {2 / omega, 2 * omega}, gate.recovery = 0.1;
    Gated<double> passed{};
    for (int k = 0; k < 100; ++k) passed = gated(gate, Pair<double>{field.p, field.s}, r, sigma, passed.left);
    const Pair<double> wanted{r + sigma, r - sigma};
    EXPECT_NEAR(passed.coupling[0], wanted[0], 1e-12);
    EXPECT_NEAR(passed.coupling[1], wanted[1], 1e-12);
    for (const double stretch : {1.0, 1.02}) {
      GatedLoop loop;
      loop.shortest = loop.longest = 1;
      loop.weight = {std::vector<double>{1}, std::vector<double>{1}};
      loop.brake.assign(60, {field.p, field.s});
      loop.coupling.assign(60, stretch * wanted);
      EXPECT_EQ(is_positive(loop.work(), 1e-9), stretch == 1.0) << r << " " << sigma;
    }
  }
}

// Where more is wanted than passes, the gate settles: both couplings come to equal parts, and stay within what limits
// grow by in a sample.
TEST(Gate, SettlesWhereItLimits) {
  CurlGate gate;
  gate.recovery = 0.02, gate.reserve = 0.02;
  Gated<double> passed{};
  for (int k = 0; k < 1000; ++k) {
    passed = gated(gate, Pair<double>{1, 1}, 0.0, 3.0, passed.left);
    if (k < 100) continue;
    EXPECT_NEAR(passed.coupling[0], 0.99, 0.02) << k;
    EXPECT_NEAR(passed.coupling[1], -0.99, 0.02) << k;
  }
  // One that had all of it leaves half of it to the other.
  for (int k = 0; k < 1000; ++k) passed = gated(gate, Pair<double>{1, 1}, 3.0, 3.0, passed.left);
  EXPECT_NEAR(passed.coupling[0], 1.98, 0.02);
  for (int k = 0; k < 1000; ++k) passed = gated(gate, Pair<double>{1, 1}, 0.0, 3.0, passed.left);
  EXPECT_NEAR(passed.coupling[0], 0.99, 0.02);
  EXPECT_NEAR(passed.coupling[1], -0.99, 0.02);
}

// Couplings that are each passive while they stay are not while they change: at one sample joint 1 has all of what
// joint 2 has at the next. A gate that looks at max(|r|, |σ|) alone lets this pass.
TEST(Gate, LimitsCouplingsAcrossSamples) {
  GatedLoop loop;
  loop.shortest = loop.longest = 1;
  loop.weight = {std::vector<double>{1}, std::vector<double>{1}};
  CurlGate gate;
  gate.recovery = 4;
  Pair<double> left{0, 0};
  GatedLoop ungated = loop;
  for (int k = 0; k < 20; ++k) {
    const double sigma = k % 2 == 0 ? 1 : -1;
    const Gated<double> passed = gated(gate, Pair<double>{1, 1}, 1.0, sigma, left);
    left = passed.left;
    for (GatedLoop* one : {&loop, &ungated}) one->brake.push_back({1, 1});
    loop.coupling.push_back(passed.coupling);
    ungated.coupling.push_back({1 + sigma, 1 - sigma});
  }
  EXPECT_TRUE(is_positive(loop.work(), 1e-12));
  EXPECT_FALSE(is_positive(ungated.work(), 0.1));
}

// Weights of both signs: an estimate may then be larger than any of its differences, by their γ. A gate that lets the
// other joint have (A − |g|)/γ lets this pass.
TEST(Gate, CountsWeightsOfBothSigns) {
  GatedLoop loop;
  loop.shortest = loop.longest = 1;
  loop.weight = {std::vector<double>{1.5, -0.5}, std::vector<double>{1.5, -0.5}};
  CurlGate gate;
  gate.gain = 2, gate.reserve = 0.02, gate.recovery = 0.04;  // Σ |e_j| (j − 1) = ½
  Pair<double> left{0, 0};
  GatedLoop shared = loop;
  for (int k = 0; k < 60; ++k) {
    const Gated<double> passed = gated(gate, Pair<double>{1, 1}, 0.5, k % 2 == 0 ? 0.15 : -0.4, left);
    left = passed.left;
    for (GatedLoop* one : {&loop, &shared}) one->brake.push_back({1, 1});
    loop.coupling.push_back(passed.coupling);
    shared.coupling.push_back(k % 2 == 0 ? Pair<double>{0.65, 0.33} : Pair<double>{0.07, 0.66});  // 0.65 + 2 · 0.66 < 2
  }
  EXPECT_TRUE(is_positive(loop.work(), 1e-12));
  EXPECT_FALSE(is_positive(shared.work(), 0.02));
}

// Commands that act a part of a period after their samples, of two joints: what moves between two samples does so under
// two commands. The least work over all motions, each either side of a write as it likes.
std::vector<std::vector<double>> work_of_late(const GatedLoop& loop, double part) {
  const std::size_t steps = loop.brake.size(), n = 4 * steps;
  std::vector<std::vector<double>> form(n, std::vector<double>(n));
  const double lasts[] = {part * loop.longest, (1 - part) * loop.longest};  // before and after the write
  for (std::size_t k = 1; k < steps; ++k)
    for (const std::size_t side : {0u, 1u})
      for (const std::size_t joint : {0u, 1u}) {
        const std::size_t told = side == 0 ? k - 1 : k, row = 4 * k + 2 * side + joint, other = 1 - joint;
        form[row][row] += loop.brake[told][joint] / lasts[side];
        const double gain = loop.coupling[told][joint] / loop.shortest;
        for (std::size_t j = 0; j < loop.weight[other].size() && j + loop.delay < told; ++j)
          for (const std::size_t of : {0u, 1u}) {
            const std::size_t column = 4 * (told - 1 - j - loop.delay) + 2 * of + other;
            form[row][column] += 0.5 * gain * loop.weight[other][j];
            form[column][row] += 0.5 * gain * loop.weight[other][j];
          }
      }
  for (std::size_t i = 0; i < 4; ++i) form[i][i] = 1;  // nothing acts on the first
  return form;
}

// If this fails, what the gate keeps for commands that act late is too little.
TEST(Gate, KeepsLateCommandsPassive) {
  Random random(33);
  int beyond = 0;
  const int cases = int(repetitions(60, 2000));
  for (int i = 0; i < cases; ++i) {
    const double part = random.uniform(0.05, 0.95);
    EXPECT_TRUE(is_positive(work_of_late(random_loop(random, 1, true), part), 1e-12)) << i;
    beyond += is_positive(work_of_late(random_loop(random, 2, true), part), 0) ? 0 : 1;
  }
  EXPECT_GT(beyond, cases / 20);
}

// What a gate is told of an estimator is what the runtime's answers to one step: its weights, and how old they are.
TEST(EstimateMemory, IsThatOfTheRuntimesEstimators) {
  using compiler::SampledLoop;
  std::vector<velocity_description> all(5);
  all[0].estimator = estimator_kind::backward_difference, all[0].window = 1;
  all[1].estimator = estimator_kind::backward_difference, all[1].window = 10;
  all[2].estimator = estimator_kind::butterworth, all[2].order = 2, all[2].cutoff = 200;
  all[3].estimator = estimator_kind::butterworth, all[3].order = 4, all[3].cutoff = 20;
  all[4].estimator = estimator_kind::least_squares, all[4].window = 16;
  for (const velocity_description& velocity : all) {
    SampledLoop loop;
    loop.has_device = true, loop.sample_period = 1e-4, loop.velocity = velocity, loop.joint_encoder_step = 1e-4;
    const auto memory = compiler::estimate_memory(loop);
    ASSERT_TRUE(memory) << name_of(velocity.estimator);
    any_estimator<double> estimator(velocity, loop.sample_period, loop.joint_encoder_step);
    estimator.reset(0);
    double gain = 0, age = 0;
    for (int j = 0; j < 20000; ++j) {
      device_sample sample;
      sample.position = 1;
      const double weight = std::abs(estimator.update(sample)) * loop.sample_period;
      gain += weight, age += j * weight;
    }
    // It is told too large by 1e-9.
    EXPECT_NEAR(memory->gain, gain, 1e-8 * gain) << name_of(velocity.estimator);
    EXPECT_NEAR(memory->age, age, 1e-8 * age + 1e-15) << name_of(velocity.estimator);
  }
  SampledLoop adaptive;
  adaptive.has_device = true, adaptive.sample_period = 1e-4, adaptive.joint_encoder_step = 1e-4;
  adaptive.velocity.estimator = estimator_kind::foaw, adaptive.velocity.window = 16;
  EXPECT_FALSE(compiler::estimate_memory(adaptive));
}

}  // namespace
}  // namespace dashpot::testing
