#include "discretise/tuned_numbers.hpp"

#include <utility>

namespace dashpot::compiler {

TunedNumbers::TunedNumbers(LawWriter& writer) : writer_(writer) {
  for (const Variable& variable : writer.law().variables) writer.unique(variable.name);
  for (const Coefficient& coefficient : writer.law().coefficients) writer.unique(coefficient.name);
}

void TunedNumbers::begin(std::vector<Statement>& program) {
  program_ = &program;
  assigned_.clear();
}

VariableId TunedNumbers::scalar(const std::string& name, const std::string& unit, const std::string& meaning,
                                Role role) {
  return writer_.scalar(writer_.unique(name), unit, meaning, role);
}

void TunedNumbers::assign(VariableId target, ExpressionId value, std::string purpose) {
  writer_.assign(*program_, target, value, std::move(purpose));
}

// A local belongs to one program; another program may have a local of the same name.
VariableId TunedNumbers::local(const std::string& name, const std::string& unit, ExpressionId value,
                               std::string purpose) {
  const auto known = locals_.find(name);
  const bool is_free = known != locals_.end() && assigned_.count(known->second) == 0;
  const VariableId variable = is_free ? known->second : scalar(name, unit, "", Role::local);
  locals_.emplace(name, variable);
  assigned_.insert(variable);
  assign(variable, value, std::move(purpose));
  return variable;
}

ExpressionId TunedNumbers::named(const std::string& name, const std::string& unit, ExpressionId value) {
  if (facts_of(writer_.law().expressions[value].operation).operands == 0) return value;
  return writer_.read(local(name, unit, value, ""));
}

VariableId TunedNumbers::told(const std::string& name, const std::string& unit, const std::string& meaning,
                              ExpressionId value) {
  const VariableId variable = scalar(name, unit, meaning, Role::tuned);
  assign(variable, value, "");
  return variable;
}

ExpressionId TunedNumbers::tuned(const std::string& name, const std::string& unit, const std::string& meaning,
                                 ExpressionId value) {
  const Expression& e = writer_.law().expressions[value];
  const bool is_there = e.operation == Operation::constant ||
                        (e.operation == Operation::read && writer_.law().variables[e.variable].role == Role::tuned);
  return is_there ? value : writer_.read(told(name, unit, meaning, value));
}

ExpressionId TunedNumbers::constant(const std::string& name, const std::string& unit, const std::string& meaning,
                                    double value, Derivation from) {
  const auto [known, is_new] = constants_.emplace(name, ExpressionId());
  if (is_new) known->second = writer_.constant(writer_.unique(name), unit, meaning, value, std::move(from));
  return known->second;
}

}  // namespace dashpot::compiler
