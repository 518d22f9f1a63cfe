#include "discretise/tuned_regime.hpp"

#include <utility>

namespace dashpot::compiler {
namespace {

// Tool and ground come after the inner ends.
std::string end_name(std::size_t end, std::size_t count) {
  return end + 1 == count ? "ground" : end + 2 == count ? "tool" : "end_" + std::to_string(end + 1);
}

}  // namespace

TunedRegime::Part TunedRegime::of_slip(std::size_t place) {
  const ExpressionId slides = slides_[place];
  return {nothing, slides == nothing ? numbers_.one() : writer_.where(slides, numbers_.zero(), numbers_.one())};
}

// If one part is rigid, all are; else dampings add up.
TunedRegime::Part TunedRegime::in_parallel(const std::vector<Part>& children, const std::string& name) {
  Part whole;
  for (const Part& child : children) {
    whole.damping = writer_.plus(whole.damping, child.damping);
    whole.rigid = writer_.plus(whole.rigid, child.rigid);
  }
  if (whole.rigid != nothing) whole.rigid = numbers_.named(joined(name, "rigid"), "1", whole.rigid);
  if (whole.damping != nothing && whole.rigid != nothing)
    whole.damping = writer_.where(whole.rigid, numbers_.zero(), whole.damping);
  if (whole.damping != nothing)
    whole.damping = numbers_.named(joined(name, "damping"), writer_.damping(), whole.damping);
  return whole;
}

// If one part slides, all do; rigid parts drop out; the damping of the rest is 1/Σ 1/b.
TunedRegime::Part TunedRegime::in_series(const std::vector<Part>& children, const std::string& name) {
  ExpressionId inverse = nothing, joins = nothing, rigid = nothing;
  bool is_rigid = true;
  for (const Part& child : children) {
    is_rigid = is_rigid && child.rigid != nothing;
    if (child.rigid != nothing) rigid = rigid == nothing ? child.rigid : writer_.multiply(rigid, child.rigid);
    const ExpressionId there = child.rigid == nothing ? numbers_.zero() : child.rigid;
    const ExpressionId passes = child.damping == nothing ? there : writer_.where(child.damping, numbers_.one(), there);
    joins = joins == nothing ? passes : writer_.multiply(joins, passes);
    if (child.damping == nothing) continue;
    inverse = writer_.plus(
        inverse, writer_.where(child.damping, writer_.divide(numbers_.one(), child.damping), numbers_.zero()));
  }
  Part whole{nothing, is_rigid ? numbers_.named(joined(name, "rigid"), "1", rigid) : ExpressionId(nothing)};
  if (inverse == nothing) return whole;
  inverse = numbers_.named(joined(name, "inverse"), "1", inverse);
  const ExpressionId found = writer_.where(inverse, writer_.divide(numbers_.one(), inverse), numbers_.zero());
  whole.damping =
      numbers_.named(joined(name, "damping"), writer_.damping(), writer_.where(joins, found, numbers_.zero()));
  return whole;
}

ExpressionId TunedRegime::of_tree(const std::vector<slip_node<double>>& nodes, const std::string& prefix) {
  std::vector<Part> parts(nodes.size());
  for (std::size_t k = nodes.size(); k-- > 0;) {
    const slip_node<double>& node = nodes[k];
    const auto place = static_cast<std::size_t>(node.place);
    const std::string name = joined(prefix, "part_" + std::to_string(k));
    const auto first = parts.begin() + node.first_child;
    const std::vector<Part> children(first, first + node.child_count);
    switch (node.kind) {
      case slip_part::block: parts[k].damping = damping_[place]; break;
      case slip_part::slip: parts[k] = of_slip(place); break;
      case slip_part::series: parts[k] = in_series(children, name); break;
      case slip_part::parallel: parts[k] = in_parallel(children, name); break;
    }
  }
  return or_zero(parts.front().damping);
}

void TunedRegime::join(Matrix& between, std::size_t a, std::size_t b, ExpressionId damping, ExpressionId rigid) {
  Part& part = a < b ? between[a][b] : between[b][a];
  if (damping != nothing) part.damping = writer_.plus(part.damping, damping);
  if (rigid != nothing) part.rigid = writer_.plus(part.rigid, rigid);
}

// If the node is rigid with another, its joins go over to the first such node; else the star becomes a mesh.
void TunedRegime::eliminate(Matrix& between, std::size_t node, const std::string& name) {
  std::vector<std::pair<std::size_t, Part>> joins;
  ExpressionId is_left = nothing, sum = nothing;  // `nothing` if no join is rigid
  for (std::size_t other = 0; other < between.size(); ++other) {
    Part& part = node < other ? between[node][other] : between[other][node];
    if (other == node || (part.damping == nothing && part.rigid == nothing)) continue;
    const std::string both = joined(name, "to_" + end_name(other, between.size()));
    if (part.damping != nothing) part.damping = numbers_.named(both, writer_.damping(), part.damping);
    if (part.rigid != nothing) part.rigid = numbers_.named(joined(both, "rigid"), "1", part.rigid);
    sum = writer_.plus(sum, part.damping);
    joins.emplace_back(other, std::exchange(part, {}));
  }
  const auto only_where = [&](ExpressionId condition, ExpressionId value) {
    return value == nothing || condition == nothing ? value : writer_.where(condition, value, numbers_.zero());
  };
  for (const auto& [with, part] : joins) {
    if (part.rigid == nothing) continue;
    const std::string both = joined(name, "is_with_" + end_name(with, between.size()));
    const ExpressionId is_it = numbers_.named(both, "1", only_where(is_left, part.rigid));
    const ExpressionId was_left = is_left == nothing ? numbers_.one() : is_left;
    is_left = numbers_.named(joined(name, "is_left_after_" + end_name(with, between.size())), "1",
                             writer_.where(part.rigid, numbers_.zero(), was_left));
    for (const auto& [other, moved] : joins)
      if (other != with) join(between, with, other, only_where(is_it, moved.damping), only_where(is_it, moved.rigid));
  }
  if (sum == nothing) return;
  sum = numbers_.named(joined(name, "sum"), writer_.damping(), sum);
  for (std::size_t i = 0; i < joins.size(); ++i)
    for (std::size_t j = i + 1; j < joins.size(); ++j) {
      const ExpressionId a = joins[i].second.damping, b = joins[j].second.damping;
      if (a == nothing || b == nothing) continue;
      const ExpressionId mesh = only_where(sum, writer_.divide(writer_.multiply(a, b), sum));
      join(between, joins[i].first, joins[j].first, only_where(is_left, mesh), nothing);
    }
}

ExpressionId TunedRegime::of_graph(int end_count, int tool, const std::vector<TunableEnds>& ties,
                                   const std::vector<TunableEnds>& links, const std::string& prefix) {
  const auto size = static_cast<std::size_t>(end_count) + 2;
  Matrix between(size, std::vector<Part>(size));
  const auto place = [](int end) { return static_cast<std::size_t>(end); };
  for (std::size_t i = 0; i < ties.size(); ++i)
    join(between, place(ties[i].from), place(ties[i].to), damping_[i], nothing);
  for (std::size_t k = 0; k < links.size(); ++k)
    join(between, place(links[k].from), place(links[k].to), nothing, of_slip(k).rigid);
  for (int node = 0; node < end_count; ++node)
    if (node != tool) eliminate(between, place(node), joined(prefix, end_name(place(node), size)));
  const Part& whole = between[place(tool)][size - 1];
  if (whole.damping == nothing) return numbers_.zero();
  return whole.rigid == nothing ? whole.damping : writer_.where(whole.rigid, numbers_.zero(), whole.damping);
}

}  // namespace dashpot::compiler
