// What happens to the springs' forces when stiffnesses change (theory, section 6, "Changing parameters while running"):
// each force stays as it is as far as energy allows that the springs and the tank already hold. So
//     V + T,   V = Σ F²/2k
// is the same before and after, and nothing is injected.
#pragma once

#include <dashpot/elementary.hpp>

namespace dashpot {

// One spring across a change of its stiffness.
template <class Scalar>
struct spring_change {
  Scalar stiffness;      // before [N/m]
  Scalar new_stiffness;  // after
  Scalar force;          // before [N]
  Scalar new_force;      // out
};

// F²/2k; nothing where there is no spring.
template <class Scalar>
constexpr Scalar spring_energy(Scalar force, Scalar stiffness) noexcept {
  return stiffness > 0 ? force * (force / stiffness) / 2 : Scalar(0);
}

// A stiffer spring keeps its force, and the tank takes what that sets free. A softer one keeps what its own energy can
// hold, F √(k′/k), and then more, up to F, as far as the tank pays; the springs in turn. Returns what is left in the
// tank [J].
template <class Scalar>
constexpr Scalar carry_forces_over(spring_change<Scalar>* springs, int count, Scalar tank) noexcept {
  for (int i = 0; i < count; ++i) {
    spring_change<Scalar>& s = springs[i];
    s.new_force = s.new_stiffness >= s.stiffness ? s.force
                  : s.new_stiffness > 0          ? s.force * square_root(s.new_stiffness / s.stiffness)
                                                 : Scalar(0);
    // Only a stiffer spring sets energy free: for the others the two energies are equal but for rounding.
    if (s.new_stiffness > s.stiffness)
      tank += spring_energy(s.force, s.stiffness) - spring_energy(s.force, s.new_stiffness);
    if (s.new_stiffness <= 0) tank += spring_energy(s.force, s.stiffness);
  }
  for (int i = 0; i < count; ++i)
    if (springs[i].new_stiffness > 0 && springs[i].new_force != springs[i].force) {
      spring_change<Scalar>& s = springs[i];
      const Scalar held = spring_energy(s.new_force, s.new_stiffness);
      const Scalar cost = spring_energy(s.force, s.new_stiffness) - held;
      const bool is_paid = cost <= tank;
      const Scalar most = square_root(2 * s.new_stiffness * (held + tank));
      s.new_force = is_paid ? s.force : s.force > 0 ? most : -most;
      tank = is_paid ? tank - cost : Scalar(0);
    }
  return tank;
}

// The same behind a static curve, where no force grows at a change. A softer spring keeps its force where the tank pays
// for all of it, else its elongation, F k′/k: so that the command that is held meanwhile gives out no more than the
// spring did. Of what that sets free the tank takes what is left when the tool has come back by `largest_change`.
template <class Scalar>
constexpr Scalar carry_forces_behind_map(spring_change<Scalar>* springs, int count, Scalar tank,
                                         Scalar largest_change) noexcept {
  for (int i = 0; i < count; ++i) {
    spring_change<Scalar>& s = springs[i];
    s.new_force = s.force;
    if (s.new_stiffness > s.stiffness)
      tank += spring_energy(s.force, s.stiffness) - spring_energy(s.force, s.new_stiffness);
  }
  for (int i = 0; i < count; ++i) {
    spring_change<Scalar>& s = springs[i];
    if (s.new_stiffness >= s.stiffness) continue;
    const Scalar cost = spring_energy(s.force, s.new_stiffness) - spring_energy(s.force, s.stiffness);
    const bool is_paid = s.new_stiffness > 0 && cost <= tank;
    const Scalar elongation = s.force / s.stiffness;
    const Scalar left = (elongation > 0 ? elongation : -elongation) - largest_change;
    const Scalar freed = left > 0 ? (s.stiffness - s.new_stiffness) * (left * left) / 2 : Scalar(0);
    s.new_force = is_paid ? s.force : s.new_stiffness * elongation;
    tank = is_paid ? tank - cost : tank + freed;
  }
  return tank;
}

// The spring between tool and ground makes up for `missing` force, as far as the tank pays. Returns what is left in it.
template <class Scalar>
constexpr Scalar make_up(spring_change<Scalar>& spring, Scalar missing, Scalar tank) noexcept {
  if (!(spring.new_stiffness > 0)) return tank;
  const Scalar all = spring_energy(spring.new_force, spring.new_stiffness) + tank;
  const Scalar most = square_root(2 * spring.new_stiffness * all);
  const Scalar wanted = spring.new_force + missing;
  spring.new_force = wanted > most ? most : wanted < -most ? -most : wanted;
  const Scalar rest = all - spring_energy(spring.new_force, spring.new_stiffness);
  return rest > 0 ? rest : Scalar(0);
}

}  // namespace dashpot
