// One storage function for several holds: the least damping b for which a single P serves all of them. With one hold a
// Riccati equation has the answer; with several it is a semidefinite program, solved here by Newton's method along the
// central path of its logarithmic barrier (Boyd & Vandenberghe 2004, chapter 11). The search need not be trusted: its
// result is rounded and checked with integers.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace dashpot::compiler {

// M = [P, 0; 0, 0] − Fᵀ P F + constant + b · damping ⪰ 0, over the states and behind them the inputs.
struct HoldInequality {
  Eigen::MatrixXd next;      // F, states × (states and inputs)
  Eigen::MatrixXd constant;  // symmetric
  Eigen::MatrixXd damping;   // symmetric, nonnegative
};

struct CommonStorage {
  double damping = 0;  // b
  Eigen::MatrixXd P;
};

// Whether P ≻ 0 and M ≻ 0, as computed in doubles.
bool serves(const HoldInequality& hold, const CommonStorage& tried);

// In: a positive definite P, which need not satisfy the inequality of any hold, and a b that is large enough for some
// P. Out: the pair whose b is no more than `excess` (relative) above the least, or the best that was reached if
// rounding ends the search before; empty if no P is found for the given b.
std::optional<CommonStorage> least_common_storage(const std::vector<HoldInequality>& holds, const CommonStorage& start,
                                                  double excess);

}  // namespace dashpot::compiler
