// The law of one port within the law of all: its tables behind those that are there, all names beginning with the
// port's.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "discretise/law_writer.hpp"

namespace dashpot::compiler {

// The programs of the port, in the terms of the law that it has become part of.
struct AppendedLaw {
  std::map<VariableId, VariableId> place;  // of each variable of the port's own law
  std::vector<Statement> output, keep, update, energy, start;
  std::vector<GuardInTurn> guards;

  VariableId at(VariableId own) const { return own == no_variable ? own : place.at(own); }
};

// A law without tables and programs, of the same scalar and sampling.
UpdateLaw empty_law_like(const UpdateLaw& law);

// `known`: variables of the port that are others of the law already. The port has no tunables. What it remembers of its
// brake for a sample that is refused is left out: that is told of all ports together. Which parts of the network a
// statement is about is not told any more, since every port counts its elements by itself.
AppendedLaw append_law(LawWriter& writer, const std::string& name, const UpdateLaw& own,
                       const std::map<VariableId, VariableId>& known = {});

}  // namespace dashpot::compiler
