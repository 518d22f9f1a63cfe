#include "verify/reference_network.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "network/disjoint_sets.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

const Reference nothing("1e-60");     // what cancellation leaves, of the whole
const Reference negligible("1e-30");  // what is there is no less
const Reference same_rate("1e-25");

// Nodes with the numbers they have in a matrix: those that are eliminated come first, then the ends.
class TerminalLaplacian {
 public:
  TerminalLaplacian(std::size_t inner, std::size_t ends)
      : inner_(inner), all_(inner + ends, ReferenceVector(inner + ends, 0)) {}

  void stamp(std::size_t i, std::size_t j, double value) {
    all_[i][i] += value;
    all_[j][j] += value;
    all_[i][j] -= value;
    all_[j][i] -= value;
  }
  ReferenceMatrix inner() const {
    ReferenceMatrix part;
    for (std::size_t i = 0; i < inner_; ++i)
      part.emplace_back(all_[i].begin(), all_[i].begin() + std::ptrdiff_t(inner_));
    return part;
  }
  ReferenceVector drive(std::size_t end) const {
    ReferenceVector column;
    for (std::size_t i = 0; i < inner_; ++i) column.push_back(all_[i][inner_ + end]);
    return column;
  }
  Reference between(std::size_t end, std::size_t other) const { return -all_[inner_ + end][inner_ + other]; }

 private:
  std::size_t inner_;
  ReferenceMatrix all_;
};

struct Relaxation {
  Reference rate;
  ReferenceVector drive;  // √k w
};

class Builder {
 public:
  Builder(const Network& network, const std::vector<std::size_t>& elements) : network_(network) {
    std::set<NodeIndex> slip_ends;
    std::map<std::pair<NodeIndex, NodeIndex>, Reference> yields;
    for (std::size_t i : elements) {
      const Element& e = network.elements[i];
      if (is_slip(e.law)) {
        slip_ends.insert({e.a, e.b});
        yields[std::minmax(e.a, e.b)] += yield_force_of(e.law);
      } else {
        linear_.push_back(i);
        widest_ = std::max({widest_, stiffness_of(e.law), damping_of(e.law)});
      }
    }
    slip_ends.erase(tool);
    slip_ends.erase(ground);
    result_.ends.assign(slip_ends.begin(), slip_ends.end());
    result_.ends.insert(result_.ends.end(), {tool, ground});
    for (const auto& [ends, yield] : yields) {
      result_.slips.push_back(ends);
      result_.yield_forces.push_back(yield);
    }
    result_.springs = result_.dampers = ReferenceMatrix(count(), ReferenceVector(count(), 0));
  }

  ReferenceNetwork build() {
    for (const std::vector<NodeIndex>& group : groups()) eliminate(group);
    add_direct();
    drop_leftovers(result_.springs);
    drop_leftovers(result_.dampers);
    return std::move(result_);
  }

 private:
  std::size_t count() const { return result_.ends.size(); }
  std::size_t end_of(NodeIndex node) const {
    return std::size_t(std::find(result_.ends.begin(), result_.ends.end(), node) - result_.ends.begin());
  }
  bool is_end(NodeIndex node) const { return end_of(node) < count(); }

  // Inner nodes that are joined without passing an end.
  std::vector<std::vector<NodeIndex>> groups() const {
    DisjointSets joined(network_.nodes.size());
    std::set<NodeIndex> inner;
    for (std::size_t i : linear_) {
      const Element& e = network_.elements[i];
      for (NodeIndex node : {e.a, e.b})
        if (!is_end(node)) inner.insert(node);
      if (!is_end(e.a) && !is_end(e.b)) joined.unite_by_least(e.a, e.b);
    }
    std::map<NodeIndex, std::vector<NodeIndex>> by_least;
    for (const NodeIndex node : inner) by_least[joined.find(node)].push_back(node);
    std::vector<std::vector<NodeIndex>> all;
    for (auto& [first, nodes] : by_least) all.push_back(std::move(nodes));
    return all;
  }

  void add_direct() {
    for (std::size_t i : linear_) {
      const Element& e = network_.elements[i];
      if (is_end(e.a) && is_end(e.b)) add_tie(end_of(e.a), end_of(e.b), stiffness_of(e.law), damping_of(e.law));
    }
  }

  void add_tie(std::size_t a, std::size_t b, const Reference& stiffness, const Reference& damping) {
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
      result_.springs[i][j] += stiffness;
      result_.dampers[i][j] += damping;
    }
  }

  void eliminate(const std::vector<NodeIndex>& group) {
    const auto row = [&](NodeIndex node) {
      const auto place = std::find(group.begin(), group.end(), node);
      return place != group.end() ? std::size_t(place - group.begin()) : group.size() + end_of(node);
    };
    TerminalLaplacian springs(group.size(), count()), dampers = springs;
    for (std::size_t i : linear_) {
      const Element& e = network_.elements[i];
      const std::size_t a = row(e.a), b = row(e.b);
      if (std::min(a, b) >= group.size() || std::max(a, b) >= group.size() + count()) continue;
      springs.stamp(a, b, stiffness_of(e.law));
      dampers.stamp(a, b, damping_of(e.law));
    }
    std::vector<ReferenceVector> drives;
    for (std::size_t end = 0; end < count(); ++end) drives.push_back(springs.drive(end));
    for (std::size_t end = 0; end < count(); ++end) drives.push_back(dampers.drive(end));
    const ReferencePencil pencil = reference_pencil(springs.inner(), dampers.inner(), drives);
    sources_.clear();
    for (std::size_t i : linear_)
      if (std::min(row(network_.elements[i].a), row(network_.elements[i].b)) < group.size()) sources_.push_back(i);
    std::sort(sources_.begin(), sources_.end());
    std::vector<Relaxation> relaxations;
    for (std::size_t i = 0; i < group.size(); ++i) add_mode(pencil.mu[i], pencil.shift, drives, i, relaxations);
    add_relaxations(std::move(relaxations));
  }

  // −(p + s q)(p + s q)ᵀ/(m + s d), with m = μ, d = (1 − μ)/ω0 (theory, section 2, with vectors).
  void add_mode(const Reference& mu, const Reference& shift, const std::vector<ReferenceVector>& drives,
                std::size_t mode, std::vector<Relaxation>& relaxations) {
    const Reference d = (1 - mu) / shift, rate = 1 - mu < nothing ? Reference(0) : Reference(mu / d);
    const auto p = [&](std::size_t end) { return drives[end][mode]; };
    const auto q = [&](std::size_t end) { return drives[count() + end][mode]; };
    for (std::size_t a = 0; a < count(); ++a)
      for (std::size_t b = a + 1; b < count(); ++b) {
        const Reference pulled = (p(a) - q(a) * rate) * (p(b) - q(b) * rate);
        if (mu < nothing) add_tie(a, b, 0, q(a) * q(b) / d);
        else if (1 - mu < nothing) add_tie(a, b, p(a) * p(b) / mu, 0);
        else add_tie(a, b, (p(a) * q(b) + q(a) * p(b) - q(a) * q(b) * rate) / d + pulled / mu, q(a) * q(b) / d);
      }
    if (mu < nothing || 1 - mu < nothing) return;
    Relaxation relaxation{rate, {}};
    for (std::size_t end = 0; end < count(); ++end) relaxation.drive.push_back((p(end) - q(end) * rate) / sqrt(mu));
    relaxations.push_back(std::move(relaxation));
  }

  void add_relaxations(std::vector<Relaxation> all) {
    std::sort(all.begin(), all.end(), [](const Relaxation& x, const Relaxation& y) { return x.rate < y.rate; });
    for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
      while (last < all.size() && all[last].rate - all[first].rate <= same_rate * all[last].rate) ++last;
      if (last == first + 1) {
        add_relaxation(all[first].rate, all[first].drive);
        continue;
      }
      ReferenceMatrix sum(count(), ReferenceVector(count(), 0));
      for (std::size_t i = first; i < last; ++i)
        for (std::size_t a = 0; a < count(); ++a)
          for (std::size_t b = 0; b < count(); ++b) sum[a][b] += all[i].drive[a] * all[i].drive[b];
      take_apart(all[first].rate, std::move(sum));
    }
  }

  // Σ √k w (√k w)ᵀ, from the first end that pulls on.
  void take_apart(const Reference& rate, ReferenceMatrix sum) {
    Reference largest = 0;
    for (std::size_t end = 0; end + 1 < count(); ++end) largest = std::max(largest, sum[end][end]);
    for (std::size_t end = 0; end + 1 < count(); ++end) {
      if (sum[end][end] <= negligible * largest) continue;
      ReferenceVector drive;
      for (std::size_t a = 0; a < count(); ++a) drive.push_back(sum[a][end] / sqrt(sum[end][end]));
      add_relaxation(rate, drive);
      for (std::size_t a = 0; a < count(); ++a)
        for (std::size_t b = 0; b < count(); ++b) sum[a][b] -= drive[a] * drive[b];
    }
  }

  void add_relaxation(const Reference& rate, const ReferenceVector& drive) {
    Reference largest = 0;
    for (std::size_t end = 0; end + 1 < drive.size(); ++end) largest = std::max(largest, Reference(abs(drive[end])));
    if (largest * largest <= negligible * widest_) return;
    ReferenceNetworkMode mode{largest * largest, rate, {}, sources_};
    for (const Reference& pull : drive)
      mode.weights.push_back(abs(pull) <= negligible * largest ? Reference(0) : Reference(pull / largest));
    result_.modes.push_back(std::move(mode));
  }

  void drop_leftovers(ReferenceMatrix& ties) const {
    for (ReferenceVector& row : ties)
      for (Reference& value : row)
        if (abs(value) <= negligible * widest_) value = 0;
  }

  const Network& network_;
  std::vector<std::size_t> linear_;
  std::vector<std::size_t> sources_;  // of the modes at hand
  double widest_ = 0;                 // largest stiffness or damping, as numbers
  ReferenceNetwork result_;
};

}  // namespace

ReferenceNetwork reference_network(const Network& network, const std::vector<std::size_t>& elements) {
  return Builder(network, elements).build();
}

}  // namespace dashpot::compiler
