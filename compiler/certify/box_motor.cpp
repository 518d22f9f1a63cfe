#include "certify/box_motor.hpp"

#include <algorithm>

#include "certify/box_numbers.hpp"
#include "certify/hold_bound.hpp"
#include "discretise/rounding.hpp"

namespace dashpot::compiler {
namespace {

// The sums over a cut: β of springs and modes, and b∞.
struct BoxCut {
  Affine stiffness, damping;
};

BoxCut plus(const BoxCut& first, const BoxCut& second) {
  return {plus(first.stiffness, second.stiffness), plus(first.damping, second.damping)};
}

class Box : private BoxNumbers {
 public:
  Box(const UpdateLaw& law, const BoxLoop& loop)
      : BoxNumbers(*law.tunable), scalar_(law.scalar), period_(law.sample_period), loop_(loop) {}

  BoxMotor motor() const {
    if (tables_.head.contact.is_there) return nothing_for("a contact, and parameters that change");
    const std::vector<Affine> brakes = brake_choices();
    const Rational behind_slips = largest_behind_slips(), made_up = make_up(brakes, behind_slips);
    if (made_up > 0 && !loop_.gain) return nothing_for("nothing is proved for the estimator in the motor");
    if (brakes.empty())
      return nothing_for(
          "the brake follows the damping of elements that lie neither beside each other nor in series, and nothing "
          "bounds that over the ranges of the parameters; with a brake whose damping does not change, as with "
          "--decomposition 0, there is a bound");
    const Affine asked = needed();
    // A command that no parameter changes finds brake and motor in step.
    const bool may_part = loop_.out_of_step &&
                          std::ranges::any_of(brakes, [&](const Affine& brake) { return most(brake) != least(brake); });
    std::optional<Rational> worst;  // below 0 if there is more than is needed
    Rational least_brake = std::max(Rational(0), least(brakes.front())), largest_brake = 0, largest_gain = 0;
    for (const Affine& brake : brakes) {
      least_brake = std::min(least_brake, std::max(Rational(0), least(brake)));
      largest_brake = std::max(largest_brake, most(brake));
      for (const Affine& gain : gains(brake)) {
        const bool is_rounding = most(gain) <= Rational(1e-9) * (1 + abs(most(brake)));
        if (!is_rounding && !loop_.gain) return nothing_for("nothing is proved for the estimator in the motor");
        if (!is_rounding) largest_gain = std::max(largest_gain, most(gain));
        Affine lacking = may_part ? asked : plus(asked, brake, -loop_.share);
        if (loop_.gain) lacking = plus(lacking, gain, loop_.hold * Rational(*loop_.gain));
        const Rational here =
            most(lacking) + (made_up > 0 ? Rational(loop_.hold * Rational(*loop_.gain) * made_up) : Rational(0));
        worst = worst ? std::max(*worst, here) : here;
      }
    }
    if (may_part) *worst -= loop_.share * least_brake;
    largest_brake = std::min(Rational(largest_brake + behind_slips), Rational(tables_.brake.max_damping));
    return {ceiling(*worst),
            -ceiling(-least_brake),
            ceiling(largest_brake),
            "",
            quantisation_gain(brakes, made_up),
            ceiling(most(asked)),
            ceiling(Rational(largest_gain + made_up))};
  }

 private:
  static BoxMotor nothing_for(std::string reason) { return {0, 0, 0, std::move(reason)}; }

  BoxCut cut_of(const BlockPart& part) const {
    switch (part.kind) {
      case PartKind::damper: return {{}, number(part.damping)};
      case PartKind::spring: return {plus({}, stiffness(part.spring), half_), {}};
      case PartKind::relaxation: return {plus({}, stiffness(part.spring), hold_of(part)), {}};
      case PartKind::mesh: break;
    }
    return cut_at_port(part);
  }

  const std::optional<FixedRelaxation>& fixed(const BlockPart& part) const {
    return tables_.fixed[static_cast<std::size_t>(part.spring)];
  }

  // ψ of a relaxation; the largest possible one if it can be tuned.
  Rational hold_of(const BlockPart& part) const {
    if (fixed(part)) return Rational(relaxation_hold(fixed(part)->share, fixed(part)->loss));
    return tables_.is_exact ? Rational(largest_relaxation_hold) : half_;
  }

  // The mesh's own edges at the port's side.
  BoxCut cut_at_port(const BlockPart& part) const {
    BoxCut cut;
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
      const MeshEdge& edge = tables_.edges[static_cast<std::size_t>(i)];
      if ((edge.from == mesh_port) == (edge.to == mesh_port)) continue;
      if (edge.spring != no_index) cut.stiffness = plus(cut.stiffness, stiffness(edge.spring), half_);
      else cut.damping = plus(cut.damping, number(edge.damping));
    }
    return cut;
  }

  BoxCut cut_of(const TunableBlock& block) const {
    BoxCut cut;
    for (const BlockPart& part : parts_of(block)) cut = plus(cut, cut_of(part));
    return cut;
  }

  Rational squared_lateness() const { return Rational(loop_.lateness) * Rational(loop_.lateness); }
  Rational cost(const BoxCut& cut) const {
    return most(cut.stiffness) * period_ * squared_lateness() + most(cut.damping);
  }

  // The cut of a block behind slips, which the law keeps above a smallest stiffness.
  BoxCut bounded_cut(int block) const {
    BoxCut cut = cut_of(tables_.blocks[static_cast<std::size_t>(block)]);
    cut.stiffness.base += Rational(tables_.least_share) * 2 * (most(cut.stiffness) + most(cut.damping) / period_);
    return cut;
  }

  // The least cut of a tree, compared by what it asks for with every parameter at its largest.
  std::optional<BoxCut> least_cut(const TunableCoupling& coupling, int index) const {
    const slip_node<double>& node = node_of(coupling, index);
    if (node.kind == slip_part::slip) return std::nullopt;
    if (node.kind == slip_part::block) return bounded_cut(coupling.first_block + node.place);
    std::optional<BoxCut> least, sum = BoxCut{};
    for (int i = node.first_child; i < node.first_child + node.child_count; ++i) {
      const std::optional<BoxCut> child = least_cut(coupling, i);
      if (child && (!least || cost(*child) < cost(*least))) least = child;
      sum = sum && child ? std::optional(plus(*sum, *child)) : std::nullopt;
    }
    return node.kind == slip_part::series ? least : sum;
  }

  // For slips in no tree: the least of all ways to choose which ends are on the tool's side, with no slip between the
  // sides. There is one, since no path of slips alone joins tool and ground.
  BoxCut least_cut(const TunableGraph& graph) const {
    std::vector<BoxCut> cuts;
    std::vector<double> costs;  // rounded: any cut proves a bound, even if it is not quite the least
    for (int i = 0; i < graph.tie_count; ++i) {
      cuts.push_back(bounded_cut(graph.first_block + i));
      costs.push_back(cost(cuts.back()).convert_to<double>());
    }
    const auto separates = [&](unsigned at_tool, const TunableEnds& ends) {
      const auto is_at_tool = [&](int end) {
        return end == graph.end_count || (end < graph.end_count && (at_tool >> end & 1u) != 0);
      };
      return is_at_tool(ends.from) != is_at_tool(ends.to);
    };
    std::optional<unsigned> least;
    double least_cost = 0;
    for (unsigned at_tool = 0; at_tool < 1u << graph.end_count; ++at_tool) {
      bool is_crossed = false;
      for (int k = graph.first_slip; k < graph.first_slip + graph.link_count; ++k)
        is_crossed |= separates(at_tool, tables_.links[static_cast<std::size_t>(k)]);
      double sum = 0;
      for (std::size_t i = 0; i < cuts.size(); ++i)
        if (separates(at_tool, tie(graph, i))) sum += costs[i];
      if (is_crossed || (least && sum >= least_cost)) continue;
      least = at_tool;
      least_cost = sum;
    }
    BoxCut cut;
    for (std::size_t i = 0; i < cuts.size(); ++i)
      if (separates(least.value(), tie(graph, i))) cut = plus(cut, cuts[i]);
    return cut;
  }

  const TunableEnds& tie(const TunableGraph& graph, std::size_t i) const {
    return tables_.ties[static_cast<std::size_t>(graph.first_tie) + i];
  }

  // T_max β lateness² + b∞(cut) T_max/h. Dampers that join tool and ground directly are the brake's,
  // also within a mesh.
  Affine needed() const {
    BoxCut cut;
    for (const BlockPart& part : parts_of(tables_.blocks.front()))
      if (part.kind != PartKind::damper) cut = plus(cut, cut_of(part));
    for (const TunableCoupling& coupling : tables_.couplings) cut = plus(cut, least_cut(coupling, 0).value());
    for (const TunableGraph& graph : tables_.graphs) cut = plus(cut, least_cut(graph));
    const Rational margin = 1 + 64 * Rational(unit_roundoff(scalar_));  // for rounding in what set() computes
    const Affine all = plus(plus({}, cut.stiffness, period_ * squared_lateness()), cut.damping);
    return plus({}, all, loop_.hold * margin);
  }

  // b∞: the dampers between tool and ground. A mesh's is between nothing and its dampers at the port.
  Affine feedthrough() const {
    Affine sum;
    for (const BlockPart& part : parts_of(tables_.blocks.front()))
      if (part.kind == PartKind::damper) sum = plus(sum, number(part.damping));
    return sum;
  }
  Affine of_meshes() const {
    Affine sum;
    for (const BlockPart& part : parts_of(tables_.blocks.front()))
      if (part.kind == PartKind::mesh) sum = plus(sum, cut_at_port(part).damping);
    return sum;
  }
  // Z(0) without the meshes.
  Affine zero_frequency() const {
    Affine sum = feedthrough();
    for (const BlockPart& part : parts_of(tables_.blocks.front()))
      if (part.kind == PartKind::relaxation) sum = plus(sum, number(part.damping));
    return sum;
  }

  bool has_meshes() const {
    return std::ranges::any_of(
        parts_of(tables_.blocks.front()), [](PartKind kind) { return kind == PartKind::mesh; }, &BlockPart::kind);
  }

  // Upper bound of b∞ in any regime: all dampers behind slips, and those of meshes at the port.
  Rational largest_behind_slips() const {
    Rational sum = 0;
    for (std::size_t i = 1; tables_.head.slip_rule.takes_part && i < tables_.blocks.size(); ++i)
      for (const BlockPart& part : parts_of(tables_.blocks[i])) sum += most(cut_of(part).damping);
    return sum;
  }

  // The most damping that the motor adds while the coil lags.
  Rational make_up(const std::vector<Affine>& brakes, const Rational& behind_slips) const {
    Rational largest = 0;
    for (const Affine& brake : brakes) largest = std::max(largest, most(brake));
    return std::min(behind_slips, Rational(Rational(tables_.brake.assured_share) * largest));
  }

  // The functions that the brake's rule chooses from, and the brake's limit. Empty if the rule depends on a mesh.
  std::vector<Affine> brake_choices() const {
    const TunableBrake& rule = tables_.brake;
    std::vector<Affine> choices;
    const Affine constant{Rational(rule.damping), {}};
    switch (rule.follows) {
      case BrakeFollows::constant: choices = {constant}; break;
      case BrakeFollows::observed: choices = {number(rule.observed)}; break;
      case BrakeFollows::feedthrough: choices = {feedthrough()}; break;
      case BrakeFollows::zero_frequency: choices = {zero_frequency()}; break;
      case BrakeFollows::half_zero_frequency: choices = {plus({}, zero_frequency(), half_), feedthrough()}; break;
      case BrakeFollows::within_viscosity: choices = {constant, zero_frequency()}; break;
    }
    const Rational reach(rule.max_damping);
    const bool looks_into_mesh = rule.follows != BrakeFollows::constant && rule.follows != BrakeFollows::observed;
    if (looks_into_mesh && has_meshes()) return {};
    if (std::any_of(choices.begin(), choices.end(), [&](const Affine& b) { return most(b) > reach; })) {
      std::erase_if(choices, [&](const Affine& b) { return least(b) >= reach; });
      choices.push_back({reach, {}});
    }
    return choices;
  }

  // Bound of Σ|h_j| of a block: k for a spring, 2 c ≤ 2 k for a relaxation, and for a mesh twice the stiffness of its
  // edges at the port with the inner nodes held fast.
  Affine gain_of(const TunableBlock& block, bool with_dampers) const {
    Affine sum;
    for (const BlockPart& part : parts_of(block)) {
      switch (part.kind) {
        case PartKind::spring: sum = plus(sum, stiffness(part.spring)); break;
        case PartKind::relaxation:
          sum = plus(sum, stiffness(part.spring), fixed(part) ? 2 * Rational(fixed(part)->share) : Rational(2));
          break;
        case PartKind::damper: sum = with_dampers ? plus(sum, number(part.damping), 2 / period_) : sum; break;
        case PartKind::mesh: {
          const BoxCut cut = cut_at_port(part);
          sum = plus(plus(sum, cut.stiffness, 4), cut.damping, 2 / period_);
        }
      }
    }
    return sum;
  }

  const slip_node<double>& node_of(const TunableCoupling& coupling, int index) const {
    return tables_.nodes[static_cast<std::size_t>(coupling.first_node + index)];
  }

  // If a slip alone joins the ends, so that the part is rigid while none gives way: the least yield force, over the
  // box, of the strongest such slip. Empty if the part is not rigid.
  std::optional<Rational> hold_of(const TunableCoupling& coupling, int index) const {
    const slip_node<double>& node = node_of(coupling, index);
    if (node.kind == slip_part::block) return std::nullopt;
    if (node.kind == slip_part::slip) {
      const TunableYield& yield = tables_.yields[static_cast<std::size_t>(coupling.first_slip + node.place)];
      std::optional<Rational> least_cut;
      for (const int index_of_cut : cuts_of(yield)) {
        const Rational cut = least(number(index_of_cut));
        if (!least_cut || cut < *least_cut) least_cut = cut;
      }
      return least_cut;
    }
    std::optional<Rational> strongest, weakest;
    bool all_hold = true;
    for (int i = node.first_child; i < node.first_child + node.child_count; ++i) {
      const std::optional<Rational> child = hold_of(coupling, i);
      all_hold = all_hold && child;
      if (child && (!strongest || *child > *strongest)) strongest = child;
      if (child && (!weakest || *child < *weakest)) weakest = child;
    }
    if (node.kind == slip_part::parallel) return strongest;
    return all_hold ? weakest : std::nullopt;
  }

  // K of one block in series with a rigid part; empty for anything else, and if the encoder's step makes a slip give
  // way.
  std::optional<Rational> gain_of(const TunableCoupling& coupling) const {
    const slip_node<double>& root = node_of(coupling, 0);
    if (root.kind != slip_part::series) return std::nullopt;
    int blocks = 0, block = 0;
    for (int i = root.first_child; i < root.first_child + root.child_count; ++i)
      if (const slip_node<double>& child = node_of(coupling, i); child.kind == slip_part::block) {
        block = coupling.first_block + child.place;
        ++blocks;
      }
    if (blocks != 1) return std::nullopt;
    const TunableBlock& only = tables_.blocks[static_cast<std::size_t>(block)];
    const Rational largest = most(gain_of(only, true)) * (1 + 2 * Rational(tables_.least_share)),
                   of_step = largest * Rational(loop_.encoder_step) / 2;
    bool carried_by_slip = false, holds = true;
    for (int i = root.first_child; i < root.first_child + root.child_count; ++i) {
      const slip_part kind = node_of(coupling, i).kind;
      if (kind == slip_part::block) continue;
      const std::optional<Rational> hold = hold_of(coupling, i);
      if (!hold) return std::nullopt;
      carried_by_slip = carried_by_slip || kind == slip_part::slip;
      holds = holds && *hold >= of_step;
    }
    // Where parameters let a slip in series yield within a step, the force is no more than its yield force; this holds
    // if there is only one such slip.
    const bool is_motors = !tables_.head.slip_rule.takes_part || most(cut_of(only).damping) == 0;
    return holds || (carried_by_slip && root.child_count == 2 && is_motors) ? std::optional(largest) : std::nullopt;
  }

  // K for the worst parameters, between changes. Not bounded if slips meet in no tree.
  std::optional<double> quantisation_gain(const std::vector<Affine>& brakes, const Rational& made_up) const {
    if (!tables_.graphs.empty()) return std::nullopt;
    Rational sum = most(gain_of(tables_.blocks.front(), false));
    for (const TunableCoupling& coupling : tables_.couplings) {
      const std::optional<Rational> gain = gain_of(coupling);
      if (!gain) return std::nullopt;
      sum += *gain;
    }
    Rational follows = 0;
    for (const Affine& brake : brakes)
      for (const Affine& gain : gains(brake)) follows = std::max(follows, most(gain));
    follows += made_up;
    if (follows > 0 && !loop_.pulse) return std::nullopt;
    if (follows > 0) sum += follows * Rational(*loop_.pulse);
    return ceiling(sum * (1 + 64 * Rational(unit_roundoff(scalar_))));
  }

  // |b∞ − b| is at most the largest of these.
  std::vector<Affine> gains(const Affine& brake) const {
    const Affine difference = plus(feedthrough(), brake, -1);
    return {plus(difference, of_meshes()), plus({}, difference, -1)};
  }

  ScalarType scalar_;
  Rational period_;
  Rational half_{1, 2};
  const BoxLoop& loop_;
};

}  // namespace

double relaxation_hold(double share, double loss) {
  const Rational phi(share), alpha(loss);
  const Rational a = 1 - alpha, A = alpha * (2 - alpha) / 2, B = a * (1 - phi), C = phi - phi * phi / 2;
  const Rational determinant = A * C - B * B / 4;
  // A relaxation that vanishes within a sample has a force only once, with k φ.
  if (!(determinant > 0)) return std::max(share, largest_relaxation_hold);
  return ceiling((alpha * alpha * C + alpha * phi * B + phi * phi * A) / (4 * determinant));
}

BoxMotor box_motor(const UpdateLaw& law, const BoxLoop& loop) { return Box(law, loop).motor(); }

}  // namespace dashpot::compiler
