#include "discretise/tuned_mesh.hpp"

#include <algorithm>

namespace dashpot::compiler {

TunedMesh::TunedMesh(TunedNumbers& numbers, const BlockPart& part, const std::vector<MeshEdge>& edges)
    : numbers_(numbers), writer_(numbers.writer()), part_(part), edges_(edges) {
  // A node is pushed by its own springs, and by those of earlier nodes that it is joined to.
  const auto count = static_cast<std::size_t>(part.node_count);
  std::vector<bool> is_pushed(count, false);
  std::vector<std::vector<bool>> is_joined(count, std::vector<bool>(count, false));
  for (int i = 0; i < part.edge_count; ++i)
    for (const auto& [node, other] : {std::pair(edge(i).from, edge(i).to), std::pair(edge(i).to, edge(i).from)}) {
      if (node < 0) continue;
      if (edge(i).spring != no_index) is_pushed[static_cast<std::size_t>(node)] = true;
      if (other >= 0) is_joined[static_cast<std::size_t>(node)][static_cast<std::size_t>(other)] = true;
    }
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      if (!is_joined[i][j]) continue;
      if (is_pushed[i]) is_pushed[j] = true;
      for (std::size_t k = j + 1; k < count; ++k)
        if (is_joined[i][k]) is_joined[j][k] = true;
    }
  const std::string unit = writer_.force();
  for (std::size_t i = 0; i < count; ++i)
    push_.push_back(is_pushed[i] ? numbers_.scalar(joined(node_name(static_cast<int>(i)), "push"), unit,
                                                   "force of the springs on an inner node", Role::state)
                                 : no_variable);
}

ExpressionId& TunedMesh::place_of(const MeshEdge& edge, Conductances& all) const {
  const auto [low, high] = std::minmax(edge.from, edge.to);
  const auto at = static_cast<std::size_t>(high);
  if (low >= 0) return all.weight[static_cast<std::size_t>(low)][at];
  if (high < 0) return all.through;
  return low == mesh_port ? all.to_port[at] : all.to_held[at];
}

TunedMesh::Conductances TunedMesh::joined_up(const Row& of_edges) const {
  const auto count = static_cast<std::size_t>(part_.node_count);
  Conductances all{std::vector<Row>(count, Row(count)), Row(count), Row(count)};
  for (int i = 0; i < part_.edge_count; ++i) {
    ExpressionId& sum = place_of(edge(i), all);
    sum = writer_.plus(sum, of_edges[static_cast<std::size_t>(i)]);
  }
  return all;
}

ExpressionId TunedMesh::told(const std::string& name, const char* unit, ExpressionId value, bool is_kept) {
  if (value == nothing) return nothing;
  if (!is_kept) return numbers_.named(name, unit, value);
  return writer_.read(numbers_.told(name, unit, "of a mesh's elimination", value));
}

// 1/Σ g, and 0 where nothing holds the node.
ExpressionId TunedMesh::inverse(ExpressionId pivot, const std::string& name) {
  if (pivot == nothing) return nothing;
  const ExpressionId sum = numbers_.named(joined(name, "sum"), "1", pivot);
  const ExpressionId quotient = numbers_.named(
      joined(name, "quotient"), "1", writer_.where(sum, writer_.divide(numbers_.one(), sum), numbers_.zero()));
  const ExpressionId is_finite = writer_.subtract(numbers_.one(), writer_.subtract(quotient, quotient));
  return writer_.where(is_finite, quotient, numbers_.zero());
}

// Eliminates node after node; each star becomes a mesh: g_jk += g_ij g_ik / Σ g_i.
TunedMesh::Shares TunedMesh::eliminated(const Row& of_edges, const std::string& prefix, bool is_kept) {
  Conductances all = joined_up(of_edges);
  const auto count = static_cast<std::size_t>(part_.node_count);
  Shares shares{all.weight, Row(count), Row(count), nothing};
  const auto product = [&](ExpressionId a, ExpressionId b) {
    return a == nothing || b == nothing ? ExpressionId(nothing) : writer_.multiply(a, b);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const int node = static_cast<int>(i);
    const std::string name = joined(prefix, node_name(node));
    const auto link = [&](std::size_t j) { return joined(prefix, link_name(node, static_cast<int>(j))); };
    all.to_port[i] = told(joined(name, "to_port"), "1", all.to_port[i], false);
    all.to_held[i] = told(joined(name, "to_held"), "1", all.to_held[i], false);
    ExpressionId pivot = writer_.plus(all.to_port[i], all.to_held[i]);
    for (std::size_t j = i + 1; j < count; ++j) {
      all.weight[i][j] = told(link(j), "1", all.weight[i][j], false);
      pivot = writer_.plus(pivot, all.weight[i][j]);
    }
    shares.inverse[i] = told(joined(name, "inverse"), "1", inverse(pivot, name), is_kept);
    shares.to_port[i] = told(joined(name, "port_share"), "1", product(all.to_port[i], shares.inverse[i]), is_kept);
    for (std::size_t j = i + 1; j < count; ++j)
      shares.weight[i][j] = told(joined(link(j), "share"), "1", product(all.weight[i][j], shares.inverse[i]), is_kept);
    for (std::size_t j = i + 1; j < count; ++j) {
      const ExpressionId share = shares.weight[i][j];
      for (std::size_t k = j + 1; k < count; ++k)
        all.weight[j][k] = writer_.plus(all.weight[j][k], product(share, all.weight[i][k]));
      all.to_port[j] = writer_.plus(all.to_port[j], product(share, all.to_port[i]));
      all.to_held[j] = writer_.plus(all.to_held[j], product(share, all.to_held[i]));
    }
    all.through = writer_.plus(all.through, product(shares.to_port[i], all.to_held[i]));
  }
  shares.through = told(joined(prefix, "through_" + node_name(0)), "1", all.through, false);
  return shares;
}

void TunedMesh::tune(const std::vector<ExpressionId>& values, ExpressionId rate) {
  Row dampers, both;
  for (int i = 0; i < part_.edge_count; ++i) {
    const ExpressionId value = values[static_cast<std::size_t>(i)];
    const bool is_spring = edge(i).spring != no_index;
    dampers.push_back(is_spring ? ExpressionId(nothing) : value);
    both.push_back(is_spring ? value : writer_.multiply(rate, value));
  }
  feedthrough_ = or_zero(eliminated(dampers, "viscous", false).through);
  shares_ = eliminated(both, "", true);
  stiffness_ = or_zero(shares_.through);
}

// The same with conductances g + s n as s goes to 0, to first order.
ExpressionId TunedMesh::viscosity(const std::vector<ExpressionId>& values) {
  Row springs, dampers;
  for (int i = 0; i < part_.edge_count; ++i) {
    const bool is_spring = edge(i).spring != no_index;
    springs.push_back(is_spring ? values[static_cast<std::size_t>(i)] : ExpressionId(nothing));
    dampers.push_back(is_spring ? ExpressionId(nothing) : values[static_cast<std::size_t>(i)]);
  }
  Conductances lead = joined_up(springs), next = joined_up(dampers);
  const auto count = static_cast<std::size_t>(part_.node_count);
  const auto tell = [&](const std::string& name, ExpressionId& leading, ExpressionId& following) {
    leading = told(joined(name, "slow"), "1", leading, false);
    following = told(joined(name, "slow_next"), "1", following, false);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = node_name(static_cast<int>(i));
    tell(joined(name, "to_port"), lead.to_port[i], next.to_port[i]);
    tell(joined(name, "to_held"), lead.to_held[i], next.to_held[i]);
    FirstOrder pivot{writer_.plus(lead.to_port[i], lead.to_held[i]), writer_.plus(next.to_port[i], next.to_held[i])};
    for (std::size_t j = i + 1; j < count; ++j) {
      tell(link_name(static_cast<int>(i), static_cast<int>(j)), lead.weight[i][j], next.weight[i][j]);
      pivot = {writer_.plus(pivot.lead, lead.weight[i][j]), writer_.plus(pivot.next, next.weight[i][j])};
    }
    tell(joined(name, "sum"), pivot.lead, pivot.next);
    const auto add_bridge = [&](FirstOrder a, FirstOrder b, ExpressionId& leading, ExpressionId& following) {
      FirstOrder sum{leading, following};
      bridge(a, b, pivot, sum);
      leading = sum.lead, following = sum.next;
    };
    const FirstOrder port{lead.to_port[i], next.to_port[i]}, held{lead.to_held[i], next.to_held[i]};
    for (std::size_t j = i + 1; j < count; ++j) {
      const FirstOrder weight{lead.weight[i][j], next.weight[i][j]};
      for (std::size_t k = j + 1; k < count; ++k)
        add_bridge(weight, {lead.weight[i][k], next.weight[i][k]}, lead.weight[j][k], next.weight[j][k]);
      add_bridge(weight, port, lead.to_port[j], next.to_port[j]);
      add_bridge(weight, held, lead.to_held[j], next.to_held[j]);
    }
    add_bridge(port, held, lead.through, next.through);
  }
  if (next.through == nothing) return numbers_.zero();
  const ExpressionId found = told(joined(node_name(0), "viscosity"), "1", next.through, false);
  return writer_.where(found, found, numbers_.zero());
}

// Adds a b/p to `sum`, to first order. If p is 0 in lowest order, so are a and b.
void TunedMesh::bridge(FirstOrder a, FirstOrder b, FirstOrder p, FirstOrder& sum) {
  const auto is_none = [](FirstOrder x) { return x.lead == nothing && x.next == nothing; };
  if (is_none(a) || is_none(b)) return;
  ExpressionId next = numbers_.zero();
  if (p.next != nothing)
    next = writer_.where(p.next, writer_.multiply(or_zero(a.next), writer_.divide(or_zero(b.next), p.next)),
                         numbers_.zero());
  if (p.lead != nothing) {
    const ExpressionId ratio = writer_.divide(or_zero(b.lead), p.lead);
    const ExpressionId lead = writer_.where(p.lead, writer_.multiply(or_zero(a.lead), ratio), numbers_.zero());
    sum.lead = writer_.plus(sum.lead, lead);
    const ExpressionId of_next = writer_.multiply(or_zero(a.next), ratio);
    const ExpressionId of_lead =
        writer_.multiply(writer_.divide(or_zero(a.lead), p.lead),
                         writer_.subtract(or_zero(b.next), writer_.multiply(ratio, or_zero(p.next))));
    next = writer_.where(p.lead, writer_.add(of_next, of_lead), next);
  }
  sum.next = writer_.plus(sum.next, next);
}

std::vector<ExpressionId> TunedMesh::moved(ExpressionId change) {
  Row pushes;
  for (const VariableId push : push_)
    pushes.push_back(push == no_variable ? ExpressionId(nothing) : writer_.read(push));
  return spread(shares_, pushes, change, "");
}

std::vector<ExpressionId> TunedMesh::loaded(const std::vector<ExpressionId>& values, ExpressionId position) {
  Row springs;
  for (int i = 0; i < part_.edge_count; ++i)
    springs.push_back(edge(i).spring != no_index ? values[static_cast<std::size_t>(i)] : ExpressionId(nothing));
  return spread(eliminated(springs, "loaded", false), Row(push_.size()), position, "loaded");
}

std::vector<ExpressionId> TunedMesh::spread(const Shares& shares, const Row& pushes, ExpressionId change,
                                            const std::string& prefix) {
  const auto count = static_cast<std::size_t>(part_.node_count);
  Row moved(count);
  for (std::size_t i = count; i-- > 0;) {
    ExpressionId sum = pushes[i] == nothing || shares.inverse[i] == nothing
                           ? ExpressionId(nothing)
                           : writer_.multiply(shares.inverse[i], pushes[i]);
    if (shares.to_port[i] != nothing) sum = writer_.plus(sum, writer_.multiply(shares.to_port[i], change));
    for (std::size_t j = i + 1; j < count; ++j)
      if (shares.weight[i][j] != nothing && moved[j] != nothing)
        sum = writer_.plus(sum, writer_.multiply(shares.weight[i][j], moved[j]));
    moved[i] = told(joined(joined(prefix, node_name(static_cast<int>(i))), "moved"), "m", sum, false);
  }
  const auto at = [&](int node) {
    return node >= 0 ? moved[static_cast<std::size_t>(node)] : node == mesh_port ? change : ExpressionId(nothing);
  };
  std::vector<ExpressionId> elongations;
  for (int i = 0; i < part_.edge_count; ++i) {
    const ExpressionId from = or_zero(at(edge(i).from)), to = at(edge(i).to);
    elongations.push_back(to == nothing ? from : writer_.subtract(from, to));
  }
  return elongations;
}

// A spring's force pulls its ends together; the push on a node is passed on to the nodes after it.
ExpressionId TunedMesh::held(const std::vector<ExpressionId>& forces) {
  Row pushes(push_.size());
  ExpressionId force = nothing, rest = nothing;
  for (int i = 0; i < part_.edge_count; ++i) {
    const ExpressionId pull = forces[static_cast<std::size_t>(i)];
    if (pull == nothing) continue;
    if (edge(i).from >= 0) {
      ExpressionId& push = pushes[static_cast<std::size_t>(edge(i).from)];
      push = writer_.subtract(or_zero(push), pull);
    }
    if (edge(i).to >= 0) {
      ExpressionId& push = pushes[static_cast<std::size_t>(edge(i).to)];
      push = writer_.add(or_zero(push), pull);
    }
    if (edge(i).from == mesh_port) force = writer_.plus(force, pull);
    else if (edge(i).to == mesh_port) force = writer_.subtract(or_zero(force), pull);
  }
  for (std::size_t i = 0; i < push_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      if (push_[j] != no_variable && shares_.weight[j][i] != nothing)
        pushes[i] = writer_.add(or_zero(pushes[i]), writer_.multiply(shares_.weight[j][i], writer_.read(push_[j])));
    if (push_[i] == no_variable) continue;
    numbers_.assign(push_[i], or_zero(pushes[i]), "");
    if (shares_.to_port[i] != nothing)
      rest = writer_.plus(rest, writer_.multiply(shares_.to_port[i], writer_.read(push_[i])));
  }
  return rest == nothing ? or_zero(force) : writer_.subtract(or_zero(force), rest);
}

}  // namespace dashpot::compiler
