// The linear form of a written structure, and how far extended precision may leave it from the exact one.
#pragma once

#include <string>

#include "linear/linear_form.hpp"
#include "support/written_network.hpp"

namespace dashpot::testing {

inline const compiler::Real rounding{"1e-45"};

inline compiler::LinearForm form_of(const std::string& structure) {
  return compiler::linear_form(written_network(structure));
}

}  // namespace dashpot::testing
