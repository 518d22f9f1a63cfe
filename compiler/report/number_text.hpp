// Numbers and units for readers.
#pragma once

#include <string>
#include <string_view>

#include "network/network.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {

// At most `digits` significant digits, without trailing zeros; outside 10⁻³ … 10⁵ as 1.5×10⁻⁷. The minus sign is
// U+2212.
std::string number_text(double value, int digits = 4);

// The same as MathML.
std::string number_mathml(double value, int digits = 4);

// "10⁻³"
std::string power_text(int exponent);

// A sentence whose numbers with a decimal point have at most four significant digits: "needs 0.01395" for "needs
// 0.0139549". Whole numbers and names with digits stay as they are.
std::string in_four_digits(std::string_view text);

// "12 N/m": an element's value.
std::string value_text(const Element& element, motion port_motion);

}  // namespace dashpot::compiler
