// What every emitted file says about its law, whatever its language.
#pragma once

#include <string>
#include <vector>

#include "emit/code_model.hpp"
#include "emit/cpp_program.hpp"
#include "emit/emission.hpp"

namespace dashpot::compiler {

// The author's text as it may stand in a comment: without line ends, and without a backslash where a line ends.
std::string comment_text(std::string text);

// What stands between the quotes of a string in C and C++.
std::string string_text(const std::string& text);

// An entry a line, as templates take it.
std::vector<Fields> as_list(const std::vector<std::string>& lines);

// "33 % of the brake, …"
std::string to_text(const DeviceShare& share);

// Facts, one behind the other, as lines of a comment.
std::vector<std::string> comment_lines(const std::vector<std::string>& facts);

// Whether some elements are stepped by backward Euler beside others that are exact.
bool mixes_schemes(const UpdateLaw& law);

// Lines of a comment: where the network comes from, its law, what is proved, and what a step costs.
std::vector<std::string> banner(const Compilation& compilation, const UpdateLaw& law, Timing timing);

// The fields that say which device the law was certified for.
void describe_device(const Compilation& compilation, Fields& fields);

// Those that name the network, its units and numbers.
void describe_file(const Compilation& compilation, Fields& fields);

// Of these what does not name the network: version, units and numbers of a law of any number of axes.
void describe_law(const UpdateLaw& law, motion port_motion, Fields& fields);

}  // namespace dashpot::compiler
