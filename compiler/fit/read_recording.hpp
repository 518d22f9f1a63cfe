// A recording from its file, row by row, in SI and at the tool.
#pragma once

#include <optional>
#include <string>

#include "fit/column_choice.hpp"
#include "fit/geometry.hpp"
#include "fit/line_reader.hpp"
#include "fit/recording.hpp"

namespace dashpot::compiler::fitting {

// Where the network was at rest before the first row.
enum class Start {
  automatic,  // at 0, where the first row is on its way from there; else where the first row is
  first_row,
  zero,
  moving,  // it was not: the forces that the branches held are fitted too
};

struct ReadChoices {
  ColumnSearch columns;
  std::optional<Geometry> geometry;
  Start start = Start::automatic;
  bool has_header = true;
  bool awaits_geometry = false;  // material quantities are read as they are, with a warning that a geometry is needed
  bool keeps_positions = false;  // a surface is looked for: positions stay as they stand in the file
  double force_delay = 0;        // the force was recorded so much later than it acted [s]
};

struct ReadRecording {
  Recording recording;
  bool has_assumed_start = false;  // a row at rest was put before the first
  bool begins_in_motion = false;
};

// In: a reader that has been opened. Refuses, with place and remedy: what has no table, cells that are no finite
// numbers, rows of another length, times that fall, two rows of one time that differ (equal ones are dropped), fewer
// than three rows, no motion, a force that never changes, signs that pull where they should push. Asks, with the
// command line that answers: units, names, geometry. Warns: a geometry that is awaited, a force that stands at its
// limit while the tool moves on.
std::optional<ReadRecording> read_recording(LineReader& lines, const ReadChoices& choices, Diagnostics& diagnostics);

}  // namespace dashpot::compiler::fitting
