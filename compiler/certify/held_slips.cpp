#include "certify/held_slips.hpp"

#include <algorithm>

#include "discretise/mode_coefficients.hpp"
#include "linear/pencil.hpp"
#include "network/disjoint_sets.hpp"

namespace dashpot::compiler {
namespace {

// If less than this share of a mode's force is left after a sample, the mode counts as a damper, which changes K by no
// more than that. Otherwise the rates of one pencil would lie further apart than its digits can resolve.
const Real vanishing{"1e-18"};
const Real negligible{"1e-40"};  // for the pencil's eigenvalues, which lie between 0 and 1

struct HeldTie {
  std::size_t a, b;
  Real yield_force;
};

// Ends by number: 0 is the ground, 1 the tool. A mode is one more node, which its spring joins to the ends by their
// weights and a damper to the ground.
class HeldNetwork {
 public:
  explicit HeldNetwork(const CutSettings& settings) : settings_(settings) {}

  std::size_t new_end() { return ends_++; }
  void add_slip(std::size_t a, std::size_t b, const Real& yield_force) { slips_.push_back({a, b, yield_force}); }
  void add_spring(std::size_t a, std::size_t b, const Real& stiffness) { add(springs_, {{a, 1}, {b, -1}}, stiffness); }
  void add_damper(std::size_t a, std::size_t b, const Real& damping) { add(dampers_, {{a, 1}, {b, -1}}, damping); }

  // As in backward Euler: k = c/a, λ = (1 − a)/(a h). A mode that vanishes within a sample is a damper c h.
  void add_mode(std::vector<std::pair<std::size_t, Real>> weights, const Real& stiffness, const Real& relaxation_rate) {
    const ModeCoefficients c = mode_coefficients({stiffness, relaxation_rate, 1, {}}, settings_.scheme,
                                                 StateInput::position, settings_.sample_period);
    const Real period = settings_.sample_period;
    if (c.decay < vanishing) return add(dampers_, weights, c.position_gain * period);
    const std::size_t node = new_end();
    weights.emplace_back(node, -1);
    add(springs_, weights, c.position_gain / c.decay);
    add(dampers_, {{node, 1}}, c.position_gain * period / c.loss);
  }

  HeldSlips gains(const std::vector<Real>& feedthroughs) {
    join_slips();
    std::vector<Pull> pulls{pull_of(side_of_tool())};
    for (std::size_t i = 0; i < slips_.size(); ++i)
      if (is_in_forest_[i]) pulls.push_back(pull_of(side_of(i)));
    eliminate_inner(pulls);
    HeldSlips result{gain_of(pulls[0], feedthroughs), -1, {}};
    for (std::size_t i = 0, place = 1; i < slips_.size(); ++i) {
      const Real gain = is_in_forest_[i] ? gain_of(pulls[place++], {Real(0)}) : Real(0);
      result.slips.push_back({gain, slips_[i].yield_force});
    }
    return result;
  }

 private:
  struct Term {
    std::vector<std::pair<std::size_t, Real>> weights;
    Real value;
  };

  // The force of springs and dampers on a set of ends, as coefficients of the displacements of the inner places, or
  // later of the modes, and of the tool.
  struct Pull {
    RealVector springs, dampers;
    Real springs_at_tool, dampers_at_tool;
  };

  static void add(std::vector<Term>& terms, std::vector<std::pair<std::size_t, Real>> weights, const Real& value) {
    if (value > 0) terms.push_back({std::move(weights), value});
  }

  // The smallest index stands for all joined ends, so that tool and ground keep theirs. A slip that closes a ring of
  // slips need not hold any change: the others can.
  void join_slips() {
    joined_ = DisjointSets(ends_);
    for (const HeldTie& slip : slips_) is_in_forest_.push_back(joined_.unite_by_least(slip.a, slip.b));
    place_.assign(ends_, -1);
    for (std::size_t end = 2; end < ends_; ++end)
      if (joined_.find(end) == end && is_pulled(end)) place_[end] = inner_++;
  }

  bool is_pulled(std::size_t end) const {
    const auto pulls = [&](const Term& term) {
      return std::any_of(term.weights.begin(), term.weights.end(),
                         [&](const auto& weight) { return joined_.find(weight.first) == end; });
    };
    return std::any_of(springs_.begin(), springs_.end(), pulls) || std::any_of(dampers_.begin(), dampers_.end(), pulls);
  }

  // Weights over the inner places, and of the tool behind them.
  RealVector row(const Term& term) const {
    RealVector weights = RealVector::Zero(inner_ + 1);
    for (const auto& [end, weight] : term.weights) {
      const std::size_t first = joined_.find(end);
      if (first == 1) weights(inner_) += weight;
      else if (first > 1) weights(place_[first]) += weight;
    }
    return weights;
  }

  RealMatrix matrix(const std::vector<Term>& terms) const {
    RealMatrix sum = RealMatrix::Zero(inner_ + 1, inner_ + 1);
    for (const Term& term : terms) sum += row(term) * row(term).transpose() * term.value;
    return sum;
  }

  // The force of terms on a set of ends, for displacements of all places.
  RealVector pull(const std::vector<Term>& terms, const std::vector<bool>& set) const {
    RealVector sum = RealVector::Zero(inner_ + 1);
    for (const Term& term : terms) {
      Real weight = 0;
      for (const auto& [end, of_end] : term.weights)
        if (set[end]) weight += of_end;
      sum += row(term) * (weight * term.value);
    }
    return sum;
  }

  Pull pull_of(const std::vector<bool>& set) const {
    const RealVector k = pull(springs_, set), b = pull(dampers_, set);
    return {k.head(inner_), b.head(inner_), k(inner_), b(inner_)};
  }

  void eliminate_inner(std::vector<Pull>& pulls) {
    const RealMatrix k = matrix(springs_), b = matrix(dampers_);
    RealMatrix drives(inner_, 2 + 2 * static_cast<Eigen::Index>(pulls.size()));
    drives.leftCols(2) << k.col(inner_).head(inner_), b.col(inner_).head(inner_);
    Eigen::Index column = 2;
    for (const Pull& pull : pulls) {
      drives.col(column++) = pull.springs;
      drives.col(column++) = pull.dampers;
    }
    pencil_ = solve_pencil(k.topLeftCorner(inner_, inner_), b.topLeftCorner(inner_, inner_), drives);
    column = 2;
    for (Pull& pull : pulls) {
      pull.springs = pencil_.drives.col(column++);
      pull.dampers = pencil_.drives.col(column++);
    }
  }

  std::vector<bool> side_of_tool() const {
    std::vector<bool> set(ends_, false);
    for (std::size_t end = 0; end < ends_; ++end) set[end] = joined_.find(end) == 1;
    return set;
  }

  // The ends that other slips join to one end of this slip: of its two sides the one without tool and ground.
  std::vector<bool> side_of(std::size_t slip) const {
    for (const std::size_t start : {slips_[slip].a, slips_[slip].b}) {
      std::vector<bool> set(ends_, false);
      set[start] = true;
      for (bool grows = true; grows;) {
        grows = false;
        for (std::size_t i = 0; i < slips_.size(); ++i) {
          if (i == slip || !is_in_forest_[i] || set[slips_[i].a] == set[slips_[i].b]) continue;
          set[slips_[i].a] = set[slips_[i].b] = grows = true;
        }
      }
      if (!set[0] && !set[1]) return set;
    }
    return std::vector<bool>(ends_, false);
  }

  // (K + sB) of the set less Σ (p′ + s q′)(p + s q)/(m + s d), with m = μ, d = (1 − μ)/ω0 (theory, section 2).
  Real gain_of(const Pull& pull, const std::vector<Real>& feedthroughs) const {
    Real stiffness = pull.springs_at_tool, damping = pull.dampers_at_tool, relaxing = 0;
    for (Eigen::Index i = 0; i < inner_; ++i) {
      const Real &pull_p = pull.springs(i), &pull_q = pull.dampers(i);
      const Real &p = pencil_.drives(i, 0), &q = pencil_.drives(i, 1);
      const Real m = pencil_.mu(i), d = (1 - m) / pencil_.shift;
      if (m < negligible) {
        damping -= pull_q * q / d;
      } else if (1 - m < negligible) {
        stiffness -= pull_p * p / m;
      } else {
        const Real rate = m / d, residue = (pull_p - pull_q * rate) * (p - q * rate) / m;
        damping -= pull_q * q / d;
        stiffness -= (pull_p * q + pull_q * p - pull_q * q * rate) / d + residue;
        relaxing += abs(residue) / (1 + rate * settings_.sample_period);
      }
    }
    Real left = 0;
    for (const Real& x : feedthroughs) left = std::max(left, Real(abs(damping - x)));
    return abs(stiffness) + 2 * left / settings_.sample_period + 2 * relaxing;
  }

  CutSettings settings_;
  std::size_t ends_ = 2;
  std::vector<Term> springs_, dampers_;
  std::vector<HeldTie> slips_;
  DisjointSets joined_{0};  // ends that slips hold together; by the least, so that tool and ground stay what they are
  std::vector<bool> is_in_forest_;
  std::vector<Eigen::Index> place_;
  Eigen::Index inner_ = 0;
  Pencil pencil_;
};

void lay(const NormalTree& tree, std::size_t from, std::size_t to, HeldNetwork& network) {
  if (tree.kind == NormalTree::Kind::slip) return network.add_slip(from, to, tree.yield_force);
  if (tree.kind == NormalTree::Kind::block) {
    network.add_spring(from, to, tree.form.static_stiffness);
    network.add_damper(from, to, tree.form.feedthrough_damping);
    for (const Mode& mode : tree.form.modes)
      network.add_mode({{from, 1}, {to, -1}}, mode.stiffness, mode.relaxation_rate);
    return;
  }
  std::size_t here = from;
  for (const NormalTree& child : tree.children) {
    const bool is_last = tree.kind == NormalTree::Kind::parallel || &child == &tree.children.back();
    const std::size_t next = is_last ? to : network.new_end();
    lay(child, here, next, network);
    if (tree.kind == NormalTree::Kind::series) here = next;
  }
}

}  // namespace

HeldSlips held_slips(const NormalTree& component, const std::vector<Real>& feedthroughs, const CutSettings& settings) {
  HeldNetwork network(settings);
  lay(component, 1, 0, network);
  HeldSlips result = network.gains(feedthroughs);
  if (component.kind != NormalTree::Kind::series) return result;
  for (const NormalTree& child : component.children)
    if (child.kind == NormalTree::Kind::slip) result.series_yield = child.yield_force;
  return result;
}

HeldSlips held_slips(const Network& whole, const std::vector<std::size_t>& elements,
                     const std::vector<Real>& feedthroughs, const CutSettings& settings) {
  const MultiportForm form = multiport_form_at_slips(whole, elements);
  HeldNetwork network(settings);
  std::vector<std::size_t> ends;
  for (const NodeIndex node : form.terminals) ends.push_back(node == tool ? 1 : network.new_end());
  ends.push_back(0);
  const auto end_of = [&](NodeIndex node) {
    return ends[std::size_t(std::find(form.terminals.begin(), form.terminals.end(), node) - form.terminals.begin())];
  };
  for (const Tie& tie : form.springs) network.add_spring(ends[tie.a], ends[tie.b], tie.value);
  for (const Tie& tie : form.dampers) network.add_damper(ends[tie.a], ends[tie.b], tie.value);
  for (const MultiportMode& mode : form.modes) {
    std::vector<std::pair<std::size_t, Real>> weights;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) weights.emplace_back(ends[i], mode.weights[i]);
    network.add_mode(std::move(weights), mode.stiffness, mode.relaxation_rate);
  }
  for (const auto& [between, yield] : slips_between(whole, elements))
    network.add_slip(end_of(between.first), end_of(between.second), yield);
  return network.gains(feedthroughs);
}

}  // namespace dashpot::compiler
