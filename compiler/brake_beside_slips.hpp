// What `faithful` gives to the brake beside slips where the slips show: all of (b, state input, law behind the slips)
// together, judged by what is felt both over the band while all slips hold and in the runs around yield.
#pragma once

#include "slip_runs.hpp"

namespace dashpot::compiler {

// In: a network whose damping beside the slips was chosen over the band alone, with its runs. Returns that candidate
// with the damping and the state input that the rule of faithful_rule.hpp takes when an option's error is the larger of
// both, and its brake the mean over all motions; Candidate::faithful holds what it was chosen by.
//
// For one state input and one law what is felt is nearly affine in b, so that both errors are convex in it: between
// dampings that have been run the felt forces are interpolated, and what is found in this way is run to be sure.
Candidate choose_beside_slips(const Compilation& c, const Choices& choices, SlipRuns& runs);

}  // namespace dashpot::compiler
