// Values for which a certain unit is due.
#pragma once

#include <dashpot/command.hpp>

#include <optional>
#include <string>

#include "network/dimension.hpp"
#include "network/expression.hpp"
#include "source/diagnostic.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

// What a value is for.
struct Expectation {
  std::string taker;  // "a damper", "the rate", "'brake.max_damping'"
  Dimension dimension;
  motion port_motion;
};

// A number, or a quantity or an expression of the dimension that is due, in SI; anything else is reported, with the
// remedy.
std::optional<double> read_quantity_as(const ValueDecl& decl, const Expectation& expected, Diagnostics& diagnostics,
                                       const NameScope& scope = {});

// Reports text that is neither a quantity nor a name.
void report_no_quantity(const ValueDecl& decl, Diagnostics& diagnostics);

// "inf", "nan", …
bool is_not_finite_word(const std::string& text);

}  // namespace dashpot::compiler
