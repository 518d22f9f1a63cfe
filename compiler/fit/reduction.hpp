// From many columns to few elements: the whole path, and the choice on it.
#pragma once

#include <functional>
#include <optional>

#include "fit/problem.hpp"

namespace dashpot::compiler::fitting {

enum class SlipChoice { none, stops, viscous };

struct ReductionChoices {
  SlipChoice slips = SlipChoice::none;
  bool springpots = false;
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
  double rms;  // of the weighted rows
};

struct Reduction {
  std::vector<PathEntry> path;  // from the richest
  std::size_t chosen = 0;
  double effective_samples = 0;  // of the richest
  Model model;                   // the chosen one, after spring, damper and offsets have been put to the test
  bool is_converged = true;      // the chosen model met what was asked for: modes, slips, tolerance
};

// 1. Weights on a grid of 4 relaxation times a decade (and of thresholds) that are zero or more.
// 2. Neighbours with weight are merged in pairs: ln τ to their weighted mean.
// 3. Times and thresholds are refined; then, again and again, the best of: leaving an element out, merging two that are
//    adjacent. The criterion, over the whole path, decides where to stop.
// 4. Spring, damper and offsets stay only where the same criterion says so: weights alone keep a spurious one often.
// `progress` hears of each step how many elements are left.
Reduction reduce(const Problem& problem, const ReductionChoices& choices,
                 const std::function<void(std::size_t)>& progress = {});

// Free of zero weights, shapes in rising order.
Model tidied(Model model);

}  // namespace dashpot::compiler::fitting
