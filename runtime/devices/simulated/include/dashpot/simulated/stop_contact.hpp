// One end-stop and the shaft against it, in the joint's coordinate. A rigid stop holds the shaft, or lets it go; a
// compliant one pushes with stiffness·depth + damping·speed while that is a push: it never pulls.
#pragma once

#include <optional>

#include <dashpot/simulated/end_stop.hpp>
#include <dashpot/simulated/shaft_sensors.hpp>

namespace dashpot::simulated {

class stop_contact {
 public:
  // `side` is +1 for the upper end of the range, −1 for the lower; `ratio` tool motion over joint motion.
  stop_contact(const std::optional<end_stop>& obstacle, double side, double ratio);

  bool is_rigid() const noexcept { return present_ && rigid_; }
  double position() const noexcept { return position_; }  // of the surface [rad] or [m]

  // Rigid: whether the shaft is at the surface or beyond, and pressed further by a force along +q.
  bool is_reached(double position) const noexcept { return is_rigid() && depth(position) >= 0; }
  bool is_passed(double position) const noexcept { return is_rigid() && depth(position) > 0; }
  bool holds_against(double force) const noexcept { return side_ * force >= 0; }

  // Compliant: whether it pushes back, decided by touch() and kept until the next.
  void touch(const shaft_motion& shaft) noexcept { pushing_ = would_push(shaft); }
  bool is_settled(const shaft_motion& shaft) const noexcept { return pushing_ == would_push(shaft); }
  double stiffness() const noexcept { return pushing_ ? stiffness_ : 0; }  // [N·m/rad] or [N/m]
  double damping() const noexcept { return pushing_ ? damping_ : 0; }      // [N·m·s/rad] or [N·s/m]
  double force(double position, double velocity) const noexcept {          // opposing +q [N·m] or [N]
    return stiffness() * (position - position_) + damping() * velocity;
  }

 private:
  double depth(double position) const noexcept { return side_ * (position - position_); }
  bool would_push(const shaft_motion& shaft) const noexcept;

  bool present_;
  bool rigid_;
  double side_;
  double position_;
  double stiffness_;
  double damping_;
  bool pushing_ = false;
};

}  // namespace dashpot::simulated
