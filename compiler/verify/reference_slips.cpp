#include "verify/reference_slips.hpp"

#include <algorithm>
#include <limits>

#include "decompose/regimes.hpp"
#include "verify/header_constants.hpp"
#include "verify/reference_network.hpp"
#include "verify/slip_rows.hpp"

namespace dashpot::compiler {
namespace {

using ReferenceKind = ReferencePart::Kind;

// All that is behind a contact as one tree.
ReferencePart whole_of(const ReferenceTree& tree) {
  ReferencePart whole{ReferenceKind::parallel, {}, {}, 0, tree.components};
  const ReferenceForm& f = tree.linear;
  if (f.static_stiffness > 0 || f.feedthrough_damping > 0 || !f.modes.empty())
    whole.children.insert(whole.children.begin(), {ReferenceKind::block, {}, f, 0, {}});
  if (whole.children.size() != 1) return whole;
  return ReferencePart(std::move(whole.children.front()));
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
      pool_["energy_weight"].push_back(f.decay < vanishing ? Reference(0)
                                                           : Reference(1 / (2 * mode.stiffness * f.decay * f.decay)));
    }
  }

  // A table's number of every node: stiffness with every slip giving way, its inverse, and the yield force.
  Reference add_table(const ReferencePart& part) {
    Reference g = 0, compliance = 0;
    bool is_flat = false;
    if (part.kind == ReferenceKind::block) g = companion(part.form, facts_);
    for (const ReferencePart& child : part.children) {
      const Reference of_child = add_table(child);
      is_flat = is_flat || of_child == 0;
      g += of_child;
      if (of_child > 0) compliance += 1 / of_child;
    }
    if (part.kind == ReferenceKind::series) g = is_flat ? Reference(0) : Reference(1 / compliance);
    for (const Reference& value : {g, g > 0 ? Reference(1 / g) : Reference(0), part.yield_force})
      pool_["table"].push_back(value);
    if (part.kind == ReferenceKind::block) add_form(part.form);
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
    for (const BrakeShare& share : shares)
      add_row_number(rows.force.change - Reference(share.feedthrough) * Reference(facts_.rate));
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
      if (const auto b = feedthrough_in(component, pattern))
        pool_["feedthrough_by_regime"].push_back(*b * Reference(facts_.rate));
    if (const auto b = feedthrough_in(component, ~std::size_t{0}))
      pool_["feedthrough_by_regime"].push_back(*b * Reference(facts_.rate));
  }

  // The same of a part that is no tree.
  void add_regimes(const RegimeList& list, const Network& network, const std::vector<std::size_t>& elements) {
    for (const Regime& regime : list.regimes) {
      const ReferenceForm form = reference_form(network_in_regime(network, elements, list.slips, regime.slides));
      pool_["feedthrough_by_regime"].push_back(form.feedthrough_damping * Reference(facts_.rate));
    }
  }

  void add_contact(const ReferenceTree& tree, const Network& network) {
    add("feedthrough", tree.linear.feedthrough_damping);
    add("feedthrough_stiffness", -tree.linear.feedthrough_damping * Reference(facts_.rate));
    if (!tree.has_slips()) add_recovery(companion(tree.linear, facts_));
    else if (tree.networks.empty()) add_table(whole_of(tree));
    else add_network(reference_network(network, elements_behind_slips(tree)), &tree.linear);
  }

  // What joins the ends over one sample, k + b/h − Σ c w wᵀ. `beside`: behind a contact, whose surface stands in the
  // tool's place and has it to the ground.
  void add_network(const ReferenceNetwork& form, const ReferenceForm* beside) {
    const std::size_t count = form.ends.size();
    add("tie", 0);
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a + 1; b < count; ++b) {
        Reference tie = form.springs[a][b] + form.dampers[a][b] * Reference(facts_.rate);
        for (const ReferenceNetworkMode& mode : form.modes)
          tie -= mode_factors(plain(mode), facts_).gain * mode.weights[a] * mode.weights[b];
        const bool joins_ends = a + 2 == count && b + 1 == count;
        if (beside != nullptr && joins_ends) tie += companion(*beside, facts_);
        add(joins_ends && beside == nullptr ? literals_in_code : "tie", tie);
        if (form.springs[a][b] > 0) add_form({form.springs[a][b], 0, {}});
      }
    for (const ReferenceNetworkMode& mode : form.modes) {
      add_form({0, 0, {plain(mode)}});
      for (const Reference& weight : mode.weights) add("weight", abs(weight));
    }
    add("links", facts_.scalar == ScalarType::float64 ? Reference(std::numeric_limits<double>::max())
                                                      : Reference(std::numeric_limits<float>::max()));
    add("links", 0);
    for (const Reference& yield : form.yield_forces) add("links", yield), add("links", -yield);
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
  // Nothing recovers behind a surface that gives no force.
  void add_recovery(const Reference& stiffness) {
    add("recovery_compliance", stiffness == 0 ? Reference(0) : Reference(-1 / stiffness));
  }
  void add_row_number(const Reference& value) { pool_["row"].push_back(abs(value)); }
  void add_row(const ReferenceRow& row) {
    add_row_number(row.change);
    for (const Reference& held : row.held) add_row_number(held);
    add_row_number(row.excess);
  }

  // Y, and Y (Y − hysteresis ∂t/∂u) where a slide ends for the command.
  void add_slip(const ReferencePart& part, const Reference& trial_by_change) {
    if (part.kind == ReferenceKind::slip) {
      const Reference& Y = part.yield_force;
      const Reference back =
          std::max(Reference(Reference(hysteresis_) * trial_by_change), Reference(Y * Reference("1e-6")));
      pool_["yield"].push_back(Y);
      pool_["leave"].push_back(Y * std::max(Reference(Y - back), Reference(0)));
    }
    for (const ReferencePart& child : part.children) add_slip(child, trial_by_change);
  }

  static ReferenceMode plain(const ReferenceNetworkMode& mode) { return {mode.stiffness, mode.relaxation_rate, 1}; }

  const LawFacts& facts_;
  double hysteresis_;
  Pool pool_;
};

ReferenceCut cut_of(const ReferenceForm& form, const LawFacts& facts) {
  ReferenceCut cut{form.static_stiffness / 2, form.feedthrough_damping};
  for (const ReferenceMode& mode : form.modes) {
    const ModeFactors f = mode_factors(mode, facts);
    cut.stiffness += f.gain / (1 + f.decay);
  }
  return cut;
}

std::optional<ReferenceCut> least_cut(const ReferencePart& part, const LawFacts& facts, const Reference& weight) {
  if (part.kind == ReferenceKind::block) return cut_of(part.form, facts);
  if (part.kind == ReferenceKind::slip) return std::nullopt;
  std::optional<ReferenceCut> least;
  ReferenceCut sum{0, 0};
  for (const ReferencePart& child : part.children) {
    const std::optional<ReferenceCut> cut = least_cut(child, facts, weight);
    if (!cut && part.kind == ReferenceKind::parallel) return std::nullopt;
    if (!cut) continue;
    sum = {sum.stiffness + cut->stiffness, sum.damping + cut->damping};
    if (!least || cut->stiffness * weight + cut->damping < least->stiffness * weight + least->damping) least = cut;
  }
  return part.kind == ReferenceKind::series ? least : sum;
}

// The same of a part that is no tree: all ways to part its ends that no slip crosses.
ReferenceCut least_cut(const Network& network, const std::vector<std::size_t>& elements, const LawFacts& facts,
                       const Reference& weight) {
  const ReferenceNetwork form = reference_network(network, elements);
  const std::size_t inner = form.ends.size() - 2;
  std::optional<ReferenceCut> least;
  for (std::size_t pattern = 0; pattern < std::size_t{1} << inner; ++pattern) {
    const auto at_tool = [&](std::size_t end) { return end < inner ? (pattern >> end & 1u) != 0 : end == inner; };
    const auto place = [&](NodeIndex node) {
      return std::size_t(std::find(form.ends.begin(), form.ends.end(), node) - form.ends.begin());
    };
    const bool is_crossed = std::any_of(elements.begin(), elements.end(), [&](std::size_t i) {
      const Element& e = network.elements[i];
      return std::holds_alternative<Slip>(e.law) && at_tool(place(e.a)) != at_tool(place(e.b));
    });
    if (is_crossed) continue;
    ReferenceCut cut{0, 0};
    for (std::size_t a = 0; a < form.ends.size(); ++a)
      for (std::size_t b = 0; b < form.ends.size(); ++b)
        if (at_tool(a) && !at_tool(b)) cut = {cut.stiffness + form.springs[a][b] / 2, cut.damping + form.dampers[a][b]};
    for (const ReferenceNetworkMode& mode : form.modes) {
      Reference pull = 0;
      for (std::size_t a = 0; a < form.ends.size(); ++a) pull += at_tool(a) ? mode.weights[a] : Reference(0);
      const ModeFactors f = mode_factors({mode.stiffness, mode.relaxation_rate, 1}, facts);
      cut.stiffness += pull * pull * f.gain / (1 + f.decay);
    }
    if (!least || cut.stiffness * weight + cut.damping < least->stiffness * weight + least->damping) least = cut;
  }
  return least.value();
}

}  // namespace

ReferenceTree rendered_tree(ReferenceTree tree, const Network& network, const SlipDecomposition& slips) {
  if (network.contact && !slips.networks.empty()) {  // all slips are solved together
    tree.networks = {elements_behind_slips(tree)};
    tree.components.clear();
  }
  for (std::size_t i = 0; i < std::min(tree.components.size(), slips.components.size()); ++i)
    if (slips.components[i].law == SlipLaw::gated)
      tree.components[i] = without_dampers_beside_slips(std::move(tree.components[i]));
  for (std::size_t i = 0; i < std::min(tree.networks.size(), slips.networks.size()); ++i) {
    if (slips.networks[i].law != SlipLaw::gated) continue;
    const std::vector<std::size_t> all = tree.networks[i];
    std::erase_if(tree.networks[i], [&](std::size_t index) {
      const Element& damper = network.elements[index];
      return std::holds_alternative<Damper>(damper.law) && std::any_of(all.begin(), all.end(), [&](std::size_t other) {
               const Element& slip = network.elements[other];
               return std::holds_alternative<Slip>(slip.law) &&
                      std::minmax(slip.a, slip.b) == std::minmax(damper.a, damper.b);
             });
    });
  }
  return tree;
}

std::vector<std::size_t> elements_behind_slips(const ReferenceTree& tree) {
  std::vector<std::size_t> elements;
  for (const ReferencePart& component : tree.components) {
    const std::vector<std::size_t> of_component = elements_of(component);
    elements.insert(elements.end(), of_component.begin(), of_component.end());
  }
  for (const std::vector<std::size_t>& part : tree.networks) elements.insert(elements.end(), part.begin(), part.end());
  return elements;
}

std::vector<std::string_view> kinds_behind_slips(std::string_view name) {
  std::vector<std::string_view> kinds;
  if (name == "velocity_gain" || name == "slips_feedthrough") return kinds;
  const bool is_picked =
      name.ends_with("_by_regime") && !name.ends_with("feedthrough_by_regime");  // b, which is chosen
  if (name.find("_by_") != name.npos && !is_picked) kinds.push_back("row");
  if (name.find("_weight_") != name.npos) kinds.push_back("weight");
  if (name.ends_with("_feedthrough")) kinds.push_back("feedthrough_by_regime");
  if (name.starts_with("coupled_")) kinds.push_back("table");
  if (name.ends_with("_between") || name.ends_with("_to_tool") || name.ends_with("_to_ground")) kinds.push_back("tie");
  for (const std::string_view kind :
       {"feedthrough_by_regime", "feedthrough_stiffness", "recovery_compliance", "energy_weight", "compliance",
        "stiffness", "yield", "leave", "gain", "decay", "loss", "velocity_drive", "links"})
    if (name.ends_with(kind)) kinds.push_back(kind);
  return kinds;
}

Pool constants_behind_slips(const ReferenceTree& tree, const Network& network, const SlipDecomposition& slips,
                            const LawFacts& facts) {
  Constants constants(facts, slips.hysteresis);
  constants.add_form(tree.linear);
  if (network.contact) {
    constants.add_contact(tree, network);
  } else {
    for (std::size_t i = 0; i < tree.components.size(); ++i) {
      const ReferencePart& component = tree.components[i];
      const std::vector<BrakeShare> none;
      if (slip_count(component) == 1)
        constants.add_single_slip(component, i < slips.components.size() ? slips.components[i].shares : none);
      else constants.add_table(component);
    }
    for (const std::vector<std::size_t>& part : tree.networks)
      constants.add_network(reference_network(network, part), nullptr);
  }
  for (const ReferencePart& component : tree.components) constants.add_regimes(component);
  for (std::size_t i = 0; i < slips.networks.size(); ++i)
    constants.add_regimes(slips.networks[i].regimes, network,
                          network.contact ? elements_behind_slips(tree) : tree.networks[i]);
  for (const ComponentSplit* split : slips.all()) constants.add_capped(*split);
  return constants.take();
}

ReferenceCut reference_cut(const ReferenceTree& tree, const Network& network, const SlipDecomposition& slips,
                           const LawFacts& facts, double lateness) {
  const Reference weight = Reference(lateness) * Reference(lateness) / Reference(facts.rate);
  const bool with_contact = network.contact.has_value();
  ReferenceCut sum{0, 0, 0};
  const auto less_the_brake = [&](const std::vector<BrakeShare>& shares) {
    if (with_contact || shares.empty()) return;
    Reference least = Reference(shares.front().feedthrough);
    for (const BrakeShare& share : shares) least = std::min(least, Reference(share.feedthrough));
    sum.brakes += least;
  };
  for (std::size_t i = 0; i < tree.components.size(); ++i) {
    const ReferenceCut cut = least_cut(tree.components[i], facts, weight).value();
    sum = {sum.stiffness + cut.stiffness, sum.damping + cut.damping, sum.brakes};
    if (i < slips.components.size()) less_the_brake(slips.components[i].shares);
  }
  for (std::size_t i = 0; i < tree.networks.size(); ++i) {
    const ReferenceCut cut = least_cut(network, tree.networks[i], facts, weight);
    sum = {sum.stiffness + cut.stiffness, sum.damping + cut.damping, sum.brakes};
    if (i < slips.networks.size()) less_the_brake(slips.networks[i].shares);
  }
  if (!with_contact) return sum;
  const ReferenceCut linear = cut_of(tree.linear, facts);
  return {sum.stiffness + linear.stiffness, sum.damping + linear.damping, sum.brakes};
}

Reference ReferenceCut::of_motor() const {
  const Reference left = damping - brakes;
  return left > damping * Reference("1e-30") ? left : Reference(0);
}

bool are_within_regimes(const ReferenceTree& tree, const SlipDecomposition& slips) {
  for (std::size_t i = 0; i < std::min(tree.components.size(), slips.components.size()); ++i) {
    const std::vector<BrakeShare>& shares = slips.components[i].shares;
    if (shares.size() != 2) continue;  // several slips: by the pool
    for (const bool slides : {false, true}) {
      const std::optional<Reference> most = feedthrough_in(tree.components[i], slides ? 1 : 0);
      if (most && Reference(shares[slides ? 1 : 0].feedthrough) > *most * (1 + Reference("1e-20"))) return false;
    }
  }
  return true;
}

}  // namespace dashpot::compiler
