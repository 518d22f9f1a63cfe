#include "linear/pencil.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace dashpot::compiler {

Pencil solve_pencil(const RealMatrix& stiffness, const RealMatrix& damping) {
  const Real stiffness_trace = stiffness.trace(), damping_trace = damping.trace();
  const Real shift = stiffness_trace > 0 && damping_trace > 0 ? Real(stiffness_trace / damping_trace) : Real(1);
  const RealMatrix metric = stiffness + shift * damping;
  const Eigen::LLT<RealMatrix> cholesky(metric);
  RealMatrix reduced = cholesky.matrixL().solve(stiffness);
  reduced = cholesky.matrixL().solve(RealMatrix(reduced.transpose()));
  const Eigen::SelfAdjointEigenSolver<RealMatrix> solver(RealMatrix((reduced + reduced.transpose()) / Real(2)));
  return {solver.eigenvalues(), cholesky.matrixL().transpose().solve(solver.eigenvectors()), shift};
}

}  // namespace dashpot::compiler
