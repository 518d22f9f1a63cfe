// Words of the page that depend on numbers.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace dashpot::paper {

inline std::string outcome(bool comes_out) { return comes_out ? "comes out" : "does not come out"; }

inline std::string more_or_less(double value, double reference) { return value > reference ? "more" : "less"; }

struct Range {
  double low = 0, high = 0;
};

template <class Items, class Value>
Range range_of(const Items& items, Value value) {
  Range range{value(*items.begin()), value(*items.begin())};
  for (const auto& item : items) range = {std::min(range.low, value(item)), std::max(range.high, value(item))};
  return range;
}

}  // namespace dashpot::paper
