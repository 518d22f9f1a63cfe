#include "decompose/regimes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "decompose/observer.hpp"
#include "network/effect.hpp"
#include "network/tree.hpp"

namespace dashpot::compiler {
namespace {

// Nodes that rigid parts have made one. The lowest stands for all, so that tool and ground stay what they are.
class JoinedNodes {
 public:
  explicit JoinedNodes(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), NodeIndex{0}); }

  NodeIndex operator()(NodeIndex node) const {
    while (parent_[node] != node) node = parent_[node];
    return node;
  }
  void join(NodeIndex a, NodeIndex b) {
    a = (*this)(a);
    b = (*this)(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<NodeIndex> parent_;
};

void keep_only(const std::vector<std::size_t>& elements, Network& network) {
  std::vector<bool> kept(network.elements.size(), false);
  for (std::size_t element : elements) kept[element] = network.elements[element].has_effect;
  for (std::size_t i = 0; i < kept.size(); ++i) network.elements[i].has_effect = kept[i];
}

// What hangs loose or is bridged by rigid parts carries no force.
void drop_what_carries_no_force(Network& network) {
  std::vector<bool> passable;
  for (const Element& element : network.elements) passable.push_back(element.has_effect && element.a != element.b);
  const std::vector<bool> on_path = on_path_between_ends(network, passable);
  for (std::size_t i = 0; i < on_path.size(); ++i) network.elements[i].has_effect = on_path[i];
}

std::vector<bool> pattern(std::size_t index, std::size_t slips) {
  std::vector<bool> slides;
  for (std::size_t i = 0; i < slips; ++i) slides.push_back((index >> i & 1) != 0);
  return slides;
}

Regime regime_of(const Network& left, std::vector<bool> slides, double reference_frequency) {
  Regime regime{std::move(slides), linear_form(left), 0, "no series-parallel tree, so the viscosity at low frequency"};
  if (const std::optional<Tree> tree = series_parallel_tree(left)) {
    const Observation observation = observe(*tree, left, ObserverRule::most_dissipative, reference_frequency);
    regime.damping = observation.damping;
    regime.reason = observation.reason;
  } else {
    regime.damping = zero_frequency_damping(regime.form);
  }
  regime.damping = std::max(regime.damping, regime.feedthrough());
  return regime;
}

}  // namespace

Network network_in_regime(const Network& network, const std::vector<std::size_t>& elements,
                          const std::vector<SlipElements>& slips, const std::vector<bool>& slides) {
  Network left = network;
  keep_only(elements, left);
  JoinedNodes joined(left.nodes.size());
  for (std::size_t i = 0; i < slips.size(); ++i)
    for (std::size_t element : slips[i]) {
      left.elements[element].has_effect = false;
      if (!slides[i]) joined.join(left.elements[element].a, left.elements[element].b);
    }
  for (Element& element : left.elements) {
    element.a = joined(element.a);
    element.b = joined(element.b);
  }
  drop_what_carries_no_force(left);
  return left;
}

RegimeList regimes_of(const Network& network, const std::vector<std::size_t>& elements, std::vector<SlipElements> slips,
                      double reference_frequency) {
  RegimeList list{std::move(slips), {}, 0};
  list.count = std::exp2(static_cast<double>(list.slips.size()));
  if (list.slips.size() > most_listed_slips) return list;
  for (std::size_t index = 0; index < std::size_t{1} << list.slips.size(); ++index) {
    std::vector<bool> slides = pattern(index, list.slips.size());
    const Network left = network_in_regime(network, elements, list.slips, slides);
    list.regimes.push_back(regime_of(left, std::move(slides), reference_frequency));
  }
  return list;
}

RegimeList regimes_of(const Network& network, const std::vector<std::size_t>& elements, double reference_frequency) {
  return regimes_of(network, elements, slips_together(network, elements), reference_frequency);
}

RegimeList regimes_of(const Network& network, const NormalTree& component, double reference_frequency) {
  std::vector<SlipElements> slips;
  for (const NormalTree* slip : slips_of(component)) slips.push_back(slip->elements);
  return regimes_of(network, elements_of(component), std::move(slips), reference_frequency);
}

}  // namespace dashpot::compiler
