// The tool's motion that a network is measured on, over and over: samples at 1 kHz.
#pragma once

#include <string>
#include <vector>

namespace dashpot::contest {

struct motion {
  std::vector<double> position;  // [m]
  std::vector<double> velocity;  // [m/s]
};

// 1,024 samples. fig_10_stuck stays within ± Y/K, fig_10_sliding slides but for a few samples behind its two turns, and
// in fig_10_switching nobody can tell beforehand what the next sample does. All others press in and come back.
motion motion_for(const std::string& network);

}  // namespace dashpot::contest
