#include "verify/verify_slips.hpp"

#include <algorithm>
#include <utility>

#include "certify/slip_motor.hpp"
#include "verify/law_constants.hpp"
#include "verify/realised_network.hpp"
#include "verify/recompiled.hpp"
#include "verify/reference_gain.hpp"

namespace dashpot::compiler {

SlipVerification::SlipVerification(const CertificateFile& certificate, const HeaderConstants& header,
                                   const PortDevice& device, const Compilation& compiled, Diagnostics& diagnostics)
    : certificate_(certificate),
      header_(header),
      compiled_(compiled),
      diagnostics_(diagnostics),
      facts_(facts_of(certificate)),
      tree_(rendered_tree(reference_tree(compiled.network), compiled.network, compiled.decomposition.slips)),
      linear_(reference_form(realised(tree_.linear_network, certificate, device))),
      equations_(tree_, linear_, compiled.network, compiled.decomposition.slips, facts_) {}

void SlipVerification::recompute_constants() {
  for (const HeaderConstant& constant : header_.all) look_at(constant);
  for (const SlipNetwork& table : compiled_.law.networks) look_at_through(table);
  if (!equations_.are_shares_within_regimes())
    diagnostics_.report<DiagnosticCode::certificate_disagrees>({}, "brake's shares", "network",
                                                               "feedthrough damping of a regime");
}

void SlipVerification::look_at(const HeaderConstant& constant) {
  if (constant.name == literals_in_code) return look_at_literals(constant, compiled_.law, {}, diagnostics_);
  if (const auto table = table_called(constant.name)) return compare(constant, *table, header_.scalar, diagnostics_);
  if (is_table_of_map(constant.name, compiled_.law)) return;
  const auto known = constant_called(constant.name, constant.values.size(), compiled_.law);
  if (!known) return compare_with_facts(constant, compiled_, facts_, diagnostics_);
  if (is_chosen(known->coefficient->role)) return compare_with_compiled(constant, *known, diagnostics_);
  for (std::size_t i = 0; i < constant.values.size(); ++i) look_at(constant, i, *known->coefficient, known->first + i);
}

void SlipVerification::look_at(const HeaderConstant& written, std::size_t number, const Coefficient& constant,
                               std::size_t place) {
  const double value = written.values[number];
  std::optional<Reference> exact = equations_.value(constant, place);
  if (!exact) {
    diagnostics_.report<DiagnosticCode::constant_of_nothing>({}, shown(written, number), value);
    return;
  }
  if (constant.role == ConstantRole::mode_weight) exact = signed_weight(value, constant, *exact);
  compare(written, number, *exact, header_.scalar, diagnostics_);
}

// A mode's weights are unique except for their common sign, which the first weight decides.
Reference SlipVerification::signed_weight(double written, const Coefficient& constant, const Reference& exact) {
  const auto& of = std::get<OfPartMode>(constant.of.front());
  const int side = (written < 0) == (exact < 0) ? 1 : -1;
  return exact * signs_.emplace(std::pair(of.elements, of.mode), side).first->second;
}

// The numbers of a table of slips that meet; nothing where the law has no table of that name. Empty where the network
// has nothing like it.
std::optional<SlipEquations::Values> SlipVerification::table_called(const std::string& name) const {
  const auto found = [](const std::optional<SlipEquations::Values>& values) {
    return values.value_or(SlipEquations::Values{});
  };
  for (const Coupling& coupling : compiled_.law.couplings)
    if (name == coupling.name) return found(equations_.nodes(coupling));
  for (const SlipNetwork& table : compiled_.law.networks) {
    if (name == table.name + "_links") return found(equations_.links(table));
    if (name == table.name + "_between") return found(equations_.between(table));
    if (name == table.name + "_to_tool") return found(equations_.to_tool(table));
    if (name == table.name + "_to_ground") return found(equations_.to_ground(table));
  }
  return std::nullopt;
}

// The stiffness between tool and ground has no name in the header: it is an argument of the step.
void SlipVerification::look_at_through(const SlipNetwork& table) {
  if (const std::optional<Reference> exact = equations_.through(table))
    compare({table.name, {table.through}, table.name + ", from tool to ground"}, 0, *exact, header_.scalar,
            diagnostics_);
}

// Computes the cut again: the certificate may not ask for less, nor, apart from its margin, for more.
void SlipVerification::recompute_bounds() {
  const Certificate& again = compiled_.certificate;
  const auto motor =
      slip_motor(compiled_.network, compiled_.form, compiled_.decomposition, certificate_.choices, again.loop);
  const ReferenceCut cut =
      reference_cut(tree_, compiled_.network, compiled_.decomposition.slips, facts_, lateness(again.loop));
  const double margin = 1 + (header_.scalar == ScalarType::float64 ? 1e-12 : 1e-4);
  const auto covers = [&](double stated, const Reference& found) {
    return Reference(stated) >= found && Reference(stated) <= found * Reference(margin) + Reference("1e-60");
  };
  if (!motor || !covers(motor->stiffness, cut.stiffness) || !covers(motor->damping, cut.of_motor()) ||
      motor->springs_alone != (cut.damping == 0))
    diagnostics_.report<DiagnosticCode::certificate_disagrees>({}, "certificate", "recomputed cut", "needed damping");
  const auto gain = motor ? reference_gain(tree_, linear_, compiled_.network, compiled_.decomposition.slips, *motor,
                                           facts_, again.loop)
                          : std::nullopt;
  compare_with_recompiled(certificate_, compiled_, gain, header_.scalar, diagnostics_);
}

}  // namespace dashpot::compiler
