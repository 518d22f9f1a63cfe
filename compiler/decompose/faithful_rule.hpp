// The rule of `faithful`: among several ways to share a network's force between brake and motor that still feel like
// the tissue, it takes the one whose brake does most (theory, section 4).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace dashpot::compiler {

// One way - a damping b, what drives the states, a law behind slips - and what it costs.
struct EvaluatedOption {
  double damping;                     // b, what the brake is told before anything is added to it [N·s/m]
  double error;                       // of what is felt, relative to the network [1]
  std::optional<double> added;        // damping that passivity adds to b [N·s/m]; empty: nothing is proved
  bool certified;                     // something is proved, and the brake can give b and what is added
  std::optional<double> motor_noise;  // rms [N]; empty: not known, which counts as the most
};

struct FaithfulChoice {
  std::size_t chosen;
  double least_error;    // that any option reaches [1]
  double allowed_error;  // max(tolerance, 1.05 × the least) [1]
  double least_added;    // of the certified ones within the error [N·s/m]; 0 where there is none
  bool certified;        // the chosen one is
  bool in_runs = false;  // the errors are those of runs around yield too, not over the band alone
};

inline constexpr double leeway = 1.05;  // on the least reachable error, and on the least added damping [1]

// max(tolerance, 1.05 × least)
double allowed_error(double tolerance, double least_error);

// Whether the error is allowed, apart from rounding.
bool is_within(double error, double allowed);

// Among all options with an error of at most max(`tolerance`, 1.05 × the least reachable), those that are certified
// with at most 1.05 × the least added damping among these; of them the largest b; of equal b the least motor noise,
// then the least error, then the first. An error that only uncertified options reach does not exclude a certified one:
// the least reachable is then that of the certified options. If none is certified, the same without that filter.
// Requires: one option at least.
FaithfulChoice choose_faithful(const std::vector<EvaluatedOption>& options, double tolerance);

}  // namespace dashpot::compiler
