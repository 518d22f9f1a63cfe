// Every constant of an emitted header, read from its text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "decompose/choices.hpp"

namespace dashpot::compiler {

struct HeaderConstant {
  std::string name;  // as its law has it; of a port without the port's name
  std::vector<double> values;
  std::string written;  // as the header has it
};

struct HeaderConstants {
  ScalarType scalar = ScalarType::float64;
  std::vector<HeaderConstant> all;  // in the order of the text
};

// The name for numbers outside of constants' declarations: initial values of states and parameters, and arguments.
// Zeros are left out. No constant of a law has this name.
inline constexpr const char* literals_in_code = "literals";

// Every number of the scalar's type that is code. Empty where a constant's value is no finite number, or the scalar is
// neither double nor float.
std::optional<HeaderConstants> header_constants(std::string_view header);

}  // namespace dashpot::compiler
