#include "discretise/coupled_slips.hpp"

#include <algorithm>

#include "discretise/element_names.hpp"

namespace dashpot::compiler {
namespace {

std::vector<Real> stiffness_of_blocks(const NormalTree& component, Scheme scheme, const Real& sample_period) {
  std::vector<Real> stiffness;
  for (const NormalTree* block : blocks_breadth_first(component))
    stiffness.push_back(companion_stiffness(block->form, scheme, sample_period));
  return stiffness;
}

void collect(const NormalTree& tree, std::vector<std::size_t>& elements) {
  elements.insert(elements.end(), tree.elements.begin(), tree.elements.end());
  for (const NormalTree& child : tree.children) collect(child, elements);
}

}  // namespace

CoupledSlips::CoupledSlips(LawWriter& writer, const Network& network, const Real& sample_period,
                           const NormalTree& component)
    : writer_(writer),
      network_(network),
      table_(slip_table(component, stiffness_of_blocks(component, writer.law().scheme, sample_period),
                        writer.law().scalar)),
      name_(writer.unique(joined("coupled", name_of(table_.slips.front()->elements, network)))) {
  for (const NormalTree* part : table_.blocks) blocks_.push_back(block_of(*part, sample_period));
}

CoupledSlips::Block CoupledSlips::block_of(const NormalTree& part, const Real& sample_period) {
  Block block{&part, writer_.unique(name_of(part.elements, network_)), nullptr};
  if (part.form.modes.empty()) return block;
  Names names;
  for (const Mode& mode : part.form.modes)
    names.push_back(writer_.unique(joined(name_of(mode.elements, network_), "mode")));
  block.modes =
      std::make_unique<ModeBank>(writer_, part.form.modes, StateInput::position, sample_period, std::move(names),
                                 block.name, std::vector<Subject>{OfElements{part.elements}});
  return block;
}

void CoupledSlips::keep_elsewhere(const NormalTree& part) {
  for (Block& block : blocks_) {
    if (block.part != &part) continue;
    block.modes.reset();
    block.is_elsewhere = true;
  }
}

double CoupledSlips::smallest_loss() const {
  double smallest = 1;
  for (const Block& block : blocks_)
    if (block.modes) smallest = std::min(smallest, block.modes->smallest_loss());
  return smallest;
}

void CoupledSlips::declare() {
  for (Block& block : blocks_) {
    if (block.has_spring())
      block.spring_force =
          writer_.scalar(joined(block.name, "spring_force"), writer_.force(), "force of the spring", Role::state);
    if (block.modes) block.modes->declare();
    if (block.has_spring() || block.modes)
      block.elongation =
          writer_.scalar(joined(block.name, "elongation"), writer_.length(), "δ of the block", Role::local);
  }
  if (!has_signs_) return;
  for (const NormalTree* slip : table_.slips)
    signs_.push_back(writer_.scalar(joined(writer_.unique(name_of(slip->elements, network_)), "sign"), "1",
                                    "direction in which the slip slides, 0 while it holds", Role::local));
}

ExpressionId CoupledSlips::write_output(VariableId change, VariableId surface_change) {
  UpdateLaw& law = writer_.law();
  Coupling coupling;
  coupling.name = name_;
  coupling.nodes = table_.nodes;
  for (const Block& block : blocks_) coupling.held.push_back(write_held(block));
  for (const Block& block : blocks_) coupling.moved.push_back(block.elongation);
  for (const NormalTree* slip : table_.slips) coupling.slips.push_back(slip->elements);
  for (const Block& block : blocks_) coupling.blocks.push_back(block.part->elements);
  coupling.sign = signs_;
  coupling.surface = surface_change;
  const VariableId force =
      writer_.scalar(joined(name_, "force"), writer_.force(), "the component's force", Role::local);
  writer_.assign(law.output, force, writer_.read(change), "slip_tree: f, and δ of every block", origins());
  law.output.back().step = SolveTree{law.couplings.add(std::move(coupling))};
  return writer_.read(force);
}

// π = F0 + Σ a F; nothing for a lone damper.
VariableId CoupledSlips::write_held(const Block& block) {
  if (block.is_elsewhere) return held_elsewhere_;
  if (!block.modes) return block.spring_force;
  if (!block.has_spring()) return block.modes->decayed_sum();
  const VariableId held =
      writer_.scalar(joined(block.name, "held"), writer_.force(), "force if the block keeps its length", Role::local);
  writer_.assign(writer_.law().output, held,
                 writer_.add(writer_.read(block.spring_force), writer_.read(block.modes->decayed_sum())),
                 "force of the spring + Σ a F");
  return held;
}

// F0 ← F0 + k0 δ; modes by δ in place of Δu.
void CoupledSlips::write_update() {
  for (const Block& block : blocks_) {
    if (block.elongation == nothing) continue;
    const VariableId elongation = writer_.kept(block.elongation);
    if (block.has_spring()) {
      const ExpressionId stiffness =
          writer_.constant(joined(block.name, "stiffness"), writer_.stiffness(), "k0", block.form().static_stiffness,
                           {ConstantRole::spring_stiffness, OfElements{block.part->elements}});
      const ExpressionId force =
          writer_.add(writer_.read(block.spring_force), writer_.multiply(stiffness, writer_.read(elongation)));
      writer_.assign(writer_.law().update, block.spring_force, writer_.flush(force), "F ← F + k δ",
                     {block.part->elements});
    }
    if (block.modes) block.modes->write_update(elongation, nothing);
  }
}

ExpressionId CoupledSlips::energy() {
  ExpressionId sum = nothing;
  for (const Block& block : blocks_) {
    if (block.has_spring()) sum = writer_.plus(sum, spring_energy(block));
    if (block.modes) sum = writer_.plus(sum, block.modes->energy());
  }
  return sum;
}

// ½ F0²/k0
ExpressionId CoupledSlips::spring_energy(const Block& block) {
  const ExpressionId weight = writer_.constant(joined(block.name, "compliance"), writer_.compliance(), "1/(2 k)",
                                               1 / (2 * block.form().static_stiffness),
                                               {ConstantRole::spring_compliance, OfElements{block.part->elements}});
  return writer_.multiply(writer_.multiply(weight, writer_.read(block.spring_force)), writer_.read(block.spring_force));
}

VariableId CoupledSlips::sign_of(const std::vector<std::size_t>& elements) const {
  const auto slip = std::find_if(table_.slips.begin(), table_.slips.end(),
                                 [&](const NormalTree* part) { return part->elements == elements; });
  return signs_[static_cast<std::size_t>(slip - table_.slips.begin())];
}

std::vector<std::vector<std::size_t>> CoupledSlips::origins() const {
  std::vector<std::size_t> elements;
  for (const NormalTree* part : table_.blocks) collect(*part, elements);
  for (const NormalTree* part : table_.slips) collect(*part, elements);
  std::sort(elements.begin(), elements.end());
  return {elements};
}

}  // namespace dashpot::compiler
