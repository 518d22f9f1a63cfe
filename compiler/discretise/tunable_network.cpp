#include "discretise/tunable_network.hpp"

#include <algorithm>
#include <set>

#include "discretise/law_writer.hpp"
#include "discretise/rounding.hpp"
#include "discretise/slip_table.hpp"
#include "discretise/tunable_blocks.hpp"
#include "network/effect.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

constexpr double offset_time = 0.1;  // [s], in which an offset goes home by 63 % where the tank pays

const Parameter* tunable_of(const Network& network, const Element& element) {
  if (!element.parameter) return nullptr;
  const Parameter& parameter = network.parameters[*element.parameter];
  return parameter.tunable ? &parameter : nullptr;
}

ElementKind kind_of_law(const Law& law) {
  return std::holds_alternative<Spring>(law)   ? ElementKind::spring
         : std::holds_alternative<Damper>(law) ? ElementKind::damper
                                               : ElementKind::slip;
}

// Every element that can be there is there.
Network at_largest(Network network) {
  for (Element& element : network.elements)
    if (const Parameter* tunable = tunable_of(network, element))
      element.law = make_law(kind_of_law(element.law), tunable->max);
  return network;
}

std::vector<std::size_t> effective_elements(const Network& network) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < network.elements.size(); ++i)
    if (network.elements[i].has_effect) all.push_back(i);
  return all;
}

int slip_elements(const Network& network) {
  return static_cast<int>(std::count_if(network.elements.begin(), network.elements.end(), [](const Element& element) {
    return element.has_effect && std::holds_alternative<Slip>(element.law);
  }));
}

// The blocks that a slip is next to in series.
void find_loose(const NormalTree& tree, std::set<const NormalTree*>& loose) {
  const auto is_slip = [](const NormalTree& child) { return child.kind == NormalTree::Kind::slip; };
  const bool slides = tree.kind == NormalTree::Kind::series && std::any_of(tree.children.begin(), tree.children.end(), is_slip);
  for (const NormalTree& child : tree.children) {
    if (slides) loose.insert(&child);
    find_loose(child, loose);
  }
}

class TablesBuilder {
 public:
  TablesBuilder(const Network& network, const BrakeRule& brake, const Decomposition& decomposition, const Choices& choices,
                const Real& sample_period)
      : network_(network), structure_(at_largest(network)), brake_(brake), decomposition_(decomposition), choices_(choices), period_(sample_period),
        blocks_(network_, choices_, period_, tables_) {}

  // False where slips are in no tree.
  bool build() {
    write_head();
    for (const Parameter& parameter : network_.parameters)
      if (parameter.tunable) add_tunable(parameter);
    if (slip_elements(structure_) == 0) {
      blocks_.add(network_, effective_elements(network_), false);
    } else {
      const std::optional<Tree> tree = series_parallel_tree(structure_);
      const std::optional<NormalForm> form = normal_form(structure_);
      if (!tree || !form) return false;
      add_tree(*tree, *form);
    }
    tables_.head.observed = blocks_.number(network_, brake_.observed);
    count();
    return true;
  }

  TunableTables take() { return std::move(tables_); }

 private:
  double to_scalar(const Real& value) const { return rounded(value, choices_.scalar); }

  void write_head() {
    const bool is_double = choices_.scalar == ScalarType::float64;
    tunable_tables<double>& head = tables_.head;
    head.period = to_scalar(period_);
    head.rate = to_scalar(1 / period_);
    head.is_exact = choices_.scheme == Scheme::exact;
    head.retention = to_scalar(exp(-period_ / Real(offset_time)));
    head.threshold = flush_threshold(choices_.scalar);
    head.least_share = is_double ? 0x1p-24 : 0x1p-10;
    head.rule = brake_.rule;
    head.damping = to_scalar(Real(brake_.damping));
    head.max_damping = brake_.max_damping ? to_scalar(Real(*brake_.max_damping)) : largest_finite(choices_.scalar);
    head.static_spring = no_index;
    head.contact = {network_.contact.has_value(), network_.contact ? to_scalar(Real(network_.contact->at)) : 0, to_scalar(Real(decomposition_.encoder_step))};
    head.slip_rule = slip_rule();
    tables_.brake = brake_.text;
  }

  tunable_slip_rule<double> slip_rule() const {
    const SlipDecomposition& slips = decomposition_.slips;
    const bool takes_part = brake_.rule != brake_rule::constant && slip_elements(structure_) > 0;
    return {takes_part, to_scalar(Real(slips.hysteresis)), to_scalar(Real(slips.coil_share)), to_scalar(Real(slips.assured_share))};
  }

  void add_tunable(const Parameter& parameter) {
    const auto user = std::find_if(network_.elements.begin(), network_.elements.end(),
                                   [&](const Element& element) { return tunable_of(network_, element) == &parameter; });
    const std::string unit = user == network_.elements.end() ? "" : unit_of(user->law, network_.port_motion);
    tables_.tunables.push_back({parameter.name, unit,
                                {to_scalar(Real(parameter.value)), to_scalar(Real(parameter.min)), to_scalar(Real(parameter.max))}});
  }

  void add_tree(const Tree& tree, const NormalForm& form) {
    std::set<std::size_t> behind_slips;
    for (const NormalTree& component : form.components) collect(component, behind_slips);
    std::vector<std::size_t> linear = effective_elements(network_);
    std::erase_if(linear, [&](std::size_t i) { return behind_slips.count(i) != 0; });
    blocks_.add(laid_out_part(network_, tree, linear), linear, false);
    if (!network_.contact)
      for (const NormalTree& component : form.components) add_component(component, tree, false);
    else
      add_component(whole_tree(form, structure_), tree, !linear.empty());
  }

  static void collect(const NormalTree& tree, std::set<std::size_t>& elements) {
    elements.insert(tree.elements.begin(), tree.elements.end());
    for (const NormalTree& child : tree.children) collect(child, elements);
  }

  // Of the table only the shape is taken: its numbers follow from the parameters. Behind a contact the first block may be the
  // one that is there.
  void add_component(const NormalTree& component, const Tree& tree, bool has_first_block) {
    const std::vector<Real> any_stiffness(blocks_breadth_first(component).size(), Real(1));
    const SlipTable table = slip_table(component, any_stiffness, choices_.scalar);
    tables_.couplings.push_back({static_cast<int>(tables_.nodes.size()), static_cast<int>(table.nodes.size()),
                                 static_cast<int>(tables_.blocks.size()) - (has_first_block ? 1 : 0),
                                 static_cast<int>(tables_.yields.size()), tables_.corners});
    for (slip_node<double> node : table.nodes) {
      node.stiffness = node.compliance = node.yield = 0;
      tables_.nodes.push_back(node);
    }
    tables_.corners += slip_tree_corners(table.nodes.data(), static_cast<int>(table.nodes.size()));
    std::set<const NormalTree*> loose;
    find_loose(component, loose);
    for (const NormalTree* block : table.blocks)
      if (!has_first_block || block != table.blocks.front()) blocks_.add(laid_out_part(network_, tree, block->elements), block->elements, loose.count(block) != 0);
    for (const NormalTree* slip : table.slips) {
      const int first = static_cast<int>(tables_.cuts.size());
      for (const std::vector<std::size_t>& cut : cuts_through(tree, slip->elements)) tables_.cuts.push_back(blocks_.number(network_, cut));
      tables_.yields.push_back({first, static_cast<int>(tables_.cuts.size()) - first});
    }
  }

  void count() {
    tunable_tables<double>& head = tables_.head;
    head.tunable_count = static_cast<int>(tables_.tunables.size());
    head.spring_count = static_cast<int>(tables_.springs.size());
    head.part_count = static_cast<int>(tables_.parts.size());
    head.block_count = static_cast<int>(tables_.blocks.size());
    head.slip_count = static_cast<int>(tables_.yields.size());
    head.coupling_count = static_cast<int>(tables_.couplings.size());
  }

  const Network& network_;
  Network structure_;
  const BrakeRule& brake_;
  const Decomposition& decomposition_;
  const Choices& choices_;
  Real period_;
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
  return exceeds(tables.springs.size(), most_tunable_springs, "springs", network, diagnostics) ||
         exceeds(static_cast<std::size_t>(tables.mesh_nodes), most_tunable_nodes, "inner nodes", network, diagnostics) ||
         exceeds(tables.blocks.size(), most_tunable_blocks, "parts between slips", network, diagnostics) ||
         exceeds(tables.nodes.size(), most_tunable_slip_parts, "parts between slips", network, diagnostics) ||
         exceeds(static_cast<std::size_t>(tables.corners), most_tunable_corners, "corners of slips", network, diagnostics);
}

}  // namespace

bool has_tunables(const Network& network) {
  return std::any_of(network.parameters.begin(), network.parameters.end(), [](const Parameter& p) { return p.tunable; });
}

Network at_default(const Network& network) {
  Network present = network;
  std::vector<bool> passable;
  for (const Element& element : network.elements) passable.push_back(element.has_effect && value_of(element.law) > 0);
  const std::vector<bool> has_effect = on_path_between_ends(network, passable);
  for (std::size_t i = 0; i < present.elements.size(); ++i) present.elements[i].has_effect = has_effect[i];
  return present;
}

std::optional<TunableTables> tunable_tables_of(const Network& linear, const Network& network, const LinearForm& form,
                                               const Decomposition& decomposition, const Choices& choices,
                                               const Real& sample_period, const Device* device, Diagnostics& diagnostics) {
  const auto tunables = std::count_if(network.parameters.begin(), network.parameters.end(), [](const Parameter& p) { return p.tunable; });
  if (exceeds(static_cast<std::size_t>(tunables), most_tunables, "tunable parameters", network, diagnostics) ||
      exceeds(form.modes.size(), most_tunable_modes, "relaxations", network, diagnostics) ||
      exceeds(static_cast<std::size_t>(slip_elements(network)), most_tunable_slips, "slips", network, diagnostics))
    return std::nullopt;
  const BrakeRule brake = brake_rule_of(linear, decomposition, device);
  TablesBuilder builder(network, brake, decomposition, choices, sample_period);
  if (!builder.build()) {
    diagnostics.report<DiagnosticCode::tunable_slips_outside_tree>(network.name_span, network.name);
    return std::nullopt;
  }
  TunableTables tables = builder.take();
  if (is_too_large(tables, network, diagnostics)) return std::nullopt;
  return tables;
}

}  // namespace dashpot::compiler
