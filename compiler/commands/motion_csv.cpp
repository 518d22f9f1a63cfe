#include "commands/motion_csv.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "commands/motion_cell.hpp"
#include "commands/uniform_period.hpp"
#include "network/rate_limits.hpp"

namespace dashpot::compiler {
namespace {

struct Cell {
  std::string_view text;
  Span span;
};

class CsvTable {
 public:
  CsvTable(const SourceFile& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}

  std::optional<Motion> read() {
    const std::vector<Cell> header = next_row();
    if (header.empty()) return refuse_empty();
    const auto time = column(header, {"time", "time [s]"}, true);
    const auto position = column(header, {"position", "position [m]", "position [rad]"}, true);
    const auto velocity = column(header, {"velocity", "velocity [m/s]", "velocity [rad/s]"}, false);
    if (failed_) return std::nullopt;
    Motion motion;
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (i == time || i == position || i == velocity) continue;
      others.push_back(i);
      motion.others.push_back({std::string(header[i].text), header[i].span, {}, {}});
    }
    for (std::vector<Cell> row = next_row(); !row.empty(); row = next_row()) {
      if (!has_fields(row, header.size())) break;
      append(motion.time, row[*time], "time");
      digits_.add(row[*time].text);
      append(motion.position, row[*position], "position");
      if (velocity) append(motion.velocity, row[*velocity], "velocity");
      for (std::size_t i = 0; i < motion.others.size(); ++i) append(motion.others[i], row[others[i]]);
      row_spans_.push_back(row.front().span);
    }
    if (failed_) return std::nullopt;
    if (motion.time.empty()) return refuse_empty();
    return find_period(motion) ? std::optional(std::move(motion)) : std::nullopt;
  }

 private:
  std::optional<Motion> refuse_empty() {
    diagnostics_.report<DiagnosticCode::csv_empty>({&file_, 0, 0});
    return std::nullopt;
  }

  // The next line that is not blank; nothing at the end of the file.
  std::vector<Cell> next_row() {
    const std::string_view all = file_.text();
    while (place_ < all.size()) {
      const std::size_t begin = place_, end = std::min(all.find('\n', place_), all.size());
      place_ = end + 1;
      if (!trimmed(begin, end).text.empty()) return cells_between(begin, end);
    }
    return {};
  }

  std::vector<Cell> cells_between(std::size_t begin, std::size_t end) const {
    std::vector<Cell> cells;
    while (begin <= end) {
      const std::size_t comma = std::min(file_.text().find(',', begin), end);
      cells.push_back(trimmed(begin, comma));
      begin = comma + 1;
    }
    return cells;
  }

  Cell trimmed(std::size_t begin, std::size_t end) const {
    const std::string_view all = file_.text();
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
    if (begin == 0 && all.substr(0, 3) == "\xEF\xBB\xBF") begin = 3;
    while (begin < end && is_blank(all[begin])) ++begin;
    while (begin < end && is_blank(all[end - 1])) --end;
    return {all.substr(begin, end - begin), {&file_, begin, end}};
  }

  // A column by its name alone, or with its unit as the loop's own log writes it.
  std::optional<std::size_t> column(const std::vector<Cell>& header, std::initializer_list<std::string_view> names,
                                    bool needed) {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (std::find(names.begin(), names.end(), header[i].text) == names.end()) continue;
      if (found) fail<DiagnosticCode::csv_column_twice>(header[i].span, *names.begin());
      found = i;
    }
    if (needed && !found) fail<DiagnosticCode::csv_missing_column>(header.front().span, *names.begin());
    return found;
  }

  bool has_fields(const std::vector<Cell>& row, std::size_t count) {
    if (row.size() != count)
      fail<DiagnosticCode::csv_field_count>({&file_, row.front().span.begin, row.back().span.end}, row.size(), count);
    return row.size() == count;
  }

  // Of many bad cells the first is reported.
  void append(std::vector<double>& values, const Cell& cell, const char* name) {
    const std::optional<double> value = number_in_cell(cell.text);
    if (!value && !failed_) report_cell(cell.span, name, diagnostics_);
    failed_ |= !value;
    values.push_back(value.value_or(0));
  }

  // What is in it may be of no interest to anybody.
  static void append(OtherColumn& column, const Cell& cell) {
    const std::optional<double> value = number_in_cell(cell.text);
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
        if (irregular.found < irregular.expected) return;
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

  const SourceFile& file_;
  Diagnostics& diagnostics_;
  std::size_t place_ = 0;
  std::vector<Span> row_spans_;
  TimeDigits digits_;
  bool failed_ = false;
};

}  // namespace

std::optional<Motion> parse_motion(const SourceFile& file, Diagnostics& diagnostics) {
  return CsvTable(file, diagnostics).read();
}

}  // namespace dashpot::compiler
