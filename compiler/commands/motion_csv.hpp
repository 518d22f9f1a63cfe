// A motion to simulate: a table of time, position and perhaps velocity.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "source/diagnostic.hpp"

namespace dashpot::compiler {

inline constexpr std::string_view own_columns[] = {"time", "position", "velocity"};  // read of every motion

// A column that is none of them.
struct OtherColumn {
  std::string name;
  Span span;                         // of the name
  std::vector<double> values;        // one a row; 0 where a cell is no finite number
  std::optional<Span> not_a_number;  // the first such cell
};

struct Motion {
  std::vector<double> time;      // [s]
  std::vector<double> position;  // [m] or [rad]
  std::vector<double> velocity;  // [m/s] or [rad/s]; empty where the file has none
  std::vector<OtherColumn> others;
  std::optional<double> period;  // [s]; empty for a single row
  double period_error = 0;       // what the rounding of the times leaves open [s]
};

// In: comma-separated text with a header that names `time` and `position`, optionally `velocity`, in any order among
// other columns, alone or with units as in "time [s]"; blank lines do not count. Refuses: missing or repeated columns,
// rows of another length, cells that are no finite numbers, times that do not rise, a period that is not uniform or
// that no loop has.
std::optional<Motion> parse_motion(const SourceFile& file, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
