#include "axes/curvature.hpp"
#include "axes/workspace.hpp"

namespace dashpot::compiler::axes {
namespace {

double bearing_of(const Pair<double>& v) { return std::atan2(v[1], v[0]); }

// The direction from a motor axis to the tip, seen from that to the middle of a box, from which it may be up to a
// quarter of a turn.
template <typename S>
S bearing_of(const Pair<S>& to, const Pair<double>& middle) {
  const Pair<S> ahead = constant<S>(middle);
  return atan(dot(turned(ahead), to) / dot(ahead, to)) + S(bearing_of(middle));
}

// Between the link at one end of a triangle and its third side: cos α = r/2a + (a² − b²)/2ar.
template <typename S>
S corner_of(const S& length, double a, double b) {
  const S difference = square(S(a)) - square(S(b)), twice(2 * a);
  return acos(length / twice + difference / (twice * length));
}

template <typename S>
Pair<S> two_links(const Arm& arm, const Pair<S>& tip, const Pair<double>& middle) {
  const S length = sqrt(length_squared(tip)), bearing = bearing_of(tip, middle);
  const S near = bearing - corner_of(length, arm.proximal, arm.distal);
  if (arm.kind == Kinematics::parallelogram) return {near, bearing + corner_of(length, arm.distal, arm.proximal)};
  const S cosine =
      (square(length) - square(S(arm.proximal)) - square(S(arm.distal))) / S(2 * arm.proximal * arm.distal);
  return {near, acos(cosine)};
}

template <typename S>
Pair<S> five_bar_joints(const Arm& arm, const Pair<S>& tip, const Pair<double>& middle) {
  const double half = arm.base / 2;
  const Pair<S> left{tip[0] + S(half), tip[1]}, right{tip[0] - S(half), tip[1]};
  const S from_left = bearing_of(left, {middle[0] + half, middle[1]}),
          from_right = bearing_of(right, {middle[0] - half, middle[1]});
  return {from_left + corner_of(sqrt(length_squared(left)), arm.proximal, arm.distal),
          from_right - corner_of(sqrt(length_squared(right)), arm.proximal, arm.distal)};
}

template <typename S>
Pair<S> joints_of(const Arm& arm, const Pair<S>& tip, const Pair<double>& middle) {
  return arm.kind == Kinematics::five_bar ? five_bar_joints(arm, tip, middle) : two_links(arm, tip, middle);
}

// All of a box is reached from a motor axis at x = `axis`, lies ahead of it, and no part makes links fold or stretch.
bool is_within(const Arm& arm, const Box& tip, double axis) {
  const Box to{tip[0] - Interval(axis), tip[1]};
  const Interval length = sqrt(length_squared(to));
  return dot(constant<Interval>(middle_of(to)), to).low > 0 && length.high < arm.proximal + arm.distal &&
         length.low > std::abs(arm.proximal - arm.distal);
}

bool is_within(const Arm& arm, const Box& tip) {
  if (arm.kind != Kinematics::five_bar) return is_within(arm, tip, 0);
  return is_within(arm, tip, -arm.base / 2) && is_within(arm, tip, arm.base / 2);
}

// The tip may also lie below the line of a five-bar's elbows, which is another branch.
bool is_on_branch(const Arm& arm, const Pair<double>& tip, const Pair<double>& joints) {
  const Pair<double> back = pose(arm, joints).tip - tip;
  return std::hypot(back[0], back[1]) <= 1e-9 * (arm.proximal + arm.distal);
}

}  // namespace

std::optional<Pair<double>> joints_at(const Arm& arm, const Pair<double>& tip) {
  if (arm.kind == Kinematics::cartesian) return tip;
  const Box point = constant<Interval>(tip);
  if (!is_within(arm, point)) return std::nullopt;
  const Pair<double> joints = middle_of(joints_of(arm, point, tip));
  if (!is_on_branch(arm, tip, joints)) return std::nullopt;
  return joints;
}

std::optional<Pair<Sloped>> enclosed_joints(const Arm& arm, const Pair<Sloped>& tip) {
  if (arm.kind == Kinematics::cartesian) return tip;
  const Box box{tip[0].value, tip[1].value};
  const Pair<double> middle = middle_of(box);
  if (!is_within(arm, box) || !joints_at(arm, middle)) return std::nullopt;
  return joints_of(arm, tip, middle);
}

std::optional<Box> joints_over(const Arm& arm, const Box& tip) {
  const std::optional<Pair<Sloped>> joints = enclosed_joints(arm, variables(tip));
  if (!joints) return std::nullopt;
  return Box{(*joints)[0].value, (*joints)[1].value};
}

TipMotion tip_motion(const Arm& arm, const Pair<Sloped>& joints, const Pair<Sloped>& tip) {
  if (arm.kind != Kinematics::five_bar) return {pose(arm, joints), curvature(arm, joints)};
  const FiveBar<Sloped> bar = five_bar(arm, joints, tip);
  return {pose_of(bar), five_bar_curvature(bar)};
}

}  // namespace dashpot::compiler::axes
