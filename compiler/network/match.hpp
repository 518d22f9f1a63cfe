// A case for each kind of a variant.
#pragma once

#include <utility>
#include <variant>

namespace dashpot::compiler {

// With a new kind this does not compile until the new kind has its case.
template <class Any, class... Cases>
decltype(auto) match(Any&& any, Cases... cases) {
  struct All : Cases... {
    using Cases::operator()...;
  };
  return std::visit(All{std::move(cases)...}, std::forward<Any>(any));
}

}  // namespace dashpot::compiler
