// The symmetric-definite pencil of stiffness and damping over internal nodes (theory, section 2).
#pragma once

#include <Eigen/Core>

#include "linear/real_traits.hpp"

namespace dashpot::compiler {

using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

// K v = μ (K + ω0 B) v, VᵀKV = diag(μ), Vᵀ(K + ω0 B)V = I.
struct Pencil {
  RealVector mu;  // ascending
  RealMatrix vectors;
  Real shift;  // ω0 [1/s]
};

// Both matrices positive semidefinite, their sum definite.
Pencil solve_pencil(const RealMatrix& stiffness, const RealMatrix& damping);

}  // namespace dashpot::compiler
