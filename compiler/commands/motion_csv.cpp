#include "commands/motion_csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace dashpot::compiler {
namespace {

constexpr double uniformity = 1e-6;  // largest relative departure of a step from the median

struct Cell {
  std::string_view text;
  Span span;
};

class Table {
 public:
  Table(const SourceFile& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}

  std::optional<Motion> read() {
    std::vector<Cell> header = next_row();
    if (header.empty()) return refuse_empty();
    const auto time = column(header, "time"), position = column(header, "position"), velocity = column(header, "velocity");
    if (!time) diagnostics_.report<DiagnosticCode::csv_missing_column>(header.front().span, "time");
    if (!position) diagnostics_.report<DiagnosticCode::csv_missing_column>(header.front().span, "position");
    if (!time || !position) return std::nullopt;
    Motion motion;
    while (place_ < file_.text().size()) {
      const std::vector<Cell> row = next_row();
      if (row.size() == 1 && row.front().text.empty()) continue;
      append(motion.time, row, *time, "time");
      append(motion.position, row, *position, "position");
      if (velocity) append(motion.velocity, row, *velocity, "velocity");
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

  std::vector<Cell> next_row() {
    const std::string_view all = file_.text();
    const std::size_t end = std::min(all.find('\n', place_), all.size());
    std::vector<Cell> cells;
    std::size_t begin = place_;
    while (begin <= end && end > place_) {
      const std::size_t comma = std::min(all.find(',', begin), end);
      cells.push_back(trimmed(begin, comma));
      begin = comma + 1;
    }
    if (cells.empty() && place_ < all.size()) cells.push_back(trimmed(place_, end));
    place_ = end + 1;
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

  static std::optional<std::size_t> column(const std::vector<Cell>& header, std::string_view name) {
    for (std::size_t i = 0; i < header.size(); ++i)
      if (header[i].text == name) return i;
    return std::nullopt;
  }

  void append(std::vector<double>& values, const std::vector<Cell>& row, std::size_t index, const char* name) {
    const Cell cell = index < row.size() ? row[index] : Cell{{}, row.back().span};
    double value = 0;
    const auto [end, error] = std::from_chars(cell.text.data(), cell.text.data() + cell.text.size(), value);
    if (error != std::errc() || end != cell.text.data() + cell.text.size() || !std::isfinite(value)) {
      if (!failed_) diagnostics_.report<DiagnosticCode::csv_not_a_number>(cell.span, name, std::string(cell.text));
      failed_ = true;
    }
    values.push_back(value);
  }

  bool find_period(Motion& motion) {
    if (motion.time.size() < 2) return true;
    std::vector<double> steps;
    for (std::size_t i = 1; i < motion.time.size(); ++i) steps.push_back(motion.time[i] - motion.time[i - 1]);
    std::vector<double> sorted = steps;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double median = sorted[sorted.size() / 2];
    for (std::size_t i = 0; i < steps.size(); ++i) {
      // Times are decimal numbers of limited length: their own rounding is allowed for.
      const double rounding = 4 * 0x1p-52 * std::abs(motion.time[i + 1]);
      if (median > 0 && std::abs(steps[i] - median) <= uniformity * median + rounding) continue;
      diagnostics_.report<DiagnosticCode::csv_not_uniform>(row_spans_[i + 1], steps[i], median);
      return false;
    }
    motion.period = median;
    return true;
  }

  const SourceFile& file_;
  Diagnostics& diagnostics_;
  std::size_t place_ = 0;
  std::vector<Span> row_spans_;
  bool failed_ = false;
};

}  // namespace

std::optional<Motion> parse_motion(const SourceFile& file, Diagnostics& diagnostics) {
  return Table(file, diagnostics).read();
}

}  // namespace dashpot::compiler
