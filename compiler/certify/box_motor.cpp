#include "certify/box_motor.hpp"

#include <algorithm>
#include <cmath>

#include "discretise/rounding.hpp"

namespace dashpot::compiler {
namespace {

// base + Σ factors[i] θ_i
struct Affine {
  double base = 0;
  std::vector<double> factors;
};

Affine plus(Affine first, const Affine& second, double weight = 1) {
  first.base += weight * second.base;
  first.factors.resize(std::max(first.factors.size(), second.factors.size()), 0);
  for (std::size_t i = 0; i < second.factors.size(); ++i) first.factors[i] += weight * second.factors[i];
  return first;
}

// What a cut holds: springs' and modes' β, and b∞.
struct BoxCut {
  Affine stiffness, damping;
};

BoxCut plus(const BoxCut& first, const BoxCut& second) {
  return {plus(first.stiffness, second.stiffness), plus(first.damping, second.damping)};
}

class Box {
 public:
  Box(const UpdateLaw& law, const BoxLoop& loop) : tables_(*law.tunable), scalar_(law.scalar), period_(law.sample_period), loop_(loop) {}

  BoxMotor motor() const {
    BoxMotor result;
    if (tables_.head.contact.is_there) return {0, 0, 0, "a contact, and parameters that change"};
    const std::vector<Affine> brakes = brake_choices();
    const double behind_slips = largest_behind_slips(), made_up = make_up(brakes, behind_slips);
    if (made_up > 0 && !loop_.gain) return {0, 0, 0, "nothing is proved for the estimator in the motor"};
    if (brakes.empty()) return {0, 0, 0, "the brake follows the viscosity of a mesh, which is not bounded over the box"};
    result.least_brake = std::max(0.0, least(brakes.front()));
    for (const Affine& brake : brakes) {
      result.least_brake = std::min(result.least_brake, std::max(0.0, least(brake)));
      result.largest_brake = std::max(result.largest_brake, most(brake));
      for (const Affine& gain : gains(brake)) {
        const bool is_rounding = most(gain) <= 1e-9 * (1 + std::abs(most(brake)));
        if (!is_rounding && !loop_.gain) return {0, 0, 0, "nothing is proved for the estimator in the motor"};
        Affine lacking = plus(plus({}, needed()), brake, -loop_.share);
        if (loop_.gain) lacking = plus(lacking, gain, loop_.hold * *loop_.gain);
        result.lacking = std::max(result.lacking, most(lacking) + (made_up > 0 ? loop_.hold * *loop_.gain * made_up : 0));
      }
    }
    result.largest_brake = std::min(result.largest_brake + behind_slips, tables_.head.max_damping);
    return result;
  }

  // Every relaxation gives no more work than its spring stores, wherever it is in the box.
  bool relaxations_give_no_energy() const {
    return std::all_of(tables_.parts.begin(), tables_.parts.end(), [&](const tunable_part<double>& part) {
      if (part.kind == tunable_kind::fixed_relaxation) return gives_no_energy(part.loss, part.share);
      if (part.kind != tunable_kind::relaxation || !tables_.head.is_exact) return true;  // (1 − φ)² + φ² ≤ 1, φ of 0 … 1
      const Affine spring = stiffness(part.spring), damper = number(part.damping);
      return exact_gives_no_energy(least(spring) * period_ / most(damper), most(spring) * period_ / least(damper));
    });
  }

 private:
  // a² + (1 − φ)² ≤ 1, with a = 1 − α; φ and α off by some 1e-15 or, in float, 1e-6 of themselves.
  bool gives_no_energy(double loss, double share) const {
    return loss * (2 - loss) * (1 + 64 * unit_roundoff(scalar_)) >= (1 - share) * (1 - share);
  }
  // α rises with x and φ falls: on a short interval the least α stands against the least φ. Below 1e-9, α > x/2 and
  // 1 − φ < x; beyond 700, α = 1 in double.
  bool exact_gives_no_energy(double low, double high) const {
    for (double x = std::max(low, 1e-9); x < std::min(high, 700.0); x *= 1.05)
      if (!gives_no_energy(-std::expm1(-x), -std::expm1(-1.05 * x) / (1.05 * x))) return false;
    return true;
  }

  Affine number(int index) const {
    const tunable_number<double>& n = tables_.numbers[static_cast<std::size_t>(index)];
    Affine value{n.base, std::vector<double>(tables_.tunables.size(), 0)};
    for (int i = n.first; i < n.first + n.count; ++i) value.factors[static_cast<std::size_t>(tables_.terms[static_cast<std::size_t>(i)])] += 1;
    return value;
  }

  double extreme(const Affine& f, bool largest) const {
    double value = f.base;
    for (std::size_t i = 0; i < f.factors.size(); ++i) {
      const tunable_range<double>& range = tables_.tunables[i].range;
      value += f.factors[i] * ((f.factors[i] > 0) == largest ? range.max : range.min);
    }
    return value;
  }
  double most(const Affine& f) const { return extreme(f, true); }
  double least(const Affine& f) const { return extreme(f, false); }

  template <class Visit>
  void each_part(const tunable_block& block, Visit visit) const {
    for (int i = block.first_part; i < block.first_part + block.part_count; ++i) visit(tables_.parts[static_cast<std::size_t>(i)]);
  }

  Affine stiffness(int spring) const { return number(tables_.springs[static_cast<std::size_t>(spring)]); }

  BoxCut cut_of(const tunable_part<double>& part) const {
    switch (part.kind) {
      case tunable_kind::damper: return {{}, number(part.damping)};
      case tunable_kind::spring: return {plus({}, stiffness(part.spring), 0.5), {}};
      case tunable_kind::relaxation: return {plus({}, stiffness(part.spring), tables_.head.is_exact ? largest_relaxation_hold : 0.5), {}};
      case tunable_kind::fixed_relaxation: return {plus({}, stiffness(part.spring), relaxation_hold(part.share, part.loss)), {}};
      case tunable_kind::mesh: break;
    }
    return cut_at_port(part);
  }

  // The mesh's own edges at the port's side.
  BoxCut cut_at_port(const tunable_part<double>& part) const {
    BoxCut cut;
    for (int i = part.first_edge; i < part.first_edge + part.edge_count; ++i) {
      const tunable_edge& edge = tables_.edges[static_cast<std::size_t>(i)];
      if ((edge.from == mesh_port) == (edge.to == mesh_port)) continue;
      if (edge.spring != no_index) cut.stiffness = plus(cut.stiffness, stiffness(edge.spring), 0.5);
      else cut.damping = plus(cut.damping, number(edge.damping));
    }
    return cut;
  }

  BoxCut cut_of(const tunable_block& block) const {
    BoxCut cut;
    each_part(block, [&](const tunable_part<double>& part) { cut = plus(cut, cut_of(part)); });
    return cut;
  }

  double cost(const BoxCut& cut) const { return most(cut.stiffness) * period_ * loop_.lateness * loop_.lateness + most(cut.damping); }

  // No softer than the law makes blocks behind slips.
  BoxCut bounded_cut(int block) const {
    BoxCut cut = cut_of(tables_.blocks[static_cast<std::size_t>(block)]);
    cut.stiffness.base += tables_.head.least_share * 2 * (most(cut.stiffness) + most(cut.damping) / period_);
    return cut;
  }

  // As least_cut() of a tree, by what a cut asks for at the box's far corner.
  std::optional<BoxCut> least_cut(const tunable_coupling& coupling, int index) const {
    const slip_node<double>& node = tables_.nodes[static_cast<std::size_t>(coupling.first_node + index)];
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

  // Of slips in no tree the least of all ways to take ends to the tool's side, no slip between the sides. There is one: no path
  // of slips alone joins tool and ground.
  BoxCut least_cut(const tunable_graph& graph) const {
    std::vector<BoxCut> cuts;
    for (int i = 0; i < graph.tie_count; ++i) cuts.push_back(bounded_cut(graph.first_block + i));
    const auto separates = [&](unsigned at_tool, const tunable_ends& ends) {
      const auto is_at_tool = [&](int end) { return end == graph.end_count || (end < graph.end_count && (at_tool >> end & 1u) != 0); };
      return is_at_tool(ends.from) != is_at_tool(ends.to);
    };
    std::optional<unsigned> least;
    double least_cost = 0;
    for (unsigned at_tool = 0; at_tool < 1u << graph.end_count; ++at_tool) {
      bool is_crossed = false;
      for (int k = graph.first_slip; k < graph.first_slip + graph.link_count; ++k) is_crossed |= separates(at_tool, tables_.links[static_cast<std::size_t>(k)]);
      double sum = 0;
      for (std::size_t i = 0; i < cuts.size(); ++i)
        if (separates(at_tool, tie(graph, i))) sum += cost(cuts[i]);
      if (is_crossed || (least && sum >= least_cost)) continue;
      least = at_tool;
      least_cost = sum;
    }
    BoxCut cut;
    for (std::size_t i = 0; i < cuts.size(); ++i)
      if (separates(least.value(), tie(graph, i))) cut = plus(cut, cuts[i]);
    return cut;
  }

  const tunable_ends& tie(const tunable_graph& graph, std::size_t i) const { return tables_.ties[static_cast<std::size_t>(graph.first_tie) + i]; }

  // T_max β lateness² + b∞(cut) T_max/h. Dampers that join tool and ground are the brake's; those of a mesh as far as none of
  // its nodes is between.
  Affine needed() const {
    BoxCut cut;
    each_part(tables_.blocks.front(), [&](const tunable_part<double>& part) {
      if (part.kind != tunable_kind::damper) cut = plus(cut, cut_of(part));
    });
    for (const tunable_coupling& coupling : tables_.couplings) cut = plus(cut, least_cut(coupling, 0).value());
    for (const tunable_graph& graph : tables_.graphs) cut = plus(cut, least_cut(graph));
    const double margin = 1 + 64 * unit_roundoff(scalar_);
    const Affine all = plus(plus({}, cut.stiffness, period_ * loop_.lateness * loop_.lateness), cut.damping);
    return plus({}, all, loop_.hold * margin);
  }

  // b∞: the dampers between tool and ground. A mesh's is between nothing and its dampers at the port.
  Affine feedthrough() const {
    Affine sum;
    each_part(tables_.blocks.front(), [&](const tunable_part<double>& part) {
      if (part.kind == tunable_kind::damper) sum = plus(sum, number(part.damping));
    });
    return sum;
  }
  Affine of_meshes() const {
    Affine sum;
    each_part(tables_.blocks.front(), [&](const tunable_part<double>& part) {
      if (part.kind == tunable_kind::mesh) sum = plus(sum, cut_at_port(part).damping);
    });
    return sum;
  }
  // Z(0) of what is no mesh.
  Affine zero_frequency() const {
    Affine sum = feedthrough();
    each_part(tables_.blocks.front(), [&](const tunable_part<double>& part) {
      if (part.kind == tunable_kind::relaxation || part.kind == tunable_kind::fixed_relaxation) sum = plus(sum, number(part.damping));
    });
    return sum;
  }

  bool has_meshes() const {
    bool found = false;
    each_part(tables_.blocks.front(), [&](const tunable_part<double>& part) { found = found || part.kind == tunable_kind::mesh; });
    return found;
  }

  // No regime has more b∞ than all dampers behind slips, and meshes theirs at the port.
  double largest_behind_slips() const {
    double sum = 0;
    for (std::size_t i = 1; tables_.head.slip_rule.takes_part && i < tables_.blocks.size(); ++i)
      each_part(tables_.blocks[i], [&](const tunable_part<double>& part) { sum += most(cut_of(part).damping); });
    return sum;
  }

  // Of a brake on its way, what the motor makes up at most.
  double make_up(const std::vector<Affine>& brakes, double behind_slips) const {
    double largest = 0;
    for (const Affine& brake : brakes) largest = std::max(largest, most(brake));
    const tunable_slip_rule<double>& rule = tables_.head.slip_rule;
    return rule.coil_share < 1 ? std::min(behind_slips, rule.assured_share * largest) : 0;
  }

  // The rule's functions, and the brake's reach. Empty where the rule looks into a mesh.
  std::vector<Affine> brake_choices() const {
    const tunable_tables<double>& head = tables_.head;
    std::vector<Affine> choices;
    const Affine constant{head.damping, {}};
    switch (head.rule) {
      case brake_rule::constant: choices = {constant}; break;
      case brake_rule::observed: choices = {number(head.observed)}; break;
      case brake_rule::feedthrough: choices = {feedthrough()}; break;
      case brake_rule::zero_frequency: choices = {zero_frequency()}; break;
      case brake_rule::half_zero_frequency: choices = {plus({}, zero_frequency(), 0.5), feedthrough()}; break;
      case brake_rule::within_viscosity: choices = {constant, zero_frequency()}; break;
    }
    const bool looks_into_mesh = head.rule != brake_rule::constant && head.rule != brake_rule::observed;
    if (looks_into_mesh && has_meshes()) return {};
    if (std::any_of(choices.begin(), choices.end(), [&](const Affine& b) { return most(b) > head.max_damping; })) {
      std::erase_if(choices, [&](const Affine& b) { return least(b) >= head.max_damping; });
      choices.push_back({head.max_damping, {}});
    }
    return choices;
  }

  // |b∞ − b| is one of these or less.
  std::vector<Affine> gains(const Affine& brake) const {
    const Affine difference = plus(feedthrough(), brake, -1);
    return {plus(difference, of_meshes()), plus({}, difference, -1)};
  }

  const TunableTables& tables_;
  ScalarType scalar_;
  double period_;
  const BoxLoop& loop_;
};

}  // namespace

double relaxation_hold(double share, double loss) {
  const double a = 1 - loss, A = loss * (2 - loss) / 2, B = a * (1 - share), C = share - share * share / 2;
  const double determinant = A * C - B * B / 4;
  // What vanishes within a sample answers once, with k φ.
  if (!(determinant > 0)) return std::max(share, 0.57);
  return (loss * loss * C + loss * share * B + share * share * A) / (4 * determinant) * (1 + 1e-9);
}

BoxMotor box_motor(const UpdateLaw& law, const BoxLoop& loop) { return Box(law, loop).motor(); }

EnergyLemma check_energy_lemma_over_box(const UpdateLaw& law) {
  const BoxLoop unused{1, 1, std::nullopt, 1};
  EnergyLemma lemma;
  lemma.applies = lemma.over_box = true;
  lemma.with_slips = !law.tunable->yields.empty();
  lemma.holds = Box(law, unused).relaxations_give_no_energy();
  return lemma;
}

}  // namespace dashpot::compiler
