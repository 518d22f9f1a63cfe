// Which column of a recording is what, and in which unit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/recording.hpp"
#include "fit/table_shape.hpp"
#include "network/dimension.hpp"

namespace dashpot::compiler::fitting {

enum class Role {
  time,
  position,
  strain,
  force,
  stress,
  omega,
  frequency,
  storage,
  loss,
  modulus,
  compliance,
  deviation,
  velocity,  // of a motion to simulate; no recording is fitted by it
};
const char* name_of(Role role);
// As headers may spell it beside that: "'t', 'zeit' or 'elapsedtime'"; capitals, blanks and signs do not matter there.
std::string other_names_of(Role role);
const std::vector<std::string>& names_of(Role role);  // as headers spell it: letters and digits only, lower case

// A column as the header tells of it: "Load (N)", "time [s]", "force_N" and "t/s" are a name with its unit.
struct TableColumn {
  std::string title;  // whole
  std::string name;
  std::optional<std::string> unit;  // one that is known
};
TableColumn table_column(std::string_view title);

// What 1 in a column of this role stands for in SI, and its dimension; a column without a unit is in SI as it is.
// Nothing for a unit that does not fit.
struct ColumnUnit {
  Dimension dimension;
  double factor;
};
std::optional<ColumnUnit> unit_of_column(const TableColumn& column, Role role);
std::optional<ColumnUnit> unit_named(std::string_view unit);

// Columns whose name says that they are this, and whose unit does not say otherwise. If one of them has the role's own
// word for its name, that one alone.
std::vector<std::size_t> columns_for(const std::vector<TableColumn>& columns, Role role);

// A column's title in two, "position [in]", whether the unit is known or not.
struct TitleParts {
  std::string name;
  std::optional<std::string> unit;
};
TitleParts parts_of(const TableColumn& column);

// The first column whose name is one of this role and whose unit is not: "position [in]", "velocity [m]".
struct MisfitUnit {
  std::size_t index;
  std::string unit;
};
std::optional<MisfitUnit> misfit_unit(const std::vector<TableColumn>& columns, Role role);
const char* likely_unit(Role role);

// A part of --columns: ROLE=[-]NAME[+NUMBER][:UNIT], the number in the column's unit; NAME may be the column's number.
struct ColumnRequest {
  Role role;
  std::string name;
  bool is_negated = false;
  double offset = 0;
  std::optional<std::string> unit;
};

// Refuses: roles that are not known, parts of another form.
std::optional<std::vector<ColumnRequest>> parse_columns(const std::string& words, Diagnostics& diagnostics);

// What is read of a table: (number + offset)·scale is the value in SI.
struct ChosenColumn {
  Role role;
  std::size_t index;  // from 0
  double offset;
  double scale;
  Dimension dimension;
  std::string title;  // as the file names it
  std::string unit;   // as the file or --columns writes it; empty where --scale says what 1 stands for
};

struct ColumnSearch {
  std::vector<ColumnRequest> requests;
  bool is_relaxation = false, is_creep = false;
  std::optional<double> scale;  // what 1 of a modulus without unit stands for, or of a compliance, in SI
  Dimension scale_dimension{};
  std::string command;  // the command line without --columns, for the question's own answer
};

// In: a table's shape. Out: the columns of a motion (time; position or strain; force or stress), a relaxation (time,
// modulus), creep (time, compliance) or a spectrum (omega or frequency; storage, loss), and a deviation where there is
// one. Asks, with the command line that answers: for what has no unit, no name, or more than one candidate. Refuses:
// names that are not there, units that do not fit, or not beside each other: a torque beside a displacement.
std::optional<std::vector<ChosenColumn>> choose_columns(const std::string& path, const TableShape& shape,
                                                        const ColumnSearch& search, Diagnostics& diagnostics);

RecordingKind kind_of(const std::vector<ChosenColumn>& columns);

// A rotation where any column's unit is that of an angle, a torque or a quotient of them; else a translation.
motion motion_of(const std::vector<ChosenColumn>& columns);

// Whether a geometry is needed to make it a quantity at a tool.
bool is_of_a_material(const ChosenColumn& column);
const ChosenColumn* find_column(const std::vector<ChosenColumn>& columns, Role role);

std::string shell_word(const std::string& word);       // as a shell takes it
std::string columns_word(const std::string& columns);  // the same of what follows --columns

// What --columns calls a column: its name, or its number where that would be read as something else.
std::string spelt(const TableShape& shape, std::size_t index);
std::string spelt(const ColumnRequest& request);  // as a part of --columns

// A quantity as the command line spells it, "10 mm" or "1kPa".
struct SpokenQuantity {
  double value;  // SI
  Dimension dimension;
};
std::optional<SpokenQuantity> spoken_quantity(const std::string& text);

}  // namespace dashpot::compiler::fitting
