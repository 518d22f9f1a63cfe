// Linear one-ports whose elements may be tunable, as parts in parallel.
#pragma once

#include <vector>

#include "decompose/choices.hpp"
#include "law/tunable_tables.hpp"
#include "linear/linear_form.hpp"
#include "linear/modal_reduction.hpp"
#include "network/tree.hpp"

namespace dashpot::compiler {

class TunableBlocks {
 public:
  TunableBlocks(const Network& network, const Choices& choices, const Real& sample_period, TunableTables& tables);

  // Adds the next block: `elements` of `network`, in which they join tool and ground. `is_loose`: in series with a
  // slip.
  void add(const Network& network, const std::vector<std::size_t>& elements, bool is_loose);

  // base + Σ of the values of elements of one kind. `named`: all elements whose values are in it, if `base` holds some
  // too.
  int number(const Network& network, const std::vector<std::size_t>& elements, NumberSubject of, const Real& base = 0,
             std::vector<std::size_t> named = {});
  // Σ of the values of elements side by side.
  int number(const Network& network, const std::vector<std::size_t>& elements) {
    return number(network, elements, {NumberKind::elements, elements});
  }

 private:
  int add_spring(int stiffness, std::string name, std::optional<FixedRelaxation> fixed = {});
  void add_direct(const Network& network, const std::vector<std::size_t>& elements, const LinearForm& fixed,
                  bool is_loose);
  void add_fixed(const Network& network, const LinearForm& fixed);
  bool add_relaxation(const Network& network, const Part& part);
  void add_mesh(const Network& network, const Part& part);

  const Network& whole_;
  Choices choices_;
  Real sample_period_;
  TunableTables& tables_;
  std::vector<std::size_t> tunable_of_parameter_;  // for a parameter that is not tunable, the next tunable
};

// The branches of `tree` that hold `elements`, laid out between tool and ground on nodes of their own.
Network laid_out_part(const Network& network, const Tree& tree, const std::vector<std::size_t>& elements);

// Every way to cut through `slips`, as a list of the elements cut: the yield force is the least of their sums.
std::vector<std::vector<std::size_t>> cuts_through(const Tree& tree, const std::vector<std::size_t>& slips);

}  // namespace dashpot::compiler
