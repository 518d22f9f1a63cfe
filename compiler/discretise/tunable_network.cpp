#include "discretise/tunable_network.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "discretise/element_names.hpp"
#include "discretise/law_writer.hpp"
#include "discretise/mode_coefficients.hpp"
#include "discretise/rounding.hpp"
#include "discretise/slip_table.hpp"
#include "discretise/tunable_blocks.hpp"
#include "discretise/tunable_graph.hpp"
#include "linear/validity.hpp"
#include "network/effect.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

const Real offset_time("0.1");  // [s], in which an offset shrinks by 63 % if the tank has the energy

// The network with every parameter at its largest, so that no element is without effect.
Network at_largest(Network network) {
  for (Element& element : network.elements)
    if (const Parameter* tunable = network.tunable_of(element))
      element.law = with_value(element.law, element.share * tunable->max);
  return network;
}

int slip_elements(const Network& network) {
  return static_cast<int>(std::count_if(network.elements.begin(), network.elements.end(), [](const Element& element) {
    return element.has_effect && is_slip(element.law);
  }));
}

// Finds the blocks that are next to a slip in series.
void find_loose(const NormalTree& tree, std::set<const NormalTree*>& loose) {
  const auto is_slip = [](const NormalTree& child) { return child.kind == NormalTree::Kind::slip; };
  const bool slides =
      tree.kind == NormalTree::Kind::series && std::any_of(tree.children.begin(), tree.children.end(), is_slip);
  for (const NormalTree& child : tree.children) {
    if (slides) loose.insert(&child);
    find_loose(child, loose);
  }
}

class TablesBuilder {
 public:
  TablesBuilder(const Network& network, const BrakeRule& brake, const Decomposition& decomposition,
                const Choices& choices, const Real& sample_period, const PortDevice& device)
      : network_(network),
        structure_(at_largest(network)),
        brake_(brake),
        decomposition_(decomposition),
        choices_(choices),
        period_(sample_period),
        device_(device),
        blocks_(network_, choices_, period_, tables_) {}

  // False, with a diagnostic, where too many slips are in no tree.
  bool build(Diagnostics& diagnostics) {
    tables_.network = network_.name;
    write_head();
    for (const Parameter& parameter : network_.parameters)
      if (parameter.tunable) add_tunable(parameter);
    const std::optional<NormalForm> form = closed_normal_form(structure_, diagnostics);
    if (!form) return false;
    if (const std::optional<Tree> tree = form->has_slips() ? series_parallel_tree(structure_) : std::nullopt)
      add_tree(*tree, *form);
    else add_parts(*form);
    tables_.head.slip_rule.takes_part = brake_.follows != BrakeFollows::constant && has_dampers_behind_slips();
    if (network_.map && !network_.contact) write_map();
    if (!network_.map && !device_.is_ideal()) write_hold();
    tables_.brake.observed = blocks_.number(network_, brake_.observed, {NumberKind::observed, brake_.observed});
    return true;
  }

  TunableTables take() { return std::move(tables_); }

 private:
  double to_scalar(const Real& value) const { return rounded(value, choices_.scalar); }

  void write_head() {
    const bool is_double = choices_.scalar == ScalarType::float64;
    TunableHead& head = tables_.head;
    head.rate = to_scalar(1 / period_);
    head.port_motion = network_.port_motion;
    tables_.is_exact = choices_.scheme == Scheme::exact;
    head.retention = to_scalar(exp(-period_ / offset_time));
    tables_.least_share = is_double ? 0x1p-24 : 0x1p-10;
    TunableBrake& brake = tables_.brake;
    brake.follows = brake_.follows;
    brake.damping = to_scalar(Real(brake_.damping));
    brake.max_damping = brake_.max_damping ? to_scalar(Real(*brake_.max_damping)) : largest_finite(choices_.scalar);
    brake.text = brake_.text;
    if (decomposition_.slips.coil_share < 1) brake.assured_share = to_scalar(Real(decomposition_.slips.assured_share));
    head.static_spring = no_index;
    // Behind a static curve's map a surface lies where the map begins.
    const double surface = network_.surface_behind_map();
    head.contact = {network_.contact.has_value(), to_scalar(Real(surface)),
                    to_scalar(Real(decomposition_.encoder_step))};
    head.acts_late = device_.acts_late();
    const SlipDecomposition& slips = decomposition_.slips;
    head.slip_rule = {false, to_scalar(Real(slips.hysteresis)), to_scalar(Real(slips.coil_share))};
  }

  void add_tunable(const Parameter& parameter) {
    const auto user = std::find_if(network_.elements.begin(), network_.elements.end(),
                                   [&](const Element& element) { return network_.tunable_of(element) == &parameter; });
    const std::string unit = user == network_.elements.end() ? "" : unit_of(user->law, network_.port_motion);
    tables_.tunables.push_back(
        {parameter.name,
         unit,
         {to_scalar(Real(parameter.value)), to_scalar(Real(parameter.min)), to_scalar(Real(parameter.max))},
         {}});
  }

  void add_tree(const Tree& tree, const NormalForm& form) {
    const std::vector<std::size_t> linear = linear_elements(form);
    blocks_.add(laid_out_part(network_, tree, linear), linear, false);
    if (!network_.contact)
      for (const NormalTree& component : form.components) add_component(component, tree, false);
    else add_component(whole_tree(form, structure_), tree, !linear.empty());
  }

  // Adds the parts of a network that is no tree as a whole.
  void add_parts(const NormalForm& form) {
    blocks_.add(network_, linear_elements(form), false);
    for (const NormalTree& component : form.components)
      add_component(component, tree_of(elements_of(component)), false);
    for (const std::vector<std::size_t>& part : form.networks) add_graph(part, form.linear);
  }

  Tree tree_of(const std::vector<std::size_t>& elements) const {
    return series_parallel_tree(with_effect_of(elements, structure_)).value();
  }

  std::vector<std::size_t> linear_elements(const NormalForm& form) const {
    return effective_elements(linear_part(network_, form));
  }

  // If there is none, slips leave nothing to the brake.
  bool has_dampers_behind_slips() const {
    if (!tables_.has_slips()) return false;
    const int first = tables_.blocks.front().part_count;
    return std::any_of(tables_.parts.begin() + first, tables_.parts.end(), [](const BlockPart& part) {
      return part.kind == PartKind::damper || part.kind == PartKind::mesh;
    });
  }

  // Only the table's shape is taken: its numbers follow from the parameters. `has_first_block`: behind a contact the
  // first block is the one that was added before.
  void add_component(const NormalTree& component, const Tree& tree, bool has_first_block) {
    const std::vector<Real> any_stiffness(blocks_breadth_first(component).size(), Real(1));
    const SlipTable table = slip_table(component, any_stiffness, choices_.scalar);
    tables_.couplings.push_back({static_cast<int>(tables_.nodes.size()), static_cast<int>(table.nodes.size()),
                                 static_cast<int>(tables_.blocks.size()) - (has_first_block ? 1 : 0),
                                 static_cast<int>(tables_.yields.size())});
    for (slip_node<double> node : table.nodes) {
      node.stiffness = node.compliance = node.yield = 0;
      tables_.nodes.push_back(node);
    }
    std::set<const NormalTree*> loose;
    find_loose(component, loose);
    for (const NormalTree* block : table.blocks)
      if (!has_first_block || block != table.blocks.front())
        blocks_.add(laid_out_part(network_, tree, block->elements), block->elements, loose.count(block) != 0);
    for (std::size_t i = 0; i < table.blocks.size(); ++i)
      tables_.blocks[static_cast<std::size_t>(tables_.couplings.back().first_block) + i].least_stiffness =
          least_stiffness(table.blocks[i]->form);
    for (const NormalTree* slip : table.slips) {
      const int first = static_cast<int>(tables_.cuts.size());
      for (const std::vector<std::size_t>& cut : cuts_through(tree, slip->elements))
        tables_.cuts.push_back(blocks_.number(network_, cut));
      tables_.yields.push_back({first, static_cast<int>(tables_.cuts.size()) - first, least_yield(slip->yield_force)});
      name_slip(slip->elements);
      tables_.links.push_back({0, 0});
    }
  }

  // Behind a contact the surface is the last of the inner ends, and block 0 between it and the ground the first tie.
  void add_graph(const std::vector<std::size_t>& elements, const LinearForm& beside) {
    const SlipGraph graph = slip_graph(structure_, elements);
    std::map<NodeIndex, int> place;
    for (NodeIndex node : graph.ends) place.emplace(node, static_cast<int>(place.size()));
    place.emplace(tool, static_cast<int>(place.size()));
    const int ends = static_cast<int>(graph.ends.size()) + (network_.contact ? 1 : 0);
    place.emplace(ground, ends + 1);
    tables_.graphs.push_back({ends, static_cast<int>(graph.links.size()), static_cast<int>(tables_.yields.size()), 0,
                              static_cast<int>(tables_.ties.size()),
                              static_cast<int>(tables_.blocks.size()) - (network_.contact ? 1 : 0)});
    if (network_.contact) {
      tables_.ties.push_back({place.at(tool), ends + 1});
      tables_.blocks.front().least_stiffness = least_stiffness(beside);
    }
    for (const OnePort& tie : graph.ties) {
      tables_.ties.push_back({place.at(tie.from), place.at(tie.to)});
      blocks_.add(laid_out(network_, tie), tie.elements, is_loose(graph, tie));
      tables_.blocks.back().least_stiffness =
          least_stiffness(linear_form(laid_out(structure_, tie), tie.elements, tool, ground));
    }
    for (const GraphLink& link : graph.links) {
      tables_.links.push_back({place.at(link.a), place.at(link.b)});
      Real largest = 0;
      for (std::size_t slip : link.slips) largest += value_of(structure_.elements[slip].law);
      tables_.yields.push_back({static_cast<int>(tables_.cuts.size()), 1, least_yield(largest)});
      tables_.cuts.push_back(blocks_.number(network_, link.slips));
      name_slip(link.slips);
    }
    tables_.graphs.back().tie_count = static_cast<int>(tables_.ties.size()) - tables_.graphs.back().first_tie;
    tables_.ends = std::max(tables_.ends, ends);
    for (std::size_t element : graph.opened) tables_.mesh_elements.push_back(network_.elements[element].name);
  }

  void name_slip(const std::vector<std::size_t>& elements) {
    tables_.slip_names.push_back(name_of(elements, network_));
    tables_.slip_elements.push_back(elements);
  }

  // Counts as many samples as an amplifier's lag takes to fall to a 64th, but no more than eight.
  void write_hold() {
    const PortDevice at_tool = device_.at_tool();
    const device_description& device = at_tool.description();
    const double speed = device.encoder.max_speed * at_tool.position_scale(), period = double(period_);
    if (!(speed > 0)) return;
    const double margin = 1 + 16 * unit_roundoff(choices_.scalar), lag = device.motor.amplifier_lag / period;
    const int of_lag = lag > 0 ? static_cast<int>(std::clamp(std::ceil(lag * std::log(64 * (1 + lag))), 1.0, 8.0)) : 0;
    // So many samples take at least so many periods less the jitter.
    const double left = lag > 0 ? std::exp((device.loop.jitter / period - of_lag) / lag) / -std::expm1(-1 / lag) : 0;
    const double change = speed * (period + device.loop.jitter) * margin;
    tables_.head.hold = {
        1 + static_cast<int>(device.loop.delay_samples) + (device.loop.write_latest > 0 ? 1 : 0) + of_lag,
        to_scalar(Real(change)), to_scalar(Real(left * change * margin))};
  }

  // Upper bounds of the change of w while a force is held, and of the static spring's stiffness.
  void write_map() {
    const double margin = 1 + 16 * unit_roundoff(choices_.scalar);
    double change = 0, stiffness = 0;
    if (!device_.is_ideal()) {
      const PortDevice at_tool = device_.at_tool();
      const double speed = at_tool.description().encoder.max_speed * at_tool.position_scale();
      change = network_.map->steepest() * speed * (double(period_) + at_tool.description().loop.jitter) *
               (1.0 + at_tool.description().loop.delay_samples);
    }
    if (tables_.head.static_spring != no_index) {
      const auto spring = static_cast<std::size_t>(tables_.head.static_spring);
      const TunableNumber& number = tables_.numbers[static_cast<std::size_t>(tables_.springs[spring])];
      stiffness = number.base;
      for (const TunableTerm& term : number.terms) stiffness += term.share * tables_.tunables[term.tunable].range.max;
    }
    tables_.head.map = {true, to_scalar(Real(change * margin)), to_scalar(Real(stiffness * margin))};
  }

  // A small share of the stiffness with every parameter at its largest: next to a part without stiffness the curves of
  // slips would lose their digits.
  double least_stiffness(const LinearForm& largest) const {
    return to_scalar(tables_.least_share * companion_stiffness(largest, choices_.scheme, period_));
  }
  double least_yield(const Real& largest) const { return to_scalar(tables_.least_share * largest); }

  const Network& network_;
  Network structure_;
  const BrakeRule& brake_;
  const Decomposition& decomposition_;
  const Choices& choices_;
  Real period_;
  const PortDevice& device_;
  TunableTables tables_;
  TunableBlocks blocks_;
};

// True, with a diagnostic, where `count` is beyond `most`.
bool exceeds(std::size_t count, int most, const char* what, const Network& network, Diagnostics& diagnostics) {
  if (count <= static_cast<std::size_t>(most)) return false;
  diagnostics.report<DiagnosticCode::too_much_to_tune>(network.name_span, network.name, count, what, most);
  diagnostics.note<DiagnosticCode::make_constant>({});
  return true;
}

bool is_too_large(const TunableTables& tables, const Network& network, Diagnostics& diagnostics) {
  return exceeds(static_cast<std::size_t>(tables.mesh_nodes), most_tunable_nodes, "inner nodes", network,
                 diagnostics) ||
         exceeds(static_cast<std::size_t>(tables.ends), most_tunable_ends, "ends of slips outside a tree", network,
                 diagnostics);
}

}  // namespace

std::optional<TunableTables> tunable_tables_of(const Network& linear, const Network& network,
                                               const Decomposition& decomposition, const Choices& choices,
                                               const Real& sample_period, const PortDevice& device,
                                               Diagnostics& diagnostics) {
  const auto tunables =
      std::count_if(network.parameters.begin(), network.parameters.end(), [](const Parameter& p) { return p.tunable; });
  if (exceeds(static_cast<std::size_t>(tunables), most_tunables, "tunable parameters", network, diagnostics) ||
      exceeds(static_cast<std::size_t>(slip_elements(network)), most_tunable_slips, "slips", network, diagnostics))
    return std::nullopt;
  const BrakeRule brake = brake_rule_of(linear, decomposition, device);
  TablesBuilder builder(network, brake, decomposition, choices, sample_period, device);
  if (!builder.build(diagnostics)) return std::nullopt;
  TunableTables tables = builder.take();
  if (is_too_large(tables, network, diagnostics)) return std::nullopt;
  return tables;
}

}  // namespace dashpot::compiler
