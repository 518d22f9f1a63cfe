#include "axes/brakes.hpp"

#include <optional>

namespace dashpot::compiler::axes {
namespace {

using Dampings = std::vector<double>;

// What is left below zero by rounding.
constexpr double slack = 1e-13;

double size_of(const Symmetric<double>& m) { return std::abs(m.xx) + std::abs(m.yy); }

bool leaves_passive(const Symmetric<double>& rest, const Symmetric<double>& of) {
  return least_eigenvalue(rest) >= -slack * size_of(of);
}

// The largest d with B − d a aᵀ ≥ 0.
double of_one(const Brake& brake, const Symmetric<double>& target) {
  const auto [p, r, s] = along_brakes(dual(brake.along, turned(brake.along)), target);
  return std::clamp(p - (s > smallest_damping ? r * r / s : 0), 0.0, brake.most);
}

Symmetric<double> without(const Symmetric<double>& target, const Brake& brake, double damping) {
  return target - damping * outer(brake.along);
}

Dampings of_two(const std::vector<Brake>& brakes, const Symmetric<double>& target, const Symmetric<double>& motion) {
  if (are_parallel(brakes[0].along, brakes[1].along)) {
    const double first = of_one(brakes[0], target);
    return {first, of_one(brakes[1], without(target, brakes[0], first))};
  }
  const Pair<double> d = non_injecting<double>(Pair<Brake>{brakes[0], brakes[1]}, target, motion);
  return {d[0], d[1]};
}

// B = Σ d_j a_j a_jᵀ, where no d_j is negative or beyond its limit.
std::optional<Dampings> exact(const std::vector<Brake>& brakes, const Symmetric<double>& target) {
  if (are_parallel(brakes[0].along, brakes[1].along)) return std::nullopt;
  const Pair<Pair<double>> base = dual(brakes[0].along, brakes[1].along);
  const double a = dot(base[0], brakes[2].along), b = dot(base[1], brakes[2].along);
  if (are_parallel(brakes[2].along, brakes[0].along) || are_parallel(brakes[2].along, brakes[1].along))
    return std::nullopt;
  const auto [p, r, s] = along_brakes(base, target);
  const double third = r / (a * b);
  const Dampings d{p - a * a * third, s - b * b * third, third};
  for (std::size_t j = 0; j < d.size(); ++j) {
    if (d[j] < 0 || d[j] > brakes[j].most) return std::nullopt;
  }
  return d;
}

double taken(const std::vector<Brake>& brakes, const Dampings& d, const Symmetric<double>& motion) {
  double sum = 0;
  for (std::size_t j = 0; j < d.size(); ++j) sum += d[j] * form(brakes[j].along, motion, brakes[j].along);
  return sum;
}

// With brake j at a bound, and the others as good as they can be then.
std::optional<Dampings> with_fixed(const std::vector<Brake>& brakes, std::size_t j, double damping,
                                   const Symmetric<double>& target, const Symmetric<double>& motion) {
  const Symmetric<double> rest = without(target, brakes[j], damping);
  if (damping >= unlimited || !leaves_passive(rest, target)) return std::nullopt;
  std::vector<Brake> others = brakes;
  others.erase(others.begin() + long(j));
  Dampings d = non_injecting(others, rest, motion);
  d.insert(d.begin() + long(j), damping);
  return d;
}

}  // namespace

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

// Where R ≠ 0 its multiplier is y yᵀ, and (a_jᵀy)² = a_jᵀCa_j holds for two directions at most: so with more brakes one
// sits at a bound. Where R = 0, three dampings are determined, and of four one can be moved to a bound.
std::vector<double> non_injecting(const std::vector<Brake>& brakes, const Symmetric<double>& target,
                                  const Symmetric<double>& motion) {
  if (brakes.size() == 1) return {of_one(brakes[0], target)};
  if (brakes.size() == 2) return of_two(brakes, target, motion);
  if (brakes.size() == 3) {
    if (const std::optional<Dampings> all = exact(brakes, target)) return *all;
  }
  Dampings best(brakes.size(), 0.0);
  for (std::size_t j = 0; j < brakes.size(); ++j) {
    for (const double bound : {0.0, brakes[j].most}) {
      const std::optional<Dampings> d = with_fixed(brakes, j, bound, target, motion);
      if (d && taken(brakes, *d, motion) > taken(brakes, best, motion)) best = *d;
    }
  }
  return best;
}

std::vector<double> choose(BrakeRule rule, const std::vector<Brake>& brakes, const Symmetric<double>& target,
                           const Symmetric<double>& motion) {
  switch (rule) {
    case BrakeRule::diagonal: return diagonal(brakes, target);
    case BrakeRule::non_injecting: return non_injecting(brakes, target, motion);
    case BrakeRule::virtual_brake: break;
  }
  return Dampings(brakes.size(), 0.0);
}

bool is_delay_proof(const Symmetric<double>& brakes, const Symmetric<double>& target) {
  return leaves_passive(brakes - 0.5 * target, target);
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
