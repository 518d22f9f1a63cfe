// Which names may stand in emitted C++.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "source/diagnostic.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

// Reports, with a legal proposal where there is one, a name that is not [A-Za-z][A-Za-z0-9_]*, holds "__", is a C++
// keyword or macro, or a member of the emitted class. `owner` is "the network", "parameter", "element", "node".
bool check_name(const Text& name, std::string_view owner, Diagnostics& diagnostics);

// The name itself where it is legal, else one that is like it; "unnamed" where nothing of it is left.
std::string legal_name(std::string_view name);

// Names compared without regard to case.
std::string folded(std::string_view name);

// "ground" or "tool" for what others call these ends of a network, as "gnd" and "tip"; empty for any other name.
std::string_view other_name_of_end(std::string_view name);

// Reports names that are equal but for case.
class UniqueNames {
 public:
  void add(const Text& name, Diagnostics& diagnostics);
  bool contains(std::string_view name) const;
  std::string free_name(const std::string& wanted) const;  // `wanted`, or `wanted`_2, `wanted`_3, …

 private:
  std::unordered_map<std::string, Span> places_;  // by folded name
};

}  // namespace dashpot::compiler
