// From many columns to few elements: the whole path, and the choice on it.
#pragma once

#include <functional>
#include <optional>

#include "fit/problem.hpp"

namespace dashpot::compiler::fitting {

enum class SlipChoice { none, stops, viscous };

// Behind which static curve the network lies: none, one of its kinds, or whatever the criterion says.
enum class ShapeChoice { none, power, exponential, table, automatic };

struct ReductionChoices {
  SlipChoice slips = SlipChoice::none;
  bool springpots = false;
  ShapeChoice shape = ShapeChoice::none;
  bool is_elastic = false;  // a spring, and nothing that relaxes
  bool gains_are_free = false;
  std::vector<Term> beside;            // offsets that were asked for
  std::vector<std::size_t> in_motion;  // files that begin in mid-motion: initial forces are fitted
  std::optional<std::size_t> modes;    // so many Maxwell branches, whatever the criterion says
  std::optional<std::size_t> stops;    // so many slips
  std::optional<double> tolerance;     // the fewest elements whose relative rms is at most this

  bool ask_for_a_size() const { return modes || stops || tolerance; }
};

// A model on the way from rich to poor.
struct PathEntry {
  Model model;
  double criterion;
  std::size_t parameters;
  double rms;          // of the weighted rows
  bool is_determined;  // false: about as many parameters as rows, which fit anything, whatever the criterion says
};

// The best network behind one kind of curve, or behind none.
struct ShapeTried {
  std::optional<CurveShape::Kind> kind;
  std::size_t parameters;
  double rms;  // of the weighted rows
  double criterion;
};

struct Reduction {
  std::vector<PathEntry> path;  // from the richest
  std::size_t chosen = 0;
  double effective_samples = 0;    // of the richest
  Model model;                     // the chosen one, after spring, damper and offsets have been put to the test
  std::vector<ShapeTried> shapes;  // where there was a choice of shape; with equal samples all
  bool is_converged = true;        // the chosen model met what was asked for: modes, slips, tolerance
};

// 1. Weights on a grid of 4 relaxation times a decade (and of thresholds) that are zero or more.
// 2. Neighbours with weight are merged in pairs: ln τ to their weighted mean.
// 3. Times and thresholds are refined; then, again and again, the best of: leaving an element out, merging two that are
//    adjacent. The criterion, over the whole path, decides where to stop.
// 4. Spring, damper and offsets stay only where the same criterion says so: weights alone keep a spurious one often.
// With a shape all of this is behind a curve: the best of a few is where its parameters begin, they are refined with
// the times, and a table's stretches are halved as long as the criterion agrees. `progress` hears of each step how many
// elements are left.
Reduction reduce(const Problem& problem, const ReductionChoices& choices,
                 const std::function<void(std::size_t)>& progress = {});

// Free of zero weights, shapes in rising order.
Model tidied(Model model);

}  // namespace dashpot::compiler::fitting
