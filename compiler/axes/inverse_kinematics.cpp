#include "axes/workspace.hpp"

namespace dashpot::compiler::axes {
namespace {

struct Sides {
  Interval squared, length, bearing;  // from a motor axis to the tip
};

double bearing_of(const Pair<double>& v) { return std::atan2(v[1], v[0]); }

// Seen from the middle's direction the box lies within a quarter of a turn to either side, and its outermost directions
// are those of corners; nothing where it does not.
std::optional<Interval> bearing_of(const Box& v) {
  const Pair<double> middle{v[0].middle(), v[1].middle()};
  const Pair<Interval> ahead = constant<Interval>(middle), aside = turned(ahead);
  std::optional<Interval> all;
  for (const double x : {v[0].low, v[0].high}) {
    for (const double y : {v[1].low, v[1].high}) {
      const Pair<Interval> to = constant<Interval>({x, y});
      const Interval forward = dot(ahead, to);
      if (!(forward.low > 0)) return std::nullopt;
      const Interval angle = atan(dot(aside, to) / forward);
      all = all ? hull(*all, angle) : angle;
    }
  }
  return *all + widened(Interval(bearing_of(middle)), 1e-15);
}

// Between the link at one end of a triangle and its third side: cos α = (r² + a² − b²)/(2 a r). Nothing where links a
// and b do not span r.
std::optional<Interval> corner_of(const Interval& squared, const Interval& length, double a, double b) {
  const Interval difference = square(Interval(a)) - square(Interval(b));
  const Interval cosine = (squared + difference) / (Interval(2 * a) * length);
  if (!(cosine.low > -1 && cosine.high < 1)) return std::nullopt;
  return acos(cosine);
}

std::optional<Sides> sides(const Box& from_motor) {
  const std::optional<Interval> bearing = bearing_of(from_motor);
  if (!bearing) return std::nullopt;
  const Interval squared = length_squared(from_motor);
  return Sides{squared, sqrt(squared), *bearing};
}

std::optional<Box> two_links(const Arm& arm, const Box& tip) {
  const std::optional<Sides> to = sides(tip);
  if (!to) return std::nullopt;
  const auto near = corner_of(to->squared, to->length, arm.proximal, arm.distal);
  const auto far = corner_of(to->squared, to->length, arm.distal, arm.proximal);
  if (!near || !far) return std::nullopt;
  if (arm.kind == Kinematics::parallelogram) return Box{to->bearing - *near, to->bearing + *far};
  const Interval links = Interval(2) * Interval(arm.proximal) * Interval(arm.distal);
  const Interval cosine = (to->squared - square(Interval(arm.proximal)) - square(Interval(arm.distal))) / links;
  return Box{to->bearing - *near, acos(cosine)};
}

std::optional<Box> five_bar_joints(const Arm& arm, const Box& tip) {
  Box result;
  for (const std::size_t side : {0u, 1u}) {
    const Interval axis(side == 0 ? -arm.base / 2 : arm.base / 2);
    const std::optional<Sides> to = sides({tip[0] - axis, tip[1]});
    if (!to) return std::nullopt;
    const auto near = corner_of(to->squared, to->length, arm.proximal, arm.distal);
    if (!near) return std::nullopt;
    result[side] = side == 0 ? to->bearing + *near : to->bearing - *near;
  }
  return result;
}

// The tip may also lie below the line of a five-bar's elbows, which is another branch.
bool is_on_branch(const Arm& arm, const Pair<double>& tip, const Pair<double>& joints) {
  const Pair<double> back = pose(arm, joints).tip - tip;
  return std::hypot(back[0], back[1]) <= 1e-9 * (arm.proximal + arm.distal);
}

}  // namespace

std::optional<Pair<double>> joints_at(const Arm& arm, const Pair<double>& tip) {
  if (arm.kind == Kinematics::cartesian) return tip;
  const Box point{Interval(tip[0]), Interval(tip[1])};
  const auto found = arm.kind == Kinematics::five_bar ? five_bar_joints(arm, point) : two_links(arm, point);
  if (!found || !is_on_branch(arm, tip, middle_of(*found))) return std::nullopt;
  return middle_of(*found);
}

std::optional<Box> joints_over(const Arm& arm, const Box& tip) {
  if (arm.kind == Kinematics::cartesian) return tip;
  if (!joints_at(arm, middle_of(tip))) return std::nullopt;
  return arm.kind == Kinematics::five_bar ? five_bar_joints(arm, tip) : two_links(arm, tip);
}

}  // namespace dashpot::compiler::axes
