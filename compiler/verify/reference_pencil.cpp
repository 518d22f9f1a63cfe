#include "verify/reference_pencil.hpp"

namespace dashpot::compiler {
namespace {

using Row = ReferenceVector;
using Square = ReferenceMatrix;

// A = L Lᵀ
Square cholesky(const Square& a) {
  const std::size_t n = a.size();
  Square l(n, Row(n, 0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      Reference sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      l[i][j] = i == j ? Reference(sqrt(sum)) : Reference(sum / l[j][j]);
    }
  return l;
}

// L⁻¹ x
Row forward(const Square& l, Row x) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) x[i] -= l[i][k] * x[k];
    x[i] /= l[i][i];
  }
  return x;
}

struct Tridiagonal {
  Row diagonal;
  Row beside;  // beside[i] stands between i and i + 1
};

// x ← x − 2 v (v·x), from `first` on, |v| = 1.
void reflect(Row& x, const Row& v, std::size_t first) {
  Reference along = 0;
  for (std::size_t i = first; i < x.size(); ++i) along += v[i] * x[i];
  for (std::size_t i = first; i < x.size(); ++i) x[i] -= 2 * along * v[i];
}

// The unit vector whose reflection takes column k of `a` below `first` to its first place; empty where all of it is
// zero.
Row reflection_of(const Square& a, std::size_t k, std::size_t first) {
  const std::size_t n = a.size();
  Reference square = 0, own = 0;
  for (std::size_t i = first; i < n; ++i) square += a[i][k] * a[i][k];
  if (square == 0) return {};
  Row v(n, 0);
  for (std::size_t i = first; i < n; ++i) v[i] = a[i][k];
  v[first] += v[first] < 0 ? Reference(-sqrt(square)) : Reference(sqrt(square));
  for (std::size_t i = first; i < n; ++i) own += v[i] * v[i];
  const Reference length = sqrt(own);
  for (std::size_t i = first; i < n; ++i) v[i] /= length;
  return v;
}

// Householder's reduction: A ← H A H, column by column; the vectors turn with it.
Tridiagonal tridiagonal(Square& a, std::vector<Row>& vectors) {
  const std::size_t n = a.size();
  for (std::size_t k = 0; k + 2 < n; ++k) {
    const Row v = reflection_of(a, k, k + 1);
    if (v.empty()) continue;
    for (Row& row : a) reflect(row, v, k + 1);
    for (std::size_t j = 0; j < n; ++j) {
      Row column(n, 0);
      for (std::size_t i = k + 1; i < n; ++i) column[i] = a[i][j];
      reflect(column, v, k + 1);
      for (std::size_t i = k + 1; i < n; ++i) a[i][j] = column[i];
    }
    for (Row& vector : vectors) reflect(vector, v, k + 1);
  }
  Tridiagonal t{Row(n), Row(n, 0)};
  for (std::size_t i = 0; i < n; ++i) t.diagonal[i] = a[i][i];
  for (std::size_t i = 0; i + 1 < n; ++i) t.beside[i] = a[i + 1][i];
  return t;
}

// One sweep of the QL method from m up to l, with Wilkinson's shift (Bowdler, Martin, Reinsch & Wilkinson 1968).
void sweep(Tridiagonal& t, std::size_t l, std::size_t m, std::vector<Row>& vectors) {
  Row& d = t.diagonal;
  Row& e = t.beside;
  const Reference ratio = (d[l + 1] - d[l]) / (2 * e[l]), size = sqrt(ratio * ratio + 1);
  Reference g = d[m] - d[l] + e[l] / (ratio < 0 ? Reference(ratio - size) : Reference(ratio + size));
  Reference s = 1, c = 1, shift = 0;
  for (std::size_t i = m; i-- > l;) {
    const Reference f = s * e[i], b = c * e[i], r = sqrt(f * f + g * g);
    e[i + 1] = r;
    if (r == 0) {
      d[i + 1] -= shift;
      e[m] = 0;
      return;
    }
    s = f / r;
    c = g / r;
    g = d[i + 1] - shift;
    const Reference turned = (d[i] - g) * s + 2 * c * b;
    shift = s * turned;
    d[i + 1] = g + shift;
    g = c * turned - b;
    for (Row& vector : vectors) {
      const Reference below = vector[i + 1], above = vector[i];
      vector[i + 1] = s * above + c * below;
      vector[i] = c * above - s * below;
    }
  }
  d[l] -= shift;
  e[l] = g;
  e[m] = 0;
}

// The eigenvalues of `a`, which is not greater than 1; the vectors come out in its eigenvectors' coordinates.
Row eigenvalues(Square a, std::vector<Row>& vectors) {
  const Reference small("1e-97");
  Tridiagonal t = tridiagonal(a, vectors);
  const std::size_t n = a.size();
  for (std::size_t l = 0; l < n; ++l)
    for (int sweeps = 0; sweeps < 200; ++sweeps) {
      std::size_t m = l;
      while (m + 1 < n && abs(t.beside[m]) > small) ++m;
      if (m == l) break;
      sweep(t, l, m, vectors);
    }
  return t.diagonal;
}

}  // namespace

ReferencePencil reference_pencil(const ReferenceMatrix& springs, const ReferenceMatrix& dampers,
                                 std::vector<ReferenceVector>& vectors) {
  Reference springs_trace = 0, dampers_trace = 0;
  const std::size_t n = springs.size();
  for (std::size_t i = 0; i < n; ++i) springs_trace += springs[i][i], dampers_trace += dampers[i][i];
  const bool both = springs_trace > 0 && dampers_trace > 0;
  const Reference shift = both ? Reference(springs_trace / dampers_trace) : Reference(1);
  Square metric = springs;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) metric[i][j] += shift * dampers[i][j];
  const Square l = cholesky(metric);
  Square reduced = springs;
  for (Row& row : reduced) row = forward(l, row);  // rows of K L⁻ᵀ
  for (std::size_t j = 0; j < n; ++j) {
    Row column(n);
    for (std::size_t i = 0; i < n; ++i) column[i] = reduced[i][j];
    column = forward(l, column);
    for (std::size_t i = 0; i < n; ++i) reduced[i][j] = column[i];
  }
  for (Row& vector : vectors) vector = forward(l, vector);
  return {eigenvalues(reduced, vectors), shift};
}

}  // namespace dashpot::compiler
