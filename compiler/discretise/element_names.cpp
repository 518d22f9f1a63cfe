#include "discretise/element_names.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "discretise/law_writer.hpp"
#include "network/name_rules.hpp"

namespace dashpot::compiler {
namespace {

template <class Named>
bool is_called(const Named& named, const std::string& name) {
  return named.name == name ||
         std::find(named.element_names.begin(), named.element_names.end(), name) != named.element_names.end();
}

// Members of the emitted class whose names do not come from elements; only some laws have them.
constexpr std::string_view members_of_some[] = {"threshold", "total", "sampled_", "kept_share", "clear"};

// States end in an underscore in the emitted class.
bool is_member(const UpdateLaw& law, const std::string& name) {
  if (std::find(std::begin(members_of_some), std::end(members_of_some), name) != std::end(members_of_some)) return true;
  if (law.tunable && name == "tunables") return true;
  if (law.joints && (name == "axes" || name == "brakes" || name == "commands")) return true;
  const std::string state = name.back() == '_' ? name.substr(0, name.size() - 1) : "";
  const auto names_state = [&](const Variable& v) { return v.is_kept() && is_called(v, state); };
  const auto names_constant = [&](const Coefficient& c) { return is_called(c, name); };
  return std::any_of(law.variables.begin(), law.variables.end(), names_state) ||
         std::any_of(law.coefficients.begin(), law.coefficients.end(), names_constant);
}

}  // namespace

std::string name_of(const std::vector<std::size_t>& elements, const Network& network) {
  std::string name;
  if (elements.size() <= 4)
    for (std::size_t element : elements) name = joined(name, network.elements[element].name);
  if (!name.empty() && name.size() <= 40) return name;
  const std::string& first = network.elements[elements.front()].name;
  return joined(joined(first, "to"), network.elements[elements.back()].name);
}

bool class_differs_from_members(const UpdateLaw& law, const Network& network, Diagnostics& diagnostics) {
  if (!is_member(law, network.name)) return true;
  diagnostics.report<DiagnosticCode::name_is_member>(network.name_span, "network", network.name);
  std::string other = legal_name(network.name + "_1");
  while (is_member(law, other)) other += "_1";
  diagnostics.note<DiagnosticCode::write_instead>({}, other);
  return false;
}

}  // namespace dashpot::compiler
