// Lines of emitted C++, of a width that can be read.
#pragma once

#include <string>
#include <vector>

namespace dashpot::compiler {

// Broken where it is too long; the remark stands behind the statement where there is room, else above it.
void append(std::vector<std::string>& lines, const std::string& text, const std::string& remark = "");

}  // namespace dashpot::compiler
