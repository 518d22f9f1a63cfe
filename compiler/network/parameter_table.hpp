// The parameters of a network while its values are being read.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "network/expression.hpp"
#include "network/network.hpp"
#include "network/read_value.hpp"

namespace dashpot::compiler {

struct ReadValue {
  double value;                          // SI
  Range range;                           // which it keeps to; of its value alone, unless it is tunable
  std::optional<std::size_t> parameter;  // that gave it
  std::optional<std::size_t> tunable;    // the same, if it may change while the law runs
};

class ParameterTable {
 public:
  // Reports ranges that are missing, contradictory, or do not hold the value. The elements' names serve for messages
  // about values that name an element.
  ParameterTable(const std::vector<ParameterDecl>& decls, std::vector<Text> element_names, Diagnostics& diagnostics);

  // A number, a quantity of the dimension that is due, an expression of constants of that dimension, or the name of a
  // parameter of it; otherwise nothing, reported.
  std::optional<ReadValue> read(const ValueDecl& decl, const Expectation& expected);

  // The same of what must not change while the law runs: that it may is reported, and no hindrance.
  std::optional<double> read_constant(const ValueDecl& decl, const Expectation& expected);

  bool is_calculated(const ValueDecl& decl) { return is_expression(decl, scope()); }

  // Warns about every parameter that no value names.
  void report_unused() const;

  const Parameter& operator[](std::size_t index) const { return entries_[index].parameter; }
  Span place_of_least(std::size_t index) const;  // of the smallest value that the parameter takes
  std::vector<Parameter> parameters() const;

 private:
  struct Entry {
    Parameter parameter;
    ParameterDecl decl;
    ExactReal exact = 0;                 // the value before it was rounded
    std::optional<Dimension> dimension;  // nothing where value and range are plain numbers, until the first use
    std::optional<Span> first_use;       // which fixed the dimension
    bool readable = true;
    bool used = false;
  };

  Entry read_entry(const ParameterDecl& decl);
  std::optional<Quantity> read_part(const ValueDecl& decl, Entry& entry);
  void read_range(Entry& entry);
  std::optional<ReadValue> use(Entry& entry, const ValueDecl& decl, const Expectation& expected);
  void report_unknown(const ValueDecl& decl) const;
  NameScope scope();
  std::optional<ExactQuantity> read_operand(const Text& name);

  std::vector<Entry> entries_;
  std::unordered_map<std::string, std::size_t> index_of_name_;
  std::set<std::string> named_early_;  // in an expression before they are defined
  std::vector<std::string> names_;     // of all parameters; `entries_` holds those read so far
  std::vector<Text> element_names_;
  Diagnostics& diagnostics_;
};

}  // namespace dashpot::compiler
