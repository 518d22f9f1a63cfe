#include "commands/motion_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "commands/motion_cell.hpp"
#include "commands/uniform_period.hpp"
#include "fit/column_choice.hpp"
#include "fit/table_shape.hpp"
#include "network/name_rules.hpp"
#include "network/port_units.hpp"
#include "network/rate_limits.hpp"
#include "source/counted.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler {
namespace {

bool is_header(const std::vector<fitting::TableColumn>& columns) {
  const auto is_there = [&](fitting::Role role) {
    return !columns_for(columns, role).empty() || misfit_unit(columns, role);
  };
  return is_there(fitting::Role::time) && is_there(fitting::Role::position);
}

// By its name or unit, or a word within its title: "Load cell (kgf)" is a force too.
bool is_answer(const fitting::TableColumn& column) {
  using fitting::Role;
  constexpr std::size_t shortest_word = 4;  // that is looked for within others
  const std::string title = folded(column.title);
  for (const Role role : {Role::force, Role::stress}) {
    const bool has_unit = column.unit && fitting::unit_of_column(column, role);
    if (has_unit || !columns_for({column}, role).empty()) return true;
  }
  for (const Role role : {Role::force, Role::stress, Role::storage, Role::loss, Role::modulus, Role::compliance})
    for (const std::string& name : names_of(role))
      if (name.size() >= shortest_word && title.find(name) != std::string::npos) return true;
  return false;
}

// All that the commands write has what the motor made.
bool is_own(const fitting::TableColumn& column) { return column.name == "motor_force"; }

constexpr const char* joint_positions[] = {"q1", "q2"};
constexpr const char* joint_velocities[] = {"v1", "v2"};

// Without unit: "q1 [deg]" is q1, and "t" is time.
std::string name_of_joints(const fitting::TableColumn& column) {
  return columns_for({column}, fitting::Role::time).empty() ? folded(parts_of(column).name) : "time";
}

// Time and both joints, once each, and the velocities of both or of none.
bool is_joint_header(const std::vector<fitting::TableColumn>& columns) {
  const auto count = [&](const char* name) {
    return std::count_if(columns.begin(), columns.end(),
                         [&](const fitting::TableColumn& column) { return name_of_joints(column) == name; });
  };
  const auto velocities = count(joint_velocities[0]);
  return count("time") == 1 && count(joint_positions[0]) == 1 && count(joint_positions[1]) == 1 && velocities <= 1 &&
         count(joint_velocities[1]) == velocities;
}

struct Cell {
  std::string_view text;
  Span span;
};

// Which column is what, and what 1 in it stands for in SI.
struct Column {
  std::size_t index;
  double factor;
};

// A table's text in lines and cells, before anything in it can be wrong.
class CsvLines {
 public:
  explicit CsvLines(const SourceFile& file) : file_(file) {}

  bool is_motion() {
    find_dialect();
    const std::vector<fitting::TableColumn> columns = columns_of(find_header(is_header));
    return is_header(columns) && (std::any_of(columns.begin(), columns.end(), is_own) ||
                                  std::none_of(columns.begin(), columns.end(), is_answer));
  }

  bool is_joint_motion() {
    find_dialect();
    return is_joint_header(columns_of(find_header(is_joint_header)));
  }

 protected:
  // Commas where nothing tells.
  void find_dialect() {
    std::vector<fitting::HeadLine> head;
    for (Cell line = next_line(); !line.text.empty() && head.size() < fitting::head_lines; line = next_line())
      head.push_back({std::string(line.text), head.size() + 1});
    place_ = 0;
    dialect_ = fitting::dialect_of(head).value_or(fitting::Dialect());
  }

  static std::vector<fitting::TableColumn> columns_of(const std::vector<Cell>& line) {
    std::vector<fitting::TableColumn> columns;
    for (const Cell& cell : line) columns.push_back(fitting::table_column(cell.text));
    return columns;
  }

  // The first line whose columns are a header's; without one the first line, whose want is told.
  std::vector<Cell> find_header(bool (*is_header)(const std::vector<fitting::TableColumn>&)) {
    std::vector<Cell> first;
    std::size_t behind_first = 0;
    for (std::size_t i = 0; i < fitting::head_lines; ++i) {
      const Cell text = next_line();
      if (text.text.empty()) break;
      const std::vector<Cell> line = names_in(text);
      if (line.empty()) continue;  // the sign of a comment alone
      if (first.empty()) first = line, behind_first = place_;
      if (is_header(columns_of(line))) return line;
    }
    place_ = behind_first;
    return first;
  }

  // The names may stand behind the sign of a comment.
  std::vector<Cell> names_in(Cell line) const {
    while (line.text.starts_with('#') || line.text.starts_with('%')) line.text.remove_prefix(1), ++line.span.begin;
    return line.text.empty() ? std::vector<Cell>() : cells_in(line);
  }

  // The next line that is not blank, without blanks around it; empty at the end of the file.
  Cell next_line() {
    const std::string_view all = file_.text();
    while (place_ < all.size()) {
      const std::size_t begin = place_, end = std::min(all.find_first_of("\n\r", place_), all.size());
      place_ = end + 1;
      if (const Cell line = trimmed(begin, end); !line.text.empty()) return line;
    }
    return {};
  }

  // A delimiter at the end of a line ends its last field, or stands before one that is empty where one is missing.
  std::vector<Cell> next_row(std::size_t width) {
    const Cell line = next_line();
    if (line.text.empty()) return {};
    std::vector<Cell> cells = cells_in(line);
    const bool ends_open = dialect_.delimiter != ' ' && line.text.back() == dialect_.delimiter;
    if (ends_open && cells.size() + 1 == width)
      cells.push_back({line.text.substr(line.text.size()), {&file_, line.span.end, line.span.end}});
    return cells;
  }

  std::vector<Cell> cells_in(const Cell& line) const {
    std::vector<Cell> cells;
    for (const std::string_view field : fitting::fields_of(line.text, dialect_)) {
      const std::size_t begin =
          field.data() == nullptr ? line.span.end : static_cast<std::size_t>(field.data() - file_.text().data());
      cells.push_back({field, {&file_, begin, begin + field.size()}});
    }
    return cells;
  }

  Cell trimmed(std::size_t begin, std::size_t end) const {
    const std::string_view all = file_.text();
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    if (begin == 0 && all.substr(0, 3) == "\xEF\xBB\xBF") begin = 3;
    while (begin < end && is_blank(all[begin])) ++begin;
    while (begin < end && is_blank(all[end - 1])) --end;
    return {all.substr(begin, end - begin), {&file_, begin, end}};
  }

  const SourceFile& file_;
  std::size_t place_ = 0;
  fitting::Dialect dialect_;
};

class CsvTable : CsvLines {
 public:
  CsvTable(const SourceFile& file, Diagnostics& diagnostics) : CsvLines(file), diagnostics_(diagnostics) {}

  std::optional<Motion> read() {
    if (!is_text()) return std::nullopt;
    find_dialect();
    const std::vector<Cell> header = find_header(is_header);
    if (header.empty()) return refuse_empty();
    Motion motion;
    const std::vector<fitting::TableColumn> columns = with_units(header);
    const auto time = column(columns, header, fitting::Role::time, motion);
    const auto position = column(columns, header, fitting::Role::position, motion);
    const auto velocity = column(columns, header, fitting::Role::velocity, motion);
    if (failed_) return std::nullopt;
    warn_of_no_unit(columns[time->index], columns[position->index], header[position->index].span);
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (i == time->index || i == position->index || (velocity && i == velocity->index)) continue;
      others.push_back(i);
      motion.others.push_back({columns[i], header[i].span, {}, {}});
    }
    digits_ = TimeDigits(time->factor);
    for (std::vector<Cell> row = next_row(header.size()); !row.empty(); row = next_row(header.size())) {
      if (!has_fields(row, header.size())) break;
      append(motion.time, row, *time, "time");
      digits_.add(with_point(row[time->index].text));
      append(motion.position, row, *position, "position");
      if (velocity) append(motion.velocity, row, *velocity, "velocity");
      for (std::size_t i = 0; i < motion.others.size(); ++i) append(motion.others[i], row[others[i]]);
      row_spans_.push_back(row.front().span);
    }
    if (failed_) return std::nullopt;
    if (motion.time.empty()) return refuse_empty();
    return find_period(motion) ? std::optional(std::move(motion)) : std::nullopt;
  }

  std::optional<JointMotion> read_joints() {
    if (!is_text()) return std::nullopt;
    find_dialect();
    const std::vector<Cell> header = find_header(is_joint_header);
    if (header.empty()) return refuse_empty(), std::nullopt;
    if (!is_joint_header(columns_of(header)))
      return fail<DiagnosticCode::axes_csv_columns>({&file_, header.front().span.begin, header.back().span.end},
                                                    excerpt(line_of(header))),
             std::nullopt;
    JointMotion motion;
    const std::vector<fitting::TableColumn> columns = with_units(header);
    const auto time = joint_column(header, columns, "time", motion);
    std::optional<Column> position[2], velocity[2];
    for (std::size_t j = 0; j < 2; ++j) {
      position[j] = joint_column(header, columns, joint_positions[j], motion);
      velocity[j] = joint_column(header, columns, joint_velocities[j], motion);
    }
    if (failed_) return std::nullopt;
    digits_ = TimeDigits(time->factor);
    for (std::vector<Cell> row = next_row(header.size()); !row.empty(); row = next_row(header.size())) {
      if (!has_fields(row, header.size())) break;
      append(motion.clock.time, row, *time, "time");
      for (std::size_t j = 0; j < 2; ++j) {
        append(motion.position[j], row, *position[j], joint_positions[j]);
        if (velocity[j]) append(motion.velocity[j], row, *velocity[j], joint_velocities[j]);
      }
      digits_.add(with_point(row[time->index].text));
      row_spans_.push_back(row.front().span);
    }
    if (failed_) return std::nullopt;
    if (motion.clock.time.empty()) return refuse_empty(), std::nullopt;
    if (!find_period(motion.clock)) return std::nullopt;
    motion.rows = row_spans_;
    return motion;
  }

 private:
  bool is_text() {
    if (fitting::is_text(file_.text())) return true;
    diagnostics_.report<DiagnosticCode::recording_not_text>({}, file_.path());
    return false;
  }

  std::optional<Motion> refuse_empty() {
    diagnostics_.report<DiagnosticCode::csv_empty>({&file_, 0, 0});
    return std::nullopt;
  }

  static std::string line_of(const std::vector<Cell>& header) {
    std::string line;
    for (const Cell& cell : header) line += (line.empty() ? "" : ",") + std::string(cell.text);
    return line;
  }

  // Nothing where there is none, or, told, where its unit is of something else.
  std::optional<Column> joint_column(const std::vector<Cell>& header, const std::vector<fitting::TableColumn>& columns,
                                     const std::string& name, JointMotion& motion) {
    const auto is_named = [&](const fitting::TableColumn& column) { return name_of_joints(column) == name; };
    const auto found = std::find_if(columns.begin(), columns.end(), is_named);
    if (found == columns.end()) return std::nullopt;
    const fitting::Role role = name == "time"   ? fitting::Role::time
                               : name[0] == 'q' ? fitting::Role::position
                                                : fitting::Role::velocity;
    const auto index = static_cast<std::size_t>(found - columns.begin());
    const fitting::TitleParts parts = parts_of(*found);
    const auto unit = parts.unit && !found->unit ? std::nullopt : fitting::unit_of_column(*found, role);
    if (!unit) {
      fail<DiagnosticCode::recording_wrong_unit>(header[index].span, found->title, *parts.unit, name_of(role),
                                                 likely_unit(role));
      return std::nullopt;
    }
    if (found->unit && role != fitting::Role::time) {
      const auto kind = unit->dimension.radian != 0 ? dashpot::motion::rotation : dashpot::motion::translation;
      if (motion.clock.kind && *motion.clock.kind != kind)
        fail<DiagnosticCode::recording_wrong_unit>(header[index].span, found->title, *found->unit, name_of(role),
                                                   port_units(*motion.clock.kind).position);
      motion.clock.kind = kind;
      motion.clock.kind_span = header[index].span;
    }
    return Column{index, unit->factor};
  }

  // Units beside the names, or in a line of their own below.
  std::vector<fitting::TableColumn> with_units(const std::vector<Cell>& header) {
    std::vector<fitting::TableColumn> columns = columns_of(header);
    const std::size_t before = place_;
    const std::vector<Cell> below = names_in(next_line());
    const auto is_unit = [](const Cell& cell) { return fitting::is_unit(cell.text); };
    if (below.size() != header.size() || !std::all_of(below.begin(), below.end(), is_unit)) {
      place_ = before;
      return columns;
    }
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (!below[i].text.empty()) columns[i] = {columns[i].title, columns[i].title, std::string(below[i].text)};
    return columns;
  }

  std::optional<Column> column(const std::vector<fitting::TableColumn>& columns, const std::vector<Cell>& header,
                               fitting::Role role, Motion& motion) {
    const std::vector<std::size_t> found = columns_for(columns, role);
    const auto misfit = found.empty() ? misfit_unit(columns, role) : std::nullopt;
    if (misfit)
      fail<DiagnosticCode::recording_wrong_unit>(header[misfit->index].span, columns[misfit->index].title, misfit->unit,
                                                 name_of(role), likely_unit(role));
    else if (found.empty() && role != fitting::Role::velocity)
      fail<DiagnosticCode::csv_missing_column>(header.front().span, name_of(role), fitting::other_names_of(role));
    if (found.size() > 1) fail<DiagnosticCode::csv_column_twice>(header[found[1]].span, name_of(role));
    if (found.size() != 1) return std::nullopt;
    const fitting::TableColumn& named = columns[found.front()];
    const fitting::ColumnUnit unit = *unit_of_column(named, role);
    if (named.unit && role != fitting::Role::time) {
      motion.kind = unit.dimension.radian != 0 ? dashpot::motion::rotation : dashpot::motion::translation;
      motion.kind_span = header[found.front()].span;
    }
    return Column{found.front(), unit.factor};
  }

  // Milliseconds beside millimetres that are not told as such are common.
  void warn_of_no_unit(const fitting::TableColumn& time, const fitting::TableColumn& position, const Span& span) {
    if (!time.unit || position.unit) return;
    diagnostics_.report<DiagnosticCode::csv_unit_left_out>(span, position.title, *time.unit);
  }

  bool has_fields(const std::vector<Cell>& row, std::size_t count) {
    if (row.size() != count)
      fail<DiagnosticCode::csv_field_count>({&file_, row.front().span.begin, row.back().span.end},
                                            counted(row.size(), "field"), count);
    return row.size() == count;
  }

  // Of many bad cells the first is reported.
  void append(std::vector<double>& values, const std::vector<Cell>& row, const Column& column, const char* name) {
    const Cell& cell = row[column.index];
    const std::optional<double> value = number_in_cell(with_point(cell.text));
    if (!value && !failed_) report_cell(cell.span, name, diagnostics_);
    failed_ |= !value;
    values.push_back(value.value_or(0) * column.factor);
    if (!std::isfinite(values.back()) && !failed_) fail<DiagnosticCode::number_too_large>(cell.span, cell.text);
  }

  // "0,5" where decimals stand behind a comma; nothing that is a number where a point stands too.
  std::string with_point(std::string_view text) const {
    std::string number(text);
    if (!dialect_.decimal_comma) return number;
    std::replace(number.begin(), number.end(), '.', ';');
    std::replace(number.begin(), number.end(), ',', '.');
    return number;
  }

  // What is in it may be of no interest to anybody.
  void append(OtherColumn& column, const Cell& cell) const {
    const std::optional<double> value = number_in_cell(with_point(cell.text));
    if (!value && !column.not_a_number) column.not_a_number = cell.span;
    column.values.push_back(value.value_or(0));
  }

  template <DiagnosticCode code, class... Arguments>
  void fail(Span span, const Arguments&... arguments) {
    failed_ = true;
    diagnostics_.report<code>(span, arguments...);
  }

  bool find_period(Motion& motion) {
    if (motion.time.size() < 2) return true;
    const auto found = uniform_period(motion.time, digits_);
    if (const auto* irregular = std::get_if<Irregularity>(&found)) {
      report(*irregular);
      return false;
    }
    const UniformPeriod uniform = std::get<UniformPeriod>(found);
    const double rate = 1 / uniform.period;
    if (rate > highest_rate) fail<DiagnosticCode::csv_rate_too_high>(row_spans_[1], rate, highest_rate);
    if (rate < lowest_rate) fail<DiagnosticCode::csv_rate_too_low>(row_spans_[1], rate, lowest_rate);
    motion.period = uniform.period;
    motion.period_error = uniform.error;
    return !failed_;
  }

  void report(const Irregularity& irregular) {
    const Span row = row_spans_[irregular.row];
    switch (irregular.kind) {
      case Irregularity::Kind::no_rise:
        diagnostics_.report<DiagnosticCode::csv_time_not_rising>(row, irregular.found, irregular.expected);
        if (irregular.found < irregular.expected || !digits_.are_known()) return;
        break;
      case Irregularity::Kind::step:
        diagnostics_.report<DiagnosticCode::csv_not_uniform>(row, irregular.found, irregular.expected);
        break;
      case Irregularity::Kind::drift:
        diagnostics_.report<DiagnosticCode::csv_drifts>(row, irregular.found, irregular.period, irregular.expected);
        break;
    }
    diagnostics_.note<DiagnosticCode::csv_uniform_remedy>({}, uniformity, irregular.unit, coarsest_share);
  }

  Diagnostics& diagnostics_;
  std::vector<Span> row_spans_;
  TimeDigits digits_;
  bool failed_ = false;
};

}  // namespace

double same_rate_of(const Motion& motion) {
  constexpr double same_rate = 1e-6;  // times in a file are decimal numbers of limited length
  return std::max(same_rate, motion.period_error / *motion.period);
}

double rate_meant(const Motion& motion) {
  const double period = *motion.period, rate = 1 / period;
  if (const double whole = std::round(rate); whole > 0 && std::abs(rate - whole) <= same_rate_of(motion) * rate)
    return whole;
  return 1 / std::strtod(fmt::format("{:.7g}", period).c_str(), nullptr);
}

std::optional<Motion> parse_motion(const SourceFile& file, Diagnostics& diagnostics) {
  return CsvTable(file, diagnostics).read();
}

std::optional<JointMotion> parse_joint_motion(const SourceFile& file, Diagnostics& diagnostics) {
  return CsvTable(file, diagnostics).read_joints();
}

std::optional<MotionOf> motion_in(const SourceFile& beginning) {
  if (CsvLines(beginning).is_joint_motion()) return MotionOf::joints;
  return CsvLines(beginning).is_motion() ? std::optional(MotionOf::port) : std::nullopt;
}

bool suits(const Motion& motion, dashpot::motion port_motion, Diagnostics& diagnostics) {
  if (!motion.kind || *motion.kind == port_motion) return true;
  const bool turns = port_motion == dashpot::motion::rotation;
  diagnostics.report<DiagnosticCode::csv_other_motion>(motion.kind_span, turns ? "metres" : "radians",
                                                       turns ? "radians" : "metres");
  return false;
}

void warn_outside_valid(const Motion& motion, const Network& network, Diagnostics& diagnostics) {
  const PortUnits units = port_units(network.port_motion);
  const auto warns = [&](const std::optional<Range>& range, double value, double time, const char* what,
                         const std::string& unit) {
    if (!range || range->contains(value)) return false;
    diagnostics.report<DiagnosticCode::outside_valid_range>(network.valid.span, what, value, unit, time, range->low,
                                                            range->high);
    return true;
  };
  bool has_displacement = false, has_rate = false;
  for (std::size_t i = 0; i < motion.time.size(); ++i) {
    const double time = motion.time[i], position = motion.position[i];
    has_displacement =
        has_displacement || warns(network.valid.displacement, position, time, "displacement", units.position);
    const double slope = i == 0 ? 0 : (position - motion.position[i - 1]) / *motion.period;
    const double velocity = motion.velocity.empty() ? slope : motion.velocity[i];
    // Rest is in every recording, and says nothing of how fast the tissue may be pressed.
    if (velocity == 0) continue;
    has_rate = has_rate || warns(network.valid.rate, std::abs(velocity), time, "rate", units.velocity);
  }
}

}  // namespace dashpot::compiler
