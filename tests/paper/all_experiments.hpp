// Every experiment but the limits of virtual damping and the map of walls, which take longer, measured and shown, in
// the order of the paper; behind them those of what goes beyond it.
#pragma once

#include "page.hpp"

namespace dashpot::paper {

// `thinned`: sweeps over unprinted values at their ends only, for tests of the page's form.
std::vector<Section> all_experiments(bool thinned = false);

// What chosen.json holds, for the page.
Table table_of_choices();

}  // namespace dashpot::paper
