// Viscous fields: what is refused, how they are split, and that the gate keeps the rest passive but little more does
// not.
#include <gtest/gtest.h>

#include "arms.hpp"
#include "axes/brakes.hpp"
#include "axes/viscous_field.hpp"
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

// At the joints the same force is made: [[p, r + σ], [r − σ, s]] = JᵀAJ, and a curl stays one: σ = ½(a12 − a21) det J.
TEST(ViscousField, JointsMakeTheFieldOfTheTip) {
  const Field a{{{5, -1}, {2, 3}}};
  Random random(31);
  for (int i = 0; i < 50; ++i) {
    const Pose<double> at = pose(five_bar_arm, *joints_at(five_bar_arm, random_tip(random)));
    const JointField<double> field = at_joints(at, a);
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
//     Σ_k (d_k,1 Δq_k+1,1² + d_k,2 Δq_k+1,2²)/T + g_k,1 v̂_k,2 Δq_k+1,1 + g_k,2 v̂_k,1 Δq_k+1,2
//
// with v̂ of each joint a mean of its last differences over h, own weights for each, the least over all motions is an
// eigenvalue.
struct GatedLoop {
  std::vector<std::array<double, 2>> brake;
  std::vector<Pair<double>> coupling;         // g
  std::array<std::vector<double>, 2> weight;  // of the difference j samples ago
  double shortest, longest;                   // periods [s]

  std::vector<std::vector<double>> work() const {
    const std::size_t steps = brake.size(), n = 2 * steps;
    std::vector<std::vector<double>> form(n, std::vector<double>(n));
    for (std::size_t k = 0; k < steps; ++k) {
      for (const std::size_t joint : {0u, 1u}) {
        form[2 * k + joint][2 * k + joint] += brake[k][joint] / longest;
        const std::size_t other = 1 - joint;
        const double gain = coupling[k][joint] / shortest;
        for (std::size_t j = 0; j < weight[other].size() && j < k; ++j) {
          const std::size_t row = 2 * k + joint, column = 2 * (k - 1 - j) + other;
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

// Couplings are as large as the gate lets them be, and `stretch` times that; wanted are some that it lets pass and some
// that it does not.
GatedLoop random_loop(Random& random, double stretch) {
  GatedLoop loop;
  loop.shortest = 1e-3, loop.longest = 1e-3 * random.uniform(1, 1.3);
  const std::size_t memory = random.between(1, 5);
  for (std::vector<double>& weights : loop.weight) {
    weights.assign(memory, 0.0);
    if (random.chance(0.5)) weights[random.index(memory)] = 1;
    else weights.assign(memory, 1 / double(memory));
  }
  const double omega = random.log_uniform(0.5, 2);
  std::vector<Pair<double>> left(memory, Pair<double>{0, 0});
  for (std::size_t k = 0; k < 40; ++k) {
    loop.brake.push_back({random.log_uniform(1e-3, 1e-2), random.log_uniform(1e-3, 1e-2)});
    const Pair<double> allowance = gate_allowance(loop.brake[k], omega, loop.shortest / loop.longest);
    const Pair<double> wanted{random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03)};
    const Pair<double> passed = gated(wanted, allowance, left);
    loop.coupling.push_back(stretch * passed);
    left.erase(left.begin());
    left.push_back(gate_left(allowance, passed));
  }
  return loop;
}

// No motion takes energy out of what the gate lets pass, and of half as much again some motion of some loop does.
TEST(Gate, KeepsEveryMotionPassive) {
  Random random(32);
  int beyond = 0;
  const int cases = int(repetitions(100, 5000));
  for (int i = 0; i < cases; ++i) {
    EXPECT_TRUE(is_positive(random_loop(random, 1).work(), 1e-12))
        << i;  // of 1 to 10 N·s/m over a period: 1e-12 of scale
    beyond += is_positive(random_loop(random, 1.5).work(), 0) ? 0 : 1;
  }
  EXPECT_GT(beyond, cases / 20);
}

// A field that stays passes whole where max(|r|, |σ|) ≤ √(p s), and 2 % beyond that it gives energy: nothing is given
// away.
TEST(Gate, PassesWhateverIsPassiveWhereNothingVaries) {
  for (const auto& [r, sigma] : {Pair<double>{0, 2}, Pair<double>{2, 0}, Pair<double>{-2, 2}, Pair<double>{1.3, -2}}) {
    const JointField<double> field{4, r, 1, sigma};
    const double omega = gate_ratio({field});
    EXPECT_NEAR(omega, 2, 1e-12);
    const Pair<double> allowance = gate_allowance(Pair<double>{field.p, field.s}, omega, 1.0),
                       wanted{r + sigma, r - sigma};
    const std::vector<Pair<double>> left(3, gate_left(allowance, wanted));
    EXPECT_NEAR(gated(wanted, allowance, left)[0], wanted[0], 1e-12);
    EXPECT_NEAR(gated(wanted, allowance, left)[1], wanted[1], 1e-12);
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

// Couplings that are each passive while they stay are not while they change: at one sample joint 1 has all of what
// joint 2 has at the next. A gate that looks at max(|r|, |σ|) alone lets this pass.
TEST(Gate, LimitsCouplingsAcrossSamples) {
  GatedLoop loop;
  loop.shortest = loop.longest = 1;
  loop.weight = {std::vector<double>{1}, std::vector<double>{1}};
  std::vector<Pair<double>> left(1, Pair<double>{0, 0});
  GatedLoop ungated = loop;
  for (int k = 0; k < 20; ++k) {
    const Pair<double> brake{1, 1}, wanted = k % 2 == 0 ? Pair<double>{2, 0} : Pair<double>{0, 2};  // r = 1, σ = ±1
    const Pair<double> allowance = gate_allowance(brake, 1.0, 1.0), passed = gated(wanted, allowance, left);
    left = {gate_left(allowance, passed)};
    for (GatedLoop* one : {&loop, &ungated}) one->brake.push_back({1, 1});
    loop.coupling.push_back(passed);
    ungated.coupling.push_back(wanted);
  }
  EXPECT_TRUE(is_positive(loop.work(), 1e-12));
  EXPECT_FALSE(is_positive(ungated.work(), 0.1));
}

}  // namespace
}  // namespace dashpot::testing
