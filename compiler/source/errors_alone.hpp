// What is made again, or otherwise than the user asked for: its warnings were given before, or are of no use.
#pragma once

#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// What `make` makes with diagnostics of its own. Where that is nothing their errors are passed on.
template <class Make>
auto with_errors_alone(Diagnostics& diagnostics, const Make& make) {
  Diagnostics own;
  auto made = make(own);
  if (!made) diagnostics.take_errors(own);
  return made;
}

}  // namespace dashpot::compiler
