#include "verify/verify_slips.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "certify/slip_motor.hpp"
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
      tree_(rendered_tree(reference_tree(compiled.network), compiled.network, compiled.decomposition.slips)) {
  pool_ = constants_behind_slips(tree_, compiled.network, compiled.decomposition.slips, facts_);
  for (const Variable& variable : compiled.law.variables)
    if (variable.rest_value != 0) pool_[literals_in_code].push_back(variable.rest_value);  // of the brake, a choice
  linear_ = reference_form(realised(tree_.linear_network, certificate, device));
  for (const auto& [kind, values] : reference_constants(linear_, facts_)) {
    std::vector<Reference>& all = pool_[kind];
    all.insert(all.end(), values.begin(), values.end());
  }
  for (auto& [kind, values] : pool_) std::sort(values.begin(), values.end());
}

void SlipVerification::recompute_constants() {
  for (const HeaderConstant& constant : header_.all) look_at(constant);
  if (!are_within_regimes(tree_, compiled_.decomposition.slips))
    diagnostics_.report<DiagnosticCode::certificate_disagrees>({}, "brake's shares", "network",
                                                               "feedthrough damping of a regime");
}

void SlipVerification::look_at(const HeaderConstant& constant) {
  std::vector<std::string_view> kinds = kinds_behind_slips(constant.name);
  if (pool_.count(constant.name) > 0 && std::find(kinds.begin(), kinds.end(), constant.name) == kinds.end())
    kinds.push_back(constant.name);
  if (kinds.empty()) return compare_with_choice(constant);
  for (std::size_t i = 0; i < constant.values.size(); ++i)
    if (std::none_of(kinds.begin(), kinds.end(),
                     [&](std::string_view kind) { return is_in_pool(kind, constant.values[i]); }))
      diagnostics_.report<DiagnosticCode::constant_of_nothing>({}, constant.name, i + 1, constant.values[i]);
}

// One of the pool's, the nearest number; rows may have been written as what is taken away, and a mode's weights are
// known but for their common sign.
bool SlipVerification::is_in_pool(std::string_view kind, double constant) const {
  const auto pool = pool_.find(kind);
  const double value = kind == "row" || kind == "weight" ? std::abs(constant) : constant;
  if (pool == pool_.end()) return false;
  // Those next to it, below and above: what rounds to a number lies around it.
  const auto above = std::lower_bound(pool->second.begin(), pool->second.end(), Reference(value));
  return (above != pool->second.end() && is_correctly_rounded(value, *above, header_.scalar)) ||
         (above != pool->second.begin() && is_correctly_rounded(value, *std::prev(above), header_.scalar));
}

void SlipVerification::compare_with_choice(const HeaderConstant& constant) {
  const auto& chosen = compiled_.law.coefficients;
  const auto like =
      std::find_if(chosen.begin(), chosen.end(), [&](const Coefficient& c) { return c.name == constant.name; });
  if (like != chosen.end() && like->values == constant.values) return;
  const double single = constant.values.front();
  if (constant.name == "damping" && single == compiled_.law.damping) return;
  if (constant.name == "added_damping" && single == compiled_.certificate.added_damping) return;
  for (const Coefficient& c : chosen)  // a vector of few places is written out as scalars
    for (std::size_t i = 0; i < c.element_names.size(); ++i)
      if (c.element_names[i] == constant.name && c.values[i] == single) return;
  diagnostics_.report<DiagnosticCode::unknown_constant>({}, constant.name);
}

// The cut once more, of which the certificate may ask no less, and, but for its margin, no more.
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
