#include "verify/reference_tree.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

using Kind = ReferencePart::Kind;

// The elements of a linear subtree between a tool and a ground of their own.
class Chain {
 public:
  explicit Chain(const Network& network) : network_(network) { chain_.nodes = {"ground", "tool"}; }

  Network of(const Tree& tree) {
    lay(tree, tool, ground);
    return std::move(chain_);
  }

 private:
  void lay(const Tree& tree, NodeIndex from, NodeIndex to) {
    if (tree.kind == Tree::Kind::leaf) {
      chain_.elements.push_back(network_.elements[tree.element]);
      chain_.elements.back().a = from;
      chain_.elements.back().b = to;
      return;
    }
    NodeIndex here = from;
    for (std::size_t i = 0; i < tree.children.size(); ++i) {
      const bool is_last = tree.kind == Tree::Kind::parallel || i + 1 == tree.children.size();
      if (!is_last) chain_.nodes.push_back("");
      const NodeIndex next = is_last ? to : chain_.nodes.size() - 1;
      lay(tree.children[i], here, next);
      if (tree.kind == Tree::Kind::series) here = next;
    }
  }

  const Network& network_;
  Network chain_;
};

// Children of one node, sorted into what is linear, what is slip and what is neither.
struct Gathered {
  Kind kind;
  std::vector<Tree> linear;
  std::optional<Reference> yield_force;
  std::vector<ReferencePart> others;

  void take(ReferencePart part) {
    if (part.kind == kind) {
      for (ReferencePart& child : part.children) take(std::move(child));
    } else if (part.kind == Kind::block) {
      linear.push_back(std::move(part.linear));
    } else if (part.kind == Kind::slip) {
      const bool is_series = kind == Kind::series;
      yield_force = !yield_force ? part.yield_force : is_series ? std::min(*yield_force, part.yield_force) : Reference(*yield_force + part.yield_force);
    } else {
      others.push_back(std::move(part));
    }
  }

  ReferencePart part() {
    ReferencePart whole{kind, {}, {}, 0, std::move(others)};
    const Tree::Kind like = kind == Kind::series ? Tree::Kind::series : Tree::Kind::parallel;
    if (linear.size() == 1) whole.children.push_back({Kind::block, std::move(linear.front()), {}, 0, {}});
    if (linear.size() > 1) whole.children.push_back({Kind::block, Tree{like, 0, std::move(linear)}, {}, 0, {}});
    if (yield_force) whole.children.push_back({Kind::slip, {}, {}, *yield_force, {}});
    if (whole.children.size() != 1) return whole;
    return ReferencePart(std::move(whole.children.front()));
  }
};

ReferencePart part_of(const Tree& tree, const Network& network) {
  if (tree.kind == Tree::Kind::leaf) {
    const Slip* slip = std::get_if<Slip>(&network.elements[tree.element].law);
    return slip ? ReferencePart{Kind::slip, {}, {}, slip->yield_force, {}} : ReferencePart{Kind::block, tree, {}, 0, {}};
  }
  Gathered gathered{tree.kind == Tree::Kind::series ? Kind::series : Kind::parallel, {}, {}, {}};
  for (const Tree& child : tree.children) gathered.take(part_of(child, network));
  return gathered.part();
}

void fill_forms(ReferencePart& part, const Network& network) {
  if (part.kind == Kind::block) part.form = reference_form(Chain(network).of(part.linear));
  for (ReferencePart& child : part.children) fill_forms(child, network);
}

bool is_slip(const ReferencePart& part) { return part.kind == Kind::slip; }

}  // namespace

std::optional<ReferenceTree> reference_tree(const Network& network) {
  const std::optional<Tree> tree = series_parallel_tree(network);
  if (!tree) return std::nullopt;
  ReferencePart whole = part_of(*tree, network);
  fill_forms(whole, network);
  if (whole.kind == Kind::block) return ReferenceTree{whole.form, {}};
  if (whole.kind == Kind::series) return ReferenceTree{{}, {whole}};
  ReferenceTree result;
  for (ReferencePart& child : whole.children)
    if (child.kind == Kind::block)
      result.linear = child.form;
    else
      result.components.push_back(std::move(child));
  return result;
}

std::size_t slip_count(const ReferencePart& part) {
  std::size_t count = is_slip(part) ? 1 : 0;
  for (const ReferencePart& child : part.children) count += slip_count(child);
  return count;
}

ReferencePart without_dampers_beside_slips(ReferencePart part) {
  const bool beside = part.kind == Kind::parallel && std::any_of(part.children.begin(), part.children.end(), is_slip);
  for (ReferencePart& child : part.children) {
    if (child.kind != Kind::block) child = without_dampers_beside_slips(std::move(child));
    else if (beside) child.form.feedthrough_damping = 0;
  }
  std::erase_if(part.children, [](const ReferencePart& child) {
    return child.kind == Kind::block && child.form.static_stiffness == 0 && child.form.feedthrough_damping == 0 && child.form.modes.empty();
  });
  if (part.children.size() != 1) return part;
  return ReferencePart(std::move(part.children.front()));
}

std::optional<Reference> feedthrough_in(const ReferencePart& part, std::size_t pattern) {
  if (part.kind == Kind::block) return part.form.feedthrough_damping;
  if (part.kind == Kind::slip) return (pattern & 1u) != 0 ? std::optional<Reference>(0) : std::nullopt;
  Reference sum = 0, inverse = 0;
  bool is_open = false, is_rigid = true, is_held = false;
  for (const ReferencePart& child : part.children) {
    const std::optional<Reference> b = feedthrough_in(child, pattern);
    const std::size_t slips = slip_count(child);
    if (slips < 64) pattern >>= slips;
    is_rigid = is_rigid && !b;
    is_held = is_held || !b;
    is_open = is_open || (b && *b == 0);
    if (b) sum += *b;
    if (b && *b > 0) inverse += 1 / *b;
  }
  if (part.kind == Kind::parallel) return is_held ? std::nullopt : std::optional(sum);
  if (is_open) return Reference(0);
  return is_rigid ? std::nullopt : std::optional(Reference(1 / inverse));
}

}  // namespace dashpot::compiler
