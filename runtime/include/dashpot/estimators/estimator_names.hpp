// The names of the estimators as device files write them, and what holds for a whole kind.
#pragma once

#include <dashpot/device_description.hpp>

namespace dashpot {

constexpr const char* name_of(estimator_kind kind) noexcept {
  switch (kind) {
    case estimator_kind::backward_difference: return "backward_difference";
    case estimator_kind::least_squares: return "least_squares";
    case estimator_kind::butterworth: return "butterworth";
    case estimator_kind::inverse_time: return "inverse_time";
    case estimator_kind::foaw: return "foaw";
    case estimator_kind::kalman: return "kalman";
    case estimator_kind::super_twisting: return "super_twisting";
    case estimator_kind::tracking_differentiator: return "tracking_differentiator";
    case estimator_kind::sensor: return "sensor";
    case estimator_kind::interval_difference: return "interval_difference";
  }
  return "";
}

// Linear and, at a constant period, time-invariant: has a pulse transfer function, and there sums to the displacement
// in the long run.
constexpr bool is_linear(estimator_kind kind) noexcept {
  switch (kind) {
    case estimator_kind::backward_difference:
    case estimator_kind::least_squares:
    case estimator_kind::butterworth:
    case estimator_kind::kalman:
    case estimator_kind::sensor:
    case estimator_kind::interval_difference: return true;
    case estimator_kind::inverse_time:
    case estimator_kind::foaw:
    case estimator_kind::super_twisting:
    case estimator_kind::tracking_differentiator: return false;
  }
  return false;
}

inline constexpr estimator_kind all_estimators[] = {
    estimator_kind::backward_difference,
    estimator_kind::least_squares,
    estimator_kind::butterworth,
    estimator_kind::inverse_time,
    estimator_kind::foaw,
    estimator_kind::kalman,
    estimator_kind::super_twisting,
    estimator_kind::tracking_differentiator,
    estimator_kind::sensor,
    estimator_kind::interval_difference,
};

constexpr bool is_same_name(const char* a, const char* b) noexcept {
  while (*a != '\0' && *a == *b) ++a, ++b;
  return *a == *b;
}

// The kind of that exact name; nullptr where there is none.
constexpr const estimator_kind* estimator_from_name(const char* name) noexcept {
  for (const estimator_kind& kind : all_estimators)
    if (is_same_name(name, name_of(kind))) return &kind;
  return nullptr;
}

}  // namespace dashpot
