// Units as people write them: "mN m s/rad", "N·s/m", "kN/m", "kg m^2", "N s/(m A^2)", "%".
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "network/dimension.hpp"

namespace dashpot::compiler {

// One of the unit is 10^power_of_ten · sixty^… · (π/180)^… in SI: the powers of ten are kept apart because they can be
// multiplied exactly, as part of a decimal literal.
struct Unit {
  Dimension dimension;
  int power_of_ten = 0;
  int power_of_sixty = 0;   // minutes
  int power_of_degree = 0;  // π/180
};

struct UnitFault {
  enum class Kind { unknown_symbol, product_after_slash, percent_in_product, malformed };

  Kind kind;
  std::size_t begin;  // bytes [begin, end) of the text
  std::size_t end;
};

// In: factors joined by blanks, '*' or '·', and '/', each a symbol with an SI prefix and an integer power ("^2", "²");
// brackets may stand around a divisor. After a '/' only the next factor divides; a product after it is refused, since
// "N/m s" is read in two ways. "%" stands alone: "10 % s" says of no time what a tenth of it is.
std::variant<Unit, UnitFault> parse_unit(std::string_view text);

// What a factor may be: a symbol, or a prefix and a symbol that takes one.
struct UnitSymbol {
  std::string_view text;
  Unit unit;
  bool takes_prefix;
};
struct UnitPrefix {
  std::string_view text;
  int power_of_ten;
};
std::span<const UnitSymbol> unit_symbols();
std::span<const UnitPrefix> unit_prefixes();

// For a symbol that is unknown, the product of known ones that it was probably meant to be ("Nms" → "N m s"); empty
// where there is none.
std::string spaced_unit(std::string_view symbol);

// For a symbol that is unknown, the one known that differs from it by case alone ("khz" → "kHz"); empty where there is
// none, or several ("mpa").
std::string unit_in_other_case(std::string_view symbol);

}  // namespace dashpot::compiler
