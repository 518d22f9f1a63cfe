// The velocity estimators that are compared, with the settings of chosen.json: all that the runtime has.
#pragma once

#include <dashpot/device_description.hpp>

#include <string>
#include <vector>

namespace dashpot::paper {

struct NamedEstimator {
  std::string name;
  velocity_description velocity;
};

// The one-sample difference first, the paper's filter second.
std::vector<NamedEstimator> compared_estimators();

}  // namespace dashpot::paper
