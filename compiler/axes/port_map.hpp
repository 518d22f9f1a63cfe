// Maps of a port: how far the tip has gone into what the port's network resists [m], over the tip's position x [m].
//
//     Plane    offset + slope·x: `along` a direction, `wall`
//     Circle   ±(radius − ρ), ρ = √(|x − centre|² + δ²): `ball`, positive inside; `cavity`, positive outside
//     Band     radius − √((n·(x − through))² + δ²): `line`
//     Grid     a bicubic in each cell (grid_map.hpp)
//
// δ = 1 nm lets a map be differentiable at a centre and on a line too, so that a law needs no case there; it moves w by
// less than that. Any scalar, as kinematics.hpp; a circle or a band takes one root and one division by ρ > 0.
#pragma once

#include <optional>
#include <variant>

#include "axes/grid_map.hpp"
#include "axes/pair.hpp"
#include "axes/sloped.hpp"

namespace dashpot::compiler::axes {

inline constexpr double blunting = 1e-9;  // δ [m]

struct Plane {
  Pair<double> slope;  // [1]
  double offset = 0;   // [m]
};

struct Circle {
  Pair<double> centre;  // [m]
  double radius = 0;    // [m]
  double sign = 1;      // 1 for a ball, −1 for a cavity
};

struct Band {
  Pair<double> through;  // a point of the line [m]
  Pair<double> normal;   // of length 1
  double radius = 0;     // [m]
};

using PortMap = std::variant<Plane, Circle, Band, Grid>;

// Directions and normals of any length but 0; they are normalised. `normal` points out of the tissue.
Plane along(const Pair<double>& direction);
Plane wall(const Pair<double>& through, const Pair<double>& normal);
Circle ball(const Pair<double>& centre, double radius);
Circle cavity(const Pair<double>& centre, double radius);
Band line(const Pair<double>& through, const Pair<double>& direction, double radius);

// A tip position in a workspace at which the map has a peak, so that its gradient reverses within about δ: a centre, or
// where an axis crosses. Empty if there is none.
std::optional<Pair<double>> peak_in(const PortMap& map, const Box& workspace);

template <typename S>
Depth<S> depth(const Plane& plane, const Pair<S>& x) {
  const Pair<S> slope = constant<S>(plane.slope);
  return {S(plane.offset) + dot(slope, x), slope};
}

template <typename S>
Depth<S> depth(const Circle& circle, const Pair<S>& x) {
  using std::sqrt;
  const Pair<S> from = x - constant<S>(circle.centre);
  const S distance = sqrt(length_squared(from) + S(blunting * blunting));
  const S inverse = S(1) / distance;
  return {S(circle.sign) * (S(circle.radius) - distance),
          S(-circle.sign) * Pair<S>{fraction(from[0], inverse), fraction(from[1], inverse)}};
}

template <typename S>
Depth<S> depth(const Band& band, const Pair<S>& x) {
  using std::sqrt;
  const Pair<S> normal = constant<S>(band.normal);
  const S from = dot(normal, x - constant<S>(band.through));
  const S distance = sqrt(square(from) + S(blunting * blunting));
  return {S(band.radius) - distance, (S(-1) * fraction(from, S(1) / distance)) * normal};
}

template <typename S>
Depth<S> depth(const PortMap& map, const Pair<S>& x) {
  return std::visit([&](const auto& one) { return depth(one, x); }, map);
}

// ∂²w/∂x² [1/m].
template <typename S>
Symmetric<S> bend(const Plane&, const Pair<S>&) {
  return {S(0), S(0), S(0)};
}

// ∓(I − n nᵀ)/ρ with n = (x − centre)/ρ.
template <typename S>
Symmetric<S> bend(const Circle& circle, const Pair<S>& x) {
  using std::sqrt;
  const Pair<S> from = x - constant<S>(circle.centre);
  const S blunt(blunting * blunting), distance = sqrt(length_squared(from) + blunt);
  const S cube = S(-circle.sign) / (distance * square(distance));
  return cube * Symmetric<S>{square(from[1]) + blunt, S(-1) * from[0] * from[1], square(from[0]) + blunt};
}

// −(δ²/ρ³) n nᵀ.
template <typename S>
Symmetric<S> bend(const Band& band, const Pair<S>& x) {
  using std::sqrt;
  const Pair<S> normal = constant<S>(band.normal);
  const S blunt(blunting * blunting), distance = sqrt(square(dot(normal, x - constant<S>(band.through))) + blunt);
  return (S(-1) * blunt / (distance * square(distance))) * outer(normal);
}

template <typename S>
Symmetric<S> bend(const PortMap& map, const Pair<S>& x) {
  return std::visit([&](const auto& one) { return bend(one, x); }, map);
}

}  // namespace dashpot::compiler::axes
