#include "linear/multiport_form.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <ranges>

#include "linear/normal_form.hpp"
#include "linear/pencil.hpp"
#include "network/disjoint_sets.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

const Real same_rate{"1e-25"};

struct Values {
  Real stiffness = 0, damping = 0;
};

Values values_of(const Element& element) { return {stiffness_of(element.law), damping_of(element.law)}; }

// Elements that share inner nodes, seen from the outer nodes: terminals and ground.
class Block {
 public:
  Block(const Network& network, std::vector<std::size_t> elements, const std::vector<NodeIndex>& terminals)
      : network_(network), elements_(std::move(elements)), outer_(terminals) {
    outer_.push_back(ground);
    for (std::size_t element : elements_)
      for (NodeIndex node : {network.elements[element].a, network.elements[element].b})
        if (!is_outer(node)) row_.emplace(node, static_cast<Eigen::Index>(row_.size()));
    stamp_all();
  }

  void add_to(MultiportForm& form) {
    if (!row_.empty()) add_modes(form);
    add_ties(form.springs, stiffness_, [](const Values& values) { return values.stiffness > 0; });
    add_ties(form.dampers, damping_, [](const Values& values) { return values.damping > 0; });
  }

 private:
  bool is_outer(NodeIndex node) const { return std::find(outer_.begin(), outer_.end(), node) != outer_.end(); }
  Eigen::Index outer_index(NodeIndex node) const {
    return std::find(outer_.begin(), outer_.end(), node) - outer_.begin();
  }

  // Inner nodes come first, then the outer ones.
  Eigen::Index index(NodeIndex node) const {
    const auto inner = row_.find(node);
    return inner != row_.end() ? inner->second : inner_count() + outer_index(node);
  }
  Eigen::Index inner_count() const { return static_cast<Eigen::Index>(row_.size()); }

  void stamp_all() {
    const Eigen::Index inner = inner_count(), outer = static_cast<Eigen::Index>(outer_.size()), all = inner + outer;
    RealMatrix k = RealMatrix::Zero(all, all), b = k;
    for (std::size_t element : elements_) {
      const Element& e = network_.elements[element];
      const Values values = values_of(e);
      for (const auto& [i, j, sign] :
           {std::tuple(e.a, e.a, 1), std::tuple(e.b, e.b, 1), std::tuple(e.a, e.b, -1), std::tuple(e.b, e.a, -1)}) {
        k(index(i), index(j)) += sign * values.stiffness;
        b(index(i), index(j)) += sign * values.damping;
      }
      largest_ = std::max({largest_, values.stiffness, values.damping});
    }
    inner_stiffness_ = k.topLeftCorner(inner, inner);
    inner_damping_ = b.topLeftCorner(inner, inner);
    drive_stiffness_ = k.topRightCorner(inner, outer);
    drive_damping_ = b.topRightCorner(inner, outer);
    stiffness_ = k.bottomRightCorner(outer, outer);
    damping_ = b.bottomRightCorner(outer, outer);
  }

  template <class Carries>
  DisjointSets joined_by(Carries carries) const {
    DisjointSets groups(network_.nodes.size());
    for (std::size_t element : elements_) {
      const Element& e = network_.elements[element];
      if (carries(values_of(e))) groups.unite(e.a, e.b);
    }
    return groups;
  }

  // Inner nodes that elements of one kind tie together but to nothing outside: each group is one direction in which the
  // matrix of that kind is singular.
  template <class Carries>
  Eigen::Index floating_groups(Carries carries) const {
    return joined_by(carries).count_apart(std::views::keys(row_), outer_);
  }

  // Theory, section 2, with vectors: −(p + s q)(p + s q)ᵀ/(m + s d) of each mode.
  void add_modes(MultiportForm& form) {
    const Eigen::Index outer = drive_stiffness_.cols();
    RealMatrix drives(inner_count(), 2 * outer);
    drives << drive_stiffness_, drive_damping_;
    const Pencil pencil = solve_pencil(inner_stiffness_, inner_damping_, drives);
    const Eigen::Index by_dampers = floating_groups([](const Values& values) { return values.stiffness > 0; });
    const Eigen::Index by_springs = floating_groups([](const Values& values) { return values.damping > 0; });
    std::vector<Relaxation> relaxations;
    for (Eigen::Index i = 0; i < inner_count(); ++i) {
      const RealVector p = pencil.drives.row(i).head(outer), q = pencil.drives.row(i).tail(outer);
      if (i < by_dampers) {
        damping_ -= q * q.transpose() * pencil.shift;
      } else if (i >= inner_count() - by_springs) {
        stiffness_ -= p * p.transpose();
      } else {
        const Real m = pencil.mu(i), d = (1 - m) / pencil.shift, rate = m / d;
        const RealVector drive = p - q * rate;
        damping_ -= q * q.transpose() / d;
        stiffness_ -=
            (p * q.transpose() + q * p.transpose() - q * q.transpose() * rate) / d + drive * drive.transpose() / m;
        relaxations.push_back({rate, drive, m});
      }
    }
    for (const Relaxation& relaxation : taken_apart(std::move(relaxations)))
      add_mode(form, relaxation.drive, relaxation.rate, relaxation.m);
  }

  struct Relaxation {
    Real rate;
    RealVector drive;
    Real m;
  };

  // Modes of equal rate are not unique, so their sum is split again in a fixed way, terminal by terminal: equal parts
  // then give equal laws.
  std::vector<Relaxation> taken_apart(std::vector<Relaxation> all) const {
    std::vector<Relaxation> result;
    for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
      while (last < all.size() && all[last].rate - all[first].rate <= same_rate * all[last].rate) ++last;
      if (last == first + 1) {
        result.push_back(std::move(all[first]));
        continue;
      }
      RealMatrix sum = all[first].drive * all[first].drive.transpose() / all[first].m;
      for (std::size_t i = first + 1; i < last; ++i) sum += all[i].drive * all[i].drive.transpose() / all[i].m;
      const Real largest = sum.diagonal().head(sum.rows() - 1).maxCoeff();
      for (Eigen::Index terminal = 0; terminal + 1 < sum.rows(); ++terminal) {
        if (sum(terminal, terminal) <= negligible_share * largest) continue;
        const RealVector drive = sum.col(terminal) / sqrt(sum(terminal, terminal));
        result.push_back({all[first].rate, drive, 1});
        sum -= drive * drive.transpose();
      }
    }
    return result;
  }

  void add_mode(MultiportForm& form, const RealVector& drive, const Real& rate, const Real& m) const {
    Real largest = 0;
    for (Eigen::Index i = 0; i + 1 < drive.size(); ++i) largest = std::max(largest, Real(abs(drive(i))));
    const Real stiffness = largest * largest / m;
    if (stiffness <= negligible_share * largest_) return;
    MultiportMode mode{stiffness, rate, {}, elements_};
    Real sum = 0;
    for (Eigen::Index i = 0; i + 1 < drive.size(); ++i) {
      const Real weight = abs(drive(i)) <= negligible_share * largest ? Real(0) : Real(drive(i) / largest);
      mode.weights.push_back(weight);
      sum += weight;
    }
    mode.weights.push_back(touches_ground() ? Real(-sum) : Real(0));
    form.modes.push_back(std::move(mode));
  }

  bool touches_ground() const {
    return std::any_of(elements_.begin(), elements_.end(), [&](std::size_t element) {
      return network_.elements[element].a == ground || network_.elements[element].b == ground;
    });
  }

  // Entries that are zero by the network's structure are set to exactly zero, not left as rounding errors.
  template <class Carries>
  void add_ties(std::vector<Tie>& ties, const RealMatrix& matrix, Carries carries) const {
    const DisjointSets groups = joined_by(carries);
    for (std::size_t a = 0; a < outer_.size(); ++a)
      for (std::size_t b = a + 1; b < outer_.size(); ++b) {
        const Real value = -matrix(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
        if (groups.find(outer_[a]) != groups.find(outer_[b]) || value <= negligible_share * largest_) continue;
        const auto known =
            std::find_if(ties.begin(), ties.end(), [&](const Tie& tie) { return tie.a == a && tie.b == b; });
        if (known == ties.end()) ties.push_back({a, b, value});
        else known->value += value;
      }
  }

  const Network& network_;
  std::vector<std::size_t> elements_;
  std::vector<NodeIndex> outer_;
  std::map<NodeIndex, Eigen::Index> row_;
  Real largest_ = 0;
  RealMatrix inner_stiffness_, inner_damping_, drive_stiffness_, drive_damping_, stiffness_, damping_;
};

std::vector<std::size_t> linear_elements(const Network& network, const std::vector<std::size_t>& elements) {
  std::vector<std::size_t> linear;
  for (std::size_t index : elements)
    if (!is_slip(network.elements[index].law)) linear.push_back(index);
  return linear;
}

// Nodes at which slips end, then the tool.
std::vector<NodeIndex> terminals_of(const Network& network, const std::vector<std::size_t>& elements) {
  std::vector<NodeIndex> nodes;
  for (const auto& [ends, yield] : slips_between(network, elements))
    for (NodeIndex node : {ends.first, ends.second})
      if (node != ground && node != tool) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  nodes.push_back(tool);
  return nodes;
}

}  // namespace

MultiportForm multiport_form(const Network& network, const std::vector<std::size_t>& elements,
                             const std::vector<NodeIndex>& terminals) {
  const auto is_outer = [&](NodeIndex node) {
    return node == ground || std::find(terminals.begin(), terminals.end(), node) != terminals.end();
  };
  DisjointSets inner(network.nodes.size());
  for (std::size_t element : elements) {
    const Element& e = network.elements[element];
    if (!is_outer(e.a) && !is_outer(e.b)) inner.unite(e.a, e.b);
  }
  std::map<std::size_t, std::vector<std::size_t>>
      blocks;  // by the group of inner nodes, or by the element if it has none
  for (std::size_t element : elements) {
    const Element& e = network.elements[element];
    const bool is_direct = is_outer(e.a) && is_outer(e.b);
    blocks[is_direct ? network.nodes.size() + element : inner.find(is_outer(e.a) ? e.b : e.a)].push_back(element);
  }
  MultiportForm form{terminals, {}, {}, {}};
  for (auto& [group, members] : blocks) Block(network, std::move(members), terminals).add_to(form);
  return form;
}

MultiportForm multiport_form_at_slips(const Network& network, const std::vector<std::size_t>& elements) {
  return multiport_form(network, linear_elements(network, elements), terminals_of(network, elements));
}

}  // namespace dashpot::compiler
