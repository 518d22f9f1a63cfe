// How the blocks between coupled slips answer a step. Each slip is replaced by its force, which is within ± its yield
// force whether it holds or gives way; what is left is linear.
#pragma once

#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// by_change Δu + Σ by_held π_i + Σ by_slip φ_k, where π_i are the forces held in the order of the step's `held`, φ_k
// those of its slips.
struct SlipAnswerRow {
  double by_change = 0;
  std::vector<double> by_held, by_slip;
};

struct SlipAnswer {
  std::vector<SlipAnswerRow> moved;  // δ of every block of a tree, or how far every inner end of a network moves
  SlipAnswerRow force;               // force that opposes the tool, or the surface that it touches
  SlipAnswerRow surface;             // how far that surface moves
  std::vector<double> yields;        // of the slips [N]
};

// `is_free`: for a surface that the tool does not touch, so that no force acts on it.
SlipAnswer slip_answer(const Coupling& coupling, bool is_free);
SlipAnswer slip_answer(const SlipNetwork& network, bool is_free);

}  // namespace dashpot::compiler
