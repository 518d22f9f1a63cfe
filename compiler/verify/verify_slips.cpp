#include "verify/verify_slips.hpp"

#include <algorithm>
#include <cmath>

#include "certify/slip_motor.hpp"

namespace dashpot::compiler {
namespace {

LawFacts facts_of(const CertificateFile& certificate) {
  const Choices& c = certificate.choices;
  return {*c.rate, c.scheme, c.scalar, *c.state_input, certificate.damping};
}

}  // namespace

SlipVerification::SlipVerification(const CertificateFile& certificate, const HeaderConstants& header,
                                   const Compilation& compiled, Diagnostics& diagnostics)
    : certificate_(certificate), header_(header), compiled_(compiled), diagnostics_(diagnostics), facts_(facts_of(certificate)),
      tree_(reference_tree(compiled.network).value()) {
  const bool with_contact = compiled.network.contact.has_value();
  pool_ = constants_behind_slips(tree_, with_contact, compiled.decomposition.slips, facts_);
  for (const auto& [kind, values] : reference_constants(tree_.linear, facts_)) {
    std::vector<Reference>& all = pool_[kind];
    all.insert(all.end(), values.begin(), values.end());
  }
}

void SlipVerification::recompute_constants() {
  for (const HeaderConstant& constant : header_.all) look_at(constant);
  if (!are_within_regimes(tree_, compiled_.decomposition.slips))
    diagnostics_.report<DiagnosticCode::certificate_disagrees>({}, "brake's shares", "network", "feedthrough damping of a regime");
}

void SlipVerification::look_at(const HeaderConstant& constant) {
  if (pool_.count(constant.name) > 0) return compare_with_pool(constant, constant.name);
  const std::string_view kind = constant.name.ends_with("velocity_drive") ? "velocity_drive" : kind_behind_slips(constant.name);
  if (!kind.empty()) return compare_with_pool(constant, kind);
  compare_with_choice(constant);
}

// One of the pool's, the nearest number; rows may have been written as what is taken away.
void SlipVerification::compare_with_pool(const HeaderConstant& constant, std::string_view kind) {
  const auto pool = pool_.find(kind);
  for (std::size_t i = 0; i < constant.values.size(); ++i) {
    const double value = kind == "row" ? std::abs(constant.values[i]) : constant.values[i];
    const bool is_there = pool != pool_.end() && std::any_of(pool->second.begin(), pool->second.end(), [&](const Reference& exact) {
      return is_correctly_rounded(value, exact, header_.scalar);
    });
    if (!is_there) diagnostics_.report<DiagnosticCode::constant_of_nothing>({}, constant.name, i + 1, constant.values[i]);
  }
}

void SlipVerification::compare_with_choice(const HeaderConstant& constant) {
  const std::vector<Coefficient>& chosen = compiled_.law.coefficients;
  const auto like = std::find_if(chosen.begin(), chosen.end(), [&](const Coefficient& c) { return c.name == constant.name; });
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
  const bool with_contact = compiled_.network.contact.has_value();
  const auto motor = slip_motor(compiled_.network, compiled_.form, compiled_.decomposition, certificate_.choices, again.loop);
  const ReferenceCut cut = reference_cut(tree_, with_contact, compiled_.decomposition.slips, facts_, lateness(again.loop));
  const double margin = 1 + (header_.scalar == ScalarType::float64 ? 1e-12 : 1e-4);
  const auto covers = [&](double stated, const Reference& found) {
    return Reference(stated) >= found && Reference(stated) <= found * Reference(margin) + Reference("1e-300");
  };
  if (!motor || !covers(motor->stiffness, cut.stiffness) || !covers(motor->damping, std::max(cut.damping, Reference(0))))
    diagnostics_.report<DiagnosticCode::certificate_disagrees>({}, "certificate", "recomputed cut", "needed damping");
  expect("needed damping", certificate_.needed_damping, again.bound.needed);
  expect("assured damping", certificate_.assured_damping, again.assured);
  expect("brake command", certificate_.brake_command, compiled_.law.damping);
  expect("added damping", certificate_.added_damping, again.added_damping);
  if (certificate_.proof != name_of(again.bound.proof) || certificate_.certified != again.certified)
    diagnostics_.report<DiagnosticCode::certificate_disagrees>({}, "certificate", "recomputed bound", "proof");
}

void SlipVerification::expect(const char* what, double stated, double found) {
  if (stated != found) diagnostics_.report<DiagnosticCode::bound_wrong>({}, what, stated, found);
}

}  // namespace dashpot::compiler
