// A number in a cell of a motion's table.
#pragma once

#include <optional>
#include <string_view>

#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// In decimal notation, like the numbers of a network: with a sign or without. Nothing where it is none, is not finite,
// or is beyond a double: too large, or not zero and yet too small.
std::optional<double> number_in_cell(std::string_view text);

// Why a cell of column `name` holds no such number.
void report_cell(Span cell, std::string_view name, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
