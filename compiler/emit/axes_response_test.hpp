// What the test that `--with-test` writes for a law of two axes expects of it: torque, damping and energy at places of
// the workspace, from the network and the arm by the formulas of kinematics.hpp with the library's sine and cosine.
#pragma once

#include "emit/axes_emission.hpp"
#include "emit/code_model.hpp"

namespace dashpot::compiler {

// For the template axes_test.cpp.in.
CodeModel axes_response_test_model(const AxesCompilation& compilation);

}  // namespace dashpot::compiler
