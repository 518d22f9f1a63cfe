// A law for many points of one network as lines of C++: every number a vector with one place a point.
#pragma once

#include <string>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

struct CppBatch {
  std::size_t states = 0;                       // scalars that a point keeps from one sample to the next
  std::size_t loaded = 0, stored = 0;           // how many of those a sample reads, and changes
  std::vector<std::string> headers, constants;  // the constants also hold the initial values of a new object
  std::vector<std::string> set;                 // if parameters can be set: for each point by itself
  std::vector<std::string> reset;               // of the state of one point
  std::vector<std::string> loads;               // states into locals
  std::vector<std::string> output;
  std::vector<std::string> commands;  // `sampled` says at which places the sample can be kept
  std::vector<std::string> update;
  std::vector<std::string> stores;
  std::vector<std::string> energy_loads;
  std::vector<std::string> energy;
};

// In: a law whose guards do not take turns.
CppBatch cpp_batch(const UpdateLaw& law);

}  // namespace dashpot::compiler
