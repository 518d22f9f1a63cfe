// Appends the law of one port to the law of all ports: its tables follow those that are there, and all its names begin
// with the port's name.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "discretise/law_writer.hpp"

namespace dashpot::compiler {

// The programs of the port, with the ids of the law that it has become part of.
struct AppendedLaw {
  std::map<VariableId, VariableId> place;  // by the variable of the port's own law
  std::vector<Statement> output, keep, update, energy, start;
  std::vector<GuardInTurn> guards;

  VariableId at(VariableId own) const { return own == no_variable ? own : place.at(own); }
};

// `known`: variables of the port's law that are in the law of all ports already. The port has no tunables. The brake
// command that it remembers for refused samples is left out, since the brake is commanded for all ports together.
// Statements lose their lists of elements, since every port numbers its elements by itself.
AppendedLaw append_law(LawWriter& writer, const std::string& name, const UpdateLaw& own,
                       const std::map<VariableId, VariableId>& known = {});

}  // namespace dashpot::compiler
