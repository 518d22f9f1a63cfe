#include <algorithm>
#include <unordered_map>
#include <utility>

#include "network/connections.hpp"
#include "network/ladder.hpp"
#include "network/law.hpp"
#include "network/name_rules.hpp"
#include "network/network.hpp"
#include "network/parameter_table.hpp"
#include "network/read_motion.hpp"
#include "network/static_curve.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t longest_network_name = 200;  // files are called after it, and file systems take 255

constexpr std::size_t most_elements = 20'000;

// A leaf with its ends; a tree has been laid out as a graph.
struct PlacedLeaf {
  const LeafDecl* leaf;
  NodeIndex a;
  NodeIndex b;
};

void add_names(const TreeDecl& tree, std::vector<Text>& names) {
  if (tree.leaf && tree.leaf->name) names.push_back(*tree.leaf->name);
  for (const TreeDecl& child : tree.children) add_names(child, names);
}

// Those that the file states.
std::vector<Text> element_names(const NetworkDecl& decl) {
  std::vector<Text> names;
  if (const auto* tree = std::get_if<TreeDecl>(&decl.structure)) add_names(*tree, names);
  else
    for (const EdgeDecl& edge : std::get<std::vector<EdgeDecl>>(decl.structure))
      if (edge.leaf.name) names.push_back(*edge.leaf.name);
  return names;
}

class NetworkBuilder {
 public:
  NetworkBuilder(const NetworkDecl& decl, const std::optional<Range>& device_band, Diagnostics& diagnostics)
      : decl_(decl),
        device_band_(device_band),
        diagnostics_(diagnostics),
        table_(decl.parameters, element_names(decl), diagnostics) {}

  Network build() {
    copy_texts();
    network_.nodes = {"ground", "tool"};
    if (!decl_.ports.empty()) return build_ports();
    node_places_.resize(network_.nodes.size());
    place_leaves();
    check_names();
    read_validity();
    add_elements();
    read_contact();
    if (decl_.static_curve)
      network_.static_curve = read_static_curve(*decl_.static_curve, table_, network_.port_motion, diagnostics_);
    network_.parameters = table_.parameters();
    check_whole();
    return std::move(network_);
  }

 private:
  void copy_texts() {
    const auto text_of = [](const std::optional<Text>& text) { return text ? text->text : std::string(); };
    network_.name = text_of(decl_.name);
    network_.name_span = decl_.name ? decl_.name->span : Span{};
    network_.title = text_of(decl_.title);
    network_.source = text_of(decl_.source);
    network_.digest = decl_.digest;
    for (const CommentDecl& comment : decl_.comments) network_.comments.push_back({comment.about, comment.text});
    network_.port_motion = read_motion(decl_.motion, diagnostics_);
  }

  // What is wrong with parts that all ports share is reported once; then the ports are not read.
  Network build_ports() {
    check_names();
    read_validity();
    network_.parameters = table_.parameters();
    if (diagnostics_.error_count() > errors_before_) return std::move(network_);
    for (const NetworkDecl& port : decl_.ports)
      if (std::optional<Network> built = build_network(port, diagnostics_, device_band_))
        network_.ports.push_back(std::move(*built));
    for (const Parameter& parameter : network_.parameters)
      if (parameter.tunable) diagnostics_.report<DiagnosticCode::tunable_with_ports>(parameter.span, parameter.name);
    return std::move(network_);
  }

  void place_leaves() {
    if (const auto* tree = std::get_if<TreeDecl>(&decl_.structure)) return place_tree(*tree, tool, ground);
    for (const EdgeDecl& edge : std::get<std::vector<EdgeDecl>>(decl_.structure)) place_edge(edge);
  }

  void place_tree(const TreeDecl& tree, NodeIndex a, NodeIndex b) {
    if (tree.leaf) leaves_.push_back({&*tree.leaf, a, b});
    NodeIndex from = a;
    for (const TreeDecl& child : tree.children) {
      const bool ends_here = tree.kind == TreeDecl::Kind::parallel || &child == &tree.children.back();
      const NodeIndex to = ends_here ? b : inner_node();
      place_tree(child, from, to);
      if (tree.kind == TreeDecl::Kind::series) from = to;
    }
  }

  NodeIndex inner_node() {
    network_.nodes.push_back(fmt::format("node_{}", network_.nodes.size() - 1));
    node_places_.emplace_back();
    return network_.nodes.size() - 1;
  }

  void place_edge(const EdgeDecl& edge) {
    const NodeIndex a = named_node(edge.from);
    const NodeIndex b = named_node(edge.to);
    if (a == b) diagnostics_.report<DiagnosticCode::same_node_twice>(edge.to.span, excerpt(edge.to.text));
    leaves_.push_back({&edge.leaf, a, b});
  }

  NodeIndex named_node(const Text& name) {
    if (name.text == "tool") return tool;
    if (name.text == "ground") return ground;
    for (const NodeIndex reserved : {tool, ground})
      if (folded(name.text) == network_.nodes[reserved]) {
        diagnostics_.report<DiagnosticCode::reserved_node_case>(name.span, name.text, network_.nodes[reserved]);
        return reserved;
      }
    const auto [known, is_new] = node_of_name_.emplace(name.text, network_.nodes.size());
    if (!is_new) return known->second;
    check_name(name, "node", diagnostics_);
    network_.nodes.push_back(name.text);
    node_places_.push_back(name.span);
    return known->second;
  }

  void check_names() {
    std::vector<std::pair<const Text*, std::string_view>> given;
    if (decl_.name) given.emplace_back(&*decl_.name, "network");
    for (const NetworkDecl& port : decl_.ports) given.emplace_back(&*port.name, "port");
    for (const ParameterDecl& parameter : decl_.parameters) given.emplace_back(&parameter.name, "parameter");
    for (const PlacedLeaf& placed : leaves_)
      if (placed.leaf->name) given.emplace_back(&*placed.leaf->name, "element");
    std::sort(given.begin(), given.end(),
              [](const auto& x, const auto& y) { return x.first->span.begin < y.first->span.begin; });
    if (decl_.name && decl_.name->text.size() > longest_network_name)
      diagnostics_.report<DiagnosticCode::name_too_long>(decl_.name->span, decl_.name->text.size(),
                                                         longest_network_name);
    for (const auto& [name, owner] : given)
      if (check_name(*name, owner, diagnostics_)) names_.add(*name, diagnostics_);
  }

  // Unnamed elements are numbered by their place among all elements.
  std::string name_of(const LeafDecl& leaf, std::size_t number) {
    if (leaf.name) return leaf.name->text;
    const std::string_view kind = leaf.springpot ? "springpot" : leaf.prony ? "prony" : kind_of(make_law(leaf.kind, 0));
    const std::string name = names_.free_name(fmt::format("{}_{}", kind, number));
    names_.add({name, leaf.span}, diagnostics_);
    return name;
  }

  void add_elements() {
    if (leaves_.size() > most_elements)
      diagnostics_.report<DiagnosticCode::too_many_elements>(decl_.structure_span, leaves_.size(), most_elements);
    std::size_t number = 0;
    for (const PlacedLeaf& placed : leaves_) {
      const bool is_ladder = placed.leaf->springpot || placed.leaf->prony;
      ++number;
      if (is_ladder) add_ladder(placed, number);
      else add_element(placed, number);
    }
  }

  void add_element(const PlacedLeaf& placed, std::size_t number) {
    Element element{name_of(*placed.leaf, number), {}, placed.a, placed.b, placed.leaf->span, {}};
    read_law(*placed.leaf, element);
    network_.elements.push_back(std::move(element));
  }

  // A ladder that cannot be read counts as a spring, so that it causes no further complaints.
  void add_ladder(const PlacedLeaf& placed, std::size_t number) {
    const std::string name = name_of(*placed.leaf, number);
    const LadderDefaults defaults{network_.valid.frequency, device_band_};
    std::optional<Ladder> ladder = read_ladder(*placed.leaf, table_, network_.port_motion, defaults, diagnostics_);
    if (!ladder) ladder = Ladder{1, {}, {}};
    if (ladder->springpot) add_springpot(name, *ladder->springpot);
    const bool is_single = ladder->branches.empty();
    if (ladder->stiffness)
      add_part(is_single ? name : new_name(name + "_spring", placed), Spring{*ladder->stiffness}, placed.a, placed.b,
               placed);
    for (std::size_t i = 0; i < ladder->branches.size(); ++i) {
      const MaxwellBranch& branch = ladder->branches[i];
      const NodeIndex inner = inner_node();
      add_part(new_name(fmt::format("{}_spring_{}", name, i + 1), placed), Spring{branch.stiffness}, placed.a, inner,
               placed);
      follow(ladder->parameter, ElementKind::spring, branch.stiffness);
      const double damping = branch.stiffness / branch.relaxation_rate;
      add_part(new_name(fmt::format("{}_damper_{}", name, i + 1), placed), Damper{damping}, inner, placed.b, placed);
      follow(ladder->parameter, ElementKind::damper, damping);
    }
  }

  void add_part(std::string name, Law law, NodeIndex a, NodeIndex b, const PlacedLeaf& placed) {
    network_.elements.push_back({std::move(name), law, a, b, placed.leaf->span, {}});
  }

  // Makes the last element's value `share` times the tunable parameter, if there is one.
  void follow(const std::optional<std::size_t>& tunable, ElementKind kind, double share) {
    if (!tunable) return;
    Element& element = network_.elements.back();
    element.parameter = tunable;
    element.share = share;
    element.law = make_law(kind, share * table_[*tunable].value);
  }

  std::string new_name(const std::string& wanted, const PlacedLeaf& placed) {
    const std::string name = names_.free_name(wanted);
    names_.add({name, placed.leaf->span}, diagnostics_);
    return name;
  }

  void add_springpot(const std::string& name, Springpot springpot) {
    springpot.name = name;
    warn_beyond_band(springpot, network_.valid.frequency, "this file is valid");
    warn_beyond_band(springpot, device_band_, "the device is judged");
    network_.springpots.push_back(std::move(springpot));
  }

  // A range that begins at 0 asks for nothing there: no band can begin at 0.
  void warn_beyond_band(const Springpot& springpot, const std::optional<Range>& asked, std::string_view who) {
    if (!asked || ((asked->low <= 0 || springpot.band.low <= asked->low) && asked->high <= springpot.band.high)) return;
    diagnostics_.report<DiagnosticCode::springpot_beyond_band>(springpot.span, springpot.name, springpot.band.low,
                                                               springpot.band.high, who, asked->low, asked->high);
  }

  // A value that cannot be read counts as present, so that it causes no further complaints.
  void read_law(const LeafDecl& leaf, Element& element) {
    element.law = make_law(leaf.kind, 1);
    if (!leaf.value) return;
    const Dimension due = dimension_of(element.law, network_.port_motion);
    const auto value = table_.read(*leaf.value, {fmt::format("a {}", kind_of(element.law)), due, network_.port_motion});
    if (!value || !check_value(leaf, element, *value)) return;
    element.law = make_law(leaf.kind, value->value);
    element.parameter = value->parameter;
    if (table_.is_calculated(*leaf.value)) element.calculation = leaf.value->text;
  }

  bool check_value(const LeafDecl& leaf, const Element& element, const ReadValue& read) {
    const bool negative = read.range.low < 0;
    if (!negative && !(leaf.kind == ElementKind::slip && read.range.high == 0)) return true;
    if (negative) report_negative(leaf, element, read.range.low);
    else report_zero_yield(leaf, element);
    if (read.parameter) diagnostics_.note<DiagnosticCode::given_here>(table_.place_of_least(*read.parameter));
    return false;
  }

  void report_negative(const LeafDecl& leaf, const Element& element, double value) {
    const std::string text = fmt::format("{} {}", value, unit_of(element.law, network_.port_motion));
    switch (leaf.kind) {
      case ElementKind::spring:
        return diagnostics_.report<DiagnosticCode::negative_stiffness>(leaf.value->span, element.name, text);
      case ElementKind::damper:
        return diagnostics_.report<DiagnosticCode::negative_damping>(leaf.value->span, element.name, text);
      case ElementKind::slip:
        return diagnostics_.report<DiagnosticCode::negative_yield>(leaf.value->span, element.name, text);
    }
  }

  void report_zero_yield(const LeafDecl& leaf, const Element& element) {
    diagnostics_.report<DiagnosticCode::zero_yield>(leaf.value->span, element.name,
                                                    unit_of(element.law, network_.port_motion));
    diagnostics_.note<DiagnosticCode::remove_slip>({});
  }

  std::optional<double> read_constant(const ValueDecl& decl, std::string_view taker, const Dimension& due) {
    return table_.read_constant(decl, {std::string(taker), due, network_.port_motion});
  }

  Dimension length() const { return network_.port_motion == motion::rotation ? dimensions::angle : dimensions::length; }

  void read_contact() {
    if (!decl_.contact) return;
    const auto at = read_constant(decl_.contact->at, "the place of the contact", length());
    network_.contact = Contact{at.value_or(0), decl_.contact->span};
  }

  void read_validity() {
    if (!decl_.valid) return;
    const Dimension rate = product(length(), power(dimensions::time, -1));
    network_.valid = {read_range(decl_.valid->rate, "the rate", rate, false),
                      read_range(decl_.valid->displacement, "the displacement", length(), true),
                      read_range(decl_.valid->frequency, "the frequency", dimensions::frequency, false),
                      decl_.valid->span};
  }

  // A single bound limits the magnitude.
  std::optional<Range> read_range(const std::optional<RangeDecl>& decl, std::string_view taker, const Dimension& due,
                                  bool is_signed) {
    if (!decl) return std::nullopt;
    const auto high = read_constant(decl->high, taker, due);
    const auto low = decl->low ? read_constant(*decl->low, taker, due) : std::optional(0.0);
    if (!low || !high) return std::nullopt;
    if (*low < 0 && !is_signed)
      diagnostics_.report<DiagnosticCode::negative_value>(decl->span, taker, fmt::format("{} {}", *low, unit_of(due)));
    else if (*high < *low)
      diagnostics_.report<DiagnosticCode::range_reversed>(decl->span, excerpt(decl->high.text),
                                                          decl->low ? excerpt(decl->low->text) : "0");
    else return Range{decl->low || !is_signed ? *low : 0 - *high, *high};
    return std::nullopt;
  }

  // Whether the command line has replaced a value: the one in the file may have used a parameter.
  bool is_set_from_outside() const {
    const auto is_set = [](const std::optional<ValueDecl>& value) {
      return value && value->span.file != nullptr && !value->span.file->words_at(value->span.begin).empty();
    };
    return std::any_of(leaves_.begin(), leaves_.end(), [&](const PlacedLeaf& p) { return is_set(p.leaf->value); }) ||
           std::any_of(decl_.parameters.begin(), decl_.parameters.end(),
                       [&](const ParameterDecl& parameter) { return is_set(parameter.value); });
  }

  // Left out if parts of the file were not understood: these checks would only report what follows from that.
  void check_whole() {
    if (!decl_.complete) return;
    if (!decl_.shares_parameters && !is_set_from_outside()) table_.report_unused();
    const std::size_t errors_before = diagnostics_.error_count();
    check_connections(network_, decl_.structure_span, node_places_, diagnostics_);
    if (diagnostics_.error_count() == errors_before) mark_effect(network_, diagnostics_);
  }

  const NetworkDecl& decl_;
  std::optional<Range> device_band_;  // [Hz]
  Diagnostics& diagnostics_;
  std::size_t errors_before_ = diagnostics_.error_count();
  ParameterTable table_;
  Network network_;
  std::vector<PlacedLeaf> leaves_;
  std::unordered_map<std::string, NodeIndex> node_of_name_;
  std::vector<Span> node_places_;  // where each node is first named
  UniqueNames names_;
};

}  // namespace

std::optional<Network> build_network(const NetworkDecl& decl, Diagnostics& diagnostics,
                                     const std::optional<Range>& device_band) {
  const std::size_t errors_before = diagnostics.error_count();
  Network network = NetworkBuilder(decl, device_band, diagnostics).build();
  if (!decl.complete || diagnostics.error_count() > errors_before) return std::nullopt;
  return network;
}

}  // namespace dashpot::compiler
