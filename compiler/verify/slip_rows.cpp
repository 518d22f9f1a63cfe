#include "verify/slip_rows.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

// p = g δ + Σ forces: what a part holds, as a function of its elongation; a slip is held at a given elongation.
struct Branch {
  const ReferencePart* part;
  std::size_t from, to;
  std::size_t block = 0;
};

void lay(const ReferencePart& part, std::size_t from, std::size_t to, std::size_t& nodes,
         std::vector<Branch>& branches) {
  if (part.children.empty()) return branches.push_back({&part, from, to});
  std::size_t here = from;
  for (std::size_t i = 0; i < part.children.size(); ++i) {
    const bool is_last = part.kind == ReferenceKind::parallel || i + 1 == part.children.size();
    const std::size_t next = is_last ? to : nodes++;
    lay(part.children[i], here, next, nodes, branches);
    if (part.kind == ReferenceKind::series) here = next;
  }
}

// Gauss's elimination of A x = b for several b, pivots by size.
void solve(std::vector<std::vector<Reference>>& rows, std::size_t unknowns) {
  for (std::size_t i = 0; i < unknowns; ++i) {
    const auto pivot = std::max_element(rows.begin() + std::ptrdiff_t(i), rows.end(),
                                        [i](const auto& x, const auto& y) { return abs(x[i]) < abs(y[i]); });
    std::swap(rows[i], *pivot);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (k == i || rows[k][i] == 0) continue;
      const Reference factor = rows[k][i] / rows[i][i];
      for (std::size_t j = i; j < rows[k].size(); ++j) rows[k][j] -= factor * rows[i][j];
    }
  }
}

// Unknowns are the inner nodes' displacements and the slip's force; inputs Δu, every π, and the slip's elongation.
class Step {
 public:
  Step(const ReferencePart& component, const std::vector<Reference>& stiffness) : stiffness_(stiffness) {
    lay(component, tool_, ground_, nodes_, branches_);
    std::size_t block = 0;
    for (Branch& branch : branches_)
      if (branch.part->kind == ReferenceKind::block) branch.block = block++;
    inputs_ = block + 2;
    balance();
    solve(rows_, unknowns());
  }

  std::size_t sliding() const { return inputs_ - 1; }
  Reference slip_force(std::size_t input) const { return solution(unknowns() - 1, input); }

  Reference elongation(const Branch& branch, std::size_t input) const {
    return moved(branch.from, input) - moved(branch.to, input);
  }
  const std::vector<Branch>& branches() const { return branches_; }

  Reference tool_force(std::size_t input) const {
    Reference force = 0;
    for (const Branch& branch : branches_) {
      if (branch.from != tool_) continue;
      if (branch.part->kind == ReferenceKind::slip) force += slip_force(input);
      else force += stiffness_[branch.block] * elongation(branch, input) + (input == branch.block + 1 ? 1 : 0);
    }
    return force;
  }

 private:
  std::size_t unknowns() const { return nodes_ - 2 + 1; }
  Reference solution(std::size_t unknown, std::size_t input) const {
    return rows_[unknown][unknowns() + input] / rows_[unknown][unknown];
  }
  Reference moved(std::size_t node, std::size_t input) const {
    if (node == ground_) return 0;
    return node == tool_ ? Reference(input == 0 ? 1 : 0) : solution(node - 2, input);
  }

  void balance() {
    rows_.assign(unknowns(), std::vector<Reference>(unknowns() + inputs_, 0));
    for (const Branch& branch : branches_)
      branch.part->kind == ReferenceKind::slip ? add_slip(branch) : add_block(branch);
  }

  void add_block(const Branch& branch) {
    const Reference& g = stiffness_[branch.block];
    const std::size_t ends[2] = {branch.from, branch.to};
    for (int end = 0; end < 2; ++end) {
      const std::size_t here = ends[end], there = ends[1 - end];
      if (here < 2) continue;
      std::vector<Reference>& row = rows_[here - 2];
      row[here - 2] += g;
      if (there >= 2) row[there - 2] -= g;
      if (there == tool_) row[unknowns()] += g;
      row[unknowns() + branch.block + 1] -= end == 0 ? 1 : -1;
    }
  }

  void add_slip(const Branch& branch) {
    const std::size_t force = unknowns() - 1;
    const std::size_t ends[2] = {branch.from, branch.to};
    for (int end = 0; end < 2; ++end) {
      const int sign = end == 0 ? 1 : -1;
      if (ends[end] == tool_) rows_[force][unknowns()] -= sign;
      if (ends[end] < 2) continue;
      rows_[ends[end] - 2][force] += sign;
      rows_[force][ends[end] - 2] += sign;
    }
    rows_[force][unknowns() + sliding()] += 1;
  }

  static constexpr std::size_t ground_ = 0, tool_ = 1;
  const std::vector<Reference>& stiffness_;
  std::size_t nodes_ = 2, inputs_ = 0;
  std::vector<Branch> branches_;
  std::vector<std::vector<Reference>> rows_;
};

void collect(const ReferencePart& part, std::vector<const ReferencePart*>& blocks) {
  if (part.kind == ReferenceKind::block) blocks.push_back(&part);
  for (const ReferencePart& child : part.children) collect(child, blocks);
}

}  // namespace

std::vector<const ReferencePart*> blocks_of(const ReferencePart& component) {
  std::vector<const ReferencePart*> blocks;
  collect(component, blocks);
  return blocks;
}

SlipRows slip_rows(const ReferencePart& component, const std::vector<Reference>& stiffness) {
  const Step step(component, stiffness);
  // The trial force falls by G for each unit that the slip gives way: δ_slip = r/G.
  const Reference by_excess = -1 / step.slip_force(step.sliding());
  const auto row = [&](auto value) {
    ReferenceRow r{value(std::size_t{0}), {}, value(step.sliding()) * by_excess};
    for (std::size_t i = 1; i < step.sliding(); ++i) r.held.push_back(value(i));
    return r;
  };
  SlipRows rows{row([&](std::size_t input) { return step.slip_force(input); }),
                row([&](std::size_t input) { return step.tool_force(input); }),
                {}};
  for (const Branch& branch : step.branches())
    if (branch.part->kind == ReferenceKind::block)
      rows.elongation.push_back(row([&](std::size_t input) { return step.elongation(branch, input); }));
  return rows;
}

}  // namespace dashpot::compiler
