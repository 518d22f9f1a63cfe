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

double place(const Ticks& ticks, double value, double from, double to) {
  return from + (value - ticks.low()) / (ticks.high() - ticks.low()) * (to - from);
}

}  // namespace dashpot::paper
