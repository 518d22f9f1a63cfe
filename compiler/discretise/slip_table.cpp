#include "discretise/slip_table.hpp"

#include <algorithm>
#include <map>

#include "discretise/law_writer.hpp"

namespace dashpot::compiler {
namespace {

std::vector<const NormalTree*> breadth_first(const NormalTree& component) {
  std::vector<const NormalTree*> parts{&component};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const NormalTree& part = *parts[i];
    for (const NormalTree& child : part.children) parts.push_back(&child);
  }
  return parts;
}

std::vector<const NormalTree*> only(NormalTree::Kind kind, std::vector<const NormalTree*> parts) {
  std::erase_if(parts, [=](const NormalTree* part) { return part->kind != kind; });
  return parts;
}

slip_part part_kind(NormalTree::Kind kind) {
  switch (kind) {
    case NormalTree::Kind::block: return slip_part::block;
    case NormalTree::Kind::slip: return slip_part::slip;
    case NormalTree::Kind::series: return slip_part::series;
    case NormalTree::Kind::parallel: return slip_part::parallel;
  }
  return slip_part::block;
}

// With every slip giving way: of a block g, of a slip 0, in parallel the sum, in series the inverse of Σ 1/g_i.
class EndStiffness {
 public:
  void set(const NormalTree* block, const Real& stiffness) { known_[block] = stiffness; }

  void add_up(const NormalTree& part) {
    Real sum = 0, compliance = 0;
    bool is_flat = part.children.empty();
    for (const NormalTree& child : part.children) {
      const Real& g = known_[&child];
      is_flat = is_flat || (part.kind == NormalTree::Kind::series && g == 0);
      sum += g;
      if (g > 0) compliance += 1 / g;
    }
    known_[&part] = is_flat ? Real(0) : part.kind == NormalTree::Kind::series ? Real(1 / compliance) : sum;
  }

  const Real& of(const NormalTree* part) { return known_[part]; }

 private:
  std::map<const NormalTree*, Real> known_;
};

}  // namespace

std::vector<const NormalTree*> blocks_breadth_first(const NormalTree& component) {
  return only(NormalTree::Kind::block, breadth_first(component));
}

SlipTable slip_table(const NormalTree& component, const std::vector<Real>& stiffness, ScalarType scalar) {
  const std::vector<const NormalTree*> parts = breadth_first(component);
  SlipTable table{{}, only(NormalTree::Kind::block, parts), only(NormalTree::Kind::slip, parts)};
  EndStiffness end_stiffness;
  for (std::size_t i = 0; i < table.blocks.size(); ++i) end_stiffness.set(table.blocks[i], stiffness[i]);
  for (auto part = parts.rbegin(); part != parts.rend(); ++part)
    if ((*part)->kind != NormalTree::Kind::block) end_stiffness.add_up(**part);
  int next_child = 1, next_block = 0, next_slip = 0, next_corner = 0;
  for (const NormalTree* part : parts) {
    const Real& g = end_stiffness.of(part);
    const int children = static_cast<int>(part->children.size()), slips = static_cast<int>(slip_count(*part));
    const bool is_block = part->kind == NormalTree::Kind::block, is_slip = part->kind == NormalTree::Kind::slip;
    table.nodes.push_back({part_kind(part->kind), children == 0 ? 0 : next_child, children, slips,
                           is_block  ? next_block++
                           : is_slip ? next_slip++
                                     : 0,
                           is_block ? 0 : next_corner, rounded(g, scalar), g > 0 ? rounded(1 / g, scalar) : 0.0,
                           rounded(Real(part->yield_force), scalar)});
    next_child += children;
    if (!is_block) next_corner += slip_curve_room(slips);
  }
  return table;
}

}  // namespace dashpot::compiler
