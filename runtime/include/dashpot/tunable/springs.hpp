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
    is_owing_ = is_shed_ = is_changing_ = false;
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
  // Behind a static curve several between two samples are one, from what there was at the first of them: one command is
  // held meanwhile.
  constexpr void begin_change(const tables& t) noexcept {
    const bool goes_on = t.map.is_there && is_changing_;
    for (int i = 0; i < t.spring_count; ++i) {
      if (goes_on) {
        elongation_[i] = sampled_elongation_[i];
        offset_[i] = sampled_offset_[i];
        continue;
      }
      changes_[i] = {stiffness_[i], 0, force(i), 0};
      sampled_elongation_[i] = elongation_[i];
      sampled_offset_[i] = offset_[i];
    }
    if (goes_on) tank_ = sampled_tank_;
    else sampled_tank_ = tank_;
    is_changing_ = true;
  }
  constexpr void end_changes() noexcept { is_changing_ = false; }
  constexpr void carry_over(const tables& t) noexcept {
    for (int i = 0; i < t.spring_count; ++i) changes_[i].new_stiffness = stiffness_[i];
    tank_ = t.map.is_there ? carry_forces_behind_map(changes_, t.spring_count, tank_, t.map.largest_change)
                           : carry_forces_over(changes_, t.spring_count, tank_);
    if (!t.map.is_there || t.static_spring == no_index) return;
    const Scalar stiffness = stiffness_[t.static_spring];
    stiffest_share_ = stiffness > 0 ? t.map.largest_stiffness / stiffness : Scalar(0);
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
    offset_[spring] = middle_of_nothing(offset_[spring], elongation_[spring]);
  }
  constexpr bool has_shed() const noexcept { return is_shed_; }

  // Behind a static curve, once a sample: what the spring between tool and ground holds is between nothing and what it
  // would hold at home were it the stiffest. What is beyond is let go of as soon as that sets free what the command
  // that is held meanwhile may give out.
  constexpr void let_go(const tables& t) noexcept {
    const int spring = t.static_spring;
    if (offset_[spring] == 0) return;
    const Scalar z = elongation_[spring], k = stiffness_[spring], stretched = z - offset_[spring];
    const Scalar kept = middle_of_nothing(stretched, stiffest_share_ * z);
    const Scalar change = size_of(stretched - kept), left = size_of(stretched + kept) / 2 - t.map.largest_change;
    if (change == 0 || left < 0) return;
    tank_ += k * change * left;
    offset_[spring] = z - kept;
  }

  // Once a sample.
  constexpr void bring_offsets_home(const tables& t) noexcept {
    if (!is_owing_) return;
    is_owing_ = false;
    for (int i = 0; i < t.spring_count; ++i) {
      const Scalar before = offset_[i], after = flush_below(t.threshold, t.retention * before);
      if (before == 0) continue;
      const Scalar z = elongation_[i];
      const Scalar of_spring = stiffness_[i] * (before - after) * ((z - after) + (z - before)) * Scalar(0.5);
      const Scalar cost = of_spring + price_of(t, stiffness_[i] * (before - after));
      if (cost <= tank_) {
        tank_ -= cost;
        offset_[i] = after;
      }
      is_owing_ = is_owing_ || offset_[i] != 0;
    }
    is_shed_ = is_shed_ && is_owing_;
  }

 private:
  static constexpr Scalar size_of(Scalar x) noexcept { return x > 0 ? x : -x; }

  // The middle one of 0, x and y.
  static constexpr Scalar middle_of_nothing(Scalar x, Scalar y) noexcept {
    const Scalar least = x < y ? x : y, most = x < y ? y : x;
    return least > 0 ? least : most < 0 ? most : Scalar(0);
  }

  // Of a force that jumps behind a static curve: what the command that is held meanwhile may give out [J].
  static constexpr Scalar price_of(const tables& t, Scalar jump) noexcept {
    return t.map.is_there ? size_of(jump) * t.map.largest_change : Scalar(0);
  }

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
  Scalar stiffest_share_ = 0;        // of the static spring: its largest k over this one; 0: there is none
  spring_change<Scalar> changes_[Springs] = {};
  bool is_changing_ = false;                 // since the last sample
  Scalar sampled_elongation_[Springs] = {};  // z, r and T before
  Scalar sampled_offset_[Springs] = {};
  Scalar sampled_tank_ = 0;
};

}  // namespace dashpot
