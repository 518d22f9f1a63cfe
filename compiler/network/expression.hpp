// Values that are calculated: "8 * G * a", "2 * pi * G * l / ln(R / a)", "eta / mu2".
//
//     sum      = product { ('+' | '-') product }
//     product  = signed { ('*' | '/') signed }
//     signed   = { '+' | '-' } power
//     power    = factor [ '^' signed ]
//     factor   = number [unit] | parameter | 'pi' | ('sqrt' | 'exp' | 'ln') '(' sum ')' | '(' sum ')'
//
// A number and the unit behind it are one factor: "2 * 5 N/m" is twice 5 N/m. Between factors stands an operator.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "network/decimal.hpp"
#include "network/quantity.hpp"

namespace dashpot::compiler {

struct ExactQuantity {
  ExactReal value;  // SI
  Dimension dimension;
};

// What names stand for where an expression is written.
struct NameScope {
  std::function<bool(std::string_view)> knows = [](std::string_view) { return false; };
  // Reports why where it returns nothing. Empty: there are no names, and a value that has one in it is refused.
  std::function<std::optional<ExactQuantity>(const Text&)> read;
};

// True for text that is to be calculated: neither a name nor a number with a unit, and with an operator, a function
// or a name that the scope knows in it.
bool is_expression(const ValueDecl& decl, const NameScope& scope);

// In: a text for which is_expression holds. Out: its value, calculated in 50 digits and rounded once. Refuses, with the
// place: what the grammar does not know, sums of different dimensions, functions and powers that have no unit, division
// by zero, results beyond a double.
std::optional<Quantity> read_expression(const ValueDecl& decl, const NameScope& scope, Diagnostics& diagnostics);

// A number with its unit, or an expression.
bool is_stated(const ValueDecl& decl, const NameScope& scope);
std::optional<Quantity> read_stated(const ValueDecl& decl, const NameScope& scope, Diagnostics& diagnostics);

// The same without names, to see what kind of value it is: empty if it cannot be read. Faults are left to the function
// that then reads it.
std::optional<Quantity> quantity_in(const ValueDecl& decl);

}  // namespace dashpot::compiler
