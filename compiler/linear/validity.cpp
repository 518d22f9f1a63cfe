#include "linear/validity.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

// 3⁸ = 6,561 patterns; no bound is known that grows less. A step tries a few of them.
constexpr std::size_t most_slips_outside_tree = 8;

// The largest number of slips in a part that is no tree.
std::size_t most_slips_together(const NormalForm& form, const Network& network) {
  std::size_t most = 0;
  for (const std::vector<std::size_t>& elements : form.networks)
    most = std::max(most, slips_between(network, elements).size());
  return most;
}

constexpr double two_pi = 6.28318530717958647692;

}  // namespace

std::optional<NormalForm> closed_normal_form(const Network& network, Diagnostics& diagnostics) {
  NormalForm form = normal_form(network);
  const std::size_t slips = most_slips_together(form, network);
  if (slips <= most_slips_outside_tree) return form;
  diagnostics.report<DiagnosticCode::too_many_slips_outside_tree>(network.name_span, slips, most_slips_outside_tree);
  return std::nullopt;
}

void warn_about_validity(const LinearForm& form, const Network& network, Diagnostics& diagnostics) {
  if (!network.valid.frequency || form.modes.empty()) return;
  const Range& band = *network.valid.frequency;
  const auto in_band = [&](const Mode& mode) { return band.contains(to_double(mode.relaxation_rate) / two_pi); };
  if (std::none_of(form.modes.begin(), form.modes.end(), in_band))
    diagnostics.report<DiagnosticCode::no_relaxation_in_band>(network.valid.span, band.low, band.high);
}

}  // namespace dashpot::compiler
