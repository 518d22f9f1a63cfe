#include "network/unit.hpp"

#include <gtest/gtest.h>

#include <string>

namespace dashpot::compiler {
namespace {

struct FaultExample {
  std::string text;
  UnitFault::Kind kind;
  std::string place;
};

const FaultExample fault_examples[] = {
    {"Nm", UnitFault::Kind::unknown_symbol, "Nm"},
    {"N/lbf", UnitFault::Kind::unknown_symbol, "lbf"},
    {"mmin", UnitFault::Kind::unknown_symbol, "mmin"},
    {"kdeg", UnitFault::Kind::unknown_symbol, "kdeg"},
    {"k%", UnitFault::Kind::unknown_symbol, "k%"},
    {"% s", UnitFault::Kind::percent_in_product, "%"},
    {"N/%", UnitFault::Kind::percent_in_product, "%"},
    {"%^2", UnitFault::Kind::percent_in_product, "%"},
    {"n", UnitFault::Kind::unknown_symbol, "n"},
    {"Å", UnitFault::Kind::unknown_symbol, "Å"},
    {"N/m s", UnitFault::Kind::product_after_slash, "s"},
    {"N/m·s", UnitFault::Kind::product_after_slash, "·s"},
    {"N/(m s) rad", UnitFault::Kind::product_after_slash, "rad"},
    {"N/", UnitFault::Kind::malformed, ""},
    {"/m", UnitFault::Kind::malformed, "/m"},
    {"N//m", UnitFault::Kind::malformed, "/m"},
    {"N^", UnitFault::Kind::malformed, ""},
    {"N^x", UnitFault::Kind::malformed, "x"},
    {"N^12", UnitFault::Kind::malformed, "2"},
    {"N⁻", UnitFault::Kind::malformed, ""},
    {"N/(m", UnitFault::Kind::malformed, ""},
    {"N/(m/s)", UnitFault::Kind::malformed, "s)"},
    {"N/()", UnitFault::Kind::malformed, ")"},
    {"N*", UnitFault::Kind::malformed, ""},
    {"1", UnitFault::Kind::malformed, ""},
    {"1 N", UnitFault::Kind::malformed, "N"},
    {"2/s", UnitFault::Kind::malformed, "2/s"},
};

// If this fails, a unit that means nothing, or two things, is read as something.
TEST(Unit, FaultsAreFoundInPlace) {
  for (const FaultExample& example : fault_examples) {
    const auto result = parse_unit(example.text);
    const auto* fault = std::get_if<UnitFault>(&result);
    ASSERT_NE(fault, nullptr) << example.text;
    EXPECT_EQ(fault->kind, example.kind) << example.text;
    EXPECT_EQ(example.text.substr(fault->begin, fault->end - fault->begin), example.place) << example.text;
  }
}

// If this fails, a derived unit is not what the base units make of it.
TEST(Unit, DerivedIsMadeOfItsParts) {
  const std::pair<const char*, const char*> same[] = {{"N", "kg m/s^2"}, {"J", "N m"}, {"W", "J/s"},
                                                      {"Pa", "N/m^2"},   {"V", "W/A"}, {"T", "V s/m^2"},
                                                      {"ohm", "V/A"},    {"Ω", "V/A"}, {"Hz", "rad^0/s"}};
  for (const auto& [symbol, parts] : same)
    EXPECT_EQ(std::get<Unit>(parse_unit(symbol)).dimension, std::get<Unit>(parse_unit(parts)).dimension) << symbol;
}

// If this fails, a long text in a file can overflow the exponents.
TEST(Unit, OfHundredsOfFactorsIsRefused) {
  std::string text = "m";
  for (int i = 0; i < 500; ++i) text += "*Tm^9";
  EXPECT_TRUE(std::holds_alternative<UnitFault>(parse_unit(text)));
}

// If this fails, the remedy for units written without blanks is no unit, or another one than was meant.
TEST(Unit, RunTogetherIsTakenApart) {
  EXPECT_EQ(spaced_unit("Nm"), "N m");
  EXPECT_EQ(spaced_unit("Nms"), "N m s");
  EXPECT_EQ(spaced_unit("mNm"), "mN m");
  EXPECT_EQ(spaced_unit("kNm"), "kN m");
  EXPECT_EQ(spaced_unit("gcm"), "g cm");
  EXPECT_EQ(spaced_unit("Nmm"), "N mm");
  EXPECT_EQ(spaced_unit("Nmrad"), "N m rad");
  for (const char* text : {"h", "lbf", "", "rpmm", "NmNmNmNmNmNmNmNm"}) EXPECT_EQ(spaced_unit(text), "") << text;
}

// If this fails, a unit in small letters has no remedy, or one that may be another unit than was meant.
TEST(Unit, InOtherCaseIsRecognised) {
  EXPECT_EQ(unit_in_other_case("khz"), "kHz");
  EXPECT_EQ(unit_in_other_case("KPA"), "kPa");
  EXPECT_EQ(unit_in_other_case("n"), "N");
  EXPECT_EQ(unit_in_other_case("RPM"), "rpm");
  for (const char* text : {"mpa", "mhz", "NM", "lbf", ""}) EXPECT_EQ(unit_in_other_case(text), "") << text;
}

// If this fails, a unit that a message recommends is not understood when it is written.
TEST(Unit, ShownInMessagesIsReadBack) {
  namespace d = dimensions;
  for (const Dimension& dimension : {d::mass,
                                     d::length,
                                     d::time,
                                     d::angle,
                                     d::frequency,
                                     d::velocity,
                                     d::angular_velocity,
                                     d::acceleration,
                                     d::angular_acceleration,
                                     d::force,
                                     d::torque,
                                     d::stiffness,
                                     d::rotational_stiffness,
                                     d::damping,
                                     d::rotational_damping,
                                     d::inertia,
                                     d::current,
                                     d::current_rate,
                                     d::force_constant,
                                     d::torque_constant,
                                     d::damping_per_current_squared,
                                     d::rotational_damping_per_current_squared,
                                     Dimension{2, -3, 0, 1, 0},
                                     Dimension{0, -1, -1, 0, 0},
                                     Dimension{0, 0, 2, 0, -2}}) {
    const auto result = parse_unit(unit_of(dimension));
    const auto* unit = std::get_if<Unit>(&result);
    ASSERT_NE(unit, nullptr) << unit_of(dimension);
    EXPECT_EQ(unit->dimension, dimension) << unit_of(dimension);
    EXPECT_EQ(unit->power_of_ten, 0) << unit_of(dimension);
  }
}

}  // namespace
}  // namespace dashpot::compiler
