// The map w of the tool's displacement behind which a network lies, so that at rest it answers with its static curve
// (theory, section 11):
//
//     w = sgn(u) √(2 E(|u|)/k),   E = ∫ f du,   w′ = f/(k w)
//
// in the form that is emitted: a piecewise cubic over uniform knots, and its own derivative.
#pragma once

#include <optional>
#include <vector>

#include "linear/linear_form.hpp"
#include "linear/real.hpp"
#include "network/motion_map.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// At a displacement that is not negative [N], and between two of them the work [J].
Real force_at(const StaticCurve& curve, const Real& displacement);
Real work_between(const StaticCurve& curve, const Real& from, const Real& to);

inline constexpr double most_static_error = 5e-4;     // that more cubics are taken for
inline constexpr double largest_static_error = 1e-2;  // beyond, a curve is refused
inline constexpr std::size_t most_cubics = 1024;

// In: a network with a static curve, the form of what of it reaches to ground without a slip. Out: its map, of 32
// cubics or of as many times two as it takes to have the static force off by no more than `error` of the largest, if
// most_cubics do. Refuses: a curve at rest of a network that holds no force at rest, a curve at once of one that has no
// springs, a curve that bends too sharply.
std::optional<MotionMap> motion_map(const Network& network, const LinearForm& form, Diagnostics& diagnostics,
                                    double error = most_static_error);

}  // namespace dashpot::compiler
