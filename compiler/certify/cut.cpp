#include "certify/cut.hpp"

#include <algorithm>

#include "discretise/mode_coefficients.hpp"

namespace dashpot::compiler {
namespace {

// c/(1 + a) of a mode F ← a F + c δ.
Real held_stiffness(const Real& stiffness, const Real& relaxation_rate, const CutSettings& settings) {
  const ModeCoefficients mode = mode_coefficients({stiffness, relaxation_rate, 1, {}}, settings.scheme,
                                                  StateInput::position, settings.sample_period);
  return mode.position_gain / (1 + mode.decay);
}

Real cost_of(const Cut& cut, const CutSettings& settings) {
  return cut.stiffness * settings.sample_period * Real(settings.lateness * settings.lateness) + cut.damping;
}

void keep_less(std::optional<Cut>& least, const std::optional<Cut>& cut, const CutSettings& settings) {
  if (cut && (!least || cost_of(*cut, settings) < cost_of(*least, settings))) least = cut;
}

// Which terminals are on the tool's side of a cut: the tool always, the ground never.
class Sides {
 public:
  Sides(std::size_t terminals, unsigned long pattern) : tool_(terminals - 1), ground_(terminals), pattern_(pattern) {}
  bool is_at_tool(std::size_t terminal) const {
    return terminal == tool_ || (terminal != ground_ && (pattern_ >> terminal & 1u) != 0);
  }
  bool separate(std::size_t a, std::size_t b) const { return is_at_tool(a) != is_at_tool(b); }

 private:
  std::size_t tool_, ground_;
  unsigned long pattern_;
};

Cut cut_between(const MultiportForm& form, const Sides& sides, const CutSettings& settings) {
  Cut cut;
  for (const Tie& tie : form.springs)
    if (sides.separate(tie.a, tie.b)) cut.stiffness += tie.value / 2;
  for (const Tie& tie : form.dampers)
    if (sides.separate(tie.a, tie.b)) cut.damping += tie.value;
  for (const MultiportMode& mode : form.modes) {
    Real weight = 0;  // of the mode, in the force on the tool's side
    for (std::size_t i = 0; i < form.terminals.size(); ++i)
      if (sides.is_at_tool(i)) weight += mode.weights[i];
    cut.stiffness += weight * weight * held_stiffness(mode.stiffness, mode.relaxation_rate, settings);
  }
  return cut;
}

}  // namespace

Cut cut_of(const LinearForm& form, const CutSettings& settings) {
  Cut cut{form.static_stiffness / 2, form.feedthrough_damping};
  for (const Mode& mode : form.modes) cut.stiffness += held_stiffness(mode.stiffness, mode.relaxation_rate, settings);
  return cut;
}

// In parallel every child is cut, in series only the best one.
std::optional<Cut> least_cut(const NormalTree& tree, const CutSettings& settings) {
  switch (tree.kind) {
    case NormalTree::Kind::block: return cut_of(tree.form, settings);
    case NormalTree::Kind::slip: return std::nullopt;
    case NormalTree::Kind::series: {
      std::optional<Cut> least;
      for (const NormalTree& child : tree.children) keep_less(least, least_cut(child, settings), settings);
      return least;
    }
    case NormalTree::Kind::parallel: break;
  }
  Cut sum;
  for (const NormalTree& child : tree.children) {
    const std::optional<Cut> cut = least_cut(child, settings);
    if (!cut) return std::nullopt;
    sum += *cut;
  }
  return sum;
}

std::optional<Cut> least_cut(const Network& network, const std::vector<std::size_t>& elements,
                             const CutSettings& settings) {
  const MultiportForm form = multiport_form_at_slips(network, elements);
  const std::size_t count = form.terminals.size();
  const auto place = [&](NodeIndex node) {
    return static_cast<std::size_t>(std::find(form.terminals.begin(), form.terminals.end(), node) -
                                    form.terminals.begin());
  };
  const auto slips = slips_between(network, elements);
  std::optional<Cut> least;
  for (unsigned long pattern = 0; pattern < 1ul << (count - 1); ++pattern) {
    const Sides sides(count, pattern);
    const bool is_crossed = std::any_of(slips.begin(), slips.end(), [&](const auto& slip) {
      return sides.separate(place(slip.first.first), place(slip.first.second));
    });
    if (!is_crossed) keep_less(least, cut_between(form, sides, settings), settings);
  }
  return least;
}

}  // namespace dashpot::compiler
