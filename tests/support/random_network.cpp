#include "support/random_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "network/effect.hpp"
#include "network/law.hpp"
#include "support/random.hpp"

namespace dashpot::testing {
namespace {

using compiler::Element;
using compiler::ground;
using compiler::Network;
using compiler::NodeIndex;
using compiler::tool;

struct Edge {
  NodeIndex a;
  NodeIndex b;
};

struct Shape {
  std::size_t nodes = 2;
  std::vector<Edge> edges = {{tool, ground}};
};

void double_edge(Shape& shape, std::size_t edge) { shape.edges.push_back(Edge(shape.edges[edge])); }

void split_edge(Shape& shape, std::size_t edge) {
  const NodeIndex middle = shape.nodes++;
  shape.edges.push_back({middle, std::exchange(shape.edges[edge].b, middle)});
}

// Series–parallel graphs are those that grow from one edge by these two steps (Duffin 1965).
Shape random_tree(Random& random, std::size_t nodes) {
  Shape shape;
  const double doubling = random.uniform(0.2, 0.7);
  while (shape.nodes < nodes) {
    const std::size_t edge = random.index(shape.edges.size());
    random.chance(doubling) ? double_edge(shape, edge) : split_edge(shape, edge);
  }
  return shape;
}

void add_ear(Shape& shape, Random& random, std::size_t inner_nodes) {
  NodeIndex here = random.index(shape.nodes), last = here;
  while (last == here) last = random.index(shape.nodes);
  for (std::size_t i = 0; i < inner_nodes; ++i) {
    shape.edges.push_back({here, shape.nodes});
    here = shape.nodes++;
  }
  shape.edges.push_back({here, last});
}

// Paths between two nodes already there, one after the other: every edge then lies on a path from tool to ground
// (Whitney's ear decomposition, tool–ground being the first ear's other side).
Shape random_graph(Random& random, std::size_t nodes) {
  Shape shape;
  const double chords = random.uniform(0.1, 0.6);
  while (shape.nodes < nodes) {
    const std::size_t room = nodes - shape.nodes;
    add_ear(shape, random, random.chance(chords) ? 0 : random.between(1, std::min<std::size_t>(room, 3)));
  }
  return shape;
}

class ValueSource {
 public:
  ValueSource(Random& random, const NetworkRecipe& recipe)
      : random_(random),
        recipe_(recipe),
        spring_probability_(random.chance(0.7) ? 0.5 : random.uniform()),
        coincidences_(random.chance(0.2)) {}

  compiler::Law law() {
    const bool is_spring = random_.chance(spring_probability_);
    return compiler::make_law(is_spring ? compiler::ElementKind::spring : compiler::ElementKind::damper, value());
  }

  double value() {
    const double middle = std::sqrt(recipe_.smallest_value * recipe_.largest_value);
    if (coincidences_) return random_.chance(0.5) ? middle : 10 * middle;
    return random_.log_uniform(recipe_.smallest_value, recipe_.largest_value);
  }

 private:
  Random& random_;
  const NetworkRecipe& recipe_;
  double spring_probability_;
  bool coincidences_;
};

bool slips_join_ends(const Network& network) {
  std::vector<bool> is_slip;
  for (const Element& element : network.elements)
    is_slip.push_back(std::holds_alternative<compiler::Slip>(element.law));
  const std::vector<bool> on_path = compiler::on_path_between_ends(network, is_slip);
  return std::find(on_path.begin(), on_path.end(), true) != on_path.end();
}

void turn_into_slips(Network& network, std::size_t most, Random& random, ValueSource& values) {
  for (std::size_t i = random.between(1, most); i > 0; --i) {
    Element& element = network.elements[random.index(network.elements.size())];
    const Element before = element;
    element.law = compiler::Slip{values.value()};
    if (slips_join_ends(network)) element = before;
  }
}

void name_everything(Network& network) {
  for (std::size_t i = 0; i < network.elements.size(); ++i)
    network.elements[i].name = fmt::format("{}_{}", compiler::kind_of(network.elements[i].law), i + 1);
  for (NodeIndex node = 2; node < network.nodes.size(); ++node) network.nodes[node] = fmt::format("n{}", node - 1);
}

constexpr NodeIndex unused = static_cast<NodeIndex>(-1);

void drop_unused_nodes(Network& network) {
  std::vector<NodeIndex> place(network.nodes.size(), unused);
  std::vector<std::string> nodes = {network.nodes[ground], network.nodes[tool]};
  place[ground] = ground;
  place[tool] = tool;
  for (Element& element : network.elements)
    for (NodeIndex* node : {&element.a, &element.b}) {
      if (place[*node] == unused) {
        place[*node] = nodes.size();
        nodes.push_back(network.nodes[*node]);
      }
      *node = place[*node];
    }
  network.nodes = std::move(nodes);
}

}  // namespace

Network random_network(std::uint64_t seed, const NetworkRecipe& recipe) {
  Random random(seed);
  const std::size_t nodes = random.between(2, recipe.most_nodes);
  const Shape shape = recipe.topology == Topology::tree ? random_tree(random, nodes) : random_graph(random, nodes);
  ValueSource values(random, recipe);
  Network network;
  network.name = fmt::format("random_{}", seed);
  network.nodes.resize(shape.nodes);
  network.nodes[ground] = "ground";
  network.nodes[tool] = "tool";
  for (const Edge& edge : shape.edges) network.elements.push_back({"", values.law(), edge.a, edge.b, {}, {}});
  if (recipe.most_slips > 0) turn_into_slips(network, recipe.most_slips, random, values);
  name_everything(network);
  return network;
}

std::string json_text(const Network& network) {
  std::string text = fmt::format("{{ \"dashpot\": 1, \"name\": \"{}\", \"elements\": [", network.name);
  for (std::size_t i = 0; i < network.elements.size(); ++i) {
    const Element& e = network.elements[i];
    text += fmt::format("{}\n  {{ \"{}\": {}, \"nodes\": [\"{}\", \"{}\"], \"name\": \"{}\" }}", i == 0 ? "" : ",",
                        compiler::kind_of(e.law), compiler::value_of(e.law), network.nodes[e.a], network.nodes[e.b],
                        e.name);
  }
  return text + " ] }\n";
}

bool tidy(Network& network) {
  const std::vector<bool> on_path = compiler::on_path_between_ends(network, compiler::may_carry_force(network));
  Network kept = network;
  kept.elements.clear();
  for (std::size_t i = 0; i < on_path.size(); ++i)
    if (on_path[i]) kept.elements.push_back(network.elements[i]);
  if (kept.elements.empty() || slips_join_ends(kept)) return false;
  drop_unused_nodes(kept);
  network = std::move(kept);
  return true;
}

}  // namespace dashpot::testing
