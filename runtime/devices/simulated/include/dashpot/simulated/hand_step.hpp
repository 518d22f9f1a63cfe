// A hand over one integration step (gauss.hpp), as linear maps that are worked out once for a step length. All in the
// joint's coordinate.
#pragma once

#include <dashpot/simulated/hand.hpp>
#include <dashpot/simulated/trajectory.hpp>

namespace dashpot::simulated {

// The hand's states less B x_d: what is left of z when the intention has been taken out.
struct hand_state {
  double shifted[hand::max_states] = {};
};

// Of a hand that was relaxed where it intended to be, and takes hold of the tool at `position` at once: −B u.
hand_state taking_hold_at(const hand& user, double position);

// Force along +q, without the mass's share [N·m] or [N], at one instant.
double force_of(const hand& user, const hand_state& state, const motion_point& intended, double velocity);

class hand_step {
 public:
  hand_step() = default;                         // of no length: to be replaced
  hand_step(const hand& user, double duration);  // [s]

  double duration() const noexcept { return duration_; }

  // The stage forces are these plus coupling()·(the joint's stage velocities) [N·m] or [N].
  void forces_at_rest(const hand_state& state, const motion_point (&intended)[2], double (&at_rest)[2]) const noexcept;
  double coupling(unsigned stage, unsigned velocity) const noexcept { return coupling_[stage][velocity]; }

  hand_state advanced(const hand_state& state, const motion_point (&intended)[2],
                      const double (&velocity)[2]) const noexcept;

 private:
  template <unsigned n>
  class solver;
  template <unsigned n>
  void solve(const hand& user);
  void solve_without_states();
  template <unsigned n>
  void push_position(const hand& user, solver<n>& answer, unsigned at);
  template <unsigned n>
  void push_velocity(const hand& user, solver<n>& answer, unsigned at);
  template <unsigned n>
  void push_state(const hand& user, solver<n>& answer, unsigned j);

  unsigned states_ = 0;
  double duration_ = 0;
  double damping_ = 0;  // D
  double force_per_state_[2][hand::max_states];
  double force_per_position_[2][2];
  double coupling_[2][2];
  double end_per_state_[hand::max_states][hand::max_states];
  double end_per_position_[hand::max_states][2];
  double end_per_velocity_[hand::max_states][2];
};

}  // namespace dashpot::simulated
