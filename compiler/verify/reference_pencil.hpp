// The pencil of stiffness and damping over inner nodes once more (linear/pencil.hpp), in 100 digits, by Cholesky's
// factors, Householder's reduction and the QL method.
#pragma once

#include "verify/reference_form.hpp"

namespace dashpot::compiler {

using ReferenceVector = std::vector<Reference>;
using ReferenceMatrix = std::vector<ReferenceVector>;

// K v = μ (K + ω0 B) v, vᵀ(K + ω0 B)v = 1.
struct ReferencePencil {
  ReferenceVector mu;
  Reference shift;  // ω0 [1/s]
};

// Both matrices positive semidefinite, their sum definite. Every vector x becomes Vᵀx.
ReferencePencil reference_pencil(const ReferenceMatrix& springs, const ReferenceMatrix& dampers,
                                 std::vector<ReferenceVector>& vectors);

}  // namespace dashpot::compiler
