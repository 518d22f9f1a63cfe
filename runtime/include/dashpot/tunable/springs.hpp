// The springs of a law with tunable parameters: elongations z, and how far from home each one's rest length is, the
// offset r. A spring's force is k (z − r). A change of stiffness leaves the forces alone and moves the offsets, as far
// as energy allows (energy_tank.hpp); with every sample the offsets then go home by a part of the way, where the tank
// pays for it. Forces that the motor cannot make are shed (shedding.hpp), which moves offsets too, and pays nothing in.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/tunable/energy_tank.hpp>
#include <dashpot/tunable/tables.hpp>

namespace dashpot {

template <class Scalar, int Springs>
class tunable_springs {
 public:
  using tables = tunable_tables<Scalar>;

  constexpr void reset(int count) noexcept {
    for (int i = 0; i < count; ++i) elongation_[i] = offset_[i] = 0;
    tank_ = 0;
    is_owing_ = is_shed_ = false;
  }

  constexpr void set_stiffness(int spring, Scalar stiffness) noexcept { stiffness_[spring] = stiffness; }
  constexpr Scalar stiffness(int spring) const noexcept { return stiffness_[spring]; }
  constexpr Scalar elongation(int spring) const noexcept { return elongation_[spring]; }
  constexpr Scalar force(int spring) const noexcept {
    return stiffness_[spring] * (elongation_[spring] - offset_[spring]);
  }

  constexpr void set_elongation(int spring, Scalar elongation) noexcept { elongation_[spring] = elongation; }
  constexpr void stretch(int spring, Scalar change, Scalar threshold) noexcept {
    elongation_[spring] = flush_below(threshold, elongation_[spring] + change);
  }

  // V + T [J]
  constexpr Scalar stored_energy(int count) const noexcept {
    Scalar energy = tank_;
    for (int i = 0; i < count; ++i) energy += force(i) * (elongation_[i] - offset_[i]) * Scalar(0.5);
    return energy;
  }

  // A change: before stiffnesses become others, after it, and then for every spring one of the last two.
  constexpr void begin_change(int count) noexcept {
    for (int i = 0; i < count; ++i) changes_[i] = {stiffness_[i], 0, force(i), 0};
  }
  constexpr void carry_over(int count) noexcept {
    for (int i = 0; i < count; ++i) changes_[i].new_stiffness = stiffness_[i];
    tank_ = carry_forces_over(changes_, count, tank_);
  }
  constexpr Scalar missing_force(int spring) const noexcept {
    return changes_[spring].force - changes_[spring].new_force;
  }
  constexpr void make_up_for(int spring, Scalar missing) noexcept { tank_ = make_up(changes_[spring], missing, tank_); }

  // What is next to it makes room for another elongation.
  constexpr void move_end(int spring) noexcept {
    if (!is_changed(spring)) return;
    const spring_change<Scalar>& change = changes_[spring];
    elongation_[spring] = change.new_stiffness > 0 ? change.new_force / change.new_stiffness : Scalar(0);
  }

  // r = z − F/k; what is no more than rounding of z is none.
  constexpr void move_offset(int spring) noexcept {
    if (!is_changed(spring)) return;
    const spring_change<Scalar>& change = changes_[spring];
    const Scalar z = elongation_[spring];
    const Scalar offset = change.new_stiffness > 0 ? z - change.new_force / change.new_stiffness : Scalar(0);
    offset_[spring] = z + offset / 4 == z ? Scalar(0) : offset;
    is_owing_ = is_owing_ || offset_[spring] != 0;
  }

  // All but `share` of a force is let go of: what is next to the spring makes room, its offset does, or both do.
  constexpr void shed_end(int spring, Scalar share) noexcept {
    elongation_[spring] = offset_[spring] + share * (elongation_[spring] - offset_[spring]);
  }
  constexpr void shed_offset(int spring, Scalar share) noexcept {
    offset_[spring] = elongation_[spring] - share * (elongation_[spring] - offset_[spring]);
    is_owing_ = is_shed_ = true;
  }
  constexpr void shed_both(int spring, Scalar share) noexcept {
    elongation_[spring] *= share;
    offset_[spring] *= share;
  }

  // What has been shed is not asked for again, and nothing pulls because of it: the offset is no further from home than
  // the spring, the middle one of 0, r and z.
  constexpr void bring_shed_offset_home(int spring) noexcept {
    const Scalar r = offset_[spring], z = elongation_[spring];
    const Scalar least = r < z ? r : z, most = r < z ? z : r;
    offset_[spring] = least > 0 ? least : most < 0 ? most : Scalar(0);
  }
  constexpr bool has_shed() const noexcept { return is_shed_; }

  // Once a sample.
  constexpr void bring_offsets_home(const tables& t) noexcept {
    if (!is_owing_) return;
    is_owing_ = false;
    for (int i = 0; i < t.spring_count; ++i) {
      const Scalar before = offset_[i], after = flush_below(t.threshold, t.retention * before);
      if (before == 0) continue;
      const Scalar z = elongation_[i];
      const Scalar cost = stiffness_[i] * (before - after) * ((z - after) + (z - before)) * Scalar(0.5);
      if (cost <= tank_) {
        tank_ -= cost;
        offset_[i] = after;
      }
      is_owing_ = is_owing_ || offset_[i] != 0;
    }
    is_shed_ = is_shed_ && is_owing_;
  }

 private:
  constexpr bool is_changed(int spring) const noexcept {
    return changes_[spring].new_stiffness != changes_[spring].stiffness ||
           changes_[spring].new_force != changes_[spring].force;
  }

  Scalar stiffness_[Springs] = {};   // k [N/m]
  Scalar elongation_[Springs] = {};  // z [m]
  Scalar offset_[Springs] = {};      // r [m]
  Scalar tank_ = 0;                  // T [J]
  bool is_owing_ = false;            // some offset is not home
  bool is_shed_ = false;             // and what was shed is the reason
  spring_change<Scalar> changes_[Springs] = {};
};

}  // namespace dashpot
