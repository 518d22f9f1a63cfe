// Every experiment but the map of walls, measured and shown, in the order of the paper.
#pragma once

#include "page.hpp"

namespace dashpot::paper {

// `thinned`: sweeps over unprinted values at their ends only, for tests of the page's form.
std::vector<Section> all_experiments(bool thinned = false);

// What chosen.json holds, for the page.
Table table_of_choices();

}  // namespace dashpot::paper
