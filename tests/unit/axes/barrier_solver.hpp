// The least tr(C R), R = B − Σ d_j a_j a_jᵀ ≥ 0, 0 ≤ d_j ≤ most_j, by a method that knows nothing of closed forms:
// Newton's steps along the central path of
//
//     t Σ d_j a_jᵀCa_j + log det R + Σ log d_j + Σ log(most_j − d_j),
//
// whose point at t is a split that is allowed and misses the best tr(C R) by at most (2 + 2n)/t (Boyd & Vandenberghe
// 2004, 11.2).
#pragma once

#include <vector>

#include "axes/brakes.hpp"

namespace dashpot::testing {

struct BarrierSplit {
  std::vector<double> dampings;
  double gap;  // of Σ d_j a_jᵀCa_j at most
};

class BarrierSolver {
 public:
  BarrierSolver(std::vector<compiler::axes::Brake> brakes, const compiler::axes::Symmetric<double>& target,
                const compiler::axes::Symmetric<double>& motion)
      : brakes_(std::move(brakes)), target_(target) {
    using namespace compiler::axes;
    for (const Brake& brake : brakes_) gain_.push_back(form(brake.along, motion, brake.along));
  }

  BarrierSplit solve() {
    const std::size_t n = brakes_.size();
    std::vector<double> d(n);
    double size = 0;
    for (std::size_t j = 0; j < n; ++j) d[j] = std::min(start(), 0.5 * brakes_[j].most), size += gain_[j];
    const double unit = size * start();  // of what is maximised
    double t = 1 / unit;
    for (; t < 1e10 / unit; t *= 4) centre(d, t);
    return {d, (2 + 2 * double(n)) / (t / 4)};
  }

 private:
  using Matrix = std::vector<std::vector<double>>;

  // Small enough that R stays positive.
  double start() const {
    double sum = 0;
    for (const auto& brake : brakes_) sum += compiler::axes::length_squared(brake.along);
    return 0.5 * compiler::axes::least_eigenvalue(target_) / sum;
  }

  double value(const std::vector<double>& d, double t) const {
    using namespace compiler::axes;
    const Symmetric<double> rest = target_ - made_by(brakes_, d);
    const double area = rest.xx * rest.yy - rest.xy * rest.xy;
    if (!(rest.xx > 0 && area > 0)) return -HUGE_VAL;
    double sum = std::log(area);
    for (std::size_t j = 0; j < d.size(); ++j) {
      if (!(d[j] > 0 && d[j] < brakes_[j].most)) return -HUGE_VAL;
      sum += t * gain_[j] * d[j] + std::log(d[j]) +
             (brakes_[j].most < compiler::axes::unlimited ? std::log(brakes_[j].most - d[j]) : 0);
    }
    return sum;
  }

  // ∂ log det R/∂d_j = −a_jᵀR⁻¹a_j, and ∂²/∂d_j∂d_k = −(a_jᵀR⁻¹a_k)².
  std::vector<double> newton_step(const std::vector<double>& d, double t) const {
    using namespace compiler::axes;
    const Symmetric<double> rest = target_ - made_by(brakes_, d);
    const double area = rest.xx * rest.yy - rest.xy * rest.xy;
    const Symmetric<double> inverse{rest.yy / area, -rest.xy / area, rest.xx / area};
    const std::size_t n = d.size();
    Matrix rows(n, std::vector<double>(n + 1));
    for (std::size_t j = 0; j < n; ++j) {
      const double above = 1 / (brakes_[j].most - d[j]);
      for (std::size_t k = 0; k < n; ++k) rows[j][k] = std::pow(form(brakes_[j].along, inverse, brakes_[k].along), 2);
      rows[j][j] += 1 / (d[j] * d[j]) + above * above;
      rows[j][n] = t * gain_[j] - form(brakes_[j].along, inverse, brakes_[j].along) + 1 / d[j] - above;
    }
    return solved(rows);
  }

  // Gauss and Jordan: the matrix is positive definite.
  static std::vector<double> solved(Matrix rows) {
    const std::size_t n = rows.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double factor = i == j ? 0 : rows[j][i] / rows[i][i];
        for (std::size_t k = i; k <= n; ++k) rows[j][k] -= factor * rows[i][k];
      }
    }
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = rows[i][n] / rows[i][i];
    return x;
  }

  void centre(std::vector<double>& d, double t) const {
    for (int step = 0; step < 50; ++step) {
      const std::vector<double> by = newton_step(d, t);
      const double from = value(d, t);
      double share = 1;
      std::vector<double> next = d;
      do {
        for (std::size_t j = 0; j < d.size(); ++j) next[j] = d[j] + share * by[j];
        share /= 2;
      } while (!(value(next, t) >= from) && share > 1e-12);
      if (!(value(next, t) > from)) return;
      d = next;
    }
  }

  std::vector<compiler::axes::Brake> brakes_;
  compiler::axes::Symmetric<double> target_;
  std::vector<double> gain_;
};

}  // namespace dashpot::testing
