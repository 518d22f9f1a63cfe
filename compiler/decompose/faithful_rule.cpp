#include "decompose/faithful_rule.hpp"

#include <algorithm>
#include <limits>

namespace dashpot::compiler {
namespace {

constexpr double none_yet = std::numeric_limits<double>::infinity();
constexpr double rounding_of_rule = 1 + 1e-12;

template <class Eligible>
double least_error(const std::vector<EvaluatedOption>& options, Eligible eligible) {
  double least = none_yet;
  for (const EvaluatedOption& option : options)
    if (eligible(option)) least = std::min(least, option.error);
  return least;
}

bool is_any(const EvaluatedOption&) { return true; }
bool is_certified(const EvaluatedOption& option) { return option.certified; }

double noise_of(const EvaluatedOption& option) { return option.motor_noise.value_or(none_yet); }

bool is_preferred(const EvaluatedOption& one, const EvaluatedOption& other) {
  if (one.damping != other.damping) return one.damping > other.damping;
  if (noise_of(one) != noise_of(other)) return noise_of(one) < noise_of(other);
  return one.error < other.error;
}

template <class Eligible>
std::optional<std::size_t> preferred(const std::vector<EvaluatedOption>& options, Eligible eligible) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < options.size(); ++i)
    if (eligible(options[i]) && (!best || is_preferred(options[i], options[*best]))) best = i;
  return best;
}

std::optional<FaithfulChoice> certified_choice(const std::vector<EvaluatedOption>& options, double least,
                                               double allowed) {
  const auto fits = [=](const EvaluatedOption& option) { return option.certified && is_within(option.error, allowed); };
  double least_added = none_yet;
  for (const EvaluatedOption& option : options)
    if (fits(option)) least_added = std::min(least_added, option.added.value_or(0));
  const auto chosen = preferred(options, [=](const EvaluatedOption& option) {
    return fits(option) && is_within(option.added.value_or(0), leeway * least_added);
  });
  if (!chosen) return std::nullopt;
  return FaithfulChoice{*chosen, least, allowed, least_added, true};
}

}  // namespace

double allowed_error(double tolerance, double least_error) { return std::max(tolerance, leeway * least_error); }

bool is_within(double error, double allowed) { return error <= allowed * rounding_of_rule; }

FaithfulChoice choose_faithful(const std::vector<EvaluatedOption>& options, double tolerance) {
  const double least = least_error(options, is_any), allowed = allowed_error(tolerance, least);
  if (const auto choice = certified_choice(options, least, allowed)) return *choice;
  const double of_certified = least_error(options, is_certified);
  if (of_certified < none_yet)
    if (const auto choice = certified_choice(options, of_certified, allowed_error(tolerance, of_certified)))
      return *choice;
  const auto chosen =
      preferred(options, [=](const EvaluatedOption& option) { return is_within(option.error, allowed); });
  return {chosen.value_or(0), least, allowed, 0, false};
}

}  // namespace dashpot::compiler
