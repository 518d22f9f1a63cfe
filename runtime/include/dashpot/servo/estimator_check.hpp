// The estimator concept of a servo loop; any_estimator is one. In the joint's coordinate, as the samples:
//     Scalar update(const dashpot::device_sample&) noexcept;   // or  Scalar update(Scalar position) noexcept
//     void reset(Scalar position) noexcept;                    // at rest there
//     dashpot::estimator_kind kind() const noexcept;           // or, where it is none of these,
//     const char* name() const noexcept;                       // what a certificate names
#pragma once

#include <type_traits>
#include <utility>

#include <dashpot/detected.hpp>
#include <dashpot/device.hpp>
#include <dashpot/estimators/estimator_names.hpp>

namespace dashpot {

namespace estimator_claim {

template <class E>
using sample_estimate = decltype(std::declval<E&>().update(std::declval<const device_sample&>()));
template <class E>
using position_estimate = decltype(std::declval<E&>().update(0.0f));
template <class E>
using update_by_sample = std::enable_if_t<std::is_floating_point_v<sample_estimate<E>>&& noexcept(
    std::declval<E&>().update(std::declval<const device_sample&>()))>;
template <class E>
using update_by_position =
    std::enable_if_t<std::is_floating_point_v<position_estimate<E>>&& noexcept(std::declval<E&>().update(0.0f))>;
template <class E>
using reset = std::enable_if_t<noexcept(std::declval<E&>().reset(0.0f))>;
template <class E>
using kind = std::enable_if_t<noexcept(estimator_kind(std::declval<const E&>().kind()))>;
template <class E>
using name = std::enable_if_t<noexcept(static_cast<const char*>(std::declval<const E&>().name()))>;

}  // namespace estimator_claim

// Refuses, in words, to compile a class that is no estimator. Always true where it compiles.
template <class Estimator>
constexpr bool check_estimator() {
  static_assert(is_detected<estimator_claim::update_by_sample, Estimator> ||
                    is_detected<estimator_claim::update_by_position, Estimator>,
                "the estimator needs 'Scalar update(const dashpot::device_sample&) noexcept' or "
                "'Scalar update(Scalar position) noexcept'");
  static_assert(is_detected<estimator_claim::reset, Estimator>,
                "the estimator needs 'void reset(Scalar position) noexcept'");
  static_assert(is_detected<estimator_claim::kind, Estimator> || is_detected<estimator_claim::name, Estimator>,
                "the estimator needs 'dashpot::estimator_kind kind() const noexcept' or "
                "'const char* name() const noexcept': a certificate names it");
  return true;
}

namespace estimator_claim {

template <class E, bool TakesSamples>
struct estimate {
  using type = sample_estimate<E>;
};
template <class E>
struct estimate<E, false> {
  using type = position_estimate<E>;
};

}  // namespace estimator_claim

// The Scalar that update() returns.
template <class Estimator>
using estimate_of =
    typename estimator_claim::estimate<Estimator, is_detected<estimator_claim::update_by_sample, Estimator>>::type;

// As device files and certificates write it.
template <class Estimator>
const char* estimator_name(const Estimator& estimator) noexcept {
  if constexpr (is_detected<estimator_claim::name, Estimator>) {
    return estimator.name();
  } else {
    return name_of(estimator.kind());
  }
}

}  // namespace dashpot
