#include "axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dashpot::paper {
namespace {

double round_step(double rough) {
  const double decade = std::pow(10, std::floor(std::log10(rough)));
  for (const double multiple : {1.0, 2.0, 5.0})
    if (rough <= multiple * decade * (1 + 1e-9)) return multiple * decade;  // 0.1 + 0.2 is to count as 0.3
  return 10 * decade;
}

// 1, 2 or 5 times a power of ten, at least `value` but for rounding.
double round_number_above(double value) { return round_step(value); }

double round_number_below(double value) { return 1 / round_step(1 / value); }

std::string plain_number(double value) {
  return value >= 1e-3 && value < 1e6 ? fmt::format("{:g}", value) : fmt::format("{:.0e}", value);
}

Axis logarithmic_axis(Interval range) {
  Axis axis{Scale::logarithmic, range.low, range.high, {}};
  const bool decades_alone = range.high / range.low > 200;
  for (double decade = std::pow(10, std::floor(std::log10(range.low) - 1e-9)); decade <= range.high * (1 + 1e-9);
       decade *= 10)
    for (const double multiple : {1.0, 2.0, 5.0}) {
      const double value = multiple * decade;
      const bool is_inside = value >= range.low * (1 - 1e-9) && value <= range.high * (1 + 1e-9);
      if (is_inside && (multiple == 1 || !decades_alone)) axis.ticks.push_back({value, plain_number(value)});
    }
  return axis;
}

}  // namespace

Ticks ticks_for(Interval values, int wanted) {
  if (!(values.high > values.low)) values = {values.low - 0.5, values.low + 0.5};
  Ticks ticks;
  ticks.step = round_step((values.high - values.low) / wanted);
  // A value that misses a tick by rounding alone does not ask for another step.
  ticks.first = std::lround(std::floor(values.low / ticks.step + 1e-9));
  ticks.last = std::max(ticks.first + 1, std::lround(std::ceil(values.high / ticks.step - 1e-9)));
  return ticks;
}

std::string tick_label(const Ticks& ticks, long count) {
  const int decimals = std::max(0, -int(std::floor(std::log10(ticks.step) + 1e-9)));
  return fmt::format("{}{:.{}f}", count < 0 ? "−" : "", std::abs(double(count) * ticks.step), decimals);
}

double Axis::share(double value) const {
  if (scale == Scale::linear) return (value - low) / (high - low);
  return std::log(value / low) / std::log(high / low);
}

Axis axis_for(Interval values, int wanted, Scale scale) {
  if (scale == Scale::logarithmic)
    return axis_within({round_number_below(values.low), round_number_above(values.high)}, wanted, scale);
  const Ticks ticks = ticks_for(values, wanted);
  Axis axis{scale, ticks.low(), ticks.high(), {}};
  for (long i = ticks.first; i <= ticks.last; ++i) axis.ticks.push_back({double(i) * ticks.step, tick_label(ticks, i)});
  return axis;
}

Axis axis_within(Interval range, int wanted, Scale scale) {
  if (scale == Scale::logarithmic) return logarithmic_axis(range);
  const Ticks ticks = ticks_for(range, wanted);
  Axis axis{scale, range.low, range.high, {}};
  const double slack = 1e-9 * ticks.step;
  for (long i = ticks.first; i <= ticks.last; ++i) {
    const double value = double(i) * ticks.step;
    if (value >= range.low - slack && value <= range.high + slack) axis.ticks.push_back({value, tick_label(ticks, i)});
  }
  return axis;
}

}  // namespace dashpot::paper
