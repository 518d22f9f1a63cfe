// The map w of the tool's displacement u that makes a network's force at rest follow a given static curve f(u) (theory,
// section 11):
//
//     w = sgn(u) √(2 E(|u|)/k),   E = ∫ f du,   w′ = f/(k w)
//
// where k is a stiffness of the network. It is emitted as a piecewise cubic over uniform knots, with its own
// derivative.
#pragma once

#include <optional>
#include <vector>

#include "linear/linear_form.hpp"
#include "linear/real.hpp"
#include "network/motion_map.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// The curve's force at a displacement of 0 or more [N], and its work between two displacements [J].
Real force_at(const StaticCurve& curve, const Real& displacement);
Real work_between(const StaticCurve& curve, const Real& from, const Real& to);

inline constexpr double most_static_error = 5e-4;     // above it, more cubics are used
inline constexpr double largest_static_error = 1e-2;  // above it, a curve is refused
inline constexpr std::size_t most_cubics = 1024;

// In: a network with a static curve, and the form of its part that reaches ground without a slip, whose k0 a curve at
// rest takes; a curve at once takes k0 + Σ k_i of the network while all slips hold. Out: its map, of 32 cubics, doubled
// until the static force is off by no more than `error` of the largest, or up to most_cubics. Refuses: a curve at rest
// for a network that holds no force at rest, a curve at once for one without springs, a curve that bends too sharply.
std::optional<MotionMap> motion_map(const Network& network, const LinearForm& form, Diagnostics& diagnostics,
                                    double error = most_static_error);

}  // namespace dashpot::compiler
