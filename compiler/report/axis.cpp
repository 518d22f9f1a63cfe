#include "report/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "report/number_text.hpp"

namespace dashpot::compiler {
namespace {

double round_step(double rough) {
  const double decade = std::pow(10, std::floor(std::log10(rough)));
  for (const double multiple : {1.0, 2.0, 5.0})
    if (rough <= multiple * decade * (1 + 1e-9)) return multiple * decade;
  return 10 * decade;
}

// A multiple of three, so that it goes with a prefix of the unit.
int power_for(double largest) {
  const int decade = static_cast<int>(std::floor(std::log10(largest) + 1e-9));
  return decade >= -2 && decade <= 3 ? 0 : 3 * static_cast<int>(std::floor(decade / 3.0));
}

constexpr int most_labels = 7;

}  // namespace

double Axis::place(double value) const {
  if (scale == AxisScale::linear) return (value - shown.low) / (shown.high - shown.low);
  return std::log(value / shown.low) / std::log(shown.high / shown.low);
}

Axis linear_axis(Interval values, int wanted) {
  // A curve that is flat but for rounding is shown as flat.
  const double size = std::max(std::abs(values.low), std::abs(values.high));
  if (values.high - values.low <= 1e-9 * size) values = {values.low - 0.5 * size, values.high + 0.5 * size};
  if (size == 0) values = {-1, 1};
  const double step = round_step((values.high - values.low) / wanted);
  const double first = std::floor(values.low / step + 1e-9);
  const double last = std::max(first + 1, std::ceil(values.high / step - 1e-9));
  Axis axis{
      AxisScale::linear, {first * step, last * step}, power_for(std::max(std::abs(first), std::abs(last)) * step), {}};
  for (double i = first; i <= last; ++i)
    axis.ticks.push_back({i * step, number_text(i * step / std::pow(10, axis.power_of_ten))});
  return axis;
}

namespace {

// Less than two decades need not hold two powers of ten: there fine ticks have numbers too, as many as have room, and
// where even those are fewer than two, the steps of a linear axis have.
void label_at_least_two(Axis& axis) {
  const auto has_label = [](const Tick& tick) { return !tick.label.empty(); };
  if (std::count_if(axis.ticks.begin(), axis.ticks.end(), has_label) >= 2) return;
  if (axis.ticks.size() < 2) {
    axis.ticks = linear_axis(axis.shown, 4).ticks;
    std::erase_if(axis.ticks,
                  [&](const Tick& tick) { return tick.value < axis.shown.low || tick.value > axis.shown.high; });
  }
  const std::size_t count = axis.ticks.size();
  const std::string_view digits = count <= 4 ? "123456789" : count <= 9 ? "12357" : "125";
  for (Tick& tick : axis.ticks)
    if (digits.find(fmt::format("{:e}", tick.value).front()) != digits.npos) tick.label = number_text(tick.value);
}

}  // namespace

Axis logarithmic_axis(Interval values) {
  Axis axis{AxisScale::logarithmic, values, 0, {}};
  const int first = static_cast<int>(std::floor(std::log10(values.low) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(values.high) - 1e-9));
  const int stride = 1 + (last - first) / most_labels;
  for (int decade = first; decade <= last; ++decade)
    for (int multiple = 1; multiple < (stride == 1 ? 10 : 2); ++multiple) {
      const double value = multiple * std::pow(10, decade);
      if (value < values.low * (1 - 1e-9) || value > values.high * (1 + 1e-9)) continue;
      axis.ticks.push_back({value, multiple == 1 && decade % stride == 0 ? number_text(value) : ""});
    }
  label_at_least_two(axis);
  return axis;
}

}  // namespace dashpot::compiler
