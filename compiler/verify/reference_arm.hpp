// What the held forces of a law of two axes need at places of the workspace, in 100 digits by code that shares no
// formula with axes/: joints to tip by intersecting circles, gradients and Hessians by differences, the ports' forces
// from reference_form(). A bound over the whole workspace may not be below it.
#pragma once

#include <array>
#include <optional>

#include "emit/axes_emission.hpp"
#include "verify/reference_constants.hpp"
#include "verify/reference_form.hpp"

namespace dashpot::compiler {

using ReferencePair = std::array<Reference, 2>;

// Where the tip of an arm is (axes/kinematics.hpp) [m].
ReferencePair reference_tip(const axes::Arm& arm, const ReferencePair& joints);

// The facts of a port's own law.
LawFacts facts_of_port(const AxesCompilation& compilation, std::size_t port);

struct NeedAtPlaces {
  std::size_t places = 0;
  Reference most = 0;   // x of x W ≥ T_max 𝓑 where it is largest [N·s/m]
  ReferencePair tip{};  // there [m]
};

// At places spread over the workspace and where the certificate says that most is missing. Nothing where no device is
// named.
std::optional<NeedAtPlaces> need_at_places(const AxesCompilation& compilation);

}  // namespace dashpot::compiler
