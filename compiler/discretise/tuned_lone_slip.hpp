// One slip among blocks while parameters change, in the closed form of discretise/slip_group: its force is what it
// would be if the slip held, up to the yield force; the rest decides how far the slip gives way (theory, section 5).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "law/tunable_tables.hpp"
#include "discretise/tuned_block.hpp"
#include "discretise/tuned_numbers.hpp"

namespace dashpot::compiler {

class TunedLoneSlip {
 public:
  // The path from the port to the slip: at each level a block is in series or in parallel with all that follows.
  struct Level {
    bool is_series;
    std::size_t block;
  };
  using Path = std::vector<Level>;
  // Nothing if there are several slips, or more than one block at a level.
  static std::optional<Path> path_of(const std::vector<slip_node<double>>& nodes, std::size_t first_block);

  // All must outlive this object. `name` is the slip's.
  TunedLoneSlip(TunedNumbers& numbers, const std::vector<TunedBlock>& blocks, Path path, std::string name)
      : numbers_(numbers),
        writer_(numbers.writer()),
        blocks_(blocks),
        path_(std::move(path)),
        name_(std::move(name)),
        levels_(path_.size()) {}

  const Path& path() const { return path_; }
  // In set(): from g of each level's block, 0 or more, and the slip's yield force.
  void tune(const std::vector<ExpressionId>& stiffness, ExpressionId yield);
  // In output(): assigns the force that opposes the tool. Returns a number above zero where the slip gives way.
  ExpressionId write_step(VariableId force, ExpressionId change);
  // In update(): δ of a block on the path, `nothing` for another block.
  ExpressionId elongation(std::size_t block);

 private:
  // Tuned numbers of a level; `nothing` if they are not needed.
  struct Numbers {
    ExpressionId stiffness = nothing;  // g of its block
    ExpressionId held = nothing;       // g of this level and all beyond, while the slip holds; `nothing` if rigid
    ExpressionId inverse = nothing;    // in series, 1/Σ g of its block and what follows
    ExpressionId given = nothing;      // elongation of its block for each newton that the slip does not hold
    VariableId stretched = nothing;    // δ of its block, local of output()
  };

  bool is_held_rigid(std::size_t level) const;  // whether this level and all beyond are rigid while the slip holds
  void tune_held();
  void tune_given();
  // While the slip holds: δ of every block, and the slip's force.
  ExpressionId write_held(ExpressionId change, std::vector<ExpressionId>& stretched);
  // The held force π of this level and all beyond, while the slip holds.
  ExpressionId held_force(std::size_t level);
  ExpressionId block_force(std::size_t level, ExpressionId stretched);
  ExpressionId pi(std::size_t level) const;
  ExpressionId local(const std::string& what, const std::string& unit, ExpressionId value, const char* purpose);
  ExpressionId times(ExpressionId a, ExpressionId b);
  ExpressionId minus(ExpressionId a, ExpressionId b);
  std::string block_name(std::size_t level) const { return blocks_[path_[level].block].name; }

  TunedNumbers& numbers_;
  LawWriter& writer_;
  const std::vector<TunedBlock>& blocks_;
  Path path_;
  std::string name_;
  std::vector<Numbers> levels_;
  ExpressionId yield_ = nothing;
};

}  // namespace dashpot::compiler
