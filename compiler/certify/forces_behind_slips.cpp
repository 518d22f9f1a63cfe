#include "certify/forces_behind_slips.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <ranges>
#include <utility>
#include <vector>

#include "linear/linear_form.hpp"
#include "linear/modal_reduction.hpp"
#include "linear/pencil.hpp"
#include "network/disjoint_sets.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

const Real rounding_of_shares{"1e-25"};  // of t, which of springs is often 1
constexpr double above_rounding = 1 + 1e-14;
constexpr double unbounded_force = std::numeric_limits<double>::infinity();

// Elements that share no inner node with a slip reach ground beside it.
std::vector<std::size_t> elements_behind_slips(const Network& network) {
  std::vector<std::size_t> elements;
  for (const Part& part : independent_parts(network, effective_elements(network), tool, ground))
    if (std::ranges::any_of(part.elements, [&](std::size_t i) { return is_slip(network.elements[i].law); }))
      unite(elements, part.elements);
  return elements;
}

// The linear rest with forces in the place of slips. Nodes that slips alone hold have no place of their own: of such a
// node one slip is taken for rigid, the strongest, since whatever holds it has to carry what the others do.
class RestBesideSlips {
 public:
  RestBesideSlips(const Network& network, const std::vector<std::size_t>& elements) : network_(network) {
    for (std::size_t index : elements) (is_slip(network.elements[index].law) ? slips_ : linear_).push_back(index);
    join_held_by_slips();
    for (std::size_t index : linear_) {
      Element& element = network_.elements[index];
      element.a = place_of(element.a), element.b = place_of(element.b);
    }
    std::erase_if(linear_, [&](std::size_t index) { return network_.elements[index].a == network_.elements[index].b; });
    number_nodes();
  }

  bool reaches_ground() const {
    const DisjointSets sets = joined([](const Element&) { return true; });
    return sets.find(tool) == sets.find(ground);
  }

  ForcesBehindSlips result() const {
    ForcesBehindSlips forces{reaches_ground()};
    const LinearForm form = linear_form(network_, linear_, tool, ground);
    if (forces.reach_round) forces.stiffness = to_double(glass_stiffness(form)) * above_rounding;
    const std::vector<Real> shares = shares_of_slips();
    for (std::size_t i = 0; i < slips_.size(); ++i)
      forces.yields += yield_force_of(network_.elements[slips_[i]].law) * to_double(shares[i]);
    return forces;
  }

 private:
  NodeIndex place_of(NodeIndex node) const { return rigid_.find(node); }

  void join_held_by_slips() {
    DisjointSets sets = joined([](const Element&) { return true; });
    const auto floats = [&](NodeIndex node) {
      return sets.find(node) != sets.find(tool) && sets.find(node) != sets.find(ground);
    };
    std::vector<std::size_t> strongest = slips_;
    std::stable_sort(strongest.begin(), strongest.end(), [&](std::size_t a, std::size_t b) {
      return yield_force_of(network_.elements[a].law) > yield_force_of(network_.elements[b].law);
    });
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      for (std::size_t index : strongest) {
        const Element& slip = network_.elements[index];
        if (sets.find(slip.a) == sets.find(slip.b) || (!floats(slip.a) && !floats(slip.b))) continue;
        sets.unite(slip.a, slip.b);
        rigid_.unite_by_least(slip.a, slip.b);
        goes_on = true;
      }
    }
  }

  template <class Joins>
  DisjointSets joined(Joins joins) const {
    DisjointSets sets(network_.nodes.size());
    for (std::size_t index : linear_)
      if (const Element& element = network_.elements[index]; joins(element)) sets.unite(element.a, element.b);
    return sets;
  }

  void number_nodes() {
    for (std::size_t index : linear_)
      for (NodeIndex node : {network_.elements[index].a, network_.elements[index].b})
        if (node != tool && node != ground) row_.emplace(node, static_cast<Eigen::Index>(row_.size()));
  }

  // Groups of inner nodes that elements of one kind tie together but to nothing else.
  template <class Joins>
  Eigen::Index floating_groups(Joins joins) const {
    return joined(joins).count_apart(std::views::keys(row_), std::array{tool, ground});
  }

  void stamp(const Element& element, RealMatrix& inner, const auto& value, Eigen::Index column,
             RealMatrix& drives) const {
    const NodeIndex ends[2] = {element.a, element.b};
    for (int end = 0; end < 2; ++end) {
      const auto here = row_.find(ends[end]), there = row_.find(ends[1 - end]);
      if (here == row_.end()) continue;
      inner(here->second, here->second) += value;
      if (there != row_.end()) inner(here->second, there->second) -= value;
      else if (ends[1 - end] == tool) drives(here->second, column) += value;
    }
  }

  // ∫|t| of each slip: x = (K + sB)⁻¹ (p + s q) u of the inner nodes, by the pencil's modes as in linear/.
  std::vector<Real> shares_of_slips() const {
    const auto size = static_cast<Eigen::Index>(row_.size()), slips = static_cast<Eigen::Index>(slips_.size());
    RealMatrix stiffness = RealMatrix::Zero(size, size), damping = stiffness;
    RealMatrix drives = RealMatrix::Zero(size, 2 + slips);
    for (std::size_t index : linear_) {
      const Element& element = network_.elements[index];
      stamp(element, stiffness, Real(stiffness_of(element.law)), 0, drives);
      stamp(element, damping, Real(damping_of(element.law)), 1, drives);
    }
    std::vector<Real> direct(slips_.size(), 0), relaxing(slips_.size(), 0);
    for (Eigen::Index j = 0; j < slips; ++j) {
      const Element& slip = network_.elements[slips_[static_cast<std::size_t>(j)]];
      for (const auto& [node, sign] : {std::pair(place_of(slip.a), 1), std::pair(place_of(slip.b), -1)}) {
        if (node == tool) direct[static_cast<std::size_t>(j)] += sign;
        else if (const auto row = row_.find(node); row != row_.end()) drives(row->second, 2 + j) += sign;
      }
    }
    if (size > 0) add_modes(solve_pencil(stiffness, damping, drives), direct, relaxing);
    std::vector<Real> shares;
    for (std::size_t j = 0; j < slips_.size(); ++j) {
      const Real share = abs(direct[j]) + relaxing[j];
      shares.push_back(abs(share - 1) < rounding_of_shares ? Real(1)
                       : share < rounding_of_shares        ? Real(0)
                                                           : Real(share * above_rounding));
    }
    return shares;
  }

  void add_modes(const Pencil& pencil, std::vector<Real>& direct, std::vector<Real>& relaxing) const {
    const Eigen::Index size = pencil.mu.size();
    const Eigen::Index by_dampers = floating_groups([](const Element& element) { return is_spring(element.law); });
    const Eigen::Index by_springs = floating_groups([](const Element& element) { return is_damper(element.law); });
    for (Eigen::Index i = 0; i < size; ++i) {
      const Real p = pencil.drives(i, 0), q = pencil.drives(i, 1), m = pencil.mu(i), d = (1 - m) / pencil.shift;
      for (std::size_t j = 0; j < direct.size(); ++j) {
        const Real moves = pencil.drives(i, 2 + static_cast<Eigen::Index>(j));
        if (i < by_dampers) direct[j] += moves * q * pencil.shift;
        else if (i >= size - by_springs) direct[j] += moves * p;
        else {
          direct[j] += moves * q / d;
          relaxing[j] += abs(moves * (p - q * m / d)) / m;
        }
      }
    }
  }

  Network network_;
  std::vector<std::size_t> linear_, slips_;
  DisjointSets rigid_{network_.nodes.size()};  // by the least, so that tool and ground stay what they are
  std::map<NodeIndex, Eigen::Index> row_;
};

}  // namespace

ForcesBehindSlips forces_behind_slips(const Network& network) {
  const std::vector<std::size_t> elements = elements_behind_slips(network);
  const RestBesideSlips rest(network, elements);
  const bool may_change =
      std::ranges::any_of(elements, [&](std::size_t i) { return network.tunable_of(network.elements[i]) != nullptr; });
  return may_change ? ForcesBehindSlips{rest.reaches_ground(), unbounded_force, unbounded_force} : rest.result();
}

}  // namespace dashpot::compiler
