// A tall least-squares problem in few rows.
#pragma once

#include <Eigen/Core>

namespace dashpot::compiler::fitting {

// Columns A and target b: ‖A x − b‖² is the same as before, for every x.
struct Compressed {
  Eigen::MatrixXd columns;
  Eigen::VectorXd target;
};

// In at most one row more than there are columns: Qᵀ of the QR decomposition of [A b] changes no length.
Compressed compressed(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target);

}  // namespace dashpot::compiler::fitting
