// Text of the user's as it is shown inside a message.
#pragma once

#include <string>
#include <string_view>

namespace dashpot::compiler {

// At most 60 code points of `text`, with "…" where more were left out.
std::string excerpt(std::string_view text);

}  // namespace dashpot::compiler
