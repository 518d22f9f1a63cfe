#include "verify/reference_form.hpp"

#include <algorithm>
#include <map>

namespace dashpot::compiler {
namespace {

using Row = std::vector<Reference>;
using Square = std::vector<Row>;

// Inner nodes that are joined without passing tool or ground.
std::vector<std::vector<NodeIndex>> components(const Network& network) {
  std::vector<NodeIndex> leader(network.nodes.size());
  for (NodeIndex i = 0; i < leader.size(); ++i) leader[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Element& e : network.elements) {
      if (!e.has_effect || e.a <= tool || e.b <= tool) continue;
      const NodeIndex least = std::min(leader[e.a], leader[e.b]);
      changed |= leader[e.a] != least || leader[e.b] != least;
      leader[e.a] = leader[e.b] = least;
    }
  }
  std::map<NodeIndex, std::vector<NodeIndex>> groups;
  std::vector<bool> touched(network.nodes.size(), false);
  for (const Element& e : network.elements)
    if (e.has_effect) touched[e.a] = touched[e.b] = true;
  for (NodeIndex i = tool + 1; i < leader.size(); ++i)
    if (touched[i]) groups[leader[i]].push_back(i);
  std::vector<std::vector<NodeIndex>> list;
  for (auto& [leader_of, nodes] : groups) list.push_back(std::move(nodes));
  return list;
}

// One kind of element, K or B: among the inner nodes, from them to the tool, and at the tool itself.
struct Laplacian {
  Square inner;
  Row to_tool;
  Reference at_tool = 0;
};

void stamp(Laplacian& matrix, const std::vector<int>& row, const Element& e, double value) {
  const NodeIndex ends[2] = {e.a, e.b};
  for (int end = 0; end < 2; ++end) {
    const int i = row[ends[end]], j = row[ends[1 - end]];
    if (ends[end] == tool) matrix.at_tool += value;
    if (i < 0) continue;
    const auto here = static_cast<std::size_t>(i);
    matrix.inner[here][here] += value;
    if (j >= 0) matrix.inner[here][static_cast<std::size_t>(j)] -= value;
    if (ends[1 - end] == tool) matrix.to_tool[here] -= value;
  }
}

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

// The unit vector whose reflection takes column k of `a` below `first` to its first place; empty where all of it is zero.
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

// Householder's reduction: A ← H A H, column by column; the two vectors turn with it.
Tridiagonal tridiagonal(Square& a, Row& first_vector, Row& second_vector) {
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
    reflect(first_vector, v, k + 1);
    reflect(second_vector, v, k + 1);
  }
  Tridiagonal t{Row(n), Row(n, 0)};
  for (std::size_t i = 0; i < n; ++i) t.diagonal[i] = a[i][i];
  for (std::size_t i = 0; i + 1 < n; ++i) t.beside[i] = a[i + 1][i];
  return t;
}

// One sweep of the QL method from m up to l, with Wilkinson's shift (Bowdler, Martin, Reinsch & Wilkinson 1968).
void sweep(Tridiagonal& t, std::size_t l, std::size_t m, Row& first, Row& second) {
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
    for (Row* vector : {&first, &second}) {
      const Reference below = (*vector)[i + 1], above = (*vector)[i];
      (*vector)[i + 1] = s * above + c * below;
      (*vector)[i] = c * above - s * below;
    }
  }
  d[l] -= shift;
  e[l] = g;
  e[m] = 0;
}

// The eigenvalues of `a`, which is not greater than 1; the two vectors come out in its eigenvectors' coordinates.
Row eigenvalues(Square a, Row& first, Row& second) {
  const Reference small("1e-97");
  Tridiagonal t = tridiagonal(a, first, second);
  const std::size_t n = a.size();
  for (std::size_t l = 0; l < n; ++l)
    for (int sweeps = 0; sweeps < 200; ++sweeps) {
      std::size_t m = l;
      while (m + 1 < n && abs(t.beside[m]) > small) ++m;
      if (m == l) break;
      sweep(t, l, m, first, second);
    }
  return t.diagonal;
}

// −(p + s q)²/(m + s d), with m = μ, d = (1 − μ)/ω0 (theory, section 2).
void add_mode(ReferenceForm& form, const Reference& mu, const Reference& shift, const Reference& p, const Reference& q) {
  const Reference nothing("1e-60");
  const Reference d = (1 - mu) / shift;
  if (mu < nothing) {
    form.feedthrough_damping -= q * q / d;
  } else if (1 - mu < nothing) {
    form.static_stiffness -= p * p / mu;
  } else {
    const Reference rate = mu / d, drive = p - q * rate, c = drive * drive / d;
    form.feedthrough_damping -= q * q / d;
    form.static_stiffness -= (2 * p * q - q * q * rate) / d + c / rate;
    if (c > 0) form.modes.push_back({c / rate, rate, p / drive});
  }
}

void add_component(ReferenceForm& form, Laplacian springs, Laplacian dampers) {
  Reference springs_trace = 0, dampers_trace = 0;
  const std::size_t n = springs.inner.size();
  for (std::size_t i = 0; i < n; ++i) springs_trace += springs.inner[i][i], dampers_trace += dampers.inner[i][i];
  const bool both = springs_trace > 0 && dampers_trace > 0;
  const Reference shift = both ? Reference(springs_trace / dampers_trace) : Reference(1);
  Square metric = springs.inner;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) metric[i][j] += shift * dampers.inner[i][j];
  const Square l = cholesky(metric);
  Square reduced = springs.inner;
  for (Row& row : reduced) row = forward(l, row);  // rows of K L⁻ᵀ
  for (std::size_t j = 0; j < n; ++j) {
    Row column(n);
    for (std::size_t i = 0; i < n; ++i) column[i] = reduced[i][j];
    column = forward(l, column);
    for (std::size_t i = 0; i < n; ++i) reduced[i][j] = column[i];
  }
  Row p = forward(l, springs.to_tool), q = forward(l, dampers.to_tool);
  const Row all = eigenvalues(reduced, p, q);
  for (std::size_t i = 0; i < n; ++i) add_mode(form, all[i], shift, p[i], q[i]);
}

void merge_equal_rates(std::vector<ReferenceMode>& modes) {
  std::stable_sort(modes.begin(), modes.end(), [](const auto& x, const auto& y) { return x.relaxation_rate < y.relaxation_rate; });
  std::vector<ReferenceMode> distinct;
  for (const ReferenceMode& mode : modes) {
    const Reference equal("1e-12");
    if (distinct.empty() || mode.relaxation_rate - distinct.back().relaxation_rate > equal * mode.relaxation_rate) {
      distinct.push_back(mode);
      continue;
    }
    ReferenceMode& both = distinct.back();
    const Reference stiffness = both.stiffness + mode.stiffness;
    const Reference damping = both.stiffness / both.relaxation_rate + mode.stiffness / mode.relaxation_rate;
    both.spring_share = (both.stiffness * both.spring_share + mode.stiffness * mode.spring_share) / stiffness;
    both.stiffness = stiffness;
    both.relaxation_rate = stiffness / damping;
  }
  modes = std::move(distinct);
}

// Re D + Im D at ω.
Reference weight_at(const ReferenceForm& form, const Reference& w) {
  Reference sum = form.static_stiffness + form.feedthrough_damping * w;
  for (const ReferenceMode& mode : form.modes)
    sum += mode.stiffness * w * (w + mode.relaxation_rate) / (w * w + mode.relaxation_rate * mode.relaxation_rate);
  return sum;
}

// Cancellation to nothing leaves some 1e-95 of the whole; what is there is never below 1e-30 of it.
void drop_leftovers(ReferenceForm& form) {
  Reference glass = abs(form.static_stiffness), viscosity = abs(form.feedthrough_damping);
  for (const ReferenceMode& mode : form.modes) glass += mode.stiffness, viscosity += mode.stiffness / mode.relaxation_rate;
  const Reference leftover("1e-60"), negligible("1e-30");
  if (abs(form.static_stiffness) < leftover * glass) form.static_stiffness = 0;
  if (abs(form.feedthrough_damping) < leftover * viscosity) form.feedthrough_damping = 0;
  const ReferenceForm whole = form;
  std::erase_if(form.modes, [&](const ReferenceMode& mode) {
    const Reference most = 2 * glass + whole.feedthrough_damping * mode.relaxation_rate;
    return mode.stiffness <= negligible * most && mode.stiffness <= negligible * weight_at(whole, mode.relaxation_rate);
  });
}

}  // namespace

ReferenceForm reference_form(const Network& network) {
  ReferenceForm form;
  std::vector<std::vector<NodeIndex>> parts = components(network);
  parts.push_back({});  // the elements between tool and ground
  std::vector<std::size_t> part_of(network.nodes.size(), parts.size() - 1);
  std::vector<int> row(network.nodes.size(), -1);
  std::vector<Laplacian> springs, dampers;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const std::size_t n = parts[part].size();
    springs.push_back({Square(n, Row(n, 0)), Row(n, 0), 0});
    dampers.push_back(springs.back());
    for (std::size_t i = 0; i < n; ++i) part_of[parts[part][i]] = part, row[parts[part][i]] = int(i);
  }
  for (const Element& e : network.elements) {
    if (!e.has_effect) continue;
    const std::size_t part = part_of[e.a > tool ? e.a : e.b];
    if (const Spring* spring = std::get_if<Spring>(&e.law)) stamp(springs[part], row, e, spring->stiffness);
    if (const Damper* damper = std::get_if<Damper>(&e.law)) stamp(dampers[part], row, e, damper->damping);
  }
  for (std::size_t part = 0; part < parts.size(); ++part) {
    form.static_stiffness += springs[part].at_tool;
    form.feedthrough_damping += dampers[part].at_tool;
    if (!parts[part].empty()) add_component(form, springs[part], dampers[part]);
  }
  drop_leftovers(form);
  merge_equal_rates(form.modes);
  return form;
}

}  // namespace dashpot::compiler
