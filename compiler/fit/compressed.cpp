#include "fit/compressed.hpp"

#include <Eigen/QR>

namespace dashpot::compiler::fitting {

Compressed compressed(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target) {
  if (columns.rows() <= columns.cols() + 1) return {columns, target};
  Eigen::MatrixXd both(columns.rows(), columns.cols() + 1);
  both << columns, target;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(both);
  const Eigen::Index size = both.cols();
  const Eigen::MatrixXd triangle = qr.matrixQR().topRows(size).triangularView<Eigen::Upper>();
  return {triangle.leftCols(size - 1), triangle.col(size - 1)};
}

}  // namespace dashpot::compiler::fitting
