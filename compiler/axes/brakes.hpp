// Which part of a wanted damping the brakes make (theory, section 12). The target B* is a symmetric matrix over the
// joints [N·m·s/rad]; a brake acts along a constant direction a_j of joint velocities with d_j a_j a_jᵀ, 0 ≤ d_j ≤
// most; the motors make the rest R = B* − Σ d_j a_j a_jᵀ from an estimate.
//
//     diagonal       brakes take all but the coupling of the first two of them that are not parallel; what couples them
//     is taken by
//                    further brakes as far as that leaves no negative diagonal, and else by the motors. Delay-proof
//                    where no brake is at its limit
//     non-injecting  R ≥ 0 with the least tr(C R), where C is the mean of q̇ q̇ᵀ over the motion
//     virtual        no brake
#pragma once

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
//     d = min((r/αβ)⁺, p/α², s/β², most), which is taken off p, r and s;      then d_1 = min(p, most_1), d_2 = min(s,
//     most_2)
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

// Of one to four brakes: with three, the exact split where it needs no negative brake, else the best pair; with limits,
// the best of the cases with one brake at 0 or at its limit; of four, the best three.
std::vector<double> non_injecting(const std::vector<Brake>& brakes, const Symmetric<double>& target,
                                  const Symmetric<double>& motion);

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
