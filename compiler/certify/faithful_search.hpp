// The damping b that `faithful` gives to the brake, among all that the brake can give and all state inputs (theory,
// section 4; faithful_rule.hpp).
//
// For one state input, what is felt errs by max |affine in (b, x)| over the band, a convex function of b and the
// damping x that passivity adds. What the loop needs is a convex function of b too: that of every frequency is, and it
// is the largest of them. So the dampings that can be certified are an interval, and so are those with x below a bound.
// Between neighbouring places where x is known its chord is above it and the neighbours' chords prolonged are below it:
// places are added until both agree where it matters. On each chord the error is convex in b alone, so that those
// within the allowed error are an interval whose ends are found by bisection. No b is tried at random, and none between
// is missed.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "certify/felt_error.hpp"
#include "decompose/choices.hpp"
#include "decompose/faithful_rule.hpp"

namespace dashpot::compiler {

// One state input.
struct SearchLine {
  StateInput state_input;
  const FeltError* felt;
  // What the loop needs at b [N·s/m]; empty where nothing is proved. Convex on both sides of b∞; at b∞ itself, where
  // the motor needs no estimate, another statement may hold.
  std::function<std::optional<double>(double)> needed;
};

// All at the tool [N·s/m].
struct SearchReach {
  double feedthrough;      // b∞
  double most;             // the brake's b and what is added to it
  double besides = 0;      // of `most`, what the brake gives elsewhere at most
  double assured_share;    // of b and what is added, that is certain [1]
  double assured_besides;  // what is certain at b = 0
  bool adds = true;        // false behind a contact, where nothing is added
  double reserve = 0;      // share of what is needed that its proof may need beyond it [1]
};

struct FoundOption {
  std::size_t line;
  EvaluatedOption option;
};

struct FaithfulFind {
  std::vector<FoundOption> options;  // those that the choice hangs on
  FaithfulChoice choice;
};

// `noise`: rms of the estimate [m/s]; empty: not known.
FaithfulFind find_faithful(const std::vector<SearchLine>& lines, const SearchReach& reach, double tolerance,
                           std::optional<double> noise);

}  // namespace dashpot::compiler
