#include "commands/value_columns.hpp"

#include <algorithm>

#include "commands/motion_cell.hpp"
#include "fit/column_choice.hpp"
#include "source/nearest_name.hpp"

namespace dashpot::compiler {
namespace {

bool is_called(const OtherColumn& other, const std::string& tunable) {
  return other.column.title == tunable || parts_of(other.column).name == tunable;
}

// What 1 in the column stands for in the tunable's unit; a column without a unit is in that.
double factor_of(const OtherColumn& other, const Tunable& tunable, Diagnostics& diagnostics) {
  const std::optional<std::string> unit = parts_of(other.column).unit;
  if (!unit || (other.column.title == tunable.name && !other.column.unit)) return 1;
  const auto written = fitting::unit_named(*unit), own = fitting::unit_named(tunable.unit);
  if (written && own && written->dimension == own->dimension) return written->factor / own->factor;
  diagnostics.report<DiagnosticCode::recording_wrong_unit>(other.span, other.column.title, *unit,
                                                           "value of '" + tunable.name + "'", tunable.unit);
  return 1;
}

}  // namespace

// Without a column where the motion has none for this tunable.
ValueColumns::Values ValueColumns::values_of(const Tunable& tunable, const Motion& motion, Diagnostics& diagnostics) {
  const auto is_named = [&](const OtherColumn& other) { return is_called(other, tunable.name); };
  const auto found = std::find_if(motion.others.begin(), motion.others.end(), is_named);
  if (found == motion.others.end()) return {};
  const auto again = std::find_if(found + 1, motion.others.end(), is_named);
  if (again != motion.others.end()) diagnostics.report<DiagnosticCode::csv_column_twice>(again->span, tunable.name);
  if (found->not_a_number) report_cell(*found->not_a_number, tunable.name, diagnostics);
  return {&*found, factor_of(*found, tunable, diagnostics)};
}

ValueColumns::ValueColumns(const Compilation& c, const Motion& motion, Diagnostics& diagnostics) : network_(c.network) {
  tunables_ = c.law.parameters();
  warned_.resize(tunables_.size());
  for (const Tunable& tunable : tunables_) {
    refuse_name_of_motion(tunable.name, diagnostics);
    columns_.push_back(values_of(tunable, motion, diagnostics));
  }
  is_empty_ = std::all_of(columns_.begin(), columns_.end(), [](const Values& v) { return v.column == nullptr; });
  warn_of_misspelt(motion, diagnostics);
}

// Of columns that are called like no tunable, where the one whose name is nearest has none.
void ValueColumns::warn_of_misspelt(const Motion& motion, Diagnostics& diagnostics) const {
  std::vector<std::string> names;
  for (const Tunable& tunable : tunables_) names.push_back(tunable.name);
  for (const OtherColumn& other : motion.others) {
    const auto is_its_own = [&](const std::string& name) { return is_called(other, name); };
    const auto nearest = nearest_name(parts_of(other.column).name, names);
    if (!nearest || std::any_of(names.begin(), names.end(), is_its_own)) continue;
    const auto found = std::find(names.begin(), names.end(), *nearest);
    if (columns_[std::size_t(found - names.begin())].column == nullptr)
      diagnostics.report<DiagnosticCode::csv_misspelt_tunable>(other.span, other.column.title, *nearest);
  }
}

double ValueColumns::value(std::size_t tunable, std::size_t row) const {
  const Values& v = columns_[tunable];
  return v.column == nullptr ? tunables_[tunable].range.value : v.factor * v.column->values[row];
}

void ValueColumns::warn_outside_range(std::size_t row, double time, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < tunables_.size(); ++i) {
    const Tunable& tunable = tunables_[i];
    const double v = value(i, row);
    if (warned_[i] || (v >= tunable.range.min && v <= tunable.range.max)) continue;
    warned_[i] = true;
    diagnostics.report<DiagnosticCode::outside_tunable_range>(place_of(tunable.name), tunable.name, v, tunable.unit,
                                                              time, tunable.range.min, tunable.range.max);
  }
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
