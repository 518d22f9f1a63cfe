// The record that `dashpot fit` writes into a network file of where its numbers come from.
#pragma once

#include "syntax/object_reader.hpp"

namespace dashpot::compiler {

// Reports, under "fit", keys that are not known and values of another type. Nothing in it changes the network.
void check_fit_record(const ObjectReader& network, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
