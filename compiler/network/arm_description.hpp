// A device of two axes as the runtime takes it.
#pragma once

#include <dashpot/arm_description.hpp>

#include "network/axes_device.hpp"

namespace dashpot::compiler {

arm_description arm_description_of(const AxesDevice& device);

}  // namespace dashpot::compiler
