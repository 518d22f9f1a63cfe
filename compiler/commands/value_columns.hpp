// Columns of a recorded motion that are called like the network's tunables.
#pragma once

#include <vector>

#include "commands/motion_csv.hpp"
#include "law/evaluate.hpp"
#include "emit/emission.hpp"

namespace dashpot::compiler {

class ValueColumns {
 public:
  // Columns are called like the tunable, "K1" or "K1 [N/mm]"; without a unit they are in the tunable's. Refuses: a unit
  // of anything else, a cell that is no finite number, a column given twice, a tunable that is called like one of the
  // motion's own. Warns of a column whose name is nearly one.
  ValueColumns(const Compilation& c, const Motion& motion, Diagnostics& diagnostics);

  // Sets the values of a row.
  template <class Scalar>
  void set(Evaluation<Scalar>& law, std::size_t row) const {
    if (is_empty_) return;
    std::vector<Scalar> values;
    for (std::size_t i = 0; i < tunables_.size(); ++i) values.push_back(static_cast<Scalar>(value(i, row)));
    law.set(values);
  }

  // Warns of a tunable whose value is out of its range in a row, once of each.
  void warn_outside_range(std::size_t row, double time, Diagnostics& diagnostics);

 private:
  // What the motion says of a tunable.
  struct Values {
    const OtherColumn* column = nullptr;  // none: its default stays
    double factor = 1;                    // what 1 in the column is in the tunable's unit
  };

  static Values values_of(const Tunable& tunable, const Motion& motion, Diagnostics& diagnostics);
  void warn_of_misspelt(const Motion& motion, Diagnostics& diagnostics) const;
  double value(std::size_t tunable, std::size_t row) const;
  Span place_of(const std::string& tunable) const;
  void refuse_name_of_motion(const std::string& tunable, Diagnostics& diagnostics) const;

  const Network& network_;
  std::vector<Tunable> tunables_;
  std::vector<Values> columns_;
  std::vector<bool> warned_;
  bool is_empty_ = true;
};

}  // namespace dashpot::compiler
