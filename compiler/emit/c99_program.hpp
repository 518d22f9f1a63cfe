// An update law's programs as lines of C99: straight-line with the author's names for few states, loops over arrays for
// many. States are members of `self`; constants stand in the function that reads them.
#pragma once

#include <string>
#include <vector>

#include "certify/state_box.hpp"
#include "emit/code_model.hpp"
#include "law/update_law.hpp"

namespace dashpot::compiler {

struct C99Program {
  std::vector<std::string> before;  // types, constants and functions that know nothing of the struct
  std::vector<std::string> states;  // members of the struct
  std::vector<std::string> bounds;  // comparisons of them with a box, joined; none where none is known
  std::vector<std::string> begin;   // before everything else
  std::vector<std::string> reset;
  std::vector<std::string> output;  // down to the assignment of `command`
  std::vector<std::string> update;  // of a finite sample
  std::vector<std::string> set;     // with the parameters' new values
  std::vector<std::string> energy;  // down to that of `stored`
  std::string kept_share;           // of all forces, by the last output; empty where a law never sheds
};

// `name` is the network's.
C99Program c99_program(const UpdateLaw& law, const std::string& name, const StateBox& box = {});

// What laws of one axis and of two have of it, as templates take it, under the names of its members.
void add_program(const C99Program& program, CodeModel& model);

}  // namespace dashpot::compiler
