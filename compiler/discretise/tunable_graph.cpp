#include "discretise/tunable_graph.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "linear/normal_form.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

bool is_slip(const Network& network, std::size_t element) { return is_slip(network.elements[element].law); }

// Groups of linear elements that share nodes at which no slip ends.
class Clusters {
 public:
  Clusters(const Network& network, const std::vector<std::size_t>& elements, const std::set<NodeIndex>& ends)
      : network_(network), ends_(ends) {
    for (std::size_t element : elements)
      if (!is_slip(network, element)) add(element);
  }

  struct Cluster {
    std::vector<std::size_t> elements;
    std::set<NodeIndex> ends, inner;
  };
  const std::vector<Cluster>& all() const { return clusters_; }

 private:
  void add(std::size_t element) {
    Cluster joined;
    add_to(joined, element);
    for (auto other = clusters_.begin(); other != clusters_.end();) {
      const bool shares = std::any_of(joined.inner.begin(), joined.inner.end(),
                                      [&](NodeIndex node) { return other->inner.count(node) != 0; });
      if (!shares) {
        ++other;
        continue;
      }
      joined.elements.insert(joined.elements.end(), other->elements.begin(), other->elements.end());
      joined.ends.insert(other->ends.begin(), other->ends.end());
      joined.inner.insert(other->inner.begin(), other->inner.end());
      other = clusters_.erase(other);
    }
    clusters_.push_back(std::move(joined));
  }

  void add_to(Cluster& cluster, std::size_t element) const {
    cluster.elements.push_back(element);
    for (NodeIndex node : {network_.elements[element].a, network_.elements[element].b})
      (ends_.count(node) != 0 ? cluster.ends : cluster.inner).insert(node);
  }

  const Network& network_;
  const std::set<NodeIndex>& ends_;
  std::vector<Cluster> clusters_;
};

// From the tool's side to the ground's.
std::pair<NodeIndex, NodeIndex> oriented(NodeIndex a, NodeIndex b) {
  const bool turned = a == ground || b == tool || (a != tool && b != ground && b < a);
  return turned ? std::pair(b, a) : std::pair(a, b);
}

}  // namespace

SlipGraph slip_graph(const Network& network, const std::vector<std::size_t>& elements) {
  SlipGraph graph;
  std::set<NodeIndex> ends = {tool, ground};
  const std::vector<SlipElements> slips = slips_together(network, elements);
  for (const SlipElements& together : slips) {
    const Element& first = network.elements[together.front()];
    graph.links.push_back({std::min(first.a, first.b), std::max(first.a, first.b), together});
    ends.insert({first.a, first.b});
  }
  std::map<std::pair<NodeIndex, NodeIndex>, std::vector<std::size_t>> between;
  const std::set<NodeIndex> of_slips = ends;
  const Clusters clusters(network, elements, of_slips);
  for (const Clusters::Cluster& cluster : clusters.all()) {
    if (cluster.ends.size() == 2) {
      std::vector<std::size_t>& port = between[oriented(*cluster.ends.begin(), *cluster.ends.rbegin())];
      port.insert(port.end(), cluster.elements.begin(), cluster.elements.end());
      continue;
    }
    ends.insert(cluster.inner.begin(), cluster.inner.end());
    graph.opened.insert(graph.opened.end(), cluster.elements.begin(), cluster.elements.end());
    for (std::size_t element : cluster.elements)
      between[oriented(network.elements[element].a, network.elements[element].b)].push_back(element);
  }
  for (auto& [nodes, port] : between) {
    std::sort(port.begin(), port.end());
    graph.ties.push_back({nodes.first, nodes.second, std::move(port)});
  }
  std::sort(graph.opened.begin(), graph.opened.end());
  for (NodeIndex node : ends)
    if (node != tool && node != ground) graph.ends.push_back(node);
  return graph;
}

Network laid_out(const Network& network, const OnePort& port) {
  Network part = network;
  part.nodes.resize(2);
  std::map<NodeIndex, NodeIndex> place = {{port.from, tool}, {port.to, ground}};
  for (Element& element : part.elements) element.has_effect = false;
  for (std::size_t index : port.elements) {
    Element& element = part.elements[index];
    element.has_effect = true;
    for (NodeIndex* node : {&element.a, &element.b}) {
      const auto [known, is_new] = place.emplace(*node, part.nodes.size());
      if (is_new) part.nodes.push_back("inner");
      *node = known->second;
    }
  }
  return part;
}

bool is_loose(const SlipGraph& graph, const OnePort& tie) {
  const auto is_alone_at = [&](NodeIndex node) {
    return node != tool && node != ground &&
           std::count_if(graph.ties.begin(), graph.ties.end(),
                         [=](const OnePort& other) { return other.from == node || other.to == node; }) == 1;
  };
  return is_alone_at(tie.from) || is_alone_at(tie.to);
}

}  // namespace dashpot::compiler
