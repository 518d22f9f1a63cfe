// Where every joule of a simulated device came from and went. Each entry is accumulated from its own force and
// velocity; none is the remainder of the others (but for the hand in a prescribed motion, which does what that takes).
#pragma once

namespace dashpot::simulated {

struct energy_ledger {
  double hand = 0;      // work of the hand on the device [J]
  double motor = 0;     // work of the motor on the device [J]
  double brake = 0;     // dissipated by the brake, its residual damping included [J]
  double friction = 0;  // dissipated by Coulomb friction [J]
  double damping = 0;   // dissipated by the device's own viscous damping [J]
  double stop = 0;      // taken up by the end-stops, stored or dissipated [J]
  double kinetic = 0;   // of the device's inertia, gained since the start [J]
  double mode = 0;      // taken up by the spring and damper of a structural mode, stored or dissipated [J]

  energy_ledger& operator+=(const energy_ledger& more) noexcept {
    hand += more.hand;
    motor += more.motor;
    brake += more.brake;
    friction += more.friction;
    damping += more.damping;
    stop += more.stop;
    kinetic += more.kinetic;
    mode += more.mode;
    return *this;
  }

  // What went in and is not accounted for [J]: rounding only.
  double imbalance() const noexcept { return hand + motor - brake - friction - damping - stop - mode - kinetic; }
};

}  // namespace dashpot::simulated
