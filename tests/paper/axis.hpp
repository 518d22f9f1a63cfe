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

enum class Scale { linear, logarithmic };

// What a panel draws: where each value lies between the two ends of the axis, 0 to 1, and what is written there.
struct Axis {
  struct Tick {
    double value;
    std::string label;
  };
  Scale scale = Scale::linear;
  double low = 0, high = 1;
  std::vector<Tick> ticks;

  double share(double value) const;
};

// In: the values to be shown, positive where the scale is logarithmic. Linear: ends at ticks. Logarithmic: ends at 1, 2
// or 5 times a power of ten, which are its ticks; over more than two decades the powers alone.
Axis axis_for(Interval values, int wanted, Scale scale);

// The same without extending it: ends at the interval, ticks within.
Axis axis_within(Interval range, int wanted, Scale scale);

}  // namespace dashpot::paper
