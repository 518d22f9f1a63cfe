// The symmetric-definite pencil of stiffness and damping over internal nodes (theory, section 2).
#pragma once

#include <Eigen/Core>

#include "linear/real_traits.hpp"

namespace dashpot::compiler {

using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

// K v = μ (K + ω0 B) v, VᵀKV = diag(μ), Vᵀ(K + ω0 B)V = I. The vectors themselves are nowhere needed.
struct Pencil {
  RealVector mu;      // ascending
  RealMatrix drives;  // Vᵀ times the columns that were given
  Real shift;         // ω0 [1/s]
};

// Both matrices positive semidefinite, their sum definite. Takes on the order of n² b operations for n nodes that can
// be numbered so that no element joins two further apart than b; those of a ladder can with b = 1.
Pencil solve_pencil(const RealMatrix& stiffness, const RealMatrix& damping, const RealMatrix& drives);

}  // namespace dashpot::compiler
