// A main program around a law in C99, for tools that read no C++: what is proved is the header that is emitted.
#pragma once

#include <map>
#include <string>

#include "compile.hpp"
#include "certify/state_box.hpp"

namespace dashpot::testing {

// What the main program of the proof starts from: each state within its bounds, in so many slices one after the other.
struct ProvenBox {
  compiler::InputRange range;
  compiler::StateBox states;
  std::map<std::string, int> slices;  // of states that need a distinction of cases
};

// Includes <name>.h. Under Frama-C, `main` takes any state in the box and any input in the range, makes one step, and
// asserts that the command is finite and the state in the box again. Elsewhere it reads positions and velocities and
// prints commands.
std::string c_form(const compiler::Compilation& compilation, const ProvenBox& box);

}  // namespace dashpot::testing
