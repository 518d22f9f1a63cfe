#include "verify/reference_box.hpp"

#include <algorithm>

#include "verify/slip_rows.hpp"

namespace dashpot::compiler {
namespace {

struct SumCut {
  ReferenceSum stiffness, damping;
};

SumCut added(const SumCut& x, const SumCut& y) {
  return {added(x.stiffness, y.stiffness), added(x.damping, y.damping)};
}

// ψ: the largest of g·(F, δ) − A F² − B F δ − C δ², with g = (a − 1, φ); never above 0.57.
Reference hold_of(const ModeFactors& factors, const Reference& stiffness) {
  const Reference share = factors.gain / stiffness, &loss = factors.loss;
  const Reference A = loss * (2 - loss) / 2, B = (1 - loss) * (1 - share), C = share - share * share / 2;
  const Reference determinant = A * C - B * B / 4;
  return (loss * loss * C + loss * share * B + share * share * A) / (4 * determinant);
}

class Box {
 public:
  Box(const ReferenceTunables& tunables, const TunableTables& tables, const ReferenceLoop& loop, const LawFacts& facts)
      : tunables_(tunables), tables_(tables), loop_(loop), facts_(facts) {}

  std::optional<ReferenceBox> find() const {
    const std::vector<ReferenceSum> brakes = brakes_of_rule();
    const Reference behind_slips = largest_behind_slips(), made_up = make_up(brakes, behind_slips);
    if (brakes.empty() || (made_up > 0 && !loop_.gain)) return std::nullopt;
    const ReferenceSum asked = needed();
    const bool may_part =
        loop_.out_of_step && std::any_of(brakes.begin(), brakes.end(),
                                         [&](const ReferenceSum& brake) { return most(brake) != least(brake); });
    std::optional<Reference> worst;  // below 0 if there is more than is needed
    ReferenceBox box{0, std::max(Reference(0), least(brakes.front())), 0, gain_of_step(brakes, made_up)};
    for (const ReferenceSum& brake : brakes) {
      box.least_brake = std::min(box.least_brake, std::max(Reference(0), least(brake)));
      box.largest_brake = std::max(box.largest_brake, most(brake));
      const ReferenceSum difference = added(feedthrough(), brake, -1);
      for (const ReferenceSum& gain : {added(difference, at_ports_of_meshes()), added({}, difference, -1)}) {
        ReferenceSum lacking = may_part ? asked : added(asked, brake, -loop_.share);
        if (loop_.gain) lacking = added(lacking, gain, loop_.hold * *loop_.gain);
        const Reference extra = made_up > 0 ? Reference(loop_.hold * *loop_.gain * made_up) : Reference(0);
        const Reference here = most(lacking) + extra;
        worst = worst ? std::max(*worst, here) : here;
      }
    }
    box.largest_brake = std::min(Reference(box.largest_brake + behind_slips), Reference(tables_.brake.max_damping));
    box.lacking = may_part ? Reference(*worst - loop_.share * box.least_brake) : *worst;
    return box;
  }

 private:
  Reference most(const ReferenceSum& sum) const { return extreme(sum, true); }
  Reference least(const ReferenceSum& sum) const { return extreme(sum, false); }
  Reference extreme(const ReferenceSum& sum, bool largest) const {
    Reference value = sum.base;
    for (std::size_t i = 0; i < sum.factors.size(); ++i) {
      const Parameter& parameter = *tunables_.parameters[i];
      value += sum.factors[i] * Reference((sum.factors[i] > 0) == largest ? parameter.max : parameter.min);
    }
    return value;
  }

  static SumCut port_of(const std::vector<ReferenceEdge>& mesh) {
    SumCut cut;
    for (const ReferenceEdge& edge : mesh) {
      if (!edge.is_at_port) continue;
      if (edge.is_spring) cut.stiffness = added(cut.stiffness, edge.value, Reference(1) / 2);
      else cut.damping = added(cut.damping, edge.value);
    }
    return cut;
  }

  SumCut cut_but_for_dampers(const ReferenceBlock& block) const {
    SumCut cut{added({}, block.stiffness, Reference(1) / 2), {}};
    const Reference of_any = tables_.is_exact ? Reference(57) / 100 : Reference(1) / 2;
    for (const ReferenceRelaxation& r : block.relaxations) {
      const Reference share = r.is_fixed ? hold_of(r.factors, r.stiffness.base) : of_any;
      cut.stiffness = added(cut.stiffness, r.stiffness, share);
    }
    for (const std::vector<ReferenceEdge>& mesh : block.meshes) cut = added(cut, port_of(mesh));
    return cut;
  }

  // Behind slips a block's stiffness is not allowed to fall below a share of its largest.
  SumCut cut_of(const ReferenceBlock& block) const {
    SumCut cut = cut_but_for_dampers(block);
    cut.damping = added(cut.damping, block.damping);
    cut.stiffness.base +=
        Reference(tables_.least_share) * 2 * (most(cut.stiffness) + most(cut.damping) * Reference(facts_.rate));
    return cut;
  }

  Reference cost(const SumCut& cut) const {
    return most(cut.stiffness) * loop_.lateness * loop_.lateness / Reference(facts_.rate) + most(cut.damping);
  }

  std::optional<SumCut> least_cut(const ReferencePart& part, std::vector<ReferenceBlock>::const_iterator& block) const {
    if (part.kind == ReferencePart::Kind::slip) return std::nullopt;
    if (part.kind == ReferencePart::Kind::block) return cut_of(*block++);
    std::optional<SumCut> best;
    SumCut sum;
    bool is_whole = true;
    for (const ReferencePart& child : part.children) {
      const std::optional<SumCut> cut = least_cut(child, block);
      is_whole = is_whole && cut;
      if (cut) sum = added(sum, *cut);
      if (cut && (!best || cost(*cut) < cost(*best))) best = cut;
    }
    if (part.kind == ReferencePart::Kind::series) return best;
    return is_whole ? std::optional(sum) : std::nullopt;
  }

  // For slips in no tree: tries every way to choose the ends on the tool's side such that no slip crosses the cut.
  SumCut least_cut(const ReferenceGraph& graph) const {
    std::optional<std::size_t> best;
    Reference least = 0;
    std::vector<SumCut> cuts;
    std::vector<Reference> costs;
    for (const ReferenceTie& tie : graph.ties) {
      cuts.push_back(cut_of(tie.block));
      costs.push_back(cost(cuts.back()));
    }
    const auto is_at_tool = [&](std::size_t pattern, NodeIndex node) {
      const auto place = std::find(graph.ends.begin(), graph.ends.end(), node);
      return place == graph.ends.end() ? node == tool : (pattern >> (place - graph.ends.begin()) & 1u) != 0;
    };
    for (std::size_t pattern = 0; pattern < std::size_t{1} << graph.ends.size(); ++pattern) {
      const auto at_tool = [&](NodeIndex node) { return is_at_tool(pattern, node); };
      if (std::any_of(graph.slips.begin(), graph.slips.end(),
                      [&](const auto& slip) { return at_tool(slip.first) != at_tool(slip.second); }))
        continue;
      Reference sum = 0;
      for (std::size_t i = 0; i < cuts.size(); ++i)
        if (at_tool(graph.ties[i].from) != at_tool(graph.ties[i].to)) sum += costs[i];
      if (best && sum >= least) continue;
      best = pattern;
      least = sum;
    }
    SumCut cut;
    for (std::size_t i = 0; i < cuts.size(); ++i)
      if (is_at_tool(best.value(), graph.ties[i].from) != is_at_tool(best.value(), graph.ties[i].to))
        cut = added(cut, cuts[i]);
    return cut;
  }

  ReferenceSum needed() const {
    SumCut cut = cut_but_for_dampers(tunables_.linear);
    for (std::size_t i = 0; i < tunables_.blocks.size(); ++i) {
      auto block = tunables_.blocks[i].begin();
      cut = added(cut, least_cut(tunables_.tree.components[i], block).value());
    }
    for (const ReferenceGraph& graph : tunables_.graphs) cut = added(cut, least_cut(graph));
    const ReferenceSum held = added({}, cut.stiffness, loop_.lateness * loop_.lateness / Reference(facts_.rate));
    return added({}, added(held, cut.damping), loop_.hold);
  }

  ReferenceSum feedthrough() const { return tunables_.linear.damping; }
  ReferenceSum at_ports_of_meshes() const {
    ReferenceSum sum;
    for (const std::vector<ReferenceEdge>& mesh : tunables_.linear.meshes) sum = added(sum, port_of(mesh).damping);
    return sum;
  }
  ReferenceSum zero_frequency() const {
    ReferenceSum sum = feedthrough();
    for (const ReferenceRelaxation& r : tunables_.linear.relaxations) sum = added(sum, r.damping);
    return sum;
  }

  // k + 2 c, and twice the dampers where they are not the brake's; of a mesh twice what its edges at the port answer
  // within a sample.
  ReferenceSum gain_of(const ReferenceBlock& block, bool with_dampers) const {
    ReferenceSum sum = block.stiffness;
    const Reference rate(facts_.rate);
    if (with_dampers) sum = added(sum, block.damping, 2 * rate);
    for (const ReferenceRelaxation& r : block.relaxations)
      sum = added(sum, r.stiffness, r.is_fixed ? Reference(2 * r.factors.gain / r.stiffness.base) : Reference(2));
    for (const std::vector<ReferenceEdge>& mesh : block.meshes)
      sum = added(added(sum, port_of(mesh).stiffness, 4), port_of(mesh).damping, 2 * rate);
    return sum;
  }

  std::optional<ReferenceGain> gain_of_step(const std::vector<ReferenceSum>& brakes, const Reference& made_up) const {
    Reference sum = most(gain_of(tunables_.linear, false)), follows = 0, largest = 0;
    for (std::size_t i = 0; i < tunables_.blocks.size(); ++i) {
      const ReferencePart& component = tunables_.tree.components[i];
      auto block = tunables_.blocks[i].begin();
      for (const ReferencePart& child : component.children) {
        if (child.kind == ReferencePart::Kind::block)
          sum += most(gain_of(*block, true)) * (1 + 2 * Reference(tables_.least_share));
        block += std::ptrdiff_t(blocks_of(child).size());
      }
    }
    for (const ReferenceSum& brake : brakes) {
      const ReferenceSum difference = added(feedthrough(), brake, -1);
      follows = std::max({follows, most(added(difference, at_ports_of_meshes())), most(added({}, difference, -1))});
      largest = std::max(largest, most(brake));
    }
    follows += made_up;
    const Reference rounding =
        largest * Reference(facts_.scalar == ScalarType::float64 ? 0x1p-49 : 0x1p-20);  // of b∞ − b
    if (!(follows > rounding))
      return ReferenceGain{sum, loop_.pulse ? Reference(sum + 2 * rounding * loop_.pulse->most) : sum};
    if (!loop_.pulse) return std::nullopt;
    return ReferenceGain{sum + (follows - rounding) * loop_.pulse->least,
                         sum + (follows + rounding) * loop_.pulse->most};
  }

  Reference largest_behind_slips() const {
    Reference sum = 0;
    if (!tables_.head.slip_rule.takes_part) return sum;
    for (const std::vector<ReferenceBlock>& component : tunables_.blocks)
      for (const ReferenceBlock& block : component) sum += most(cut_of(block).damping);
    for (const ReferenceGraph& graph : tunables_.graphs)
      for (const ReferenceTie& tie : graph.ties) sum += most(cut_of(tie.block).damping);
    return sum;
  }

  Reference make_up(const std::vector<ReferenceSum>& brakes, const Reference& behind_slips) const {
    Reference largest = 0;
    for (const ReferenceSum& brake : brakes) largest = std::max(largest, most(brake));
    return std::min(behind_slips, Reference(tables_.brake.assured_share * largest));
  }

  ReferenceSum observed() const {
    const TunableNumber& number = tables_.numbers[std::size_t(tables_.brake.observed)];
    ReferenceSum sum{number.base, std::vector<Reference>(tunables_.parameters.size(), 0)};
    for (const TunableTerm& term : number.terms) sum.factors[term.tunable] += Reference(term.share);
    return sum;
  }

  std::vector<ReferenceSum> brakes_of_rule() const {
    const BrakeFollows follows = tables_.brake.follows;
    const ReferenceSum constant{tables_.brake.damping, {}};
    const bool looks_inside = follows != BrakeFollows::constant && follows != BrakeFollows::observed;
    std::vector<ReferenceSum> all;
    if (looks_inside && !tunables_.linear.meshes.empty()) return all;
    switch (follows) {
      case BrakeFollows::constant: all = {constant}; break;
      case BrakeFollows::observed: all = {observed()}; break;
      case BrakeFollows::feedthrough: all = {feedthrough()}; break;
      case BrakeFollows::zero_frequency: all = {zero_frequency()}; break;
      case BrakeFollows::half_zero_frequency:
        all = {added({}, zero_frequency(), Reference(1) / 2), feedthrough()};
        break;
      case BrakeFollows::within_viscosity: all = {constant, zero_frequency()}; break;
    }
    const Reference reach = tables_.brake.max_damping;
    if (std::none_of(all.begin(), all.end(), [&](const ReferenceSum& b) { return most(b) > reach; })) return all;
    std::erase_if(all, [&](const ReferenceSum& b) { return least(b) >= reach; });
    all.push_back({reach, {}});
    return all;
  }

  const ReferenceTunables& tunables_;
  const TunableTables& tables_;
  const ReferenceLoop& loop_;
  const LawFacts& facts_;
};

}  // namespace

std::optional<ReferenceBox> reference_box(const ReferenceTunables& tunables, const TunableTables& tables,
                                          const ReferenceLoop& loop, const LawFacts& facts) {
  return Box(tunables, tables, loop, facts).find();
}

}  // namespace dashpot::compiler
