// Which of the known names somebody probably meant.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot::compiler {

// The candidate with the smallest edit distance (insert, delete, replace, swap neighbours; case counts half), the first
// on ties; none where more than a third of the letters, and more than one, would have to change. Looks at the first 200
// candidates, and at names of up to 64 bytes.
std::optional<std::string> nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace dashpot::compiler
