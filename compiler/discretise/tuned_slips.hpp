// Slips while parameters change: the numbers of their solvers, which set() computes, the steps of the solvers, and the
// damping that is left to the brake (theory, section 6).
#pragma once

#include <string>
#include <vector>

#include "discretise/slide_memory.hpp"
#include "law/tunable_tables.hpp"
#include "discretise/tuned_block.hpp"
#include "discretise/tuned_lone_slip.hpp"
#include "discretise/tuned_numbers.hpp"

namespace dashpot::compiler {

class TunedSlips {
 public:
  // All must outlive this object; the contents of the blocks may be filled in later.
  TunedSlips(TunedNumbers& numbers, const TunableTables& tables, const std::vector<TunedBlock>& blocks)
      : numbers_(numbers), writer_(numbers.writer()), tables_(tables), rule_(tables.head.slip_rule), blocks_(blocks) {}

  void declare();
  // In set(), when every block has its g.
  void tune(const std::vector<ExpressionId>& numbers);

  // In output(): the force that opposes the tool, by its change; behind a surface, by the tool's approach, also the
  // surface's change.
  void write_step(VariableId force, ExpressionId change);
  void write_push(VariableId force, ExpressionId approach, VariableId surface_change);
  // After that: b∞/h behind slips as far as the brake makes it, the present b and, if asked for, the b that a lagging
  // coil moves to.
  struct Brake {
    VariableId now, damping, wanted;
  };
  void write_brake(const Brake& found, VariableId position, ExpressionId left);
  // In reset(): b while all hold.
  void write_resting_brake(VariableId damping, ExpressionId left);

  // In update(): δ of a block behind slips; and storing what later samples need.
  ExpressionId elongation(std::size_t block);
  void keep();

 private:
  struct Tree {
    Coupling coupling;
    std::size_t first_block, first_slip;
  };
  struct Graph {
    SlipNetwork network;
    const TunableGraph* table;
  };

  // A tree of one slip, which needs no solver.
  struct Lone {
    TunedLoneSlip step;
    std::vector<slip_node<double>> nodes;
    std::size_t first_block, slip;
  };

  bool is_pushed() const { return tables_.head.contact.is_there; }
  bool coil_lags() const { return rule_.coil_share < 1; }
  void declare(const TunableCoupling& table);
  void declare(const TunableGraph& table);
  void tune(Lone& lone, const std::vector<ExpressionId>& numbers);
  void tune(Tree& tree, const std::vector<ExpressionId>& numbers);
  void tune(Graph& graph, const std::vector<ExpressionId>& numbers);
  void tune_end(Tree& tree, std::size_t node, std::vector<ExpressionId>& stiffness,
                std::vector<ExpressionId>& compliance);
  ExpressionId yield_of(std::size_t slip, const std::vector<ExpressionId>& numbers);
  // The same, stored as a constant or as a tuned variable.
  void tune_yield(std::size_t slip, const std::vector<ExpressionId>& numbers, double& constant, VariableId& tuned);
  ExpressionId bounded_stiffness(std::size_t block);
  void write_tree(Tree& tree, VariableId force, ExpressionId change, VariableId surface_change);
  void write_graph(Graph& graph, VariableId force, ExpressionId change, VariableId surface_change);
  ExpressionId moved(const Graph& graph, int end);
  ExpressionId damping_of(const std::vector<ExpressionId>& slides, const std::string& prefix);
  ExpressionId within(ExpressionId left, const std::string& name, ExpressionId damping);
  ExpressionId least_of(ExpressionId one, ExpressionId other);
  ExpressionId largest_of(ExpressionId one, ExpressionId other);
  // The value of a constant, nothing for a tuned expression.
  std::optional<double> constant_in(ExpressionId value) const;

  TunedNumbers& numbers_;
  LawWriter& writer_;
  const TunableTables& tables_;
  const TunableSlipRule& rule_;
  const std::vector<TunedBlock>& blocks_;
  std::vector<Lone> lone_;
  std::vector<Tree> trees_;
  std::vector<Graph> graphs_;
  std::vector<VariableId> elongations_;  // local of output, of blocks in trees
  std::vector<VariableId> signs_;        // local of output, of slips in trees and graphs, if something reads them
  std::vector<ExpressionId> slides_;     // in output(), above zero where the slip gives way
  std::vector<SlideMemory> memories_;    // one for each slip if the encoder has steps
  VariableId change_ = nothing;          // of the tool, or of the surface, in output()
  VariableId root_ = nothing, root_now_ = nothing;  // √b if the coil lags
};

}  // namespace dashpot::compiler
