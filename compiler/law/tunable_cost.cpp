#include "law/tunable_tables.hpp"

#include <dashpot/slip_network.hpp>
#include <dashpot/slip_regime.hpp>
#include <dashpot/slip_tree.hpp>

namespace dashpot::compiler {
namespace {

// What one call takes at most, counted in the headers of the runtime.
constexpr std::size_t square_root_operations = 110;

std::size_t size_of(int count) { return static_cast<std::size_t>(count); }

std::size_t pairs(std::size_t n) { return n * (n - (n > 0 ? 1 : 0)) / 2; }

// tunable_mesh::eliminate: every node joins all that are left.
std::size_t elimination(std::size_t nodes) {
  std::size_t operations = 0;
  for (std::size_t left = 0; left < nodes; ++left) operations += 8 + 7 * left + 2 * pairs(left);
  return operations;
}

// tunable_mesh::eliminate_to_first_order: nine operations a bridge.
std::size_t first_order_elimination(std::size_t nodes) {
  std::size_t operations = 0;
  for (std::size_t left = 0; left < nodes; ++left) operations += 2 + 2 * left + 9 * (1 + 2 * left + pairs(left));
  return operations;
}

std::size_t held(const TunableTables& tables) {
  std::size_t operations = 0;
  for (const tunable_part& part : tables.parts) {
    const std::size_t nodes = size_of(part.node_count), edges = size_of(part.edge_count);
    switch (part.kind) {
      case tunable_kind::spring: operations += 3; break;
      case tunable_kind::damper: operations += 1; break;
      case tunable_kind::relaxation: operations += 6; break;
      case tunable_kind::mesh: operations += 5 * edges + 2 * pairs(nodes) + 2 * nodes + 2; break;
    }
  }
  return operations;
}

std::size_t advance(const TunableTables& tables) {
  std::size_t operations = 0;
  for (const tunable_part& part : tables.parts) {
    const std::size_t nodes = size_of(part.node_count), edges = size_of(part.edge_count);
    operations += part.kind == tunable_kind::mesh ? 2 * edges + 2 * pairs(nodes) + 3 * nodes : 4;
  }
  return operations;
}

std::size_t slips(const TunableTables& tables) {
  std::size_t operations = 0;
  for (const tunable_coupling& coupling : tables.couplings)
    operations += size_of(slip_tree_operations(tables.nodes.data() + coupling.first_node, coupling.node_count));
  // What blocks do at both ends, and how long they become.
  for (const tunable_graph& graph : tables.graphs)
    operations += size_of(tables.operations(graph) + 5 * graph.tie_count);
  return operations;
}

// g and b∞ of every block, and the curves of slips.
std::size_t tuning(const TunableTables& tables) {
  std::size_t operations = 4 * tables.nodes.size();
  for (const tunable_part& part : tables.parts) {
    const std::size_t nodes = size_of(part.node_count), edges = size_of(part.edge_count);
    operations += part.kind == tunable_kind::relaxation ? 4 : 3;
    if (part.kind == tunable_kind::mesh) operations += 3 + 4 * edges + 2 * elimination(nodes);
  }
  return operations;
}

std::size_t viscosity(const TunableTables& tables) {
  std::size_t operations = 0;
  for (int i = 0; i < tables.blocks.front().part_count; ++i) {
    const tunable_part& part = tables.parts[size_of(tables.blocks.front().first_part + i)];
    if (part.kind == tunable_kind::mesh)
      operations += 1 + 2 * size_of(part.edge_count) + first_order_elimination(size_of(part.node_count));
  }
  return operations;
}

// Of the regime of the sample and of the command's, and √b where a coil lags.
std::size_t slip_brake(const TunableTables& tables) {
  if (!tables.head.slip_rule.takes_part) return 0;
  std::size_t operations =
      16 + 4 * tables.yields.size() + (tables.head.slip_rule.coil_share < 1 ? square_root_operations + 4 : 0);
  for (const tunable_coupling& coupling : tables.couplings)
    operations +=
        2 * (1 + size_of(slip_regime_operations(tables.nodes.data() + coupling.first_node, coupling.node_count)));
  for (const tunable_graph& graph : tables.graphs)
    operations += 2 * (1 + size_of(2 * graph.tie_count) + elimination(size_of(graph.end_count)));
  return operations;
}

// How far offsets come home, and what is shed.
std::size_t springs(const TunableTables& tables) {
  const std::size_t of_map = tables.head.map.is_there ? 3 * tables.springs.size() + 12 : 0;
  return (tables.sheds() ? 12 : 9) * tables.springs.size() + (tables.sheds() ? 10 : 0) + of_map;
}

}  // namespace

// Of patterns only how many there are matters: a slip that holds 1 N, and behind a contact the tool's own, which has
// two.
int TunableTables::operations(const tunable_graph& graph) const {
  std::vector<slip_link<double>> of_graph(size_of(graph.link_count), {0, 0, -1, 1});
  if (head.contact.is_there) of_graph.push_back({0, 0, 0, 1});
  return slip_network_operations(of_graph.data(), static_cast<int>(of_graph.size()), graph.end_count);
}

std::size_t operations_of(const TunableTables& tables, TunableCall call) {
  switch (call) {
    case TunableCall::slip:
    case TunableCall::push: return slips(tables);
    case TunableCall::slip_brake: return slip_brake(tables);
    case TunableCall::limit: return 7;
    case TunableCall::follow: return 2;
    case TunableCall::update: return advance(tables) + held(tables) + springs(tables);
    case TunableCall::set: return tuning(tables) + held(tables);
    case TunableCall::viscosity: return viscosity(tables);
    case TunableCall::meshes:
    case TunableCall::held:
    case TunableCall::reset:
    case TunableCall::resting_brake:
    case TunableCall::stored_energy: return 0;  // not in the loop, or nothing to work out
  }
  return 0;
}

std::size_t operations_of_energy(const TunableTables& tables) {
  if (tables.head.map.is_there) return 34 * tables.springs.size() + 2;  // no square root
  const std::size_t per_spring = 2 + 2 * square_root_operations + 30 + 6;
  return tables.springs.size() * per_spring + square_root_operations + 16;
}

}  // namespace dashpot::compiler
