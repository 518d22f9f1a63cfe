// A slip among blocks while parameters change, in closed form as discretise/slip_group has it: what its force would be
// if it held, as far as it can, and the rest as a displacement that it gives way by (theory, section 5).
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
  // From the port to the slip: in series or in parallel with what follows stands a block.
  struct Level {
    bool is_series;
    std::size_t block;
  };
  using Path = std::vector<Level>;
  // Nothing where there are several slips, or more blocks than one at a place.
  static std::optional<Path> path_of(const std::vector<slip_node<double>>& nodes, std::size_t first_block);

  // All outlive this. `name` is the slip's.
  TunedLoneSlip(TunedNumbers& numbers, const std::vector<TunedBlock>& blocks, Path path, std::string name)
      : numbers_(numbers),
        writer_(numbers.writer()),
        blocks_(blocks),
        path_(std::move(path)),
        name_(std::move(name)),
        levels_(path_.size()) {}

  const Path& path() const { return path_; }
  // In set(): by g of the block of each level, no less than 0, and the slip's yield force.
  void tune(const std::vector<ExpressionId>& stiffness, ExpressionId yield);
  // In output(): assigns the force that opposes the tool. Returns a number above zero where the slip gives way.
  ExpressionId write_step(VariableId force, ExpressionId change);
  // In update(): δ of a block of it, nothing of another.
  ExpressionId elongation(std::size_t block);

 private:
  // Numbers of a level, tuned, and `nothing` where they do not matter.
  struct Numbers {
    ExpressionId stiffness = nothing;  // g of its block
    ExpressionId held = nothing;       // of all from there on, while the slip holds; nothing where that is rigid
    ExpressionId inverse = nothing;    // in series, 1/Σ g of its block and what follows
    ExpressionId given = nothing;      // what its block is stretched by for each newton that the slip does not hold
    VariableId stretched = nothing;    // δ of its block, local of output()
  };

  bool is_held_rigid(std::size_t level) const;  // all from there on
  void tune_held();
  void tune_given();
  // From the port on, while the slip holds: δ of every block, and the slip's force.
  ExpressionId write_held(ExpressionId change, std::vector<ExpressionId>& stretched);
  // π of all from there on, while the slip holds.
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
