#include "axes/workspace.hpp"

#include <numbers>

#include "axes/curvature.hpp"

namespace dashpot::compiler::axes {
namespace {

constexpr int finest_part = 1024;  // of a workspace, either way
constexpr int range_part = 32;

// Whether a part of a workspace is as narrow as one of n × n.
bool is_one_of(int n, const Box& part, const Box& workspace) {
  return part[0].width() <= workspace[0].width() / n && part[1].width() <= workspace[1].width() / n;
}

Singularity singular_at(const Arm& arm, const Pair<double>& tip) {
  const double left = arm.kind == Kinematics::five_bar ? arm.base / 2 : 0;
  const double far = std::max(std::hypot(tip[0] + left, tip[1]), std::hypot(tip[0] - left, tip[1]));
  const double near = std::min(std::hypot(tip[0] + left, tip[1]), std::hypot(tip[0] - left, tip[1]));
  if (far > arm.proximal + arm.distal) return {Singularity::Kind::out_of_reach, tip};
  if (near < std::abs(arm.proximal - arm.distal) || !joints_at(arm, tip)) return {Singularity::Kind::too_close, tip};
  return {Singularity::Kind::in_line, tip};
}

bool is_regular(const Arm& arm, const Box& tip) {
  const std::optional<Box> joints = joints_over(arm, tip);
  if (!joints) return false;
  const Interval size = determinant(arm, *joints);
  return size.low > 0 && std::isfinite(size.high);
}

// Moved by whole turns as near to a joint position as possible.
Box without_jump(const Arm& arm, Box joints, const Pair<double>& near) {
  if (arm.kind == Kinematics::cartesian) return joints;
  for (const std::size_t j : {0u, 1u}) {
    const double turns = std::round((near[j] - joints[j].middle()) / (2 * std::numbers::pi));
    if (turns != 0) joints[j] = widened(joints[j] + Interval(2 * turns * std::numbers::pi), 1e-14);
  }
  return joints;
}

double centre(const Interval& range, int part, int n) { return range.low + (part + 0.5) / n * range.width(); }

}  // namespace

Pair<Box> halves(const Box& part, const Box& whole) {
  const std::size_t side = part[0].width() * whole[1].width() >= part[1].width() * whole[0].width() ? 0 : 1;
  Pair<Box> result{part, part};
  result[0][side].high = result[1][side].low = part[side].middle();
  return result;
}

std::optional<Singularity> singularity(const Arm& arm, const Box& workspace) {
  std::vector<Box> open{workspace};
  while (!open.empty()) {
    const Box part = open.back();
    open.pop_back();
    if (is_regular(arm, part)) continue;
    if (is_one_of(finest_part, part, workspace)) return singular_at(arm, middle_of(part));
    for (const Box& half : halves(part, workspace)) open.push_back(half);
  }
  return std::nullopt;
}

Box joint_ranges(const Arm& arm, const Box& workspace) {
  const std::optional<Pair<double>> middle = joints_at(arm, middle_of(workspace));
  std::optional<Box> all;
  std::vector<Box> open{workspace};
  while (!open.empty() && middle) {
    const Box part = open.back();
    open.pop_back();
    const std::optional<Box> joints = joints_over(arm, part);
    if (!is_one_of(joints ? range_part : finest_part, part, workspace)) {
      for (const Box& half : halves(part, workspace)) open.push_back(half);
    } else if (joints) {
      const Box seen = without_jump(arm, *joints, *middle);
      all = all ? Box{hull((*all)[0], seen[0]), hull((*all)[1], seen[1])} : seen;
    }
  }
  return all.value_or(Box{});
}

std::vector<Place> places_in(const Arm& arm, const Box& workspace, int n) {
  std::vector<Place> places;
  const double area = workspace[0].width() * workspace[1].width() / (n * n);
  for (int i = 0; i < n * n; ++i) {
    const auto joints = joints_at(arm, {centre(workspace[0], i % n, n), centre(workspace[1], i / n, n)});
    if (joints) places.push_back({*joints, area});
  }
  return places;
}

}  // namespace dashpot::compiler::axes
