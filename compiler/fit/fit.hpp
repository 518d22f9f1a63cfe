// From recordings to a network: everything that `dashpot fit` finds out.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fit/floor.hpp"
#include "fit/reduction.hpp"
#include "fit/written_network.hpp"

namespace dashpot::compiler::fitting {

struct FitChoices {
  std::string name = "fitted";  // of the network
  std::string command;          // the command line, for the file's own record
  std::string title;            // of the network; empty: how many recordings it was fitted to
  std::string source;           // where the recordings are from, and how they were converted
  motion port_motion = motion::translation;
  Form form = Form::stiffness;
  Weighting weighting = Weighting::uniform;
  ReductionChoices reduction;
  std::vector<std::size_t> assumed_starts;  // files that were taken to start from rest before their first row
  std::optional<double> contact;            // where the surface was found or said to lie [m]
  bool contact_is_found = false;
};

// What the written network leaves of one recording, over the recording's own times.
struct FileScore {
  std::string name;
  std::string digest;
  std::size_t rows = 0;
  std::size_t free_rows = 0;  // of these: the tool has left the tissue, and they are left out
  double free_rms = 0;        // of the force in the free rows, in the recording's quantity
  double free_largest = 0;    // of its amounts
  std::vector<bool> is_free;  // row by row
  double rms = 0;             // in the recording's quantity; with weights that are not uniform, of the weighted rows
  double range = 0;           // of what was measured: greatest less least
  double r_squared = 0;
  double largest_error = 0;
  double largest_time = 0;      // where [s] or [rad/s]
  double largest_position = 0;  // where [m]; of a motion
  double lag_one = 0;           // correlation of neighbours in what is left
  double effective_samples = 0;
  double best_gain = 1;                // the gain that fits this file best by itself
  double offset = 0;                   // that was fitted, in the recording's quantity
  double gain = 1;                     // that was fitted
  std::optional<double> left_out_rms;  // with the network fitted to the other files
  std::vector<double> answer;          // of the written network, row by row; storage, then loss, of a spectrum
};

// Something that a reader must know before believing the network.
struct Finding {
  enum class Kind {
    untouched,            // name: the file [from, to, force]
    floor_above_noise,    // [floor, noise]
    left_above_noise,     // of a network that is not linear: [rms, noise]
    floor_not_certified,  // [cosine]
    slower_than_record,   // name [time, duration]
    faster_than_step,     // name [time, step]
    ill_conditioned,      // [condition]
    beyond_reach,         // name, other: elements too far apart to be compiled [factor]
    no_intervals,         // [effective samples, parameters]
    left_out_pushes,      // name: the file [rows, largest, rms]
    slips_or_softening,
    shape_is_straight,  // name: of the curve
    loading_only,
    one_rate,
    no_hold,
    unstable_left_out,  // name, other: the file [low, high, value]
    few_rows,           // [rows, parameters]
    in_motion,          // name: the file
    assumed_start,      // name: the file [position]
    late_force,         // name: the file [delay]
    size_not_met,
    offsets_absorb,
    gains_fitted,
    not_exact_in_simulate,
  };

  Kind kind;
  std::string name;
  std::vector<double> numbers;
  std::string other;
};

struct Fit {
  FitChoices choices;
  Floor floor;
  std::vector<PathEntry> path;
  std::size_t chosen = 0;
  Model model;  // before rounding
  std::vector<FittedElement> elements;
  std::vector<FittedCurveValue> curve_values;  // of the static curve
  std::vector<ShapeTried> shapes;              // where there was a choice of them
  std::string text;                            // of the network file
  std::string network_name;
  double effective_samples = 0;
  std::size_t parameters = 0;
  double rms = 0;  // of the written file, over all weighted rows
  double floor_rms = 0;
  double r_squared = 0;
  double criterion = 0;
  double condition = 1;
  bool has_intervals = false;   // where one is missing then, its value is not known
  std::optional<double> noise;  // of the force, by its second differences
  std::vector<FileScore> files, held_out;
  std::vector<Model> left_out;  // one a file
  std::vector<Finding> findings;
};

// In: recordings of one kind. Out: the network file's text, and all that is known of it. Ensures: the file compiles;
// `files` is computed from the file as it was read back. Behind a surface, rows in which the network would pull at a
// tool that withdraws faster than the tissue comes back are left out, and the surface goes on without the tool.
// Refuses: recordings in which nothing resists, with a diagnostic. `progress` hears what is being done.
std::optional<Fit> fit(const std::vector<Recording>& recordings, const std::vector<Recording>& held_out,
                       const FitChoices& choices, Diagnostics& diagnostics,
                       const std::function<void(const std::string&)>& progress = {});

// The surface that leaves the least for a network behind one of the shapes that are asked for (a table, or any of them:
// behind a line, a power or an exponential). Of each recording it looks at the rows before the force has first come
// back to nothing.
double find_contact(const std::vector<Recording>& recordings, const ReductionChoices& choices = {});
// Displacement beyond the surface counts, in front of it there is none.
std::vector<Recording> behind_surface(std::vector<Recording> recordings, double contact);

}  // namespace dashpot::compiler::fitting
