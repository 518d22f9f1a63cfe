#include "emit/step_shape.hpp"

#include <fmt/format.h>
#include "law/cost.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

std::size_t operations_of(const UpdateLaw& law) {
  return operations_of(cost_of(law, law.output)) + operations_of(cost_of(law, law.update));
}

// True, with an error, where the law's step is no list of statements.
bool refuses(const Compilation& c, const char* option, Diagnostics& diagnostics) {
  if (c.law.couplings.empty() && c.law.networks.empty()) return false;
  diagnostics.report<DiagnosticCode::step_of_coupled_slips>(c.network.name_span, c.network.name, option);
  return true;
}

}  // namespace

bool can_be_emitted(const Compilation& c, const EmissionOptions& options, Diagnostics& diagnostics) {
  const bool untimed = options.constant_time && refuses(c, "--constant-time", diagnostics);
  if (untimed) diagnostics.note<DiagnosticCode::bounded_step_remedy>({}, "--constant-time", operations_of(c.law));
  const bool single = options.batch && refuses(c, "--batch", diagnostics);
  if (single) diagnostics.note<DiagnosticCode::object_each_remedy>({}, "--batch");
  return !untimed && !single;
}

bool can_be_c99(const std::string& name, const Span& name_span, Diagnostics& diagnostics) {
  const bool is_taken = name == "restrict" || name.starts_with("dashpot_");
  if (is_taken) diagnostics.report<DiagnosticCode::name_is_word_of_c>(name_span, name);
  return !is_taken;
}

}  // namespace dashpot::compiler
