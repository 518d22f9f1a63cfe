// Every experiment but the map of walls, measured and shown, in the order of the paper.
#pragma once

#include "page.hpp"

namespace dashpot::paper {

std::vector<Section> all_experiments();

// What chosen.json holds, for the page.
Table table_of_choices();

}  // namespace dashpot::paper
