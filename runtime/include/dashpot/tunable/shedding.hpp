// A law with tunable parameters that never asks its motor for more than it can make: where the command would be beyond
// the motor's limit, or further from the last one than the motor can go in a period, all forces in the network are
// multiplied by one share in [0, 1] (theory, section 10).
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/tunable/tables.hpp>

namespace dashpot {

template <class Scalar>
class tunable_shedding {
 public:
  using tables = tunable_tables<Scalar>;

  constexpr void reset() noexcept {
    last_ = now_ = dent_ = returned_ = 0;
    share_ = 1;
  }

  static constexpr bool is_limited(const tables& t) noexcept { return t.motor_limit > 0 || t.motor_step > 0; }

  // m within the motor's limits, and s = m/wanted where `wanted` is beyond it.
  constexpr Scalar command(const tables& t, Scalar wanted) noexcept {
    share_ = 1;
    now_ = wanted;
    if (t.motor_step > 0) {
      const Scalar most = within_limit(t, last_ + t.motor_step), least = within_limit(t, last_ - t.motor_step);
      now_ = wanted > most ? most : wanted < least ? least : wanted;
    } else if (t.motor_limit > 0) {
      now_ = clamp_to(t.motor_limit, wanted);
    }
    if ((wanted - now_) * wanted > 0) share_ = now_ * wanted > 0 ? now_ / wanted : Scalar(0);
    return now_;
  }

  // Where a surface that lies at `surface` stands when it and its dent have followed a tool that is `gap` away, until
  // the dent is none.
  constexpr Scalar followed(Scalar surface, Scalar gap) noexcept {
    returned_ = gap > 0 && dent_ > 0 ? (gap < dent_ ? gap : dent_) : Scalar(0);
    return surface - returned_;
  }

  // Once a sample, of a surface that can come back: how far from there it now lies at rest [m].
  constexpr Scalar dented(Scalar surface) noexcept {
    dent_ -= returned_;
    if (share_ < 1) dent_ = surface - share_ * (surface - dent_);
    return dent_;
  }

  constexpr void keep() noexcept { last_ = now_; }

  constexpr Scalar share() const noexcept { return share_; }

 private:
  static constexpr Scalar within_limit(const tables& t, Scalar force) noexcept {
    return t.motor_limit > 0 ? clamp_to(t.motor_limit, force) : force;
  }

  Scalar last_ = 0, now_ = 0;  // m of the sample before, and of this one [N]
  Scalar share_ = 1;           // of all forces, that is kept
  Scalar dent_ = 0;            // of a surface, by what was shed [m]
  Scalar returned_ = 0;        // of it in this sample [m]
};

}  // namespace dashpot
