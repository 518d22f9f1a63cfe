// One axis of a panel: which numbers it shows, and where they are drawn.
#pragma once

#include <string>
#include <vector>

namespace dashpot::paper {

struct Interval {
  double low = 0, high = 0;
};

// In: the least and the greatest value to be shown, finite. Out: a step of 1, 2 or 5 times a power of ten and the whole
// steps that enclose the values, about `wanted` of them and at least one.
struct Ticks {
  double step = 1;
  long first = 0, last = 1;  // in steps

  double low() const { return double(first) * step; }
  double high() const { return double(last) * step; }
};
Ticks ticks_for(Interval values, int wanted);

// The label of the tick `count` steps from zero: as many decimals as the step needs.
std::string tick_label(const Ticks& ticks, long count);

// Where on the paper, between `from` and `to`, the value lies.
double place(const Ticks& ticks, double value, double from, double to);

}  // namespace dashpot::paper
