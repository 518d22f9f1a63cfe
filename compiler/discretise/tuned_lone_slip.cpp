#include "discretise/tuned_lone_slip.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dashpot::compiler {

std::optional<TunedLoneSlip::Path> TunedLoneSlip::path_of(const std::vector<slip_node<double>>& nodes,
                                                          std::size_t first_block) {
  Path path;
  std::size_t at = 0;
  while (nodes[at].kind != slip_part::slip) {
    const slip_node<double>& node = nodes[at];
    if (node.child_count != 2) return std::nullopt;
    const auto first = static_cast<std::size_t>(node.first_child);
    const std::size_t block = nodes[first].kind == slip_part::block ? first : first + 1;
    if (nodes[block].kind != slip_part::block) return std::nullopt;
    path.push_back({node.kind == slip_part::series, first_block + static_cast<std::size_t>(nodes[block].place)});
    at = block == first ? first + 1 : first;
  }
  return std::any_of(path.begin(), path.end(), [](const Level& l) { return l.is_series; }) ? std::optional(path)
                                                                                           : std::nullopt;
}

bool TunedLoneSlip::is_held_rigid(std::size_t level) const {
  return std::none_of(path_.begin() + static_cast<std::ptrdiff_t>(level), path_.end(),
                      [](const Level& l) { return l.is_series; });
}

void TunedLoneSlip::tune(const std::vector<ExpressionId>& stiffness, ExpressionId yield) {
  yield_ = yield;
  for (std::size_t i = 0; i < path_.size(); ++i)
    levels_[i].stiffness = numbers_.tuned(joined(block_name(i), "answer"), writer_.stiffness(),
                                          "g, stiffness of the block over one sample", stiffness[i]);
  tune_held();
  tune_given();
}

// From the slip to the port: in parallel stiffnesses add up, in series their inverses do. Levels before the first
// series need no value.
void TunedLoneSlip::tune_held() {
  const auto first = static_cast<std::size_t>(
      std::find_if(path_.begin(), path_.end(), [](const Level& l) { return l.is_series; }) - path_.begin());
  for (std::size_t i = path_.size(); i-- > 0;) {
    Numbers& level = levels_[i];
    if (is_held_rigid(i + 1)) {
      if (path_[i].is_series) level.held = level.stiffness;
      continue;
    }
    const std::string name = joined(block_name(i), "with_what_follows");
    const ExpressionId both = writer_.add(level.stiffness, levels_[i + 1].held);
    if (path_[i].is_series) {
      level.inverse = numbers_.tuned(joined(name, "gives"), writer_.compliance(),
                                     "1/Σ g of the block and of all beyond it", writer_.divide(numbers_.one(), both));
      const ExpressionId product = writer_.multiply(level.stiffness, levels_[i + 1].held);
      if (i > first)
        level.held = numbers_.tuned(joined(name, "answer"), writer_.stiffness(),
                                    "g of the block and of all beyond it, while the slip holds",
                                    writer_.multiply(product, level.inverse));
    } else if (i > first) {
      level.held = numbers_.tuned(joined(name, "answer"), writer_.stiffness(),
                                  "g of the block and of all beyond it, while the slip holds", both);
    }
  }
}

// From the port to the slip: the stiffness that resists the slip's displacement while the port does not move; and back
// again: how that displacement is shared.
void TunedLoneSlip::tune_given() {
  std::vector<ExpressionId> resisting(path_.size() + 1, nothing);  // nothing where nothing gives way
  for (std::size_t i = 0; i < path_.size(); ++i) {
    const ExpressionId g = levels_[i].stiffness, before = resisting[i];
    if (before == nothing) resisting[i + 1] = path_[i].is_series ? g : before;
    else if (!path_[i].is_series) resisting[i + 1] = writer_.add(before, g);
    else resisting[i + 1] = writer_.divide(writer_.multiply(before, g), writer_.add(before, g));
    if (resisting[i + 1] != nothing)
      resisting[i + 1] =
          numbers_.named(joined(name_, fmt::format("resisted_{}", i + 1)), writer_.stiffness(), resisting[i + 1]);
  }
  ExpressionId moved = writer_.divide(numbers_.one(), resisting.back());
  for (std::size_t i = path_.size(); i-- > 0 && resisting[i + 1] != nothing;) {
    moved = numbers_.named(joined(name_, fmt::format("moved_{}", i + 1)), writer_.compliance(), moved);
    Numbers& level = levels_[i];
    const auto given = [&](ExpressionId value) {
      return numbers_.tuned(joined(block_name(i), "given_way"), writer_.compliance(),
                            "δ for each newton that the slip does not hold", value);
    };
    if (!path_[i].is_series) {
      level.given = given(moved);
    } else if (resisting[i] == nothing) {
      level.given = given(writer_.subtract(numbers_.zero(), moved));
    } else {
      const ExpressionId pulled = writer_.multiply(resisting[i + 1], moved);
      level.given = given(writer_.subtract(numbers_.zero(), writer_.divide(pulled, level.stiffness)));
      moved = writer_.divide(pulled, resisting[i]);
    }
  }
}

ExpressionId TunedLoneSlip::pi(std::size_t level) const {
  const VariableId held = blocks_[path_[level].block].held;
  return held == nothing ? ExpressionId(nothing) : writer_.read(held);
}

ExpressionId TunedLoneSlip::held_force(std::size_t level) {
  if (level == path_.size()) return nothing;
  const ExpressionId own = pi(level);
  if (is_held_rigid(level + 1)) return path_[level].is_series ? own : ExpressionId(nothing);
  const ExpressionId further = held_force(level + 1);
  if (!path_[level].is_series) return own == nothing ? further : writer_.plus(further, own);
  ExpressionId sum = times(levels_[level].stiffness, further);
  if (own != nothing) sum = writer_.plus(sum, times(levels_[level + 1].held, own));
  const ExpressionId found = times(levels_[level].inverse, sum);
  return found == nothing ? found
                          : local(joined(block_name(level), "held_behind"), writer_.force(), found,
                                  "force of the block and of all beyond it if they keep their length");
}

ExpressionId TunedLoneSlip::block_force(std::size_t level, ExpressionId stretched) {
  const ExpressionId force = writer_.multiply(levels_[level].stiffness, stretched), own = pi(level);
  return own == nothing ? force : writer_.add(force, own);
}

ExpressionId TunedLoneSlip::write_held(ExpressionId change, std::vector<ExpressionId>& stretched) {
  ExpressionId here = change, force = nothing;
  for (std::size_t i = 0; i < path_.size(); ++i) {
    if (!path_[i].is_series) {
      // A block beside a slip that holds is not stretched; the slip's force is the total less that of the block.
      if (force != nothing) force = minus(force, pi(i));
      else stretched[i] = here;
    } else if (is_held_rigid(i + 1)) {
      stretched[i] = here;
      force = block_force(i, here);
    } else {
      const ExpressionId further = held_force(i + 1);
      ExpressionId sum = times(levels_[i].stiffness, here);
      if (const ExpressionId difference = minus(pi(i), further); difference != nothing)
        sum = writer_.add(sum, difference);
      const ExpressionId next =
          local(joined(block_name(i), "behind_if_stuck"), writer_.length(), writer_.multiply(levels_[i].inverse, sum),
                "δ of all beyond the block, if the slip held");
      stretched[i] = writer_.subtract(here, next);
      here = next;
    }
  }
  return force;
}

ExpressionId TunedLoneSlip::write_step(VariableId target, ExpressionId change) {
  std::vector<ExpressionId> stretched(path_.size(), nothing);
  const ExpressionId trial =
      local(joined(name_, "trial"), writer_.force(), write_held(change, stretched), "force of the slip if it held");
  const ExpressionId slip =
      local(joined(name_, "force"), writer_.force(), writer_.clamp(trial, yield_), "clamp(trial, ±Y)");
  const ExpressionId excess =
      local(joined(name_, "excess"), writer_.force(), writer_.subtract(trial, slip), "excess = trial − force");
  for (std::size_t i = 0; i < path_.size(); ++i) {
    if (levels_[i].given != nothing) {
      const ExpressionId more = writer_.multiply(levels_[i].given, excess);
      stretched[i] = stretched[i] == nothing ? more : writer_.add(stretched[i], more);
    }
    if (pi(i) == nothing || stretched[i] == nothing) continue;
    levels_[i].stretched =
        numbers_.local(joined(block_name(i), "stretched"), writer_.length(), stretched[i], "δ of the block");
    stretched[i] = writer_.read(levels_[i].stretched);
  }
  // The blocks in parallel at the port, up to the first level in series.
  ExpressionId sum = nothing;
  std::size_t i = 0;
  for (; !path_[i].is_series; ++i) sum = writer_.plus(sum, block_force(i, change));
  // A block in series with the slip alone has the slip's force.
  const ExpressionId inner = i + 1 == path_.size() ? slip : block_force(i, stretched[i]);
  numbers_.assign(target, writer_.plus(sum, inner), "f");
  return writer_.where(excess, excess, writer_.subtract(numbers_.zero(), excess));
}

ExpressionId TunedLoneSlip::elongation(std::size_t block) {
  for (std::size_t i = 0; i < path_.size(); ++i)
    if (path_[i].block == block)
      return levels_[i].stretched == nothing ? ExpressionId(nothing) : writer_.read(writer_.kept(levels_[i].stretched));
  return nothing;
}

ExpressionId TunedLoneSlip::local(const std::string& name, const std::string& unit, ExpressionId value,
                                  const char* purpose) {
  return writer_.read(numbers_.local(name, unit, value, purpose));
}

ExpressionId TunedLoneSlip::times(ExpressionId a, ExpressionId b) {
  return a == nothing || b == nothing ? ExpressionId(nothing) : writer_.multiply(a, b);
}

ExpressionId TunedLoneSlip::minus(ExpressionId a, ExpressionId b) {
  if (b == nothing) return a;
  return writer_.subtract(a == nothing ? numbers_.zero() : a, b);
}

}  // namespace dashpot::compiler
