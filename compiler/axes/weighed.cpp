#include "axes/weighed.hpp"

#include <utility>
#include <vector>

namespace dashpot::compiler::axes {

Interval weighed(const Symmetric<Interval>& n, const Pair<double>& weight) {
  const Interval first(weight[0]), second(weight[1]);
  const Interval a = Interval(n.xx.high) / first, c = Interval(n.yy.high) / second;
  const Interval coupling = Interval(abs(n.xy).high);
  return Interval(0.5) * (a + c) + sqrt(square(Interval(0.5) * (a - c)) + square(coupling) / (first * second));
}

Largest weighed(const Symmetric<Sloped>& n, const Pair<double>& weight) {
  const auto is_level = [&](std::size_t j) {
    const auto level = [&](const Sloped& s) { return s.slope[j].low == 0 && s.slope[j].high == 0; };
    return level(n.xx) && level(n.xy) && level(n.yy);
  };
  std::vector<std::pair<Symmetric<Interval>, Pair<double>>> ends{{{n.xx.middle, n.xy.middle, n.yy.middle}, {0, 0}}};
  for (std::size_t j = 0; j < std::tuple_size_v<Slopes>; ++j) {
    if (is_level(j)) continue;
    const Symmetric<Interval> way{n.xx.slope[j], n.xy.slope[j], n.yy.slope[j]};
    const std::size_t so_far = ends.size();
    for (std::size_t i = 0; i < so_far; ++i) {
      auto [less, at] = ends[i];
      if (j < 2) at[j] = -1;
      ends.emplace_back(less - way, at);
      ends[i].first = less + way;
      if (j < 2) ends[i].second[j] = 1;
    }
  }
  Largest most{-infinity};
  for (const auto& [end, at] : ends) {
    const double x = weighed(end, weight).high;
    if (!(x <= most.x)) most = {x, at};
  }
  const double as_they_are = weighed(Symmetric<Interval>{n.xx.value, n.xy.value, n.yy.value}, weight).high;
  if (!(most.x <= as_they_are)) most.x = as_they_are;
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
