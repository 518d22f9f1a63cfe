// Names, constants and locals of the programs of a law with tunable parameters.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "discretise/law_writer.hpp"

namespace dashpot::compiler {

class TunedNumbers {
 public:
  // The writer must outlive this object; variables already in its law keep their names.
  explicit TunedNumbers(LawWriter& writer);

  // Statements are added to `program` from here on; it must not move.
  void begin(std::vector<Statement>& program);
  // The same for a program that continues the present one: names that are taken there stay taken.
  void go_on(std::vector<Statement>& program) { program_ = &program; }

  // A new variable; its name gets a number if it is taken.
  VariableId scalar(const std::string& name, const std::string& unit, const std::string& meaning, Role role);
  void assign(VariableId target, ExpressionId value, std::string purpose);
  Statement& last() { return program_->back(); }
  VariableId local(const std::string& name, const std::string& unit, ExpressionId value, std::string purpose);
  // The value itself where that is a variable or a constant, else a local that has it.
  ExpressionId named(const std::string& name, const std::string& unit, ExpressionId value);
  // In set(): a variable that keeps the value for the other programs; or the value itself if it is constant or such a
  // variable already.
  VariableId told(const std::string& name, const std::string& unit, const std::string& meaning, ExpressionId value);
  ExpressionId tuned(const std::string& name, const std::string& unit, const std::string& meaning, ExpressionId value);
  ExpressionId constant(const std::string& name, const std::string& unit, const std::string& meaning, double value,
                        Derivation from = ConstantRole::brake_choice);
  ExpressionId zero() { return writer_.constant("zero", "1", "nothing", 0, ConstantRole::zero); }
  ExpressionId one() { return writer_.constant("one", "1", "one", 1, ConstantRole::plain_number); }

  LawWriter& writer() { return writer_; }

 private:
  LawWriter& writer_;
  std::vector<Statement>* program_ = nullptr;
  std::map<std::string, VariableId> locals_;  // by the name they were asked for
  std::set<VariableId> assigned_;             // in the present program
  std::map<std::string, ExpressionId> constants_;
};

}  // namespace dashpot::compiler
