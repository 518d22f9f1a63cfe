#include "axes/brakes.hpp"

namespace dashpot::compiler::axes {

bool are_parallel(const Pair<double>& a, const Pair<double>& b) {
  return std::abs(dot(turned(a), b)) <= 1e-9 * std::sqrt(length_squared(a) * length_squared(b));
}

std::size_t second_of_base(const std::vector<Brake>& brakes) {
  std::size_t other = 1;
  while (other < brakes.size() && are_parallel(brakes[0].along, brakes[other].along)) ++other;
  return other < brakes.size() ? other : 0;
}

Pair<Pair<double>> dual(const Pair<double>& first, const Pair<double>& second) {
  const double area = dot(turned(first), second);
  return {(-1 / area) * turned(second), (1 / area) * turned(first)};
}

std::vector<double> choose(BrakeRule rule, const std::vector<Brake>& brakes, const Symmetric<double>& target,
                           const Symmetric<double>& motion) {
  switch (rule) {
    case BrakeRule::diagonal: return diagonal(brakes, target);
    case BrakeRule::non_injecting: return non_injecting(brakes, target, motion);
    case BrakeRule::virtual_brake: break;
  }
  return std::vector<double>(brakes.size(), 0.0);
}

// What rounding leaves below zero counts as 0.
bool is_delay_proof(const Symmetric<double>& brakes, const Symmetric<double>& target) {
  return least_eigenvalue(brakes - 0.5 * target) >= -1e-13 * (std::abs(target.xx) + std::abs(target.yy));
}

double least_eigenvalue(const Symmetric<double>& m) {
  return 0.5 * (m.xx + m.yy) - std::hypot(0.5 * (m.xx - m.yy), m.xy);
}

// With n = L Lᵀ those of L⁻¹ m L⁻ᵀ.
Pair<double> eigenvalues(const Symmetric<double>& m, const Symmetric<double>& n) {
  const double first = std::sqrt(n.xx), shear = n.xy / first, second = std::sqrt(n.yy - shear * shear);
  const double xx = m.xx / n.xx, xy = (m.xy - shear * m.xx / first) / (first * second);
  const double yy = (m.yy - 2 * shear / first * m.xy + shear * shear / n.xx * m.xx) / (second * second);
  const double middle = 0.5 * (xx + yy), apart = std::hypot(0.5 * (xx - yy), xy);
  return {middle - apart, middle + apart};
}

}  // namespace dashpot::compiler::axes
