#include "verify/verify_tunables.hpp"

#include <algorithm>

#include "certify/estimator_factors.hpp"
#include "verify/law_constants.hpp"
#include "verify/realised_network.hpp"
#include "verify/recompiled.hpp"

namespace dashpot::compiler {

TunableVerification::TunableVerification(const CertificateFile& certificate, const HeaderConstants& header,
                                         const Compilation& compiled, Diagnostics& diagnostics)
    : certificate_(certificate),
      header_(header),
      compiled_(compiled),
      diagnostics_(diagnostics),
      facts_(facts_of(certificate)),
      tunables_(reference_tunables(compiled.network, facts_)),
      equations_(tunables_, *compiled.law.tunable, compiled.network, facts_) {}

void TunableVerification::recompute_constants() {
  for (const HeaderConstant& constant : header_.all) look_at(constant);
}

void TunableVerification::look_at(const HeaderConstant& constant) {
  if (constant.name == literals_in_code)
    return look_at_literals(constant, compiled_.law, equations_.fixed_yields(), diagnostics_);
  if (is_table_of_map(constant.name, compiled_.law)) return;
  if (constant.name == "tunables") return compare(constant, ranges(), header_.scalar, diagnostics_);
  const auto known = constant_called(constant.name, constant.values.size(), compiled_.law);
  if (!known) return compare_with_facts(constant, compiled_, facts_, diagnostics_);
  const Coefficient& coefficient = *known->coefficient;
  if (is_chosen(coefficient.role)) {
    compare_with_compiled(constant, *known, diagnostics_);
  } else if (const auto exact = equations_.value(coefficient)) {
    compare(constant, {*exact}, header_.scalar, diagnostics_);
  } else {
    diagnostics_.report<DiagnosticCode::constant_of_nothing>({}, shown(constant, 0), constant.values.front());
  }
}

// In the order of the network's parameters: value, least and largest.
std::vector<Reference> TunableVerification::ranges() const {
  std::vector<Reference> all;
  for (const Parameter* parameter : tunables_.parameters)
    all.insert(all.end(), {parameter->value, parameter->min, parameter->max});
  return all;
}

// Allows for rounding: what is needed may be a difference of the brake's damping, whose rounding, and that of b∞ − b,
// then count besides its own.
bool TunableVerification::covers(double stated, const ReferenceBox& box, const Reference& share) const {
  const bool is_double = header_.scalar == ScalarType::float64;
  const Reference found = box.needed(share), size = found + share * box.least_brake + box.largest_brake;
  const Reference rounding = is_double ? 0x1p-49 : 0x1p-20, margin = is_double ? Reference("1e-12") : Reference("1e-4");
  return Reference(stated) >= found - rounding * size &&
         Reference(stated) <= found + margin * size + Reference("1e-60");
}

// The certificate may not ask for less than the box computed again, apart from rounding, nor, apart from its margin,
// for more.
void TunableVerification::recompute_bounds() {
  const SampledLoop& loop = compiled_.certificate.loop;
  const auto gain = estimate_gain(loop);
  const Rational exact_share = assured_share(loop);
  const Reference share = Reference(numerator(exact_share)) / Reference(denominator(exact_share));
  const Reference hold = Reference(loop.longest_hold()) / Reference(loop.sample_period);
  const ReferenceLoop around{hold,
                             lateness(loop),
                             share,
                             gain ? std::optional(Reference(*gain)) : std::nullopt,
                             reference_pulse(loop),
                             loop.out_of_step};
  const auto box =
      compiled_.network.contact ? std::nullopt : reference_box(tunables_, *compiled_.law.tunable, around, facts_);
  const bool is_proved = certificate_.proof != name_of(Proof::none);
  if (is_proved && !box)
    diagnostics_.report<DiagnosticCode::certificate_disagrees>({}, "certificate", "recomputed box", "proof");
  if (is_proved && box && !covers(certificate_.needed_damping, *box, share))
    expect_bound("needed damping", certificate_.needed_damping, box->needed(share).convert_to<double>(), diagnostics_);
  compare_with_recompiled(certificate_, compiled_, box ? box->gain : std::nullopt, header_.scalar, diagnostics_);
}

}  // namespace dashpot::compiler
