#include "certify/common_storage.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "certify/recent.hpp"

namespace dashpot::compiler {
namespace {

using Matrix = Eigen::MatrixXd;
using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

// For few rows and columns: the preparation that Eigen does for large products would cost more than it saves.
template <class Left, class Right>
Matrix product(const Left& left, const Right& right) {
  return left.lazyProduct(right);
}

Matrix matrix_of(const HoldInequality& of, const CommonStorage& at) {
  const Eigen::Index n = at.P.rows();
  Matrix M = of.constant + at.damping * of.damping - product(of.next.transpose(), product(at.P, of.next));
  M.topLeftCorner(n, n) += at.P;
  return M;
}

// log det, or nothing where the matrix is not positive.
std::optional<double> log_determinant(const Matrix& M) {
  const Eigen::LLT<Matrix> factors(M);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const double sum = factors.matrixLLT().diagonal().array().log().sum();
  return std::isfinite(sum) ? std::optional(2 * sum) : std::nullopt;
}

Matrix inverse_of(const Matrix& M) { return Eigen::LLT<Matrix>(M).solve(Matrix::Identity(M.rows(), M.cols())); }

// t b less the logarithms of all determinants: what Newton's method makes small.
class Barrier {
 public:
  Barrier(const std::vector<HoldInequality>& all, Eigen::Index states) : all_(all), n_(states) {
    for (Eigen::Index i = 0; i < n_; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) entries_.emplace_back(i, j);
  }

  std::optional<double> value(const CommonStorage& at, double t) const {
    std::optional<double> sum = log_determinant(at.P);
    for (const HoldInequality& one : all_) {
      const std::optional<double> found = sum ? log_determinant(matrix_of(one, at)) : std::nullopt;
      sum = found ? std::optional(*sum + *found) : std::nullopt;
    }
    return sum ? std::optional(t * at.damping - *sum) : std::nullopt;
  }

  // Newton's step and the square of its decrement.
  std::pair<CommonStorage, double> step(const CommonStorage& at, double t) const {
    const Eigen::Index count = Eigen::Index(entries_.size());
    Vector gradient = Vector::Zero(count + 1);
    Matrix hessian = Matrix::Zero(count + 1, count + 1);
    gradient(count) = t;
    const Matrix inverse = inverse_of(at.P);
    gradient.head(count) -= on_entries(inverse);
    add_products(inverse, 1, hessian);
    for (const HoldInequality& one : all_) {
      const Matrix W = inverse_of(matrix_of(one, at));
      const Matrix onward = product(one.next, W), weighed = product(W, product(one.damping, W));
      const Matrix before = W.topLeftCorner(n_, n_), across = onward.leftCols(n_).transpose(),
                   after = product(onward, one.next.transpose());
      gradient.head(count) += on_entries(after - before);
      gradient(count) -= W.cwiseProduct(one.damping).sum();
      add_products(before, 1, hessian);
      add_products(across, -1, hessian);
      add_products(across.transpose(), -1, hessian);
      add_products(after, 1, hessian);
      hessian.row(count).head(count) +=
          on_entries(weighed.topLeftCorner(n_, n_) - product(one.next, product(weighed, one.next.transpose())));
      hessian(count, count) += weighed.cwiseProduct(one.damping).sum();
    }
    const Vector unit = hessian.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix scaled = unit.asDiagonal() * hessian * unit.asDiagonal();
    const Vector moved =
        -(unit.asDiagonal() * scaled.selfadjointView<Eigen::Lower>().ldlt().solve(Vector(unit.cwiseProduct(gradient))));
    CommonStorage step{moved(count), Matrix(n_, n_)};
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto [i, j] = entries_[std::size_t(k)];
      step.P(i, j) = step.P(j, i) = moved(k);
    }
    return {step, -gradient.dot(moved)};
  }

 private:
  // tr(X E) for every E of the basis: one entry and its mirror.
  Vector on_entries(const Matrix& X) const {
    Vector traces(Eigen::Index(entries_.size()));
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      const auto [i, j] = entries_[k];
      traces(Eigen::Index(k)) = i == j ? X(i, i) : X(i, j) + X(j, i);
    }
    return traces;
  }

  // factor · tr(E X E′ Xᵀ) for all pairs of the basis, in the lower half. X lies by rows, as it is
  // read.
  void add_products(const ByRows& X, double factor, Matrix& to) const {
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      const auto& [i, j] = entries_[k];
      const double *of_i = X.row(i).data(), *of_j = X.row(j).data();
      const double once = i == j ? factor : 2 * factor;
      for (std::size_t l = 0; l <= k; ++l) {
        const auto& [r, s] = entries_[l];
        const double share = r == s ? once / 2 : once;
        to(Eigen::Index(k), Eigen::Index(l)) += share * (of_j[r] * of_i[s] + of_j[s] * of_i[r]);
      }
    }
  }

  const std::vector<HoldInequality>& all_;
  Eigen::Index n_;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> entries_;  // of P, by rows up to the diagonal
};

// Starts at a pair that satisfies all inequalities strictly and lowers b as far as possible; ends early below 0.
CommonStorage least(const std::vector<HoldInequality>& all, CommonStorage at, double excess) {
  constexpr int most_steps = 150;
  const Barrier barrier(all, at.P.rows());
  double dimensions = double(at.P.rows());
  for (const HoldInequality& one : all) dimensions += double(one.constant.rows());
  double t = dimensions / std::abs(at.damping);
  std::optional<double> value = barrier.value(at, t);
  for (int i = 0; i < most_steps && at.damping > 0; ++i) {
    const auto [step, decrement] = barrier.step(at, t);
    if (!value || !std::isfinite(decrement) || decrement < 0) break;
    if (decrement < 1) {  // near enough to the path, where b is no more than dimensions/t above the least
      if (dimensions / t < excess * std::abs(at.damping)) break;
      *value += 9 * t * at.damping;
      t *= 10;
      continue;
    }
    std::optional<CommonStorage> better;
    for (double length = 1; length > 1e-8 && !better; length /= 2) {
      const CommonStorage tried{at.damping + length * step.damping, at.P + length * step.P};
      const std::optional<double> reached = barrier.value(tried, t);
      if (reached && *reached < *value - length * decrement / 10) better = tried, value = reached;
    }
    if (!better) break;
    at = std::move(*better);
  }
  return at;
}

// By how much M fails to be positive, in its worst direction; 0 or less if M ⪰ 0.
double lacking(const HoldInequality& hold, const CommonStorage& at) {
  return -Eigen::SelfAdjointEigenSolver<Matrix>(matrix_of(hold, at), Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
}

// The inequality in the coordinates to · x.
HoldInequality in_coordinates(const HoldInequality& hold, const Matrix& to, const Matrix& from) {
  const Eigen::Index n = to.rows(), all = hold.constant.rows();
  Matrix back = Matrix::Identity(all, all);
  back.topLeftCorner(n, n) = from;
  return {to * hold.next * back, back.transpose() * hold.constant * back, back.transpose() * hold.damping * back};
}

// Searches from `start` on, for these holds only.
std::optional<CommonStorage> least_for(const std::vector<HoldInequality>& holds, const CommonStorage& start,
                                       double excess) {
  const Eigen::Index n = start.P.rows();
  std::vector<HoldInequality> by_damping = holds, by_slack;
  // P stays below a bound, ρ I − P ⪰ 0: where the input does not reach a state, nothing else keeps it from growing.
  const Matrix one = Matrix::Identity(n, n);
  by_damping.push_back({std::sqrt(2.0) * one, 1000 * start.P.trace() * one, Matrix::Zero(n, n)});
  CommonStorage at{-std::numeric_limits<double>::infinity(), start.P};
  for (const HoldInequality& hold : by_damping) {
    HoldInequality slack = hold;
    slack.constant += start.damping * slack.damping;
    slack.damping.setIdentity();
    const double lack = lacking(slack, {0, at.P});
    at.damping = std::max(at.damping, lack > 0 ? 2 * lack : lack / 2);
    by_slack.push_back(std::move(slack));
  }
  // Minimises the largest shortfall for the given b; done once it is below 0.
  at = least(by_slack, std::move(at), 1e-3);
  if (!(at.damping < 0)) return std::nullopt;
  at.damping = start.damping;
  return least(by_damping, std::move(at), excess);
}

// Only few of the holds determine the result: the search begins with the last, and adds whichever is violated most. It
// runs in coordinates in which `start` is the identity: otherwise the P of states that the input hardly reaches grows
// so far beyond that of the others that rounding ends the search.
std::optional<CommonStorage> searched(const std::vector<HoldInequality>& holds, const CommonStorage& start,
                                      double excess) {
  const Eigen::Index n = start.P.rows();
  const Eigen::LLT<Matrix> factors(start.P);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const Matrix one = Matrix::Identity(n, n), to = factors.matrixU(), from = factors.matrixU().solve(one);
  std::vector<HoldInequality> others;
  for (const HoldInequality& hold : holds) others.push_back(in_coordinates(hold, to, from));
  std::vector<HoldInequality> asking = {std::move(others.back())};
  others.pop_back();
  CommonStorage best{start.damping, one};
  for (bool is_first = true;; is_first = false) {
    const auto lacks = [&](const HoldInequality& hold) { return lacking(hold, best); };
    const auto least_served = std::ranges::max_element(others, {}, lacks);
    if (least_served != others.end() && lacks(*least_served) > 0) {
      asking.push_back(std::move(*least_served));
      others.erase(least_served);
    } else if (!is_first) {
      return CommonStorage{best.damping, to.transpose() * best.P * to};
    }
    std::optional<CommonStorage> found = least_for(asking, {start.damping, one}, excess);
    if (!found) return std::nullopt;
    best = std::move(*found);
  }
}

// What a search reads, as numbers: two searches of which they are equal end alike.
std::vector<double> all_numbers(const std::vector<HoldInequality>& holds, const CommonStorage& start, double excess) {
  std::vector<double> all = {excess, start.damping, double(start.P.rows())};
  const auto add = [&](const Matrix& M) { all.insert(all.end(), M.data(), M.data() + M.size()); };
  add(start.P);
  for (const HoldInequality& hold : holds) {
    all.push_back(double(hold.constant.rows()));
    add(hold.next), add(hold.constant), add(hold.damping);
  }
  return all;
}

}  // namespace

bool serves(const HoldInequality& hold, const CommonStorage& tried) {
  return log_determinant(tried.P) && log_determinant(matrix_of(hold, tried));
}

std::optional<CommonStorage> least_common_storage(const std::vector<HoldInequality>& holds, const CommonStorage& start,
                                                  double excess) {
  thread_local Recent<std::vector<double>, std::optional<CommonStorage>> recent;
  return recent.at(all_numbers(holds, start, excess), [&] { return searched(holds, start, excess); });
}

}  // namespace dashpot::compiler
