// What the choice of observers needs to know of a part of the network: its dynamic stiffness D at a few places.
#pragma once

#include <vector>

#include "linear/linear_form.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

inline const Real equal_to{"1e-12"};  // relative: two dissipations that differ by less are equal

struct ObserverResponse {
  Real stiffness = 0;              // k0 of D(s) = k0 + z s + … for s → 0 [N/m]
  Real viscosity = 0;              // z there [N·s/m]
  ComplexReal at_reference{0, 0};  // D(jω) at the reference frequency [N/m]
  std::vector<Real> along;         // D(s) at positive s, the same places for every part of a network [N/m]
};

// Where the responses of a network's parts are taken.
class ObserverPlaces {
 public:
  ObserverPlaces(const Network& network, double reference_frequency);  // [rad/s]
  ObserverResponse of(const Law& law) const;

 private:
  Real reference_;
  std::vector<Real> along_;  // [1/s], to two decades beyond all ratios of a stiffness to a damping in the network
};

ObserverResponse in_parallel(const std::vector<ObserverResponse>& parts);
ObserverResponse in_series(const std::vector<ObserverResponse>& parts);
ObserverResponse scaled(ObserverResponse response, const Real& factor);

// D_first/D_second where it is one number at all frequencies to 1e-12, else zero.
Real constant_ratio(const ObserverResponse& first, const ObserverResponse& second);

}  // namespace dashpot::compiler
