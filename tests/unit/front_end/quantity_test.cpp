#include "network/quantity.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "network/decimal.hpp"
#include "source/render.hpp"
#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

std::optional<Quantity> read(const std::string& text) {
  Diagnostics diagnostics;
  return read_quantity({ValueDecl::Form::text, text, {}}, diagnostics);
}

struct Example {
  std::string text;
  double value;
  Dimension dimension;
};

const Example examples[] = {
    {"12 mN/m", 0.012, dimensions::stiffness},
    {"12mN/m", 0.012, dimensions::stiffness},
    {"  12  mN / m ", 0.012, dimensions::stiffness},
    {"0.1 kN/m", 100, dimensions::stiffness},
    {"1 MN/m", 1e6, dimensions::stiffness},
    {"5 N s/m", 5, dimensions::damping},
    {"5 N·s/m", 5, dimensions::damping},
    {"5 N⋅s/m", 5, dimensions::damping},
    {"5 N*s/m", 5, dimensions::damping},
    {"7 mN m s/rad", 0.007, dimensions::rotational_damping},
    {"14 N m/rad", 14, dimensions::rotational_stiffness},
    {"2 J", 2, dimensions::torque},
    {"30 um", 0.00003, dimensions::length},
    {"30 µm", 0.00003, dimensions::length},  // U+00B5 micro sign
    {"30 μm", 0.00003, dimensions::length},  // U+03BC Greek mu
    {"0.03 mm", 0.00003, dimensions::length},
    {"3e-5 m", 0.00003, dimensions::length},
    {"3E+0 cm", 0.03, dimensions::length},
    {"5 %", 0.05, dimensions::number},
    {"5", 5, dimensions::number},
    {"1 kg m^2", 1, dimensions::inertia},
    {"1 g m²", 0.001, dimensions::inertia},
    {"65 mN m/A", 0.065, dimensions::torque_constant},
    {"2 mN m s/(rad A^2)", 0.002, dimensions::rotational_damping_per_current_squared},
    {"2 N s/m/A^2", 2, dimensions::damping_per_current_squared},
    {"10 kHz", 10000, dimensions::frequency},
    {"10 1/s", 10, dimensions::frequency},
    {"10 s^-1", 10, dimensions::frequency},
    {"10 s⁻¹", 10, dimensions::frequency},
    {"50 us", 0.00005, dimensions::time},
    {"2 min", 120, dimensions::time},
    {"6 rad/min", 0.1, dimensions::angular_velocity},
    {"180 deg", 3.141592653589793, dimensions::angle},
    {"1 deg", 0.017453292519943295, dimensions::angle},
    {"1 °", 0.017453292519943295, dimensions::angle},
    {"1 mm/ms", 1, dimensions::velocity},
    {"9.81 m/s^2", 9.81, dimensions::acceleration},
    {"1 kg m/s²", 1, dimensions::force},
    {"+.5 N", 0.5, dimensions::force},
    {"5. N", 5, dimensions::force},
    {"-0 N", 0, dimensions::force},
    {"9007199254740993000 mN", 9007199254740992, dimensions::force},  // a tie, to even
    {"4.9406564584124654e-324 N", 4.9406564584124654e-324, dimensions::force},
    {"1.7976931348623157e311 mN", 1.7976931348623157e308, dimensions::force},
};

// If this fails, a value in a network file means something else than its author wrote, be it by one bit.
TEST(Quantity, IsReadToTheLastBit) {
  for (const Example& example : examples) {
    const std::optional<Quantity> quantity = read(example.text);
    ASSERT_TRUE(quantity) << example.text;
    EXPECT_EQ(quantity->value, example.value) << example.text;
    EXPECT_FALSE(std::signbit(quantity->value) && quantity->value == 0) << example.text;
    EXPECT_EQ(quantity->dimension, example.dimension) << example.text;
  }
}

// If this fails, a plain JSON number is refused where it should be SI of whatever is due.
TEST(Quantity, OfANumberHasNoDimension) {
  Diagnostics diagnostics;
  const auto quantity = read_quantity({ValueDecl::Form::number, "-1.5e3", {}}, diagnostics);
  ASSERT_TRUE(quantity);
  EXPECT_EQ(quantity->value, -1500);
  EXPECT_EQ(quantity->dimension, std::nullopt);
}

// If this fails, an overflow or underflow reaches the network as infinity or as zero.
TEST(Quantity, BeyondADoubleIsRefused) {
  for (const char* text : {"1e309 N", "1e308 kN", "1e-400 N", "1e-323 fN", "1e99999999999999999999 N",
                           "1e-99999999999999999999 N", "1e308 min", "0.0000001e-99999999999999999999 min"})
    EXPECT_FALSE(read(text)) << text;
  for (const char* text : {"0e999999999999 N", "0.000e-5 N"}) EXPECT_EQ(read(text)->value, 0) << text;
}

std::string random_literal(testing::Random& random) {
  std::string digits;
  for (std::size_t i = random.between(1, 25); i > 0; --i) digits += static_cast<char>('0' + random.index(10));
  if (random.chance(0.5)) digits.insert(random.index(digits.size() + 1), ".");
  const auto exponent = static_cast<int>(random.between(0, 60)) - 30;
  return fmt::format("{}{}e{}", random.chance(0.5) ? "-" : "", digits, exponent);
}

using Real = boost::multiprecision::cpp_bin_float_100;

bool is_nearest_double(double value, const Real& exact) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Real error = abs(exact - value);
  return error <= abs(exact - std::nextafter(value, infinity)) &&
         error <= abs(exact - std::nextafter(value, -infinity));
}

// If this fails, values lose their last bit on the way through prefixes, minutes or degrees.
TEST(Quantity, IsCorrectlyRounded) {
  const std::pair<std::string, Real> units[] = {{"N", Real(1)},
                                                {"mN", Real(1) / 1000},
                                                {"kN", Real(1000)},
                                                {"mN/um", Real(1000)},
                                                {"N/nm^2", pow(Real(10), 18)},
                                                {"min", Real(60)},
                                                {"1/min", Real(1) / 60},
                                                {"deg", boost::math::constants::pi<Real>() / 180},
                                                {"N m/deg", 180 / boost::math::constants::pi<Real>()}};
  testing::Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const std::string literal = random_literal(random);
    const auto& [unit, factor] = units[random.index(std::size(units))];
    const auto quantity = read(literal + " " + unit);
    ASSERT_TRUE(quantity) << literal << " " << unit;
    EXPECT_TRUE(is_nearest_double(quantity->value, Real(literal) * factor)) << literal << " " << unit;
  }
}

// If this fails, a parameter is taken for a quantity or the other way round.
TEST(Quantity, IsToldFromANameByItsFirstCharacter) {
  for (const char* text : {"5 N", " 5 N", "-5", "+5", ".5", ""})
    EXPECT_TRUE(is_quantity({ValueDecl::Form::text, text, {}})) << text;
  for (const char* text : {"K1", "N", "…", "inf"}) EXPECT_FALSE(is_quantity({ValueDecl::Form::text, text, {}})) << text;
}

}  // namespace
}  // namespace dashpot::compiler
