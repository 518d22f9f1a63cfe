#include "linear/pencil.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace dashpot::compiler {
namespace {

using Index = Eigen::Index;

// Cuthill and McKee's order (1969): neighbours follow each other, so that what is not zero lies near the diagonal.
std::vector<Index> order_of(const RealMatrix& a, const RealMatrix& b) {
  const Index size = a.rows();
  std::vector<std::vector<Index>> neighbours(static_cast<std::size_t>(size));
  for (Index j = 0; j < size; ++j)
    for (Index i = 0; i < size; ++i)
      if (i != j && (a(i, j) != 0 || b(i, j) != 0)) neighbours[static_cast<std::size_t>(j)].push_back(i);
  const auto has_fewer = [&](Index i, Index j) {
    return neighbours[static_cast<std::size_t>(i)].size() < neighbours[static_cast<std::size_t>(j)].size();
  };
  for (std::vector<Index>& those : neighbours) std::stable_sort(those.begin(), those.end(), has_fewer);
  std::vector<Index> starts(static_cast<std::size_t>(size)), order;
  std::iota(starts.begin(), starts.end(), Index{0});
  std::stable_sort(starts.begin(), starts.end(), has_fewer);
  std::vector<bool> is_in(static_cast<std::size_t>(size), false);
  const auto put = [&](Index i) {
    if (!is_in[static_cast<std::size_t>(i)]) order.push_back(i);
    is_in[static_cast<std::size_t>(i)] = true;
  };
  for (std::size_t done = 0; Index start : starts)
    for (put(start); done < order.size(); ++done)
      for (Index next : neighbours[static_cast<std::size_t>(order[done])]) put(next);
  return order;
}

RealMatrix in_order(const RealMatrix& a, const std::vector<Index>& order) {
  const Index size = a.rows();
  RealMatrix result(size, size);
  for (Index j = 0; j < size; ++j)
    for (Index i = 0; i < size; ++i)
      result(i, j) = a(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(j)]);
  return result;
}

Index width_of(const RealMatrix& a) {
  Index width = 0;
  for (Index j = 0; j < a.rows(); ++j)
    for (Index i = j + width + 1; i < a.rows(); ++i)
      if (a(i, j) != 0) width = i - j;
  return width;
}

// M = L Lᵀ within a band.
RealMatrix cholesky(const RealMatrix& m, Index width) {
  const Index size = m.rows();
  RealMatrix l = RealMatrix::Zero(size, size);
  for (Index i = 0; i < size; ++i)
    for (Index j = std::max(Index{0}, i - width); j <= i; ++j) {
      Real sum = m(i, j);
      for (Index k = std::max(Index{0}, i - width); k < j; ++k) sum -= l(i, k) * l(j, k);
      l(i, j) = i == j ? Real(sqrt(sum)) : Real(sum / l(j, j));
    }
  return l;
}

// A symmetric band matrix, of which one half is stored, and vectors that are rotated with it.
class Band {
 public:
  Band(const RealMatrix& a, RealMatrix vectors, Index width)
      : a_(a), vectors_(std::move(vectors)), size_(a.rows()), width_(width) {}

  // A ← L⁻¹ A L⁻ᵀ by Crawford's method (1973): column by column of L, and what each puts outside of the band is rotated
  // away among the columns before it, which are orthonormal already.
  void reduce(const RealMatrix& l) {
    for (Index k = 0; k < size_; ++k) {
      const Index first = std::max(Index{0}, k - width_), last = std::min(k + width_, size_ - 1) - width_ - 1;
      // The division by column k of L spreads row k over as many rows as the band is wide. Those of its entries that
      // would land outside of the band, in columns `first` to `last`, are gathered in column `last` before. Each
      // rotation makes an entry outside of the band, which others move up along it until it leaves the matrix.
      for (Index j = first; j < last; ++j) {
        turn_right(k, j);
        for (Index above = j - width_; above >= 0; above -= width_) turn_right(above + width_ + 1, above);
      }
      divide_by(l, k);
      // Now each of these columns has one entry outside of the band. All are moved up along it together, by one width
      // at a time, until they leave the matrix.
      for (Index up = 0; up <= last; up += width_)
        for (Index j = last; j >= std::max(first, up); --j) turn_right(j - up + width_ + 1, j - up);
    }
  }

  // To bandwidth 1, by Schwarz's rotations (1968).
  void make_tridiagonal() {
    for (Index column = 0; column + 2 < size_; ++column)
      for (Index row = std::min(column + width_, size_ - 1); row >= column + 2; --row) turn_down(row, column);
  }

  Real& at(Index i, Index j) { return i >= j ? a_(i, j) : a_(j, i); }
  RealMatrix& vectors() { return vectors_; }

 private:
  // Takes (row, column) into the place on its right.
  void turn_right(Index row, Index column) {
    const Real x = at(row, column), y = at(row, column + 1);
    if (x == 0) return;
    const Real length = sqrt(x * x + y * y);
    rotate(column, y / length, x / length);
    at(row, column) = 0;
  }

  // Takes (row, column) into the place above; what that puts outside of the band goes down along it and out.
  void turn_down(Index row, Index column) {
    for (; row < size_; column = row - 1, row += width_) {
      const Real x = at(row - 1, column), y = at(row, column);
      if (y == 0) return;
      const Real length = sqrt(x * x + y * y);
      rotate(row - 1, x / length, -y / length);
      at(row, column) = 0;
    }
  }

  // Rows and columns p and p + 1: p ← c p − s (p + 1), p + 1 ← s p + c (p + 1).
  void rotate(Index p, const Real& c, const Real& s) {
    const Index q = p + 1;
    const auto turn = [&](Real& x, Real& y) {
      if (x == 0 && y == 0) return;
      const Real old = x;
      x = c * old - s * y;
      y = s * old + c * y;
    };
    for (Index i = std::max(Index{0}, p - width_); i < p; ++i) turn(a_(p, i), a_(q, i));
    for (Index i = q + 1; i <= std::min(q + width_, size_ - 1); ++i) turn(a_(i, p), a_(i, q));
    for (Index i = 0; i < vectors_.cols(); ++i) turn(vectors_(p, i), vectors_(q, i));
    const Real across = a_(q, p), difference = a_(p, p) - a_(q, q);
    const Real moved = s * (2 * c * across + s * difference);
    a_(q, p) = (c * c - s * s) * across + c * s * difference;
    a_(p, p) -= moved;
    a_(q, q) += moved;
  }

  // A ← L_k⁻¹ A L_k⁻ᵀ, where L_k is the unit matrix but for column k of L.
  void divide_by(const RealMatrix& l, Index k) {
    const Index first = std::max(Index{0}, k - width_), end = std::min(k + width_, size_ - 1) + 1;
    for (Index j = first; j < end; ++j) at(k, j) /= l(k, k);
    a_(k, k) /= l(k, k);
    vectors_.row(k) /= l(k, k);
    for (Index i = k + 1; i < end; ++i) {
      if (l(i, k) == 0) continue;
      for (Index j = first; j < k; ++j)
        if (a_(k, j) != 0) a_(i, j) -= l(i, k) * a_(k, j);
      vectors_.row(i) -= l(i, k) * vectors_.row(k);
    }
    for (Index i = k + 1; i < end; ++i) a_(i, k) -= l(i, k) * a_(k, k) / 2;
    for (Index i = k + 1; i < end; ++i)
      for (Index j = k + 1; j <= i; ++j)
        if (l(i, k) != 0 || l(j, k) != 0) a_(i, j) -= l(i, k) * a_(j, k) + a_(i, k) * l(j, k);
    for (Index i = k + 1; i < end; ++i) a_(i, k) -= l(i, k) * a_(k, k) / 2;
  }

  RealMatrix a_;  // its lower half
  RealMatrix vectors_;
  Index size_, width_;
};

// Implicit QL with Wilkinson's shift (Dubrulle, Martin & Wilkinson 1968) of a tridiagonal matrix: `diagonal` becomes
// its eigenvalues, and each row of `vectors` the component of one eigenvector. As in Golub & Welsch (1969), only the
// vectors that are needed turn.
class Eigenvalues {
 public:
  explicit Eigenvalues(Band& band) : vectors_(band.vectors()), diagonal_(vectors_.rows()), beside_(vectors_.rows()) {
    const Index size = vectors_.rows();
    for (Index i = 0; i < size; ++i) diagonal_(i) = band.at(i, i);
    for (Index i = 0; i + 1 < size; ++i) beside_(i) = band.at(i + 1, i);
    for (Index first = 0; first < size; ++first)
      for (int sweeps = 0; sweeps < most_sweeps; ++sweeps) {
        const Index last = end_of_block(first);
        if (last == first) break;
        sweep(first, last);
      }
  }

  const RealVector& values() const { return diagonal_; }

 private:
  static constexpr int most_sweeps = 200;  // three or four are usual

  Index end_of_block(Index first) const {
    const Real epsilon = std::numeric_limits<Real>::epsilon();
    Index last = first;
    while (last + 1 < diagonal_.size() &&
           abs(beside_(last)) > epsilon * (abs(diagonal_(last)) + abs(diagonal_(last + 1))))
      ++last;
    return last;
  }

  void sweep(Index first, Index last) {
    const Real ratio = (diagonal_(first + 1) - diagonal_(first)) / (2 * beside_(first));
    const Real root = sqrt(ratio * ratio + 1);
    Real g =
        diagonal_(last) - diagonal_(first) + beside_(first) / (ratio < 0 ? Real(ratio - root) : Real(ratio + root));
    Real s = 1, c = 1, shift = 0;
    for (Index i = last; i-- > first;) {
      const Real f = s * beside_(i), b = c * beside_(i), length = sqrt(f * f + g * g);
      beside_(i + 1) = length;
      if (length == 0) {
        diagonal_(i + 1) -= shift;
        beside_(last) = 0;
        return;
      }
      s = f / length;
      c = g / length;
      g = diagonal_(i + 1) - shift;
      const Real turned = (diagonal_(i) - g) * s + 2 * c * b;
      shift = s * turned;
      diagonal_(i + 1) = g + shift;
      g = c * turned - b;
      for (Index j = 0; j < vectors_.cols(); ++j) {
        const Real below = vectors_(i + 1, j), above = vectors_(i, j);
        vectors_(i + 1, j) = s * above + c * below;
        vectors_(i, j) = c * above - s * below;
      }
    }
    diagonal_(first) -= shift;
    beside_(first) = g;
    beside_(last) = 0;
  }

  RealMatrix& vectors_;
  RealVector diagonal_, beside_;  // beside_(i) is the entry between i and i + 1
};

}  // namespace

Pencil solve_pencil(const RealMatrix& stiffness, const RealMatrix& damping, const RealMatrix& drives) {
  const Real stiffness_trace = stiffness.trace(), damping_trace = damping.trace();
  const Real shift = stiffness_trace > 0 && damping_trace > 0 ? Real(stiffness_trace / damping_trace) : Real(1);
  const std::vector<Index> order = order_of(stiffness, damping);
  const RealMatrix metric = in_order(stiffness + shift * damping, order), k = in_order(stiffness, order);
  RealMatrix turned(drives.rows(), drives.cols());
  for (Index i = 0; i < drives.rows(); ++i) turned.row(i) = drives.row(order[static_cast<std::size_t>(i)]);
  const Index width = std::max({width_of(k), width_of(metric), Index{1}});
  Band band(k, std::move(turned), width);
  band.reduce(cholesky(metric, width));
  band.make_tridiagonal();
  const Eigenvalues solved(band);
  std::vector<Index> ascending(order.size());
  std::iota(ascending.begin(), ascending.end(), Index{0});
  std::sort(ascending.begin(), ascending.end(),
            [&](Index i, Index j) { return solved.values()(i) < solved.values()(j); });
  Pencil result{RealVector(drives.rows()), RealMatrix(drives.rows(), drives.cols()), shift};
  for (Index i = 0; i < drives.rows(); ++i) {
    result.mu(i) = solved.values()(ascending[static_cast<std::size_t>(i)]);
    result.drives.row(i) = band.vectors().row(ascending[static_cast<std::size_t>(i)]);
  }
  return result;
}

}  // namespace dashpot::compiler
