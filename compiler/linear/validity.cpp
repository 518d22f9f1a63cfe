#include "linear/validity.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

constexpr double two_pi = 6.28318530717958647692;

void warn_about_tunables(const Network& network, Diagnostics& diagnostics) {
  for (const Parameter& parameter : network.parameters)
    if (parameter.tunable)
      diagnostics.report<DiagnosticCode::tunable_compiled_at_default>(parameter.span, parameter.name, parameter.value);
}

}  // namespace

std::optional<NormalForm> closed_normal_form(const Network& network, Diagnostics& diagnostics) {
  std::optional<NormalForm> form = normal_form(network);
  if (!form) diagnostics.report<DiagnosticCode::slips_outside_tree>(network.name_span, network.name);
  return form;
}

void warn_about_validity(const LinearForm& form, const Network& network, Diagnostics& diagnostics) {
  warn_about_tunables(network, diagnostics);
  if (!network.valid.frequency || form.modes.empty()) return;
  const Range& band = *network.valid.frequency;
  const auto in_band = [&](const Mode& mode) { return band.contains(to_double(mode.relaxation_rate) / two_pi); };
  if (std::none_of(form.modes.begin(), form.modes.end(), in_band))
    diagnostics.report<DiagnosticCode::no_relaxation_in_band>(network.valid.span, band.low, band.high);
}

}  // namespace dashpot::compiler
