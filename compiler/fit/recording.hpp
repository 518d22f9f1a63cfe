// A measurement, in SI and at the tool: what `dashpot fit` fits to.
#pragma once

#include <dashpot/command.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace dashpot::compiler::fitting {

enum class RecordingKind {
  motion,      // position and force over time, whatever was done
  relaxation,  // stiffness over the time since a step of position
  creep,       // compliance over the time since a step of force
  frequency,   // storage and loss stiffness over angular frequency
};

// Rotation reads rad for m and N m for N throughout.
struct Recording {
  std::string name;    // of its file
  std::string digest;  // of the file's bytes
  RecordingKind kind = RecordingKind::motion;
  motion port_motion = motion::translation;
  std::vector<double> time;       // [s]; of frequency: angular frequency [rad/s]; rising
  std::vector<double> position;   // of a motion: from rest [m]; else empty
  std::vector<double> force;      // motion [N], relaxation [N/m], creep [m/N], frequency: storage [N/m]
  std::vector<double> loss;       // of frequency [N/m]; else empty
  std::vector<double> deviation;  // of the force, in its unit; empty where it was not measured
  std::size_t assumed_rows = 0;   // at the start: rest before the first measured row; they carry no weight
  double origin = 0;              // position at rest, as it stands in the file [m]
  double in_front = 0;            // of a motion behind a surface: how far in front of it the tool has been [m]
  std::vector<double> surface;    // where a tool leaves the tissue: of that, from rest [m]; else empty, the position

  std::size_t measured_rows() const { return time.size() - assumed_rows; }
  // How far the tissue is pushed in each row.
  const std::vector<double>& pushed() const { return surface.empty() ? position : surface; }
  // Of a tool that has left the tissue: there its force tells nothing of it.
  bool is_free(std::size_t row) const { return !surface.empty() && surface[row] != position[row]; }
  std::size_t free_rows() const;
};

// From row to row [s]; the first is 0. Periods that differ by no more than the rounding of the times are made equal.
std::vector<double> steps_of(const std::vector<double>& time);
double usual_step(const std::vector<double>& steps);  // their median but for the first

}  // namespace dashpot::compiler::fitting
