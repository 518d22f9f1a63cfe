#include "axes/motor_norms.hpp"

#include <algorithm>

#include "axes/best_first.hpp"
#include "axes/curvature.hpp"
#include "axes/weighed.hpp"

namespace dashpot::compiler::axes {
namespace {

Largest larger(const Largest& one, const Largest& other) { return one.x < other.x || other.x != other.x ? other : one; }

// `matrices_at` gives the matrices at a motion of the tip; the largest |λ| of any of them counts.
template <typename Matrices>
Size largest_size(const Arm& arm, const Box& workspace, const Pair<double>& weight, int parts,
                  const Matrices& matrices_at) {
  double attained = 0;
  const auto size_over = [&](const Box& tip) {
    const std::optional<Pair<Sloped>> joints = enclosed_joints(arm, variables(tip));
    if (!joints) return Largest{infinity};
    Largest most{0};
    for (const Symmetric<Sloped>& one : matrices_at(tip_motion(arm, *joints, variables(tip))))
      most = larger(larger(most, weighed(one, weight)), weighed(Sloped(-1) * one, weight));
    return most.x < infinity ? most : Largest{infinity};  // also for a NaN
  };
  const auto measured = [&](const Box& tip) {
    const Largest most = size_over(tip);
    if (!(most.x > attained) || most.x == infinity) return most.x;
    const double there = size_over(constant<Interval>(place_in(tip, most))).x;
    if (there < infinity) attained = std::max(attained, there);
    return std::max(most.x, attained);
  };
  const double most = best_first(workspace, parts, measured,
                                 [&](double bound) { return bound - attained <= bound_tolerance * attained; });
  return {most, attained};
}

// The sums for all choices of ports that are off.
std::vector<Symmetric<Sloped>> wanted_by(const std::vector<PortDamping>& ports, const ViscousField& field,
                                         const Pose<Sloped>& pose) {
  std::vector<Symmetric<Sloped>> sums{at_joints(pose, symmetric_part(field_at(field, pose.tip)))};
  for (const PortDamping& port : ports) {
    const Symmetric<Sloped> on = Sloped(port.damping) * outer(at_joints(pose, depth(port.map, pose.tip).gradient));
    const std::size_t so_far = sums.size();
    for (std::size_t i = 0; i < so_far; ++i) {
      if (port.is_off) sums.push_back(sums[i]);
      sums[i] = sums[i] + on;
    }
  }
  return sums;
}

}  // namespace

Size largest_remainder(const Arm& arm, const Box& workspace, const std::vector<PortDamping>& ports,
                       const ViscousField& field, const std::vector<Brake>& brakes, BrakeRule rule,
                       const Pair<double>& weight, int parts) {
  return largest_size(arm, workspace, weight, parts, [&](const TipMotion& there) {
    std::vector<Symmetric<Sloped>> remainders;
    for (const Symmetric<Sloped>& wanted : wanted_by(ports, field, there.pose))
      remainders.push_back(rule == BrakeRule::diagonal ? wanted - made_by(brakes, diagonal(brakes, wanted)) : wanted);
    return remainders;
  });
}

Size largest_uncoupled_remainder(const Arm& arm, const Box& workspace, const std::vector<PortDamping>& ports,
                                 const ViscousField& field, const Pair<Brake>& brakes, const Pair<double>& weight,
                                 int parts) {
  if (brakes[0].most >= unlimited && brakes[1].most >= unlimited) return {0, 0};
  const Pair<Pair<double>> base = dual(brakes[0].along, brakes[1].along);
  return largest_size(arm, workspace, weight, parts, [&](const TipMotion& there) {
    std::vector<Symmetric<Sloped>> remainders;
    for (const Symmetric<Sloped>& wanted : wanted_by(ports, field, there.pose)) {
      const Symmetric<Sloped> along = along_brakes(base, wanted);
      const Sloped first = max(along.xx - Sloped(brakes[0].most), Sloped(0)),
                   second = max(along.yy - Sloped(brakes[1].most), Sloped(0));
      remainders.push_back(first * outer(constant<Sloped>(brakes[0].along)) +
                           second * outer(constant<Sloped>(brakes[1].along)));
    }
    return remainders;
  });
}

// [[0, σ], [σ, 0]] has the same size.
Size largest_curl(const Arm& arm, const Box& workspace, const ViscousField& field, const Pair<double>& weight,
                  int parts) {
  return largest_size(arm, workspace, weight, parts, [&](const TipMotion& there) {
    const auto& [first, second] = there.pose.column;
    const Sloped determinant = first[0] * second[1] - first[1] * second[0];
    const Matrix<Sloped> a = field_at(field, there.pose.tip);
    return std::vector{Symmetric<Sloped>{Sloped(0), Sloped(0.5) * (a[0][1] - a[1][0]) * determinant, Sloped(0)}};
  });
}

Size largest_gradient(const Arm& arm, const Box& workspace, const PortMap& map, const Pair<double>& weight, int parts) {
  return largest_size(arm, workspace, weight, parts, [&](const TipMotion& there) {
    return std::vector{outer(at_joints(there.pose, depth(map, there.pose.tip).gradient))};
  });
}

Size largest_turning(const Arm& arm, const Box& workspace, const PortLoad& load, const Pair<double>& weight,
                     int parts) {
  const Interval range = range_of(load.map, workspace);
  return largest_size(arm, workspace, weight, parts, [&](const TipMotion& there) {
    const Depth<Sloped> depth = axes::depth(load.map, there.pose.tip);
    const double force = abs(motor_force(load, depth.value.value, range)).high;
    if (force == 0) return std::vector<Symmetric<Sloped>>{};
    return std::vector{Sloped(force) *
                       at_joints(there.pose, there.bends, depth.gradient, bend(load.map, there.pose.tip))};
  });
}

}  // namespace dashpot::compiler::axes
