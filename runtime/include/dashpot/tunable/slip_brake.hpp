// What slips leave to the brake while parameters change: b∞ of the regime, for the command with a hysteresis over the
// encoder and no faster than the coil can follow (theory, section 5, "Regimes").
#pragma once

#include <dashpot/elementary.hpp>
#include <dashpot/tunable/tables.hpp>

namespace dashpot {

template <class Scalar, int Slips>
class tunable_slip_brake {
 public:
  constexpr void reset(Scalar damping) noexcept {
    for (int i = 0; i < Slips; ++i) {
      slid_[i] = false;
      slid_at_[i] = 0;
    }
    root_ = square_root(damping);
  }

  // Which slips slide for the command: a slide ends where the tool has gone the hysteresis, to either side, and the
  // slip not with it.
  void follow(const tunable_slip_rule<Scalar>& rule, int count, const int* sign, Scalar position,
              int* commanded) noexcept {
    for (int i = 0; i < count; ++i) {
      const Scalar way = position - slid_at_[i];
      slides_now_[i] = sign[i] != 0 || (slid_[i] && rule.hysteresis * rule.hysteresis - way * way > Scalar(0));
      slid_at_now_[i] = sign[i] != 0 ? position : slid_at_[i];
      commanded[i] = slides_now_[i] ? 1 : 0;
    }
  }

  // b, from what the regime would have: √b ← √b + κ (√b_regime − √b).
  Scalar damping(const tunable_slip_rule<Scalar>& rule, Scalar wanted) noexcept {
    if (!(rule.coil_share < Scalar(1))) return wanted;
    root_now_ = root_ + rule.coil_share * (square_root(wanted) - root_);
    return root_now_ * root_now_;
  }

  void keep(int count) noexcept {
    for (int i = 0; i < count; ++i) {
      slid_[i] = slides_now_[i];
      slid_at_[i] = slid_at_now_[i];
    }
    root_ = root_now_;
  }

 private:
  bool slid_[Slips] = {}, slides_now_[Slips] = {};
  Scalar slid_at_[Slips] = {}, slid_at_now_[Slips] = {};  // where the tool was when a slip last slid [m]
  Scalar root_ = 0, root_now_ = 0;                        // √b
};

}  // namespace dashpot
