#include "verify/reference_tree.hpp"

#include <algorithm>

#include "network/disjoint_sets.hpp"
#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

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
  ReferenceKind kind;
  std::vector<Tree> linear, slips;
  std::optional<Reference> yield_force;
  std::vector<ReferencePart> others;

  void take(ReferencePart part) {
    if (part.kind == kind) {
      for (ReferencePart& child : part.children) take(std::move(child));
    } else if (part.kind == ReferenceKind::block) {
      linear.push_back(std::move(part.elements));
    } else if (part.kind == ReferenceKind::slip) {
      const bool is_series = kind == ReferenceKind::series;
      slips.push_back(std::move(part.elements));
      yield_force = !yield_force ? part.yield_force
                    : is_series  ? std::min(*yield_force, part.yield_force)
                                 : Reference(*yield_force + part.yield_force);
    } else {
      others.push_back(std::move(part));
    }
  }

  ReferencePart part() {
    ReferencePart whole{kind, {}, {}, 0, std::move(others)};
    if (!linear.empty()) whole.children.push_back({ReferenceKind::block, together(std::move(linear)), {}, 0, {}});
    if (yield_force) whole.children.push_back({ReferenceKind::slip, together(std::move(slips)), {}, *yield_force, {}});
    if (whole.children.size() != 1) return whole;
    return ReferencePart(std::move(whole.children.front()));
  }

 private:
  Tree together(std::vector<Tree> trees) const {
    if (trees.size() == 1) return std::move(trees.front());
    return {kind == ReferenceKind::series ? Tree::Kind::series : Tree::Kind::parallel, 0, std::move(trees)};
  }
};

ReferencePart part_of(const Tree& tree, const Network& network) {
  if (tree.kind == Tree::Kind::leaf) {
    const Law& law = network.elements[tree.element].law;
    return {is_slip(law) ? ReferenceKind::slip : ReferenceKind::block, tree, {}, yield_force_of(law), {}};
  }
  Gathered gathered{tree.kind == Tree::Kind::series ? ReferenceKind::series : ReferenceKind::parallel, {}, {}, {}, {}};
  for (const Tree& child : tree.children) gathered.take(part_of(child, network));
  return gathered.part();
}

void fill_forms(ReferencePart& part, const Network& network) {
  if (part.kind == ReferenceKind::block) part.form = reference_form(laid_out(part.elements, network));
  for (ReferencePart& child : part.children) fill_forms(child, network);
}

bool is_of_slips(const ReferencePart& part) { return part.kind == ReferenceKind::slip; }

void collect(const Tree& tree, std::vector<std::size_t>& elements) {
  if (tree.kind == Tree::Kind::leaf) elements.push_back(tree.element);
  for (const Tree& child : tree.children) collect(child, elements);
}

void collect(const ReferencePart& part, std::vector<std::size_t>& elements) {
  if (part.children.empty()) collect(part.elements, elements);
  for (const ReferencePart& child : part.children) collect(child, elements);
}

// All slips move the surface together.
void join_behind_surface(ReferenceTree& tree) {
  std::vector<std::size_t> together;
  for (const ReferencePart& component : tree.components) collect(component, together);
  for (const std::vector<std::size_t>& part : tree.networks) together.insert(together.end(), part.begin(), part.end());
  tree.components.clear();
  tree.networks = {std::move(together)};
}

Network only(const std::vector<std::size_t>& elements, Network network) {
  for (Element& element : network.elements) element.has_effect = false;
  for (std::size_t i : elements) network.elements[i].has_effect = true;
  return network;
}

}  // namespace

std::vector<std::vector<std::size_t>> parts_between_ends(const Network& network) {
  std::vector<std::vector<std::size_t>> parts;
  DisjointSets joined(network.nodes.size());
  for (const Element& e : network.elements)
    if (e.has_effect && std::min(e.a, e.b) > tool) joined.unite(e.a, e.b);
  std::vector<NodeIndex> leader_of_part;
  for (std::size_t i = 0; i < network.elements.size(); ++i) {
    const Element& e = network.elements[i];
    if (!e.has_effect) continue;
    const NodeIndex first = std::max(e.a, e.b) <= tool ? network.nodes.size() + i : joined.find(std::max(e.a, e.b));
    const auto known = std::find(leader_of_part.begin(), leader_of_part.end(), first);
    if (known == leader_of_part.end()) {
      leader_of_part.push_back(first);
      parts.push_back({i});
    } else {
      parts[std::size_t(known - leader_of_part.begin())].push_back(i);
    }
  }
  return parts;
}

ReferenceTree reference_tree(const Network& network) {
  ReferenceTree result;
  result.linear_network = network;
  for (Element& element : result.linear_network.elements) element.has_effect = false;
  for (const std::vector<std::size_t>& part : parts_between_ends(network)) {
    const Network alone = only(part, network);
    const bool slips =
        std::any_of(part.begin(), part.end(), [&](std::size_t i) { return is_slip(network.elements[i].law); });
    const std::optional<Tree> tree = series_parallel_tree(alone);
    if (!slips)
      for (std::size_t i : part) result.linear_network.elements[i].has_effect = true;
    else if (tree) result.components.push_back(part_of(*tree, network));
    else result.networks.push_back(part);
  }
  if (network.contact && !result.networks.empty()) join_behind_surface(result);
  for (ReferencePart& component : result.components) fill_forms(component, network);
  result.linear = reference_form(result.linear_network);
  return result;
}

Network laid_out(const Tree& tree, const Network& network) { return Chain(network).of(tree); }

std::vector<std::size_t> elements_of(const ReferencePart& part) {
  std::vector<std::size_t> elements;
  collect(part, elements);
  return elements;
}

std::vector<std::size_t> elements_of(const Tree& tree) {
  std::vector<std::size_t> elements;
  collect(tree, elements);
  return elements;
}

std::vector<std::size_t> sorted(std::vector<std::size_t> elements) {
  std::sort(elements.begin(), elements.end());
  return elements;
}

std::size_t slip_count(const ReferencePart& part) {
  std::size_t count = is_of_slips(part) ? 1 : 0;
  for (const ReferencePart& child : part.children) count += slip_count(child);
  return count;
}

// In a chain of slips that would have no damper left only that which yields first is without one.
ReferencePart without_dampers_beside_slips(ReferencePart part) {
  const auto alone = [](const ReferencePart& child) {
    return child.kind == ReferenceKind::parallel && without_dampers_beside_slips(child).kind == ReferenceKind::slip;
  };
  const auto yields_sooner = [](const ReferencePart& one, const ReferencePart& other) {
    return without_dampers_beside_slips(one).yield_force < without_dampers_beside_slips(other).yield_force;
  };
  const ReferencePart* sole = nullptr;
  if (part.kind == ReferenceKind::series && std::none_of(part.children.begin(), part.children.end(), is_of_slips))
    for (const ReferencePart& child : part.children)
      if (alone(child) && (sole == nullptr || yields_sooner(child, *sole))) sole = &child;
  const bool beside =
      part.kind == ReferenceKind::parallel && std::any_of(part.children.begin(), part.children.end(), is_of_slips);
  for (ReferencePart& child : part.children) {
    if (child.kind == ReferenceKind::block)
      child.form.feedthrough_damping = beside ? Reference(0) : child.form.feedthrough_damping;
    else if (part.kind != ReferenceKind::series || &child == sole || !alone(child))
      child = without_dampers_beside_slips(std::move(child));
  }
  std::erase_if(part.children, [](const ReferencePart& child) {
    return child.kind == ReferenceKind::block && child.form.static_stiffness == 0 &&
           child.form.feedthrough_damping == 0 && child.form.modes.empty();
  });
  if (part.children.size() != 1) return part;
  return ReferencePart(std::move(part.children.front()));
}

std::optional<Reference> feedthrough_in(const ReferencePart& part, std::size_t pattern) {
  if (part.kind == ReferenceKind::block) return part.form.feedthrough_damping;
  if (part.kind == ReferenceKind::slip) return (pattern & 1u) != 0 ? std::optional<Reference>(0) : std::nullopt;
  Reference sum = 0, inverse = 0;
  bool is_open = false, is_rigid = true, is_held = false;
  for (const ReferencePart& child : part.children) {
    const std::optional<Reference> b = feedthrough_in(child, pattern);
    const std::size_t slips = slip_count(child);
    if (slips < 64 && pattern != every_slip_slides) pattern >>= slips;
    is_rigid = is_rigid && !b;
    is_held = is_held || !b;
    is_open = is_open || (b && *b == 0);
    if (b) sum += *b;
    if (b && *b > 0) inverse += 1 / *b;
  }
  if (part.kind == ReferenceKind::parallel) return is_held ? std::nullopt : std::optional(sum);
  if (is_open) return Reference(0);
  return is_rigid ? std::nullopt : std::optional(Reference(1 / inverse));
}

}  // namespace dashpot::compiler
