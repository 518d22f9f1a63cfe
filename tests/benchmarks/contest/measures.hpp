// How a contender is measured; every figure is a time of one step [s], or one number of a machine.
#pragma once

#include "contender.hpp"
#include "motion.hpp"

namespace dashpot::contest {

// Each sample waits for the force of the one before: returns the last force.
double run_chain(const contender& c, void* law, const motion& tool, long steps);

// Samples are there beforehand: returns something of all forces.
double run_stream(const contender& c, void* law, const motion& tool, long steps);

// Mean of the middle of `ticks` samples, each looked at by itself: from the input's arrival to the command. What
// follows the command is done but not timed.
double command_latency(const contender& c, void* law, const motion& tool, int ticks);

// The same of whole samples, to the end of the update, each after code, constants and states have been driven out of
// all caches.
double cold_tick(const contender& c, void* law, const motion& tool, int ticks);

}  // namespace dashpot::contest
