// True when an expression about a type is well formed: the readable half of a C++17 concept.
//
// `Claim` is an alias template that names a type only where the expression holds:
//     template <class T> using has_size = decltype(std::declval<T&>().size());
//     static_assert(is_detected<has_size, My>, "…");
#pragma once

#include <type_traits>

namespace dashpot {

template <template <class> class Claim, class Type, class = void>
inline constexpr bool is_detected = false;

template <template <class> class Claim, class Type>
inline constexpr bool is_detected<Claim, Type, std::void_t<Claim<Type>>> = true;

}  // namespace dashpot
