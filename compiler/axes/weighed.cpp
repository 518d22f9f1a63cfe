#include "axes/weighed.hpp"

#include <array>

namespace dashpot::compiler::axes {
namespace {

// N to W^−½ N W^−½, of which x is the largest eigenvalue.
class Scaling {
 public:
  explicit Scaling(const Pair<double>& weight)
      : first_(Interval(1) / Interval(weight[0])),
        coupled_(Interval(1) / sqrt(Interval(weight[0]) * Interval(weight[1]))),
        second_(Interval(1) / Interval(weight[1])) {}

  Symmetric<Interval> operator()(const Interval& xx, const Interval& xy, const Interval& yy) const {
    return {first_ * xx, coupled_ * xy, second_ * yy};
  }

 private:
  Interval first_, coupled_, second_;
};

// x of a scaled matrix, and no less; ∞ where it has no numbers.
double largest_of(const Symmetric<Interval>& m) {
  const Interval a(m.xx.high), c(m.yy.high), b(abs(m.xy).high), half(0.5);
  const double x = (half * (a + c) + sqrt(square(half * (a - c)) + square(b))).high;
  return x < infinity ? x : infinity;
}

struct Corner {
  Symmetric<Interval> scaled;
  Pair<double> at{0, 0};
};

}  // namespace

Largest weighed(const Symmetric<Sloped>& n, const Pair<double>& weight) {
  const Scaling scaled(weight);
  std::array<Corner, std::size_t(1) << std::tuple_size_v<Slopes>> corners;
  corners[0].scaled = scaled(n.xx.middle, n.xy.middle, n.yy.middle);
  std::size_t count = 1;
  for (std::size_t j = 0; j < std::tuple_size_v<Slopes>; ++j) {
    if (is_zero(n.xx.slope[j]) && is_zero(n.xy.slope[j]) && is_zero(n.yy.slope[j])) continue;
    const Symmetric<Interval> way = scaled(n.xx.slope[j], n.xy.slope[j], n.yy.slope[j]);
    for (std::size_t i = 0; i < count; ++i) {
      Corner &ahead = corners[i], &behind = corners[count + i];
      behind = {ahead.scaled - way, ahead.at};
      ahead.scaled = ahead.scaled + way;
      if (j < 2) ahead.at[j] = 1, behind.at[j] = -1;
    }
    count *= 2;
  }
  Largest most{-infinity};
  for (std::size_t i = 0; i < count; ++i) {
    const double x = largest_of(corners[i].scaled);
    if (x > most.x) most = {x, corners[i].at};
  }
  most.x = std::min(most.x, largest_of(scaled(n.xx.value, n.xy.value, n.yy.value)));
  return most;
}

double size_of(const Symmetric<Sloped>& h, const Pair<double>& weight) {
  return std::max(weighed(h, weight).x, weighed(Sloped(-1) * h, weight).x);
}

Pair<double> place_in(const Box& box, const Largest& largest) {
  Pair<double> place = middle_of(box);
  for (const std::size_t j : {0u, 1u})
    if (largest.at[j] != 0) place[j] = largest.at[j] > 0 ? box[j].high : box[j].low;
  return place;
}

}  // namespace dashpot::compiler::axes
