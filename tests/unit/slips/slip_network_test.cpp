// The solver of slips outside trees by itself, between random springs.
#include <dashpot/slip_network.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "counted.hpp"
#include "support/random.hpp"

namespace dashpot::testing {
namespace {

// Ends, slips and springs at random; every end is tied to tool or ground by something, and these two not by slips
// alone.
struct Problem {
  int nodes;
  std::vector<slip_link<double>> links;
  std::vector<double> between, to_tool, to_ground, held;

  double tie(int i, int j) const { return between[static_cast<std::size_t>(i * nodes + j)]; }
  int slips() const { return static_cast<int>(links.size()); }
};

class Sets {
 public:
  explicit Sets(int size) : set_(static_cast<std::size_t>(size)) { std::iota(set_.begin(), set_.end(), 0); }
  void unite(int a, int b) {
    const int from = of(a), to = of(b);
    std::replace(set_.begin(), set_.end(), from, to);
  }
  int of(int i) const { return set_[static_cast<std::size_t>(i)]; }

 private:
  std::vector<int> set_;
};

// What the tool was tied to is tied to the first end, which the tool pushes.
void put_behind_contact(Problem& p) {
  for (std::size_t i = 1; i < p.to_tool.size(); ++i) p.between[i] = p.between[i * p.to_tool.size()] = p.to_tool[i];
  p.to_tool.assign(p.to_tool.size(), 0);
  std::erase_if(p.links,
                [&](const auto& link) { return std::min(link.a, link.b) == 0 && std::max(link.a, link.b) == p.nodes; });
  for (auto& link : p.links)
    for (int* end : {&link.a, &link.b})
      if (*end == p.nodes) *end = 0;
  p.links.push_back({p.nodes, 0, 0, std::numeric_limits<double>::max()});
}

Problem random_ties(Random& random) {
  Problem p;
  p.nodes = static_cast<int>(random.between(1, 7));
  const auto nodes = static_cast<std::size_t>(p.nodes);
  p.between.assign(nodes * nodes, 0);
  p.to_tool.assign(nodes, 0);
  p.to_ground.assign(nodes, 0);
  const double density = random.uniform(0.2, 1), stiffest = random.chance(0.5) ? 10 : 1e6;
  for (std::size_t i = 0; i < nodes; ++i) {
    if (random.chance(density / 2)) p.to_tool[i] = random.log_uniform(1, stiffest);
    if (random.chance(density / 2)) p.to_ground[i] = random.log_uniform(1, stiffest);
    for (std::size_t j = 0; j < i; ++j)
      if (random.chance(density)) p.between[i * nodes + j] = p.between[j * nodes + i] = random.log_uniform(1, stiffest);
  }
  const std::size_t slips = random.between(1, 5);
  while (p.links.size() < slips) {
    const int a = static_cast<int>(random.index(nodes + 2)), b = static_cast<int>(random.index(nodes + 2));
    const double yield = random.chance(0.25) ? 1 : random.log_uniform(0.1, stiffest);
    if (a != b && std::min(a, b) < p.nodes) p.links.push_back({a, b, -yield, yield});
  }
  if (random.chance(0.3)) put_behind_contact(p);
  return p;
}

bool is_legal(const Problem& p) {
  Sets sets(p.nodes + 2);
  for (const auto& link : p.links) sets.unite(link.a, link.b);
  if (sets.of(p.nodes) == sets.of(p.nodes + 1)) return false;
  sets.unite(p.nodes, p.nodes + 1);
  for (int i = 0; i < p.nodes; ++i) {
    if (p.to_tool[static_cast<std::size_t>(i)] > 0) sets.unite(i, p.nodes);
    if (p.to_ground[static_cast<std::size_t>(i)] > 0) sets.unite(i, p.nodes);
    for (int j = 0; j < i; ++j)
      if (p.tie(i, j) > 0) sets.unite(i, j);
  }
  for (int i = 0; i < p.nodes; ++i)
    if (sets.of(i) != sets.of(p.nodes)) return false;
  return true;
}

Problem random_problem(Random& random) {
  Problem p = random_ties(random);
  while (!is_legal(p)) p = random_ties(random);
  return p;
}

// Held by the springs, so that parts that only slips hold are in balance.
void hold(Problem& p, Random& random) {
  const auto nodes = static_cast<std::size_t>(p.nodes);
  p.held.assign(nodes + 1, 0);
  for (std::size_t i = 0; i < nodes; ++i) {
    if (p.to_tool[i] > 0) {
      const double force = random.uniform(-3, 3);
      p.held[i] += force;
      p.held[nodes] -= force;
    }
    if (p.to_ground[i] > 0) p.held[i] += random.uniform(-3, 3);
    for (std::size_t j = 0; j < i; ++j) {
      if (p.between[i * nodes + j] == 0) continue;
      const double force = random.uniform(-3, 3);
      p.held[i] += force;
      p.held[j] -= force;
    }
  }
}

template <class Scalar>
class NetworkSteps {
 public:
  explicit NetworkSteps(const Problem& p)
      : problem(p),
        moved(static_cast<std::size_t>(p.nodes)),
        sign(p.links.size(), 0),
        between_(p.between.begin(), p.between.end()),
        to_tool_(p.to_tool.begin(), p.to_tool.end()),
        to_ground_(p.to_ground.begin(), p.to_ground.end()),
        group_(moved.size() + 2),
        room_(between_.size()),
        numbers_(8 * moved.size()) {
    for (const auto& link : p.links) links_.push_back({link.a, link.b, Scalar(link.lowest), Scalar(link.highest)});
  }

  Scalar step(double change) {
    const std::vector<Scalar> held(problem.held.begin(), problem.held.end());
    slip_network<Scalar> solver(links_.data(), problem.slips(),
                                {between_.data(), to_tool_.data(), to_ground_.data(), Scalar(0)}, problem.nodes,
                                {group_.data(), room_.data(), numbers_.data()});
    const Scalar force = solver.step(Scalar(change), held.data(), moved.data(), sign.data());
    most_patterns = std::max(most_patterns, solver.patterns_tried());
    return force;
  }

  Problem problem;
  std::vector<Scalar> moved;
  std::vector<int> sign;
  int most_patterns = 0;

 private:
  std::vector<slip_link<Scalar>> links_;
  std::vector<Scalar> between_, to_tool_, to_ground_;
  std::vector<int> group_;
  std::vector<Scalar> room_, numbers_;
};

// How steeply Φ falls when some ends move together, over the sum of all that is rounded there; 0 where it rises.
double steepest_fall(const NetworkSteps<double>& run, double change) {
  const Problem& p = run.problem;
  double worst = 0, scale = 0;
  std::vector<double> pull;
  for (int i = 0; i < p.nodes; ++i) {
    const auto here = static_cast<std::size_t>(i);
    const double x = run.moved[here];
    double sum = p.held[here] + p.to_tool[here] * (x - change) + p.to_ground[here] * x;
    scale +=
        std::abs(p.held[here]) + p.to_tool[here] * (std::abs(x) + std::abs(change)) + p.to_ground[here] * std::abs(x);
    for (int j = 0; j < p.nodes; ++j)
      if (j != i) {
        const double other = run.moved[static_cast<std::size_t>(j)];
        sum += p.tie(i, j) * (x - other);
        scale += p.tie(i, j) * (std::abs(x) + std::abs(other));
      }
    pull.push_back(sum);
  }
  for (const auto& link : p.links) scale -= link.lowest;
  for (unsigned ends = 1; ends < 1u << p.nodes; ++ends)
    for (const int way : {-1, 1}) {
      double slope = 0;
      for (int i = 0; i < p.nodes; ++i) slope += (ends >> i & 1) != 0 ? way * pull[static_cast<std::size_t>(i)] : 0;
      for (std::size_t k = 0; k < p.links.size(); ++k) {
        const auto in = [&](int end) { return end < p.nodes && (ends >> end & 1) != 0 ? way : 0; };
        const int stretch = in(p.links[k].a) - in(p.links[k].b);
        const bool pulls_up = run.sign[k] == 0 ? stretch > 0 : run.sign[k] > 0;
        if (stretch != 0) slope += stretch * (pulls_up ? p.links[k].highest : p.links[k].lowest);
      }
      worst = std::max(worst, -slope / scale);
    }
  return worst;
}

}  // namespace

// If this failed, the step would end where Φ is not least: with all of a network's ends the directions below are those
// that tell.
TEST(SlipNetwork, EndsWhereNothingGoesDown) {
  Random random(4);
  for (int i = 0; i < 3000; ++i) {
    NetworkSteps<double> run(random_problem(random));
    for (int k = 0; k < 10; ++k) {
      hold(run.problem, random);
      const double change = random.uniform(-1, 1) * random.log_uniform(0.01, 10);
      run.step(change);
      // A few dozen roundoffs; the step itself takes 2⁻⁴⁸ for none.
      ASSERT_LT(steepest_fall(run, change), 0x1p-46) << "problem " << i << ", step " << k;
      const auto at = [&](int end) {
        return end == run.problem.nodes  ? change
               : end > run.problem.nodes ? 0.0
                                         : run.moved[static_cast<std::size_t>(end)];
      };
      for (std::size_t s = 0; s < run.sign.size(); ++s) {
        const auto& link = run.problem.links[s];
        const double stretch = at(link.a) - at(link.b), rounding = 1e-12 * (std::abs(change) + std::abs(at(link.a)));
        ASSERT_TRUE(run.sign[s] == 0 ? std::abs(stretch) <= rounding : run.sign[s] * stretch >= -rounding)
            << "problem " << i;
      }
    }
  }
}

// If this failed, the banner would promise fewer operations than a step takes, or the search come to its end without
// having found.
TEST(SlipNetwork, TakesNoMoreOperationsThanStated) {
  Random random(5);
  int most_patterns = 0;
  for (int i = 0; i < 2000; ++i) {
    NetworkSteps<Counted> run(random_problem(random));
    const int each = slip_network_operations_each(run.problem.nodes, run.problem.slips());
    const int once = slip_network_pull_operations(run.problem.nodes, run.problem.slips()) + 4 * run.problem.nodes +
                     run.problem.slips() + 2;
    for (int k = 0; k < 5; ++k) {
      hold(run.problem, random);
      run.most_patterns = 0;
      Counted::operations = 0;
      run.step(random.chance(0.1) ? 0 : random.uniform(-3, 3));
      ASSERT_LE(Counted::operations, run.most_patterns * each + once) << i;
      ASSERT_LE(run.most_patterns, slip_network_patterns(run.problem.links.data(), run.problem.slips()));
      most_patterns = std::max(most_patterns, run.most_patterns);
    }
  }
  EXPECT_LT(most_patterns, 40);
}

// If this failed, a finite force would come with a state that is not, and never heal; or a NaN or infinite sample would
// not end.
TEST(SlipNetwork, EndsWithAnyInput) {
  Random random(8);
  const double huge = std::numeric_limits<double>::max(), infinite = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 200; ++i) {
    NetworkSteps<double> run(random_problem(random));
    hold(run.problem, random);
    for (double change : {huge, -huge, infinite, -infinite, std::nan(""), 0x1p-1074}) {
      run.step(change);
      EXPECT_LE(run.most_patterns, slip_network_patterns(run.problem.links.data(), run.problem.slips()) + 1);
    }
  }
}

}  // namespace dashpot::testing
