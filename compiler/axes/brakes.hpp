// Which part of a wanted damping the brakes make (theory, section 12). The target B* is a symmetric matrix over the
// joints [N·m·s/rad]; a brake acts along a constant direction a_j of joint velocities with d_j a_j a_jᵀ, 0 ≤ d_j ≤
// most; the motors make the rest R = B* − Σ d_j a_j a_jᵀ from an estimate.
//
//     diagonal       brakes take all but the coupling of the first two of them that are not parallel; that coupling is
//                    taken by further brakes as far as that leaves no negative diagonal, and else by the motors.
//                    Delay-proof where no brake is at its limit
//     non-injecting  R ≥ 0 with the least tr(C R), where C is the mean of q̇ q̇ᵀ over the motion
//     virtual        no brake
#pragma once

#include <array>
#include <vector>

#include "axes/pair.hpp"

namespace dashpot::compiler::axes {

inline constexpr double unlimited = 1e30;          // what a brake without a limit can make [N·m·s/rad]
inline constexpr double smallest_damping = 1e-30;  // below which one counts as none [N·m·s/rad]

struct Brake {
  Pair<double> along{1, 0};  // a_j, not normalised
  double most = unlimited;   // [N·m·s/rad]
};

enum class BrakeRule { diagonal, non_injecting, virtual_brake };

// ã_1 and ã_2, with ã_i·a_k = 1 for i = k and else 0, of two directions that are not parallel.
Pair<Pair<double>> dual(const Pair<double>& first, const Pair<double>& second);

// A symmetric matrix over the joints in the coordinates y_j = a_j·q̇ of two brakes: ã_iᵀ m ã_k.
template <typename S>
Symmetric<S> along_brakes(const Pair<Pair<double>>& dual, const Symmetric<S>& m) {
  const Pair<S> first = constant<S>(dual[0]), second = constant<S>(dual[1]);
  return {form(first, m, first), form(first, m, second), form(second, m, second)};
}

// One damping for each of one to four brakes, as a law computes it. Divides by nothing that varies. With [[p, r], [r,
// s]] in the coordinates of the two brakes, and a further brake along α a_1 + β a_2:
//
//     d = min((r/αβ)⁺, p/α², s/β², most), which is taken off p, r and s;
//     then d_1 = min(p, most_1), d_2 = min(s, most_2)
template <typename S>
std::vector<S> diagonal(const std::vector<Brake>& brakes, const Symmetric<S>& target);

// Brakes 0 and k, the first that is not parallel to it, or k = 0 where all are parallel.
std::size_t second_of_base(const std::vector<Brake>& brakes);
bool are_parallel(const Pair<double>& a, const Pair<double>& b);

// Of two brakes that are not parallel, as a law computes it; `motion` is C over the joints. With [[p, r], [r, s]] and C
// in the brakes' own coordinates,
//
//     ρ1 = |r| √(C22/C11), at most p and r²/(s − most_2), at least r²/s and p − most_1
//     ρ2 = r²/ρ1, at least s − most_2,        d = (p − ρ1, s − ρ2)
//
// Divides by C11 > 0, by s, and by ρ1 and s − most_2, which are kept from zero.
template <typename S>
Pair<S> non_injecting(const Pair<Brake>& brakes, const Symmetric<S>& target, const Symmetric<S>& motion) {
  using std::abs, std::max, std::min, std::sqrt;
  const S none(0), least(smallest_damping), first_most(brakes[0].most), second_most(brakes[1].most);
  const auto [p, r, s] = along_brakes(dual(brakes[0].along, brakes[1].along), target);
  const Pair<S> first = constant<S>(brakes[0].along), second = constant<S>(brakes[1].along);
  const S coupling = square(r), beyond = s - second_most;
  const S balanced = abs(r) * sqrt(form(second, motion, second) / form(first, motion, first));
  const S most = min(p, coupling / max(beyond, least));
  const S kept = max(min(balanced, most), max(p - first_most, coupling / max(s, least)));
  const S other_kept = max(coupling / max(kept, least), beyond);
  return {min(max(p - kept, none), first_most), min(max(s - other_kept, none), second_most)};
}

// One brake beside what others make, B − d a aᵀ ≥ 0: the largest d.
template <typename S>
S alone(const Brake& brake, const Symmetric<S>& target) {
  using std::max, std::min;
  const auto [p, r, s] = along_brakes(dual(brake.along, turned(brake.along)), target);
  return min(max(p - square(r) / max(s, S(smallest_damping)), S(0)), S(brake.most));
}

// Of one to four brakes, as a law computes it. Where R ≠ 0 its multiplier is y yᵀ, and (a_jᵀy)² = a_jᵀCa_j holds for
// two directions at most: so all brakes but two sit at 0 or at their limits. Where R = 0 three dampings are determined,
// and of four one can be moved to a bound. Of all these cases the one that takes most, tr(C D), is the best.
template <typename S>
class NonInjecting {
 public:
  NonInjecting(const std::vector<Brake>& brakes, const Symmetric<S>& target, const Symmetric<S>& motion)
      : brakes_(brakes), target_(target), motion_(motion), best_(brakes.size(), S(0)) {}

  std::vector<S> best() {
    if (brakes_.size() == 1) return {alone(brakes_[0], target_)};
    if (brakes_.size() == 2) return with_free(target_, {0, 1}, best_);
    for (std::size_t i = 0; i < brakes_.size(); ++i)
      for (std::size_t k = i + 1; k < brakes_.size(); ++k) try_bounds({i, k});
    if (brakes_.size() == 3) try_exact(target_, {0, 1, 2}, best_, S(1));
    for (std::size_t j = 0; brakes_.size() == 4 && j < 4; ++j)
      for (const double bound : {0.0, brakes_[j].most}) {
        if (bound >= unlimited) continue;
        std::vector<S> dampings(4, S(0));
        dampings[j] = S(bound);
        const Symmetric<S> rest = without(target_, j, bound);
        try_exact(rest, {j == 0 ? 1u : 0u, j <= 1 ? 2u : 1u, j <= 2 ? 3u : 2u}, dampings, S(1));
      }
    return best_;
  }

 private:
  // What rounding leaves of a matrix that is no less than 0.
  static constexpr double slack = 1e-13;

  Symmetric<S> without(const Symmetric<S>& target, std::size_t j, double damping) const {
    return damping == 0 ? target : target - S(damping) * outer(constant<S>(brakes_[j].along));
  }

  // Above 0 where the least eigenvalue is 0 or more.
  S is_passive(const Symmetric<S>& rest) const {
    using std::min;
    const S size = target_.xx + target_.yy + S(smallest_damping);
    return min(min(rest.xx, rest.yy) + S(slack) * size, rest.xx * rest.yy - square(rest.xy) + S(slack) * square(size));
  }

  std::vector<S> with_free(const Symmetric<S>& rest, const std::array<std::size_t, 2>& free,
                           std::vector<S> dampings) const {
    const Pair<Brake> pair{brakes_[free[0]], brakes_[free[1]]};
    if (are_parallel(pair[0].along, pair[1].along)) {
      dampings[free[0]] = alone(pair[0], rest);
      dampings[free[1]] = alone(pair[1], rest - dampings[free[0]] * outer(constant<S>(pair[0].along)));
      return dampings;
    }
    const Pair<S> d = non_injecting<S>(pair, rest, motion_);
    dampings[free[0]] = d[0], dampings[free[1]] = d[1];
    return dampings;
  }

  void try_bounds(const std::array<std::size_t, 2>& free) {
    std::vector<std::size_t> fixed;
    for (std::size_t j = 0; j < brakes_.size(); ++j)
      if (j != free[0] && j != free[1]) fixed.push_back(j);
    for (unsigned at_limit = 0; at_limit < 1u << fixed.size(); ++at_limit) {
      std::vector<S> dampings(brakes_.size(), S(0));
      Symmetric<S> rest = target_;
      bool is_possible = true;
      for (std::size_t i = 0; i < fixed.size(); ++i) {
        if ((at_limit >> i & 1u) == 0) continue;
        is_possible = is_possible && brakes_[fixed[i]].most < unlimited;
        dampings[fixed[i]] = S(brakes_[fixed[i]].most);
        rest = without(rest, fixed[i], brakes_[fixed[i]].most);
      }
      if (is_possible) take_if_better(with_free(rest, free, dampings), at_limit == 0 ? S(1) : is_passive(rest));
    }
  }

  // B = Σ d_j a_j a_jᵀ, where no d_j is negative or beyond its limit.
  void try_exact(const Symmetric<S>& rest, const std::array<std::size_t, 3>& of, std::vector<S> dampings,
                 S is_possible) {
    using std::min;
    const Pair<double>&first = brakes_[of[0]].along, &second = brakes_[of[1]].along, &third = brakes_[of[2]].along;
    if (are_parallel(first, second) || are_parallel(third, first) || are_parallel(third, second)) return;
    const Pair<Pair<double>> base = dual(first, second);
    const double a = dot(base[0], third), b = dot(base[1], third);
    const auto [p, r, s] = along_brakes(base, rest);
    const S last = S(1 / (a * b)) * r;
    dampings[of[0]] = p - S(a * a) * last, dampings[of[1]] = s - S(b * b) * last, dampings[of[2]] = last;
    for (const std::size_t j : of) {
      is_possible = min(is_possible, dampings[j]);
      if (brakes_[j].most < unlimited) is_possible = min(is_possible, S(brakes_[j].most) - dampings[j]);
    }
    take_if_better(dampings, is_possible);
  }

  void take_if_better(const std::vector<S>& dampings, const S& is_possible) {
    using std::min;
    S taken(0);
    for (std::size_t j = 0; j < dampings.size(); ++j) {
      const Pair<S> along = constant<S>(brakes_[j].along);
      taken = taken + dampings[j] * form(along, motion_, along);
    }
    const S is_better = min(is_possible, taken - most_taken_);
    for (std::size_t j = 0; j < dampings.size(); ++j) best_[j] = where(is_better, dampings[j], best_[j]);
    most_taken_ = where(is_better, taken, most_taken_);
  }

  const std::vector<Brake>& brakes_;
  const Symmetric<S> target_, motion_;
  std::vector<S> best_;
  S most_taken_ = S(0);
};

template <typename S>
std::vector<S> non_injecting(const std::vector<Brake>& brakes, const Symmetric<S>& target, const Symmetric<S>& motion) {
  return NonInjecting<S>(brakes, target, motion).best();
}

std::vector<double> choose(BrakeRule rule, const std::vector<Brake>& brakes, const Symmetric<double>& target,
                           const Symmetric<double>& motion);

template <typename S>
std::vector<S> diagonal(const std::vector<Brake>& brakes, const Symmetric<S>& target) {
  using std::max, std::min;
  const std::size_t other = second_of_base(brakes);
  const Pair<double> second = other == 0 ? turned(brakes[0].along) : brakes[other].along;
  const Pair<Pair<double>> base = dual(brakes[0].along, second);
  Symmetric<S> rest = along_brakes(base, target);
  std::vector<S> dampings(brakes.size(), S(0));
  const auto take = [&](std::size_t j, const Pair<double>& share, const S& wanted) {
    dampings[j] = min(max(wanted, S(0)), S(brakes[j].most));
    rest = rest - dampings[j] * outer(constant<S>(share));
  };
  const auto share_of = [&](std::size_t j) {
    return Pair<double>{dot(base[0], brakes[j].along), dot(base[1], brakes[j].along)};
  };
  for (std::size_t j = 1; j < brakes.size(); ++j) {
    const auto [a, b] = share_of(j);
    if (j == other || are_parallel(brakes[j].along, brakes[0].along) || are_parallel(brakes[j].along, second)) continue;
    take(j, {a, b}, min(S(1 / (a * b)) * rest.xy, min(S(1 / (a * a)) * rest.xx, S(1 / (b * b)) * rest.yy)));
  }
  for (std::size_t j = 0; j < brakes.size(); ++j) {
    if (are_parallel(brakes[j].along, brakes[0].along)) {
      const double a = share_of(j)[0];
      take(j, {a, 0}, S(1 / (a * a)) * rest.xx);
    } else if (are_parallel(brakes[j].along, second)) {
      const double b = share_of(j)[1];
      take(j, {0, b}, S(1 / (b * b)) * rest.yy);
    }
  }
  return dampings;
}

// Σ d_j a_j a_jᵀ.
template <typename S>
Symmetric<S> made_by(const std::vector<Brake>& brakes, const std::vector<S>& dampings) {
  Symmetric<S> sum{S(0), S(0), S(0)};
  for (std::size_t j = 0; j < brakes.size(); ++j) sum = sum + dampings[j] * outer(constant<S>(brakes[j].along));
  return sum;
}

// C of a motion of the tip that is alike in all directions, up to a factor: (JᵀJ)⁻¹ det(JᵀJ), of the columns of J.
template <typename S>
Symmetric<S> isotropic_motion(const Pair<Pair<S>>& column) {
  return {length_squared(column[1]), S(-1) * dot(column[0], column[1]), length_squared(column[0])};
}

// Half-viscosity for matrices: with D ≥ ½ B* every common delay or averaging of the estimate leaves the viscous part
// passive.
bool is_delay_proof(const Symmetric<double>& brakes, const Symmetric<double>& target);

// The least eigenvalue, and those of m v = λ n v with n > 0, least first.
double least_eigenvalue(const Symmetric<double>& m);
Pair<double> eigenvalues(const Symmetric<double>& m, const Symmetric<double>& n);

}  // namespace dashpot::compiler::axes
