#include "emit/step_shape.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "law/cost.hpp"

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
  // The network is a type of that name beside those of C's headers and the functions that compilers call.
  constexpr std::string_view kept[] = {"restrict",    "self",     "main",   "memcmp",    "memcpy",
                                       "memmove",     "memset",   "size_t", "ptrdiff_t", "wchar_t",
                                       "max_align_t", "offsetof", "abs",    "complex",   "I"};
  const bool is_taken =
      std::find(std::begin(kept), std::end(kept), name) != std::end(kept) || name.starts_with("dashpot_");
  if (is_taken) diagnostics.report<DiagnosticCode::name_is_word_of_c>(name_span, name);
  return !is_taken;
}

}  // namespace dashpot::compiler
