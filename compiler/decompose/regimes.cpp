#include "decompose/regimes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "decompose/observer.hpp"
#include "network/disjoint_sets.hpp"
#include "network/effect.hpp"
#include "network/tree.hpp"

namespace dashpot::compiler {
namespace {

void keep_only(const std::vector<std::size_t>& elements, Network& network) {
  std::vector<bool> kept(network.elements.size(), false);
  for (std::size_t element : elements) kept[element] = network.elements[element].has_effect;
  for (std::size_t i = 0; i < kept.size(); ++i) network.elements[i].has_effect = kept[i];
}

// Drops elements that have a loose end or whose two ends are rigidly joined: they carry no force.
void drop_what_carries_no_force(Network& network) {
  std::vector<bool> passable;
  for (const Element& element : network.elements) passable.push_back(element.has_effect && element.a != element.b);
  network = along(passable, std::move(network));
}

std::vector<bool> pattern(std::size_t index, std::size_t slips) {
  std::vector<bool> slides;
  for (std::size_t i = 0; i < slips; ++i) slides.push_back((index >> i & 1) != 0);
  return slides;
}

Regime regime_of(const Network& left, std::vector<bool> slides, double reference_frequency) {
  Regime regime{std::move(slides), linear_form(left), 0,
                "not a series-parallel tree, so b is the zero-frequency damping"};
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

// Some of a network's elements as a network of their own, so that work on them does not depend on the size of the
// whole.
class PartOfNetwork {
 public:
  PartOfNetwork(const Network& whole, const std::vector<std::size_t>& elements) : elements_(elements) {
    std::sort(elements_.begin(), elements_.end());
    network_.port_motion = whole.port_motion;
    network_.nodes = {whole.nodes[ground], whole.nodes[tool]};
    std::map<NodeIndex, NodeIndex> places = {{ground, ground}, {tool, tool}};
    for (const std::size_t i : elements_)
      for (const NodeIndex node : {whole.elements[i].a, whole.elements[i].b}) places.emplace(node, 0);
    for (auto& [node, place] : places) {
      if (node == ground || node == tool) continue;
      place = NodeIndex(network_.nodes.size());
      network_.nodes.push_back(whole.nodes[node]);
    }
    for (const std::size_t i : elements_) {
      network_.elements.push_back(whole.elements[i]);
      network_.elements.back().a = places.at(whole.elements[i].a);
      network_.elements.back().b = places.at(whole.elements[i].b);
    }
  }

  const Network& network() const { return network_; }

  std::vector<std::size_t> here(const std::vector<std::size_t>& in_whole) const {
    std::vector<std::size_t> places;
    for (const std::size_t i : in_whole)
      places.push_back(std::size_t(std::lower_bound(elements_.begin(), elements_.end(), i) - elements_.begin()));
    return places;
  }
  LinearForm in_whole(LinearForm form) const {
    const auto name_as_in_whole = [this](std::vector<std::size_t>& places) {
      for (std::size_t& place : places) place = elements_[place];
    };
    for (Mode& mode : form.modes) name_as_in_whole(mode.elements);
    name_as_in_whole(form.static_elements);
    name_as_in_whole(form.feedthrough_elements);
    return form;
  }

 private:
  std::vector<std::size_t> elements_;  // of the whole, ascending
  Network network_;
};

}  // namespace

Network network_in_regime(const Network& network, const std::vector<std::size_t>& elements,
                          const std::vector<SlipElements>& slips, const std::vector<bool>& slides) {
  Network left = network;
  keep_only(elements, left);
  DisjointSets joined(left.nodes.size());  // the smallest index represents a set, so that tool and ground keep theirs
  for (std::size_t i = 0; i < slips.size(); ++i)
    for (std::size_t element : slips[i]) {
      left.elements[element].has_effect = false;
      if (!slides[i]) joined.unite_by_least(left.elements[element].a, left.elements[element].b);
    }
  for (Element& element : left.elements) {
    element.a = joined.find(element.a);
    element.b = joined.find(element.b);
  }
  drop_what_carries_no_force(left);
  return left;
}

RegimeList regimes_of(const Network& network, const std::vector<std::size_t>& elements, std::vector<SlipElements> slips,
                      double reference_frequency) {
  RegimeList list{std::move(slips), {}, 0};
  list.count = std::exp2(static_cast<double>(list.slips.size()));
  if (list.slips.size() > most_listed_slips) return list;
  const PartOfNetwork part(network, elements);
  const std::vector<std::size_t> elements_here = part.here(elements);
  std::vector<SlipElements> slips_here;
  for (const SlipElements& slip : list.slips) slips_here.push_back(part.here(slip));
  for (std::size_t index = 0; index < std::size_t{1} << list.slips.size(); ++index) {
    std::vector<bool> slides = pattern(index, list.slips.size());
    const Network left = network_in_regime(part.network(), elements_here, slips_here, slides);
    list.regimes.push_back(regime_of(left, std::move(slides), reference_frequency));
    list.regimes.back().form = part.in_whole(std::move(list.regimes.back().form));
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
