#include <dashpot/simulated/trajectory.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace dashpot::simulated {
namespace {

// The way between two knots: the share of it that is done, and how fast, when the share τ of the time is over.
using gait = motion_point (*)(double tau);

motion_point at_constant_speed(double tau) { return {tau, 1}; }

motion_point with_least_jerk(double tau) {
  const double rest = 1 - tau;
  return {tau * tau * tau * (10 + tau * (6 * tau - 15)), 30 * tau * tau * rest * rest};
}

trajectory walk(std::vector<knot> knots, gait stride) {
  assert(!knots.empty());
  return [knots = std::move(knots), stride](double time) -> motion_point {
    const auto later = [](double t, const knot& k) { return t < k.time; };
    const auto next = std::upper_bound(knots.begin(), knots.end(), time, later);
    if (next == knots.begin()) return {knots.front().position, 0};
    if (next == knots.end()) return {knots.back().position, 0};
    const knot& from = *(next - 1);
    const double duration = next->time - from.time;
    const double way = next->position - from.position;
    const motion_point share = stride((time - from.time) / duration);
    return {from.position + way * share.position, way / duration * share.velocity};
  };
}

}  // namespace

trajectory hold_at(double position) {
  return [position](double) { return motion_point{position, 0}; };
}

trajectory sine(double amplitude, double frequency, double phase, double centre) {
  const double rate = 2 * 3.14159265358979323846 * frequency;
  return [=](double time) {
    const double angle = rate * time + phase;
    return motion_point{centre + amplitude * std::sin(angle), amplitude * rate * std::cos(angle)};
  };
}

trajectory through(std::vector<knot> knots) { return walk(std::move(knots), at_constant_speed); }

trajectory smoothly_through(std::vector<knot> knots) { return walk(std::move(knots), with_least_jerk); }

}  // namespace dashpot::simulated
