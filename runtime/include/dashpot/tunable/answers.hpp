// What a law with tunable parameters tells the program around it.
#pragma once

namespace dashpot {

// Of the meshes that join tool and ground, or the surface and ground, without a slip.
template <class Scalar>
struct tunable_meshes {
  Scalar stiffness;    // g without b∞/h [N/m]
  Scalar feedthrough;  // b∞ [N·s/m]
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
  Scalar wanted;   // and where it is going [N·s/m]
};

// Of a motor that can make no more.
template <class Scalar>
struct tunable_limit {
  Scalar force;  // m [N]
  Scalar share;  // of all forces in the network, what is kept [1]
};

}  // namespace dashpot
