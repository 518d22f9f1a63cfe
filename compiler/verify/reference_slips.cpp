#include "verify/reference_slips.hpp"

#include <algorithm>

#include "verify/slip_rows.hpp"

namespace dashpot::compiler {
namespace {

using Kind = ReferencePart::Kind;

Reference companion(const ReferenceForm& form, const LawFacts& facts) {
  Reference g = form.static_stiffness + form.feedthrough_damping * Reference(facts.rate);
  for (const ReferenceMode& mode : form.modes) g += mode_factors(mode, facts).gain;
  return g;
}

class Constants {
 public:
  Constants(const LawFacts& facts, double hysteresis) : facts_(facts), hysteresis_(hysteresis) {}

  void add_form(const ReferenceForm& form) {
    if (form.static_stiffness > 0) {
      pool_["stiffness"].push_back(form.static_stiffness);
      pool_["compliance"].push_back(1 / (2 * form.static_stiffness));
    }
    const double vanishing = facts_.scalar == ScalarType::float64 ? 1e-100 : 1e-12;
    for (const ReferenceMode& mode : form.modes) {
      const ModeFactors f = mode_factors(mode, facts_);
      pool_["gain"].push_back(f.decay * f.gain);
      pool_["decay"].push_back(f.decay);
      pool_["loss"].push_back(f.loss);
      pool_["energy_weight"].push_back(f.decay < vanishing ? Reference(0) : Reference(1 / (2 * mode.stiffness * f.decay * f.decay)));
    }
  }

  // A table's number of every node: stiffness with every slip giving way, its inverse, and the yield force.
  Reference add_table(const ReferencePart& part) {
    Reference g = 0, compliance = 0;
    bool is_flat = false;
    if (part.kind == Kind::block) g = companion(part.form, facts_);
    for (const ReferencePart& child : part.children) {
      const Reference of_child = add_table(child);
      is_flat = is_flat || of_child == 0;
      g += of_child;
      if (of_child > 0) compliance += 1 / of_child;
    }
    if (part.kind == Kind::series) g = is_flat ? Reference(0) : Reference(1 / compliance);
    for (const Reference& value : {g, g > 0 ? Reference(1 / g) : Reference(0), part.yield_force}) pool_["table"].push_back(value);
    if (part.kind == Kind::block) add_form(part.form);
    return g;
  }

  void add_single_slip(const ReferencePart& component, const std::vector<BrakeShare>& shares) {
    std::vector<Reference> stiffness;
    const std::vector<const ReferencePart*> blocks = blocks_of(component);
    for (const ReferencePart* block : blocks) {
      stiffness.push_back(companion(block->form, facts_));
      add_form(block->form);
    }
    const SlipRows rows = slip_rows(component, stiffness);
    add_row(rows.trial);
    add_row(rows.force);
    for (const BrakeShare& share : shares) add_row_number(rows.force.change - Reference(share.feedthrough) * Reference(facts_.rate));
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      add_row(rows.elongation[i]);
      ReferenceRow spring = rows.elongation[i];
      const Reference& k = blocks[i]->form.static_stiffness;
      spring.change *= k;
      for (Reference& held : spring.held) held *= k;
      if (blocks[i]->form.modes.empty()) spring.held[i] += 1;
      spring.excess *= k;
      add_row(spring);
    }
    add_slip(component, rows.trial.change);
  }

  // b∞/h of every pattern.
  void add_regimes(const ReferencePart& component) {
    const std::size_t slips = slip_count(component);
    for (std::size_t pattern = 0; slips <= most_listed_slips && pattern < std::size_t{1} << slips; ++pattern)
      if (const auto b = feedthrough_in(component, pattern)) pool_["feedthrough_by_regime"].push_back(*b * Reference(facts_.rate));
    if (const auto b = feedthrough_in(component, ~std::size_t{0})) pool_["feedthrough_by_regime"].push_back(*b * Reference(facts_.rate));
  }

  // What the brake could not give: a choice.
  void add_capped(const ComponentSplit& split) {
    for (std::size_t i = 0; i < split.shares.size() && i < split.regimes.regimes.size(); ++i)
      if (split.shares[i].feedthrough < split.regimes.regimes[i].feedthrough())
        pool_["feedthrough_by_regime"].push_back(Reference(split.shares[i].feedthrough) * Reference(facts_.rate));
  }

  Pool take() { return std::move(pool_); }
  void add(const char* kind, const Reference& value) { pool_[kind].push_back(value); }

 private:
  void add_row_number(const Reference& value) { pool_["row"].push_back(abs(value)); }
  void add_row(const ReferenceRow& row) {
    add_row_number(row.change);
    for (const Reference& held : row.held) add_row_number(held);
    add_row_number(row.excess);
  }

  // Y, and Y (Y − hysteresis ∂t/∂u) where a slide ends for the command.
  void add_slip(const ReferencePart& part, const Reference& trial_by_change) {
    if (part.kind == Kind::slip) {
      const Reference& Y = part.yield_force;
      const Reference back = std::max(Reference(Reference(hysteresis_) * trial_by_change), Reference(Y * Reference("1e-6")));
      pool_["yield"].push_back(Y);
      pool_["leave"].push_back(Y * std::max(Reference(Y - back), Reference(0)));
    }
    for (const ReferencePart& child : part.children) add_slip(child, trial_by_change);
  }

  const LawFacts& facts_;
  double hysteresis_;
  Pool pool_;
};

ReferencePart rendered(const ReferencePart& component, const SlipDecomposition& slips, std::size_t index) {
  const bool is_gated = index < slips.components.size() && slips.components[index].law == SlipLaw::gated;
  return is_gated ? without_dampers_beside_slips(component) : component;
}

// All that is behind a contact as one tree.
ReferencePart whole_of(const ReferenceTree& tree) {
  ReferencePart whole{Kind::parallel, {}, {}, 0, tree.components};
  const ReferenceForm& f = tree.linear;
  if (f.static_stiffness > 0 || f.feedthrough_damping > 0 || !f.modes.empty())
    whole.children.insert(whole.children.begin(), {Kind::block, {}, f, 0, {}});
  if (whole.children.size() != 1) return whole;
  return ReferencePart(std::move(whole.children.front()));
}

ReferenceCut cut_of(const ReferenceForm& form, const LawFacts& facts) {
  ReferenceCut cut{form.static_stiffness / 2, form.feedthrough_damping};
  for (const ReferenceMode& mode : form.modes) {
    const ModeFactors f = mode_factors(mode, facts);
    cut.stiffness += f.gain / (1 + f.decay);
  }
  return cut;
}

std::optional<ReferenceCut> least_cut(const ReferencePart& part, const LawFacts& facts, const Reference& weight) {
  if (part.kind == Kind::block) return cut_of(part.form, facts);
  if (part.kind == Kind::slip) return std::nullopt;
  std::optional<ReferenceCut> least;
  ReferenceCut sum{0, 0};
  for (const ReferencePart& child : part.children) {
    const std::optional<ReferenceCut> cut = least_cut(child, facts, weight);
    if (!cut && part.kind == Kind::parallel) return std::nullopt;
    if (!cut) continue;
    sum = {sum.stiffness + cut->stiffness, sum.damping + cut->damping};
    if (!least || cut->stiffness * weight + cut->damping < least->stiffness * weight + least->damping) least = cut;
  }
  return part.kind == Kind::series ? least : sum;
}

}  // namespace

std::string_view kind_behind_slips(std::string_view name) {
  if (name.ends_with("feedthrough_by_regime")) return "feedthrough_by_regime";
  if (name.find("_by_regime") != name.npos) return "";  // b, which is chosen
  if (name.find("_by_") != name.npos) return "row";
  for (const std::string_view kind : {"feedthrough_stiffness", "recovery_compliance", "energy_weight", "compliance", "stiffness", "yield", "leave", "gain",
                                      "decay", "loss"})
    if (name.ends_with(kind) && name != "velocity_gain") return kind;
  if (name == "slips_feedthrough") return "";
  if (name.ends_with("_feedthrough")) return "feedthrough_by_regime";
  return name == "feedthrough" ? "feedthrough" : name.starts_with("coupled_") ? "table" : "";
}

Pool constants_behind_slips(const ReferenceTree& tree, bool with_contact, const SlipDecomposition& slips, const LawFacts& facts) {
  Constants constants(facts, slips.hysteresis);
  constants.add_form(tree.linear);
  if (with_contact) {
    constants.add("feedthrough", tree.linear.feedthrough_damping);
    constants.add("feedthrough_stiffness", -tree.linear.feedthrough_damping * Reference(facts.rate));
    if (tree.components.empty()) constants.add("recovery_compliance", -1 / companion(tree.linear, facts));
    else constants.add_table(whole_of(tree));
    for (const ReferencePart& component : tree.components) constants.add_regimes(component);
    for (const ComponentSplit* split : slips.all()) constants.add_capped(*split);
    return constants.take();
  }
  for (std::size_t i = 0; i < tree.components.size(); ++i) {
    const ReferencePart component = rendered(tree.components[i], slips, i);
    const std::vector<BrakeShare> none;
    if (slip_count(component) == 1) constants.add_single_slip(component, i < slips.components.size() ? slips.components[i].shares : none);
    else constants.add_table(component);
    constants.add_regimes(component);
  }
  for (const ComponentSplit* split : slips.all()) constants.add_capped(*split);
  return constants.take();
}

ReferenceCut reference_cut(const ReferenceTree& tree, bool with_contact, const SlipDecomposition& slips, const LawFacts& facts,
                           double lateness) {
  const Reference weight = Reference(lateness) * Reference(lateness) / Reference(facts.rate);
  ReferenceCut sum{0, 0};
  for (std::size_t i = 0; i < tree.components.size(); ++i) {
    const ReferenceCut cut = least_cut(with_contact ? tree.components[i] : rendered(tree.components[i], slips, i), facts, weight).value();
    sum = {sum.stiffness + cut.stiffness, sum.damping + cut.damping};
    if (with_contact || i >= slips.components.size() || slips.components[i].shares.empty()) continue;
    Reference least = Reference(slips.components[i].shares.front().feedthrough);
    for (const BrakeShare& share : slips.components[i].shares) least = std::min(least, Reference(share.feedthrough));
    sum.damping -= least;
  }
  if (!with_contact) return sum;
  const ReferenceCut linear = cut_of(tree.linear, facts);
  return {sum.stiffness + linear.stiffness, sum.damping + linear.damping};
}

bool are_within_regimes(const ReferenceTree& tree, const SlipDecomposition& slips) {
  for (std::size_t i = 0; i < std::min(tree.components.size(), slips.components.size()); ++i) {
    const std::vector<BrakeShare>& shares = slips.components[i].shares;
    if (shares.size() != 2) continue;  // several slips: by the pool
    for (const bool slides : {false, true}) {
      const std::optional<Reference> most = feedthrough_in(rendered(tree.components[i], slips, i), slides ? 1 : 0);
      if (most && Reference(shares[slides ? 1 : 0].feedthrough) > *most * (1 + Reference("1e-40"))) return false;
    }
  }
  return true;
}

}  // namespace dashpot::compiler
