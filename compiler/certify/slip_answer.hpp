// How the blocks between coupled slips answer a step, whatever the slips do: each slip is replaced by its force, which
// is within ± its yield force both where it holds and where it gives way. What is left is linear.
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
  SlipAnswerRow force;               // that opposes the tool, or the surface that it touches
  SlipAnswerRow surface;             // how far that surface moves
  std::vector<double> yields;        // of the slips [N]
};

// `is_free`: of a surface that the tool does not touch, so that no force acts on it.
SlipAnswer slip_answer(const Coupling& coupling, bool is_free);
SlipAnswer slip_answer(const SlipNetwork& network, bool is_free);

}  // namespace dashpot::compiler
