#include "network/dimension.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace dashpot::compiler {
namespace {

struct NamedDimension {
  Dimension dimension;
  std::string_view words;
  std::string_view unit;
};

constexpr NamedDimension named_dimensions[] = {
    {dimensions::mass, "a mass", "kg"},
    {dimensions::length, "a length", "m"},
    {dimensions::time, "a time", "s"},
    {dimensions::angle, "an angle", "rad"},
    {dimensions::frequency, "a frequency", "Hz"},
    {dimensions::velocity, "a velocity", "m/s"},
    {dimensions::angular_velocity, "an angular velocity", "rad/s"},
    {dimensions::acceleration, "an acceleration", "m/s^2"},
    {dimensions::angular_acceleration, "an angular acceleration", "rad/s^2"},
    {dimensions::force, "a force", "N"},
    {dimensions::torque, "a torque", "N m"},
    {dimensions::force_rate, "a force over time", "N/s"},
    {dimensions::torque_rate, "a torque over time", "N m/s"},
    {dimensions::stiffness, "a stiffness", "N/m"},
    {dimensions::rotational_stiffness, "a rotational stiffness", "N m/rad"},
    {dimensions::damping, "a damping", "N s/m"},
    {dimensions::rotational_damping, "a rotational damping", "N m s/rad"},
    {dimensions::inertia, "a moment of inertia", "kg m^2"},
    {dimensions::current, "a current", "A"},
    {dimensions::current_rate, "a rate of current", "A/s"},
    {dimensions::force_constant, "a force constant", "N/A"},
    {dimensions::torque_constant, "a torque constant", "N m/A"},
    {dimensions::damping_per_current_squared, "a damping per squared current", "N s/(m A^2)"},
    {dimensions::rotational_damping_per_current_squared, "a rotational damping per squared current", "N m s/(rad A^2)"},
};

const NamedDimension* find_name(const Dimension& dimension) {
  const auto found = std::find_if(std::begin(named_dimensions), std::end(named_dimensions),
                                  [&](const NamedDimension& named) { return named.dimension == dimension; });
  return found == std::end(named_dimensions) ? nullptr : found;
}

struct BasePower {
  std::string_view unit;
  int exponent;
};

// The factors whose exponents have that sign, by their magnitudes.
std::string factors(const Dimension& dimension, int sign) {
  std::string text;
  for (const BasePower& base : {BasePower{"kg", dimension.kilogram},
                                {"m", dimension.metre},
                                {"s", dimension.second},
                                {"A", dimension.ampere},
                                {"rad", dimension.radian}}) {
    const int exponent = sign * base.exponent;
    if (exponent <= 0) continue;
    text += fmt::format("{}{}", text.empty() ? "" : " ", base.unit);
    if (exponent > 1) text += fmt::format("^{}", exponent);
  }
  return text;
}

std::string base_units(const Dimension& dimension) {
  const std::string above = factors(dimension, 1);
  const std::string below = factors(dimension, -1);
  if (below.empty()) return above;
  const bool is_product = below.find(' ') != std::string::npos;
  return fmt::format("{}/{}", above.empty() ? "1" : above, is_product ? "(" + below + ")" : below);
}

}  // namespace

Dimension product(const Dimension& x, const Dimension& y) {
  return {x.kilogram + y.kilogram, x.metre + y.metre, x.second + y.second, x.ampere + y.ampere, x.radian + y.radian};
}

Dimension power(const Dimension& x, int exponent) {
  return {x.kilogram * exponent, x.metre * exponent, x.second * exponent, x.ampere * exponent, x.radian * exponent};
}

std::string unit_of(const Dimension& dimension) {
  if (dimension == dimensions::number) return "1";
  const NamedDimension* named = find_name(dimension);
  return named != nullptr ? std::string(named->unit) : base_units(dimension);
}

std::string describe(const Dimension& dimension) {
  if (dimension == dimensions::number) return "a plain number";
  const NamedDimension* named = find_name(dimension);
  return fmt::format("{} [{}]", named != nullptr ? named->words : "a quantity", unit_of(dimension));
}

}  // namespace dashpot::compiler
