// The velocity estimator of a device file for loops in C, from templates/c99/estimator.h.
#pragma once

#include <dashpot/device_description.hpp>

#include <string>
#include <vector>

namespace dashpot::compiler {

// Whether the lines of an estimator need the command header in front of them.
bool needs_command_header(estimator_kind estimator);

// A type `name`, <name>_reset() and <name>_update(): any_estimator<double> of a description without a fault, with all
// its constants written out.
std::vector<std::string> c99_estimator(const device_description& device, const std::string& name);

}  // namespace dashpot::compiler
