#include "certify/sampled_bound.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <queue>

namespace dashpot::compiler {
namespace {

using std::numbers::pi;

struct BoundedArc {
  Arc arc;
  double bound;
  bool operator<(const BoundedArc& other) const { return bound < other.bound; }
};

}  // namespace

SampledBound sampled_bound(const NeededDamping& needed, double sample_period, std::size_t terms) {
  SampledBound result;
  result.attained = -std::numeric_limits<double>::infinity();
  std::priority_queue<BoundedArc> open;
  const auto look = [&](const Arc& arc) {
    const NeededDamping::Bounds bounds = needed.on(arc);
    ++result.arcs;
    open.push({arc, bounds.over_arc});
    if (!(bounds.at_centre > result.attained)) return;
    result.attained = bounds.at_centre;
    result.frequency = arc.angle() / (2 * pi * sample_period);
  };
  look({0, 0});  // most suprema lie at rest or at Nyquist
  look({1, 1});
  look({0, 1});
  const double resolution = std::max(1e-12, 4 * needed.roundoff()) * needed.scale();
  while (result.arcs * needed.terms() < terms) {
    const BoundedArc highest = open.top();
    const double middle = highest.arc.centre();
    const bool close = highest.bound <= result.attained + bound_precision * std::max(result.attained, 0.0) + resolution;
    if (close || middle <= highest.arc.low || middle >= highest.arc.high) break;
    open.pop();
    look({highest.arc.low, middle});
    look({middle, highest.arc.high});
  }
  result.needed = std::max(open.top().bound, result.attained);
  return result;
}

}  // namespace dashpot::compiler
