#include "commands/value_columns.hpp"

#include <algorithm>

#include "commands/motion_cell.hpp"

namespace dashpot::compiler {
namespace {

const OtherColumn* column_of(const std::string& name, const Motion& motion, Diagnostics& diagnostics) {
  const auto is_named = [&](const OtherColumn& column) { return column.name == name; };
  const auto found = std::find_if(motion.others.begin(), motion.others.end(), is_named);
  if (found == motion.others.end()) return nullptr;
  const auto again = std::find_if(found + 1, motion.others.end(), is_named);
  if (again != motion.others.end()) diagnostics.report<DiagnosticCode::csv_column_twice>(again->span, name);
  if (found->not_a_number) report_cell(*found->not_a_number, name, diagnostics);
  return &*found;
}

}  // namespace

ValueColumns::ValueColumns(const Compilation& c, const Motion& motion, Diagnostics& diagnostics) : network_(c.network) {
  tunables_ = c.law.parameters();
  warned_.resize(tunables_.size());
  for (const Tunable& tunable : tunables_) {
    refuse_name_of_motion(tunable.name, diagnostics);
    columns_.push_back(column_of(tunable.name, motion, diagnostics));
  }
  is_empty_ =
      std::all_of(columns_.begin(), columns_.end(), [](const OtherColumn* column) { return column == nullptr; });
}

std::vector<double> ValueColumns::values_of(std::size_t row, double time, Diagnostics& diagnostics) {
  std::vector<double> values;
  for (std::size_t i = 0; i < tunables_.size(); ++i) {
    values.push_back(columns_[i] == nullptr ? tunables_[i].range.value : columns_[i]->values[row]);
    warn_once_outside_range(i, values.back(), time, diagnostics);
  }
  return values;
}

void ValueColumns::warn_once_outside_range(std::size_t i, double value, double time, Diagnostics& diagnostics) {
  const Tunable& tunable = tunables_[i];
  if (warned_[i] || (value >= tunable.range.min && value <= tunable.range.max)) return;
  warned_[i] = true;
  diagnostics.report<DiagnosticCode::outside_tunable_range>(place_of(tunable.name), tunable.name, value, tunable.unit,
                                                            time, tunable.range.min, tunable.range.max);
}

Span ValueColumns::place_of(const std::string& tunable) const {
  return std::find_if(network_.parameters.begin(), network_.parameters.end(),
                      [&](const Parameter& p) { return p.name == tunable; })
      ->span;
}

// Its column would be the motion's, so that nothing could ever set it.
void ValueColumns::refuse_name_of_motion(const std::string& tunable, Diagnostics& diagnostics) const {
  if (std::find(std::begin(own_columns), std::end(own_columns), tunable) != std::end(own_columns))
    diagnostics.report<DiagnosticCode::tunable_named_as_column>(place_of(tunable), tunable);
}

}  // namespace dashpot::compiler
