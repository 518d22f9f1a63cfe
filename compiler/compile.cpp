#include "compile.hpp"

#include "decompose/slip_laws.hpp"
#include "discretise/element_names.hpp"
#include "discretise/representable.hpp"
#include "linear/reach.hpp"
#include "linear/validity.hpp"
#include "syntax/parse_network.hpp"

namespace dashpot::compiler {

std::optional<Network> check(const SourceFile& source, Diagnostics& diagnostics) {
  const std::optional<NetworkDecl> decl = parse_network(source, diagnostics);
  return decl ? build_network(*decl, diagnostics) : std::nullopt;
}

std::optional<Compilation> compile(const SourceFile& source, const Choices& choices, const std::optional<Device>& device,
                                   Diagnostics& diagnostics) {
  std::optional<Network> network = check(source, diagnostics);
  if (!network || !is_within_reach(*network, diagnostics)) return std::nullopt;
  std::optional<NormalForm> form = closed_normal_form(*network, diagnostics);
  if (!form) return std::nullopt;
  Compilation result;
  result.network = std::move(*network);
  result.device = device;
  result.rate = choices.rate.value_or(device ? 1 / device->description.loop.sample_period : default_rate);
  result.form = std::move(*form);
  warn_about_validity(result.form.linear, result.network, diagnostics);
  std::optional<Decomposition> decomposition =
      decompose(result.network, result.form, choices, device ? &*device : nullptr, diagnostics);
  if (!decomposition) return std::nullopt;
  result.decomposition = std::move(*decomposition);
  result.law = discretise(result.network, result.form, result.decomposition, choices, result.rate, diagnostics);
  if (!is_representable(result.law, result.network, diagnostics)) return std::nullopt;
  if (!class_differs_from_members(result.law, result.network, diagnostics)) return std::nullopt;
  return result;
}

}  // namespace dashpot::compiler
