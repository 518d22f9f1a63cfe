// A motion to simulate: a table of time, position and perhaps velocity.
#pragma once

#include <dashpot/command.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/column_choice.hpp"
#include "network/network.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

inline constexpr std::string_view own_columns[] = {"time", "position", "velocity"};  // read of every motion

// A column that is none of them.
struct OtherColumn {
  fitting::TableColumn column;
  Span span;                         // of the name
  std::vector<double> values;        // one a row; 0 where a cell is no finite number
  std::optional<Span> not_a_number;  // the first such cell
};

struct Motion {
  std::optional<dashpot::motion> kind;  // what the units of position and velocity say; empty where they stand alone
  Span kind_span;                       // of the column that says so
  std::vector<double> time;             // [s]
  std::vector<double> position;         // [m] or [rad]
  std::vector<double> velocity;         // [m/s] or [rad/s]; empty where the file has none
  std::vector<OtherColumn> others;
  std::optional<double> period;  // [s]; empty for a single row
  double period_error = 0;       // what the rounding of the times leaves open [s]
};

// The rate that a motion of two rows or more means: a whole number of hertz, or a period with few digits, rather than
// the rounding of times.
double rate_meant(const Motion& motion);

// What rates may differ by to be the same, relative: the times' rounding leaves more of it open where they have few
// digits.
double same_rate_of(const Motion& motion);

// In: a table as `dashpot fit` reads it, separated by commas, semicolons, bars, tabs or blanks, decimals behind a point
// or a comma, lines of other text before its header. The header names time and position, perhaps velocity, in any order
// among other columns and under any of the names that `fit` knows, with a unit beside or below the name ("position
// [mm]") or, without one, in SI. Blank lines do not count. The page of `dashpot report` reads by the same rules
// (report/page/table.js). Refuses: missing or repeated columns, rows of another length, cells that are no finite
// numbers, times that do not rise, a period that is not uniform or that no loop has.
std::optional<Motion> parse_motion(const SourceFile& file, Diagnostics& diagnostics);

// The motion of two joints: columns time, q1, q2 and perhaps v1, v2, among others.
struct JointMotion {
  Motion clock;                                 // its times, period and kind alone
  std::array<std::vector<double>, 2> position;  // [rad] or [m]
  std::array<std::vector<double>, 2> velocity;  // [rad/s] or [m/s]; empty where the file has none
  std::vector<Span> rows;                       // where each stands
};

// As parse_motion(), but for the names of joints, which are these alone.
std::optional<JointMotion> parse_joint_motion(const SourceFile& file, Diagnostics& diagnostics);

enum class MotionOf { port, joints };

// Of what a table that begins so is a motion: its first line names time and position, and no force, stress or anything
// else that answered them; or `simulate` and `run` have written it, which read it again. Empty if it is
// none. Faults are left to the function that then reads it.
std::optional<MotionOf> motion_in(const SourceFile& beginning);

// Refuses a motion in degrees for a tool that moves in metres, and the other way round.
bool suits(const Motion& motion, dashpot::motion port_motion, Diagnostics& diagnostics);

// Warns, once each, where the position or the rate leaves the range that the network is valid in. Without a column of
// velocity the rate is that between rows.
void warn_outside_valid(const Motion& motion, const Network& network, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
