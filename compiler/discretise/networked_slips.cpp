#include "discretise/networked_slips.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "discretise/element_names.hpp"
#include "discretise/rounding.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

const Element& first_slip(const Network& network, const std::vector<std::size_t>& elements) {
  return network.elements[*std::find_if(elements.begin(), elements.end(),
                                        [&](std::size_t index) { return is_slip(network.elements[index].law); })];
}

}  // namespace

NetworkedSlips::NetworkedSlips(LawWriter& writer, const Network& network, const Real& sample_period,
                               std::vector<std::size_t> elements, bool is_pushed)
    : writer_(writer),
      network_(network),
      sample_period_(sample_period),
      elements_(std::move(elements)),
      is_pushed_(is_pushed),
      form_(multiport_form_at_slips(network, elements_)) {
  name_ = step_.name = writer_.unique(joined("network", first_slip(network, elements_).name));
  number_ends();
  add_links();
  add_modes();
  for (const Tie& tie : form_.springs) {
    add_stiffness(tie.a, tie.b, tie.value);
    springs_.push_back(
        {tie, writer_.unique(joined(end_names_[tie.a], tie.b < end_names_.size() ? end_names_[tie.b] : "ground"))});
  }
  for (const Tie& tie : form_.dampers) add_stiffness(tie.a, tie.b, tie.value / sample_period_);
}

NodeIndex NetworkedSlips::node_of(std::size_t terminal) const {
  return terminal == form_.terminals.size() ? ground : form_.terminals[terminal];
}

Subject NetworkedSlips::subject_of(const Tie& tie) const { return OfTie{elements_, node_of(tie.a), node_of(tie.b)}; }

OfPartMode NetworkedSlips::subject_of(std::size_t mode) const {
  const ElementList& elements = form_.modes[mode].elements;
  const auto before = std::count_if(form_.modes.begin(), form_.modes.begin() + static_cast<std::ptrdiff_t>(mode),
                                    [&](const MultiportMode& other) { return other.elements == elements; });
  return {elements_, elements, static_cast<std::size_t>(before)};
}

Derivation NetworkedSlips::weight_of(const NetworkMode& mode, std::size_t terminal) const {
  OfPartMode subject = subject_of(static_cast<std::size_t>(&mode - modes_.data()));
  subject.node = node_of(terminal);
  return {ConstantRole::mode_weight, std::move(subject)};
}

// Numbers all terminals; the tool is the last.
void NetworkedSlips::number_ends() {
  for (NodeIndex node : form_.terminals)
    end_names_.push_back(writer_.unique(node == tool ? "tool" : network_.nodes[node]));
  step_.node_count = static_cast<int>(form_.terminals.size()) - (is_pushed_ ? 0 : 1);
  step_.elements = elements_;
  step_.end_nodes.assign(form_.terminals.begin(), form_.terminals.begin() + step_.node_count);
  const auto nodes = static_cast<std::size_t>(step_.node_count);
  between_.assign(nodes * nodes, Real(0));
  to_tool_.assign(nodes, Real(0));
  to_ground_.assign(nodes, Real(0));
}

// The number in the step of a terminal, or of the ground, whose index follows those of the terminals. With a contact
// the surface is an inner end, and no element ends at the tool.
int NetworkedSlips::end_of(std::size_t terminal) const {
  const bool is_ground = terminal == form_.terminals.size();
  return is_ground ? step_.node_count + 1 : static_cast<int>(terminal);
}

void NetworkedSlips::add_links() {
  const auto terminal = [&](NodeIndex node) {
    return static_cast<std::size_t>(std::find(form_.terminals.begin(), form_.terminals.end(), node) -
                                    form_.terminals.begin());
  };
  for (const auto& [ends, yield] : slips_between(network_, elements_)) {
    const double limit = rounded(Real(yield), writer_.law().scalar);
    step_.links.push_back({end_of(terminal(ends.first)), end_of(terminal(ends.second)), -limit, limit});
  }
  if (is_pushed_)
    step_.links.push_back({step_.node_count, end_of(terminal(tool)), 0, largest_finite(writer_.law().scalar)});
}

void NetworkedSlips::add_modes() {
  for (const MultiportMode& mode : form_.modes) {
    const Mode plain{mode.stiffness, mode.relaxation_rate, 1, mode.elements};
    const Real gain =
        mode_coefficients(plain, writer_.law().scheme, StateInput::position, sample_period_).position_gain;
    for (std::size_t a = 0; a < mode.weights.size(); ++a)
      for (std::size_t b = a + 1; b < mode.weights.size(); ++b)
        add_stiffness(a, b, -mode.weights[a] * mode.weights[b] * gain);
    const std::string name = writer_.unique(joined(name_of(mode.elements, network_), "mode"));
    modes_.push_back(
        {mode, name,
         std::make_unique<ModeBank>(writer_, std::vector<Mode>{plain}, StateInput::position, sample_period_,
                                    Names{name}, name, std::vector<Subject>{subject_of(modes_.size())})});
  }
}

void NetworkedSlips::add_stiffness(std::size_t a, std::size_t b, const Real& stiffness) {
  const int nodes = step_.node_count, first = std::min(end_of(a), end_of(b)), second = std::max(end_of(a), end_of(b));
  const auto inner = static_cast<std::size_t>(first), other = static_cast<std::size_t>(second),
             size = static_cast<std::size_t>(nodes);
  if (second < nodes) {
    between_[inner * size + other] += stiffness;
    between_[other * size + inner] += stiffness;
  } else if (first >= nodes) {
    through_ += stiffness;
  } else {
    (second == nodes ? to_tool_ : to_ground_)[inner] += stiffness;
  }
}

double NetworkedSlips::smallest_loss() const {
  double smallest = 1;
  for (const NetworkMode& mode : modes_) smallest = std::min(smallest, mode.bank->smallest_loss());
  return smallest;
}

void NetworkedSlips::declare() {
  for (SpringTie& spring : springs_)
    spring.force =
        writer_.scalar(joined(spring.name, "spring_force"), writer_.force(), "force of the spring", Role::state);
  for (NetworkMode& mode : modes_) mode.bank->declare();
  for (std::size_t i = 0; i < static_cast<std::size_t>(step_.node_count); ++i)
    step_.moved.push_back(
        writer_.scalar(joined(end_names_[i], "moved"), writer_.length(), "displacement of the node", Role::local));
  for (std::size_t k = 0; k < step_.links.size(); ++k) {
    const VariableId sign = writer_.scalar(joined(name_, fmt::format("sign_{}", k + 1)), "1",
                                           "direction in which the slip slides, 0 while it holds", Role::local);
    step_.sign.push_back(sign);
    step_.last_sign.push_back(writer_.kept(sign));
  }
}

ExpressionId NetworkedSlips::write_output(VariableId change) {
  change_ = change;
  for (std::size_t i = 0; i < form_.terminals.size(); ++i) step_.held.push_back(write_held(i, no_variable));
  return write_step(change);
}

ExpressionId NetworkedSlips::write_push(VariableId change, VariableId surface_change, const BesideSlips& beside) {
  const std::size_t surface = form_.terminals.size() - 1;
  add_stiffness(surface, form_.terminals.size(), beside.stiffness);
  change_ = step_.surface = step_.moved[surface] = surface_change;
  for (std::size_t i = 0; i < form_.terminals.size(); ++i)
    step_.held.push_back(write_held(i, i == surface ? beside.held : no_variable));
  step_.held.push_back(no_variable);
  return write_step(change);
}

void NetworkedSlips::round_stiffness() {
  const ScalarType scalar = writer_.law().scalar;
  for (const Real& value : between_) step_.between.push_back(rounded(value, scalar));
  for (const Real& value : to_tool_) step_.to_tool.push_back(rounded(value, scalar));
  for (const Real& value : to_ground_) step_.to_ground.push_back(rounded(value, scalar));
  step_.through = rounded(through_, scalar);
}

ExpressionId NetworkedSlips::write_step(VariableId change) {
  UpdateLaw& law = writer_.law();
  round_stiffness();
  const VariableId force = writer_.scalar(joined(name_, "force"), writer_.force(), "the part's force", Role::local);
  writer_.assign(law.output, force, writer_.read(change), "slip_network: f, and how far every node moves", {elements_});
  law.output.back().step = SolveNetwork{law.networks.add(step_)};
  return writer_.read(force);
}

// Σ ±F of springs + Σ w a F of modes
ExpressionId NetworkedSlips::held_at(std::size_t terminal) {
  ExpressionId sum = nothing;
  for (const SpringTie& spring : springs_) {
    if (spring.tie.a == terminal) sum = writer_.plus(sum, writer_.read(spring.force));
    if (spring.tie.b != terminal) continue;
    const ExpressionId none = writer_.constant("none", writer_.force(), "nothing", 0, ConstantRole::zero);
    sum = writer_.subtract(sum == nothing ? none : sum, writer_.read(spring.force));
  }
  for (const NetworkMode& mode : modes_) {
    if (mode.mode.weights[terminal] == 0) continue;
    const ExpressionId weight =
        writer_.constant(joined(mode.name, joined("weight", end_names_[terminal])), "1",
                         "weight of the mode at this node", mode.mode.weights[terminal], weight_of(mode, terminal));
    sum = writer_.plus(sum, writer_.multiply(weight, writer_.read(mode.bank->decayed_sum())));
  }
  return sum;
}

VariableId NetworkedSlips::write_held(std::size_t terminal, VariableId beside) {
  ExpressionId sum = held_at(terminal);
  if (beside != no_variable) sum = writer_.plus(sum, writer_.read(beside));
  if (sum == nothing) return no_variable;
  const VariableId held = writer_.scalar(joined(end_names_[terminal], "held"), writer_.force(),
                                         "force at the node if no node moves", Role::local);
  writer_.assign(writer_.law().output, held, sum, "");
  return held;
}

ExpressionId NetworkedSlips::movement(std::size_t terminal) {
  if (terminal == form_.terminals.size()) return nothing;
  const bool is_tool = terminal + 1 == form_.terminals.size();
  return writer_.read(writer_.kept(is_tool ? change_ : step_.moved[terminal]));
}

ExpressionId NetworkedSlips::elongation(const Tie& tie) {
  const ExpressionId other = movement(tie.b);
  return other == nothing ? movement(tie.a) : writer_.subtract(movement(tie.a), other);
}

// wᵀ x
ExpressionId NetworkedSlips::drive(const NetworkMode& mode) {
  ExpressionId sum = nothing;
  for (std::size_t i = 0; i < form_.terminals.size(); ++i) {
    if (mode.mode.weights[i] == 0) continue;
    const ExpressionId weight =
        writer_.constant(joined(mode.name, joined("weight", end_names_[i])), "1", "weight of the mode at this node",
                         mode.mode.weights[i], weight_of(mode, i));
    sum = writer_.plus(sum, writer_.multiply(weight, movement(i)));
  }
  return sum;
}

// F ← F + k (x_a − x_b); modes by wᵀ x in place of Δu.
void NetworkedSlips::write_update() {
  std::vector<Statement>& update = writer_.law().update;
  for (const SpringTie& spring : springs_) {
    const ExpressionId stiffness =
        writer_.constant(joined(spring.name, "stiffness"), writer_.stiffness(), "k0", spring.tie.value,
                         {ConstantRole::spring_stiffness, subject_of(spring.tie)});
    const ExpressionId force =
        writer_.add(writer_.read(spring.force), writer_.multiply(stiffness, elongation(spring.tie)));
    writer_.assign(update, spring.force, writer_.flush(force), "F ← F + k δ", {elements_});
  }
  for (const NetworkMode& mode : modes_) {
    const VariableId driven = writer_.scalar(joined(mode.name, "drive"), writer_.length(), "", Role::local);
    writer_.assign(update, driven, drive(mode), "Σ weight · displacement of the node");
    mode.bank->write_update(driven, nothing);
  }
}

VariableId NetworkedSlips::sign_of(const std::vector<std::size_t>& elements) const {
  const std::vector<std::vector<std::size_t>> slips = slips_together(network_, elements_);
  const auto slip = std::find(slips.begin(), slips.end(), elements);
  return step_.sign[static_cast<std::size_t>(slip - slips.begin())];
}

// ½ F²/k
ExpressionId NetworkedSlips::energy() {
  ExpressionId sum = nothing;
  for (const SpringTie& spring : springs_) {
    const ExpressionId weight =
        writer_.constant(joined(spring.name, "compliance"), writer_.compliance(), "1/(2 k)", 1 / (2 * spring.tie.value),
                         {ConstantRole::spring_compliance, subject_of(spring.tie)});
    const ExpressionId force = writer_.read(spring.force);
    sum = writer_.plus(sum, writer_.multiply(writer_.multiply(weight, force), force));
  }
  for (const NetworkMode& mode : modes_) sum = writer_.plus(sum, mode.bank->energy());
  return sum;
}

}  // namespace dashpot::compiler
