#include "network/read_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "network/name_rules.hpp"
#include "network/port_units.hpp"
#include "network/quantity.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler {
namespace {

// The same thing in the other motion.
bool is_of_other_motion(const Dimension& x, const Dimension& y) {
  constexpr std::pair<Dimension, Dimension> pairs[] = {
      {dimensions::stiffness, dimensions::rotational_stiffness},
      {dimensions::damping, dimensions::rotational_damping},
      {dimensions::force, dimensions::torque},
      {dimensions::length, dimensions::angle},
      {dimensions::velocity, dimensions::angular_velocity},
      {dimensions::acceleration, dimensions::angular_acceleration},
      {dimensions::mass, dimensions::inertia},
      {dimensions::force_constant, dimensions::torque_constant},
      {dimensions::damping_per_current_squared, dimensions::rotational_damping_per_current_squared}};
  return std::any_of(std::begin(pairs), std::end(pairs),
                     [&](const auto& pair) { return pair == std::pair(x, y) || pair == std::pair(y, x); });
}

// "2 N/m" for "2", "(2 * n) * (1 N/m)" for "2 * n".
std::string with_unit(const ValueDecl& decl, const std::string& unit, const NameScope& scope) {
  return is_expression(decl, scope) ? fmt::format("({}) * (1 {})", excerpt(decl.text), unit)
                                    : excerpt(decl.text) + " " + unit;
}

// "5 N m/rad" for "5 N m", "(K * r^2) / 1 rad" for "K * r^2".
std::string per_radian(const ValueDecl& decl, const NameScope& scope) {
  return is_expression(decl, scope) ? "(" + excerpt(decl.text) + ") / 1 rad" : excerpt(decl.text) + "/rad";
}

void report_wrong_unit(const ValueDecl& decl, const Dimension& found, const Expectation& expected,
                       const NameScope& scope, Diagnostics& diagnostics) {
  // A percentage is of something, and no unit behind it would say of what.
  const bool is_share = decl.text.ends_with('%');
  const bool is_time_by_share = is_share && expected.dimension == dimensions::time;
  diagnostics.report<DiagnosticCode::wrong_unit>(
      decl.span, excerpt(decl.text), describe(found), expected.taker,
      describe(expected.dimension) + (is_time_by_share ? " such as '50 us'" : ""));
  if (found == dimensions::number && (is_quantity(decl) || is_expression(decl, scope)) && !is_share)
    diagnostics.note<DiagnosticCode::write_instead>({}, with_unit(decl, unit_of(expected.dimension), scope));
  else if (expected.dimension.radian < 0 && product(found, power(dimensions::angle, -1)) == expected.dimension)
    diagnostics.note<DiagnosticCode::write_instead>({}, per_radian(decl, scope));
  else if (is_of_other_motion(found, expected.dimension))
    diagnostics.note<DiagnosticCode::units_of_motion>({}, name_of(expected.port_motion));
}

}  // namespace

std::optional<double> read_quantity_as(const ValueDecl& decl, const Expectation& expected, Diagnostics& diagnostics,
                                       const NameScope& scope) {
  if (!is_stated(decl, scope)) {
    report_no_quantity(decl, diagnostics);
    return std::nullopt;
  }
  const std::optional<Quantity> quantity = read_stated(decl, scope, diagnostics);
  if (!quantity) return std::nullopt;
  if (!quantity->dimension || quantity->dimension == expected.dimension) return quantity->value;
  report_wrong_unit(decl, *quantity->dimension, expected, scope, diagnostics);
  return std::nullopt;
}

void report_no_quantity(const ValueDecl& decl, Diagnostics& diagnostics) {
  if (is_not_finite_word(decl.text)) diagnostics.report<DiagnosticCode::not_finite>(decl.span, decl.text);
  else diagnostics.report<DiagnosticCode::malformed_quantity>(decl.span, excerpt(decl.text));
}

bool is_not_finite_word(const std::string& text) {
  const std::string word = folded(text);
  return word == "inf" || word == "infinity" || word == "nan";
}

}  // namespace dashpot::compiler
