// A value as its author wrote it, in SI.
#pragma once

#include <optional>

#include "network/decimal.hpp"
#include "network/dimension.hpp"
#include "source/diagnostic.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

struct Quantity {
  double value;                        // SI, correctly rounded
  std::optional<Dimension> dimension;  // nothing for a JSON number, which is SI of whatever is due
  ExactReal exact;                     // before the rounding, for what is calculated from it
};

// True for a string that is meant as a quantity, not as the name of a parameter: it starts with a digit, sign or point.
bool is_quantity(const ValueDecl& decl);

// In: a number, or a string for which is_quantity holds. Out: its value: the decimal literal times the exact factor of
// the unit, rounded once. Refuses: unknown or ambiguous units, malformed numbers, and numbers that a double cannot
// hold.
std::optional<Quantity> read_quantity(const ValueDecl& decl, Diagnostics& diagnostics);

// The place of bytes [begin, end) of the value's text in the file; of the whole value where JSON escapes hide it.
Span part_of(const ValueDecl& decl, std::size_t begin, std::size_t end);

}  // namespace dashpot::compiler
