#include "emit/step_shape.hpp"

#include <fmt/format.h>
#include "law/cost.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

std::size_t operations_of(const UpdateLaw& law) {
  return operations_of(cost_of(law, law.output)) + operations_of(cost_of(law, law.update));
}

}  // namespace

bool can_be_timed(const Compilation& c, Diagnostics& diagnostics) {
  if (c.law.couplings.empty() && c.law.networks.empty()) return true;
  diagnostics.report<DiagnosticCode::step_of_coupled_slips>(c.network.name_span, c.network.name);
  diagnostics.note<DiagnosticCode::bounded_step_remedy>({}, operations_of(c.law));
  return false;
}

bool can_be_c99(const std::string& name, const Span& name_span, Diagnostics& diagnostics) {
  const bool is_taken = name == "restrict" || name.starts_with("dashpot_");
  if (is_taken) diagnostics.report<DiagnosticCode::name_is_word_of_c>(name_span, name);
  return !is_taken;
}

}  // namespace dashpot::compiler
