#include "network/expression.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "front_end_run.hpp"
#include "source/render.hpp"

namespace dashpot::compiler {
namespace {

// G = 2 kPa, a = 3 mm, R = 10 mm, nu = 0.49, m = 7 s.
NameScope scope() {
  static const std::map<std::string, ExactQuantity, std::less<>> names = {
      {"G", {2000, {1, -1, -2}}},
      {"a", {ExactReal("0.003"), dimensions::length}},
      {"R", {ExactReal("0.01"), dimensions::length}},
      {"nu", {ExactReal("0.49"), dimensions::number}},
      {"m", {7, dimensions::time}}};
  return {[](std::string_view name) { return names.find(name) != names.end(); },
          [](const Text& name) { return std::optional(names.at(name.text)); }};
}

std::optional<Quantity> read_expression(const std::string& text, std::string* said = nullptr) {
  const SourceFile file("values.json", '"' + text + '"');
  const ValueDecl decl{ValueDecl::Form::text, text, {&file, 0, text.size() + 2}};
  Diagnostics diagnostics;
  const std::optional<Quantity> quantity =
      is_expression(decl, scope()) ? read_expression(decl, scope(), diagnostics) : std::nullopt;
  if (said) *said = render_text(diagnostics);
  return quantity;
}

struct WrittenExpression {
  std::string text;
  double value;
  Dimension dimension;
};

const double e = std::numbers::e;
const double pi = std::numbers::pi;

const WrittenExpression written_expressions[] = {
    {"8 * G * a", 48, dimensions::stiffness},
    {"2 * pi * G * 50 mm / ln(R / a)", 2 * pi * 2000 * 0.05 / std::log(10.0 / 3), dimensions::stiffness},
    {"2*5 N/m", 10, dimensions::stiffness},
    {"5 N/m * 2", 10, dimensions::stiffness},
    {"5 uN m s/rad/A^2 * (1.5 A)^2", 11.25e-6, dimensions::rotational_damping},
    {"5 uN m s/(rad A^2) * (1.5 A)^2", 11.25e-6, dimensions::rotational_damping},
    {"5 kPa * (2 mm)", 10, dimensions::stiffness},
    {"5 N/(2 mm)", 2500, dimensions::stiffness},
    {"5 N/(m s^-1) / 2", 2.5, dimensions::damping},
    {"5 N s/m + 3 N s/m", 8, dimensions::damping},
    {"5 N/m - -3 N/m", 8, dimensions::stiffness},
    {"-5 N/m + 7 N/m", 2, dimensions::stiffness},
    {"8 N/m - 5 N/m - 1 N/m", 2, dimensions::stiffness},
    {"12 N/m / 3 / 2", 2, dimensions::stiffness},
    {"2 ^ 3 ^ 2 * 1 N/m", 512, dimensions::stiffness},
    {"-2 ^ 2 * 1 N/m", -4, dimensions::stiffness},
    {"(a / R) ^ 2 * G * a", 0.09 * 6, dimensions::stiffness},
    {"sqrt(a * R) * G", std::sqrt(3e-5) * 2000, dimensions::stiffness},
    {"(a^3 * R^3) ^ (1/3) * G / 1 m", 3e-5 * 2000, dimensions::stiffness},
    {"exp(1 - nu / nu + 1) * 1 N", e, dimensions::force},
    {"G*a/(1 - nu)", 6 / 0.51, dimensions::stiffness},
    {"3 N/m * nu", 1.47, dimensions::stiffness},  // "N/m": a metre, though a parameter is called m
    {"6 N / m", 6, {1, 0, -2}},                   // a quantity as it stands: never an expression
    {"2 * 6 N / m", 12, dimensions::stiffness},   // the unit reaches as far as it can
    {"2 * (6 N) / m", 12.0 / 7, {1, 1, -3}},      // behind a bracket stands no unit
    {"1.5e-3 kN/mm * 2", 3000, dimensions::stiffness},
    {"(5 mm)", 0.005, dimensions::length},
    {"1/3", 1.0 / 3, dimensions::number},
    {"G * a * 3 %", 0.18, dimensions::stiffness},
    {"30 deg * 2", 60 * pi / 180, dimensions::angle},
};

// If this fails, a calculated value is not what its author wrote.
TEST(Expression, IsCalculatedAsArithmeticHasIt) {
  for (const WrittenExpression& example : written_expressions) {
    if (example.text == "6 N / m") continue;
    std::string said;
    const std::optional<Quantity> quantity = read_expression(example.text, &said);
    ASSERT_TRUE(quantity) << example.text << "\n" << said;
    EXPECT_NEAR(quantity->value, example.value, 4e-16 * std::abs(example.value)) << example.text;
    EXPECT_EQ(quantity->dimension, example.dimension) << example.text;
  }
}

// If this fails, plain quantities and names are taken for expressions, with other messages and other rounding.
TEST(Expression, PlainQuantitiesAndNamesAreNoExpressions) {
  for (const char* text : {"6 N / m", "5 N s/m", "5 N*s/m", "1e-3 m", "10 1/s", "10 s^-1", "G", "inf", "-inf", "5 Nms",
                           "5 N/m s", "5 N s/m s", "1,5 N/m", "5 5 N/m", ""})
    EXPECT_FALSE(is_expression({ValueDecl::Form::text, text, {}}, scope())) << text;
}

// If this fails, a value that is calculated in several steps is rounded in each of them.
TEST(Expression, RoundsOnce) {
  ASSERT_NE(1.0 / 49 * 49, 1.0) << "rounded twice it is another number";
  const NetworkRun run(R"({ "dashpot": 1, "name": "sample",
    "parameters": { "part": "1 N/m / 49", "K": "part * 49" }, "network": { "spring": "K" } })");
  ASSERT_TRUE(run.network) << run.said();
  EXPECT_EQ(std::get<Spring>(run.network->elements[0].law).stiffness, 1);
}

// If this fails, an expression cannot stand where architecture, section 7, allows it.
TEST(Expression, StandsWhereverAValueMay) {
  const NetworkRun run(R"json({ "dashpot": 1, "name": "sample",
    "parameters": { "a": "3 mm", "G": "2 kPa", "nu": 0.49,
                    "B": { "value": "2 * 3 N s/m", "tunable": true, "min": "1 N s/m + 1 N s/m", "max": "2 * 50 N s/m" } },
    "network": { "parallel": [ { "spring": "4 * G * a / (1 - nu)", "name": "K" }, { "damper": "B" } ] },
    "contact": { "at": "2 * a" },
    "valid": { "rate": "a / 2 s", "frequency": [ "1 / 10 s", "3 * 10 Hz" ] } })json");
  ASSERT_TRUE(run.network) << run.said();
  EXPECT_DOUBLE_EQ(std::get<Spring>(run.network->elements[0].law).stiffness, 24 / 0.51);
  EXPECT_EQ(run.network->parameters[3].value, 6);
  EXPECT_EQ(run.network->parameters[3].max, 100);
  EXPECT_EQ(run.network->contact->at, 0.006);
  EXPECT_EQ(run.network->valid.rate->high, 0.0015);
  EXPECT_EQ(run.network->valid.frequency->low, 0.1);
}

// If this fails, hostile text in a value crashes or hangs the front end instead of being refused.
TEST(Expression, RefusesHostileText) {
  for (const std::string& text :
       {std::string(100'000, '('), "2" + std::string(100'000, '^'), "2 * " + std::string(100'000, '-') + "3",
        std::string("9^9^9^9^9 * 1 N"), std::string("2 ^ (1/0)"), std::string("a ^ 10^30"),
        std::string("sqrt(sqrt(sqrt(a)))"), std::string("2 * é"), std::string("ln(0 * a / a)")})
    EXPECT_FALSE(read_expression(text)) << text.substr(0, 30);
}

}  // namespace
}  // namespace dashpot::compiler
