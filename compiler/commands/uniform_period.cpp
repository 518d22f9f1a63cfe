#include "commands/uniform_period.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "network/decimal.hpp"

namespace dashpot::compiler {
namespace {

constexpr int farthest_exponent = 400;  // beyond any double's

// A double's own rounding, of two times and of their difference.
double rounding_at(double time) { return 4 * 0x1p-52 * std::abs(time); }

std::vector<double> steps_between(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  return steps;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<std::size_t> row_without_rise(const std::vector<double>& times) {
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1])) return i;
  return std::nullopt;
}

// The first row whose step is not the median to `uniformity` and `allowance`.
std::optional<std::size_t> row_off_step(const std::vector<double>& times, double median, double allowance) {
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double departure = std::abs(times[i] - times[i - 1] - median);
    if (!(departure <= uniformity * median + rounding_at(times[i]) + allowance)) return i;
  }
  return std::nullopt;
}

// The first row that leaves the straight line through the ends by more than the rounding of both: times t + e, |e| ≤
// unit/2. Where the period between the ends is a whole number of units, e is the same at both; what is between them is
// off by no less than the one and no more than the other, so by the same too.
std::optional<std::size_t> row_off_line(const std::vector<double>& times, double period, const TimeDigits& digits,
                                        double unit_at_ends) {
  const double duration = times.back() - times.front(), units = std::round(duration / unit_at_ends);
  const bool is_whole = std::abs(duration - units * unit_at_ends) <= rounding_at(times.back()) &&
                        std::fmod(units, static_cast<double>(times.size() - 1)) == 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double departure = std::abs(times[i] - (times.front() + static_cast<double>(i) * period));
    const double unit = digits.unit_at(times[i]);
    const double rounding = is_whole && unit == unit_at_ends ? 0 : (unit_at_ends + unit) / 2;
    if (departure > rounding + uniformity * period + rounding_at(times[i])) return i;
  }
  return std::nullopt;
}

}  // namespace

void TimeDigits::add(std::string_view number) {
  const std::size_t mantissa_end = std::min(number.find_first_of("eE"), number.size());
  int exponent = 0, decimals = 0, significant = 0;
  if (mantissa_end < number.size()) {
    const std::string_view text = number.substr(mantissa_end + (number.substr(mantissa_end + 1, 1) == "+" ? 2 : 1));
    std::from_chars(text.data(), text.data() + text.size(), exponent);
    exponent = std::clamp(exponent, -farthest_exponent, farthest_exponent);
  }
  bool behind_point = false;
  for (const char c : number.substr(0, mantissa_end)) {
    if (c == '.') behind_point = true;
    if (!is_digit(c)) continue;
    if (behind_point) ++decimals;
    if (significant > 0 || c != '0') ++significant;
  }
  if (significant == 0 && decimals == 0) return;  // a bare 0 says nothing of the digits of others
  last_place_ = std::min(last_place_.value_or(exponent - decimals), exponent - decimals);
  significant_ = std::max(significant_, significant);
}

double TimeDigits::unit_at(double time) const {
  const double by_decimals = std::pow(10.0, last_place_.value_or(0));
  if (time == 0) return unit_ * by_decimals;
  return unit_ *
         std::max(by_decimals, std::pow(10.0, std::floor(std::log10(std::abs(time / unit_))) + 1 - significant_));
}

std::variant<UniformPeriod, Irregularity> uniform_period(const std::vector<double>& times, const TimeDigits& digits) {
  const double unit = std::max(digits.unit_at(times.front()), digits.unit_at(times.back()));
  if (const auto row = row_without_rise(times))
    return Irregularity{Irregularity::Kind::no_rise, *row, times[*row], times[*row - 1], 0, unit};
  const double median = median_of(steps_between(times));
  const auto last = static_cast<double>(times.size() - 1);
  const double period = (times.back() - times.front()) / last;
  const std::optional<std::size_t> off_step = row_off_step(times, median, 0);
  const double rounding = rounding_at(times.back());
  if (!off_step) return UniformPeriod{period, rounding / last};
  const auto irregular = [&](std::size_t row) {
    return Irregularity{Irregularity::Kind::step, row, times[row] - times[row - 1], median, median, unit};
  };
  if (unit > coarsest_share * median) return irregular(*off_step);
  if (const auto row = row_off_line(times, period, digits, unit)) {
    // Steps of a uniform motion, rounded, are of two lengths that differ by a unit.
    if (const auto gap = row_off_step(times, median, unit)) return irregular(*gap);
    return Irregularity{
        Irregularity::Kind::drift, *row, times[*row], times.front() + static_cast<double>(*row) * period, period, unit};
  }
  return UniformPeriod{period, (unit + rounding) / last};
}

}  // namespace dashpot::compiler
