#include "decompose/beside_slips.hpp"

#include <algorithm>
#include <utility>

#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

bool has_force(const LinearForm& form) {
  return form.static_stiffness > 0 || form.feedthrough_damping > 0 || !form.modes.empty();
}

bool is_slip(const NormalTree& tree) { return tree.kind == NormalTree::Kind::slip; }

bool is_damper(const NormalTree& tree) {
  return tree.kind == NormalTree::Kind::block && tree.form.static_stiffness == 0 && tree.form.modes.empty();
}

// Whether the part is a slip and a damper, and nothing else.
bool is_damped_slip(const NormalTree& tree) {
  return tree.kind == NormalTree::Kind::parallel && tree.children.size() == 2 &&
         std::any_of(tree.children.begin(), tree.children.end(), is_slip) &&
         std::any_of(tree.children.begin(), tree.children.end(), is_damper);
}

Real yield_of(const NormalTree& damped_slip) {
  return std::find_if(damped_slip.children.begin(), damped_slip.children.end(), is_slip)->yield_force;
}

bool drop_dampers(NormalTree& tree);

bool drop_damper_beside_slip(NormalTree& parallel) {
  bool dropped = false;
  for (NormalTree& child : parallel.children) {
    if (child.kind != NormalTree::Kind::block || child.form.feedthrough_damping == 0) continue;
    child.form.feedthrough_damping = 0;
    dropped = true;
  }
  std::erase_if(parallel.children, [](const NormalTree& child) {
    return child.kind == NormalTree::Kind::block && !has_force(child.form);
  });
  if (parallel.children.size() == 1) parallel = NormalTree(std::move(parallel.children.front()));
  return dropped;
}

bool drop_in_parallel(NormalTree& parallel) {
  bool dropped = false;
  for (NormalTree& child : parallel.children) dropped |= drop_dampers(child);
  const bool beside = std::any_of(parallel.children.begin(), parallel.children.end(), is_slip);
  return (beside && drop_damper_beside_slip(parallel)) || dropped;
}

bool drop_in_series(NormalTree& series) {
  bool dropped = false;
  NormalTree* weakest = nullptr;
  for (NormalTree& child : series.children) {
    if (!is_damped_slip(child)) dropped |= drop_dampers(child);
    else if (weakest == nullptr || yield_of(child) < yield_of(*weakest)) weakest = &child;
  }
  const bool has_bare_slip = std::any_of(series.children.begin(), series.children.end(), is_slip);
  return (weakest != nullptr && !has_bare_slip && drop_dampers(*weakest)) || dropped;
}

bool drop_dampers(NormalTree& tree) {
  if (tree.kind == NormalTree::Kind::parallel) return drop_in_parallel(tree);
  return tree.kind == NormalTree::Kind::series && drop_in_series(tree);
}

// How a part acts on the rest: rigid, as a constant force, or as a linear form.
struct Answer {
  enum class Hold { rigid, constant, form } hold;
  LinearForm form = {};
};

class RegimeForm {
 public:
  RegimeForm(const std::vector<SlipElements>& slips, const std::vector<bool>& slides)
      : slips_(slips), slides_(slides) {}

  Answer of(const NormalTree& tree) const {
    switch (tree.kind) {
      case NormalTree::Kind::block: return {Answer::Hold::form, tree.form};
      case NormalTree::Kind::slip: return {does_slide(tree) ? Answer::Hold::constant : Answer::Hold::rigid};
      case NormalTree::Kind::series:
      case NormalTree::Kind::parallel: break;
    }
    return joined(tree);
  }

 private:
  bool does_slide(const NormalTree& slip) const {
    return slides_[static_cast<std::size_t>(std::find(slips_.begin(), slips_.end(), slip.elements) - slips_.begin())];
  }

  // In parallel forms add up, a constant force adds nothing, and a rigid part makes all rigid. In series the
  // reciprocals add up, a rigid part adds nothing, and a constant force is the force of all.
  Answer joined(const NormalTree& tree) const {
    const bool in_series = tree.kind == NormalTree::Kind::series;
    const auto [neutral, deciding] = in_series ? std::pair(Answer::Hold::rigid, Answer::Hold::constant)
                                               : std::pair(Answer::Hold::constant, Answer::Hold::rigid);
    Answer sum{neutral};
    for (const NormalTree& child : tree.children) {
      Answer answer = of(child);
      if (answer.hold == deciding) return answer;
      if (answer.hold == neutral) continue;
      sum = {Answer::Hold::form, in_parallel(std::move(sum.form), in_series ? reciprocal(answer.form) : answer.form)};
    }
    if (in_series && sum.hold == Answer::Hold::form) sum.form = reciprocal(sum.form);
    return sum;
  }

  const std::vector<SlipElements>& slips_;
  const std::vector<bool>& slides_;
};

}  // namespace

std::optional<NormalTree> without_dampers_beside_slips(NormalTree component) {
  return drop_dampers(component) ? std::optional(std::move(component)) : std::nullopt;
}

std::optional<std::vector<std::size_t>> without_dampers_beside_slips(const Network& network,
                                                                     const std::vector<std::size_t>& elements) {
  const auto slips = slips_between(network, elements);
  std::vector<std::size_t> left = elements;
  std::erase_if(left, [&](std::size_t index) {
    const Element& element = network.elements[index];
    return is_damper(element.law) && slips.count(std::minmax(element.a, element.b)) != 0;
  });
  return left.size() < elements.size() ? std::optional(std::move(left)) : std::nullopt;
}

LinearForm form_in_regime(const NormalTree& component, const std::vector<SlipElements>& slips,
                          const std::vector<bool>& slides) {
  return RegimeForm(slips, slides).of(component).form;
}

}  // namespace dashpot::compiler
