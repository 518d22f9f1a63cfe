// One axis of a plot: the numbers that it shows and where they are drawn.
#pragma once

#include <string>
#include <vector>

namespace dashpot::compiler {

enum class AxisScale { linear, logarithmic };

struct Interval {
  double low;
  double high;
};

struct Tick {
  double value;
  std::string label;  // empty: a fine tick of a logarithmic axis
};

struct Axis {
  AxisScale scale;
  Interval shown;           // ends are ticks on a linear axis
  int power_of_ten;         // labels are in units of it; 0 on a logarithmic axis
  std::vector<Tick> ticks;  // ascending

  // From 0 at `shown.low` to 1 at `shown.high`.
  double place(double value) const;
};

// In: what is to be shown. Linear: steps of 1, 2 or 5 times a power of ten, about `wanted` of them, that enclose the
// values, labels far from 1 in units of a power of ten. Logarithmic: the values as they are, above zero, a label each
// decade or, over many, every second or third; where that gives fewer than two, more.
Axis linear_axis(Interval values, int wanted);
Axis logarithmic_axis(Interval values);

}  // namespace dashpot::compiler
