// b∞ of slips and the blocks between them while parameters change: as statements, for every pattern of the slips that
// slide at once (theory, section 5, "Regimes"). A slip that holds counts as rigid, one that slides as absent.
#pragma once

#include <vector>

#include "law/tunable_tables.hpp"
#include "discretise/tuned_numbers.hpp"

namespace dashpot::compiler {

class TunedRegime {
 public:
  // `damping`: b∞ of each block, `nothing` if it has none; `slides`: for each slip a number above zero where it slides,
  // or `nothing` if all hold. Both are indexed by the places in the tables.
  TunedRegime(TunedNumbers& numbers, std::vector<ExpressionId> damping, std::vector<ExpressionId> slides)
      : numbers_(numbers), writer_(numbers.writer()), damping_(std::move(damping)), slides_(std::move(slides)) {}

  // At the root of a tree. `prefix` names the locals.
  ExpressionId of_tree(const std::vector<slip_node<double>>& nodes, const std::string& prefix);
  // Between `tool`, an end, and the ground; ends are numbered as in the tables.
  ExpressionId of_graph(int end_count, int tool, const std::vector<TunableEnds>& ties,
                        const std::vector<TunableEnds>& links, const std::string& prefix);

 private:
  // A part: its damping, 0 where it is rigid or slides; and a number above zero where it is rigid, `nothing` if it
  // never is.
  struct Part {
    ExpressionId damping = nothing, rigid = nothing;
  };
  using Matrix = std::vector<std::vector<Part>>;

  Part of_slip(std::size_t place);
  Part in_parallel(const std::vector<Part>& children, const std::string& name);
  Part in_series(const std::vector<Part>& children, const std::string& name);
  void eliminate(Matrix& between, std::size_t node, const std::string& name);
  void join(Matrix& between, std::size_t a, std::size_t b, ExpressionId damping, ExpressionId rigid);
  ExpressionId or_zero(ExpressionId value) { return value == nothing ? numbers_.zero() : value; }

  TunedNumbers& numbers_;
  LawWriter& writer_;
  std::vector<ExpressionId> damping_, slides_;
};

}  // namespace dashpot::compiler
