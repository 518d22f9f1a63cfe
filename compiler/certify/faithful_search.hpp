// The damping b that `faithful` gives to the brake, among all that the brake can give and all state inputs (theory,
// section 4; faithful_rule.hpp).
//
// For one state input, the error of what is felt is max |an affine function of (b, x)| over the band, so a convex
// function of b and of the damping x that passivity adds. The damping that the loop needs is convex in b too, as the
// largest of functions that are convex in b, one for each frequency. So the dampings that can be certified form an
// interval, and so do those with x below a bound. Between neighbouring places where x is known, its chord lies above x
// and the prolonged chords of the neighbours lie below it: places are added until both agree where it matters. On each
// chord the error is convex in b alone, so that the b within the allowed error form an interval, whose ends are found
// by bisection. No b is tried at random, and none in between is missed.
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
  double besides = 0;      // part of `most` that the brake may have to give elsewhere
  double assured_share;    // share of b and the addition that is certain [1]
  double assured_besides;  // what is certain at b = 0
  bool adds = true;        // false behind a contact, where nothing is added
  double reserve = 0;      // share by which the proof may need more than the bound [1]
};

struct FoundOption {
  std::size_t line;
  EvaluatedOption option;
};

struct FaithfulFind {
  std::vector<FoundOption> options;  // those that the choice depends on
  FaithfulChoice choice;
};

// `noise`: rms of the estimate [m/s]; empty: not known.
FaithfulFind find_faithful(const std::vector<SearchLine>& lines, const SearchReach& reach, double tolerance,
                           std::optional<double> noise);

}  // namespace dashpot::compiler
