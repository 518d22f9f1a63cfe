// What a law with tunable parameters tells the program around it.
#pragma once

namespace dashpot {

// What the tool meets: of what joins tool and ground, or the surface and ground, without a slip.
template <class Scalar>
struct tunable_port {
  Scalar held = 0;         // π [N]
  Scalar stiffness = 0;    // g without b∞/h [N/m]
  Scalar recovery = 0;     // −1/g, of a surface that nothing touches [m/N]
  Scalar feedthrough = 0;  // b∞/h [N/m]
  Scalar damping = 0;      // b [N·s/m]
  Scalar gain = 0;         // b∞ − b [N·s/m]
};

// Of slips behind a surface.
template <class Scalar>
struct tunable_push {
  Scalar force;   // that opposes the tool [N]
  Scalar change;  // of the surface [m]
};

// Of slips and the brake.
template <class Scalar>
struct tunable_brake {
  Scalar now;      // b∞/h behind slips in this sample, as far as the brake makes it [N/m]
  Scalar damping;  // b of it, on its way there with the coil [N·s/m]
  Scalar make_up;  // what the motor makes up for a coil on its way [N·s/m]
};

// Of a motor that can make no more.
template <class Scalar>
struct tunable_limit {
  Scalar force;  // m [N]
  Scalar share;  // of all forces in the network, what is kept [1]
};

}  // namespace dashpot
