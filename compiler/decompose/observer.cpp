#include "decompose/observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "decompose/observer_response.hpp"
#include "network/law.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

bool nearly_equal(const Real& x, const Real& y) { return abs(x - y) <= equal_to * (abs(x) + abs(y)); }

// Re(1/Z) = Re(jω/D), to leading order c·ωⁿ: in series all children carry the same force F, and child i dissipates
// |F|² Re(1/Z_i). At a finite reference frequency the order is 0 and c is the value there.
struct Dissipation {
  int order;
  Real coefficient;

  bool exceeds(const Dissipation& other) const {
    if (coefficient == 0 || other.coefficient == 0) return coefficient > other.coefficient;
    return order != other.order ? order < other.order : coefficient > other.coefficient;
  }
  bool ties_with(const Dissipation& other) const {
    return coefficient == 0 ? other.coefficient == 0
                            : order == other.order && nearly_equal(coefficient, other.coefficient);
  }
};

Dissipation dissipation_of(const ObserverResponse& response, const Real& reference) {
  if (reference > 0) {
    const ComplexReal& d = response.at_reference;
    return {0, reference * d.imaginary / (d.real * d.real + d.imaginary * d.imaginary)};
  }
  if (response.stiffness == 0) return {0, 1 / response.viscosity};
  return {2, response.viscosity / (response.stiffness * response.stiffness)};
}

// A subtree with its observers chosen: children of a series are reordered, the observed ones first.
struct Observed {
  Tree tree;
  ObserverResponse response;
  Real damping;
};

// Children in series whose responses are constant multiples of one another.
struct Group {
  std::vector<Observed> members;
  Real compliance_ratio = 0;  // Σ D_first/D_i
  Real damping = 0;

  ObserverResponse response() const {
    return members.size() == 1 ? members.front().response : scaled(members.front().response, 1 / compliance_ratio);
  }
};

void join(std::vector<Group>& groups, Observed child) {
  for (Group& group : groups) {
    const Real ratio = constant_ratio(group.members.front().response, child.response);
    if (ratio == 0) continue;
    const Real sum = group.compliance_ratio + ratio;
    group.damping = std::max(Real(group.damping * group.compliance_ratio), Real(child.damping * ratio)) / sum;
    group.compliance_ratio = sum;
    group.members.push_back(std::move(child));
    return;
  }
  const Real damping = child.damping;
  groups.push_back({{std::move(child)}, 1, damping});
}

std::string names_in(const Tree& tree, const Network& network) {
  if (tree.kind == Tree::Kind::leaf) return network.elements[tree.element].name;
  std::string names;
  const char* separator = tree.kind == Tree::Kind::series ? " - " : " | ";
  for (const Tree& child : tree.children) names += (names.empty() ? "" : separator) + names_in(child, network);
  return tree.kind == Tree::Kind::parallel ? "(" + names + ")" : names;
}

class Observer {
 public:
  Observer(const Network& network, ObserverRule rule, double reference)
      : network_(network), rule_(rule), reference_(reference), places_(network, reference) {}

  Observed visit(const Tree& tree) {
    switch (tree.kind) {
      case Tree::Kind::leaf: return visit_leaf(tree);
      case Tree::Kind::parallel: return visit_parallel(tree);
      case Tree::Kind::series: return visit_series(tree);
    }
    return visit_leaf(tree);
  }

  std::string reason(const Real& damping) const {
    if (damping == 0) return "no damper acts";
    std::string text;
    const std::size_t shown = std::min<std::size_t>(clauses_.size(), 4);
    for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : "; ") + clauses_[i];
    if (clauses_.size() > shown)
      text += fmt::format("; and {} more series connections likewise", clauses_.size() - shown);
    return text.empty() ? "dampers at the tool in parallel add" : text;
  }

 private:
  Observed visit_leaf(const Tree& tree) const {
    const Law& law = network_.elements[tree.element].law;
    return {tree, places_.of(law), Real(damping_of(law))};
  }

  Observed visit_parallel(const Tree& tree) {
    Observed whole{{Tree::Kind::parallel, 0, {}}, {}, 0};
    std::vector<ObserverResponse> responses;
    for (const Tree& child : tree.children) {
      Observed part = visit(child);
      whole.damping += part.damping;
      responses.push_back(std::move(part.response));
      whole.tree.children.push_back(std::move(part.tree));
    }
    whole.response = in_parallel(responses);
    return whole;
  }

  Observed visit_series(const Tree& tree) {
    std::vector<Group> groups;
    for (const Tree& child : tree.children) join(groups, visit(child));
    const auto observed = std::min_element(groups.begin(), groups.end(),
                                           [this](const Group& x, const Group& y) { return is_preferred(x, y); });
    std::vector<ObserverResponse> responses;
    for (const Group& group : groups) responses.push_back(group.response());
    Observed whole{{Tree::Kind::series, 0, {}}, in_series(responses), observed->damping};
    explain_choice(groups, *observed);
    std::rotate(groups.begin(), observed, observed + 1);
    for (Group& group : groups)
      for (Observed& member : group.members) whole.tree.children.push_back(std::move(member.tree));
    return whole;
  }

  bool is_preferred(const Group& x, const Group& y) const {
    if (rule_ == ObserverRule::largest) return x.damping > y.damping;
    const Dissipation of_x = dissipation_of(x.response(), reference_), of_y = dissipation_of(y.response(), reference_);
    return of_x.ties_with(of_y) ? x.damping > y.damping : of_x.exceeds(of_y);
  }

  // The observed group's share of what all groups dissipate, in percent.
  double share_of(const Group& observed, const std::vector<Group>& groups) const {
    const Dissipation own = dissipation_of(observed.response(), reference_);
    Real total = 0;
    for (const Group& group : groups) {
      const Dissipation other = dissipation_of(group.response(), reference_);
      if (other.order == own.order) total += other.coefficient;
    }
    return total > 0 ? to_double(100 * own.coefficient / total) : 0;
  }

  void explain_choice(const std::vector<Group>& groups, const Group& observed) {
    std::string names;
    for (const Observed& member : observed.members)
      names += (names.empty() ? "" : " - ") + names_in(member.tree, network_);
    if (names.size() > 60) names = names.substr(0, 57) + "...";
    const double damping = to_double(observed.damping);
    if (groups.size() == 1)
      clauses_.push_back(fmt::format("{} in series act as one of {:.6g} {}", names, damping, unit()));
    else if (rule_ == ObserverRule::largest)
      clauses_.push_back(fmt::format("in series the largest damping is the {:.6g} {} of {}", damping, unit(), names));
    else
      clauses_.push_back(
          fmt::format("in series, {} dissipates {:.4g} % of the energy at {}, so that the brake makes its {:.6g} {}",
                      names, share_of(observed, groups), where(), damping, unit()));
  }

  std::string unit() const { return port_units(network_.port_motion).damping; }

  std::string where() const {
    return reference_ > 0 ? fmt::format("{:.6g} rad/s", to_double(reference_)) : std::string("low frequency");
  }

  const Network& network_;
  ObserverRule rule_;
  Real reference_;
  ObserverPlaces places_;
  std::vector<std::string> clauses_;
};

// Lays the reordered tree out as a graph again.
void lay_out(const Tree& tree, NodeIndex from, NodeIndex to, Network& network) {
  if (tree.kind == Tree::Kind::leaf) {
    network.elements[tree.element].a = from;
    network.elements[tree.element].b = to;
  } else if (tree.kind == Tree::Kind::parallel) {
    for (const Tree& child : tree.children) lay_out(child, from, to, network);
  } else {
    NodeIndex here = from;
    for (std::size_t i = 0; i < tree.children.size(); ++i) {
      NodeIndex next = to;
      if (i + 1 < tree.children.size()) {
        next = network.nodes.size();
        network.nodes.push_back(fmt::format("node_{}", next - tool));
      }
      lay_out(tree.children[i], here, next, network);
      here = next;
    }
  }
}

Network laid_out(const Tree& tree, Network network) {
  network.nodes.resize(2);
  lay_out(tree, tool, ground, network);
  return network;
}

}  // namespace

Observation observe(const Tree& tree, const Network& network, ObserverRule rule, double reference_frequency) {
  Observer observer(network, rule, reference_frequency);
  const Observed whole = observer.visit(tree);
  return {whole.damping, observer.reason(whole.damping), laid_out(whole.tree, network)};
}

}  // namespace dashpot::compiler
