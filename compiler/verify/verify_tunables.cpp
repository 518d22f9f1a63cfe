#include "verify/verify_tunables.hpp"

#include <algorithm>

#include "certify/estimator_factors.hpp"
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
      pool_(constants_of_tunables(tunables_, compiled.network, facts_)) {
  const TunableTables& tables = *compiled.law.tunable;
  const TunableHead& head = tables.head;
  pool_["numbers"].push_back(tables.numbers[std::size_t(tables.brake.observed)].base);
  const UpdateLaw& law = compiled.law;
  for (const Coefficient& constant : law.coefficients) add_pool_of(constant);
  pool_["sample_period"] = {1 / Reference(facts_.rate)};
  pool_["added_damping"] = pool_["steady_damping"] = {compiled.certificate.added_damping};
  pool_["threshold"] = {compiled.law.flush_threshold};
  pool_["surface_at"] = {compiled.network.map ? compiled.network.map->start : head.contact.at};
  pool_["encoder_step"] = {head.contact.encoder_step};
  pool_["none"] = {0};
  add_literals(law);
}

// What a new law has, and the tables of its slips: yield forces to either side, by the network where no parameter
// changes them.
void TunableVerification::add_literals(const UpdateLaw& law) {
  std::vector<Reference>& pool = pool_[literals_in_code];
  for (const Variable& variable : law.variables)
    if (variable.is_kept()) pool.push_back(variable.rest_value);
  const auto add_yield = [&](VariableId tuned, double constant) {
    if (tuned != no_variable) return pool.push_back(-Reference(law.variables[tuned].rest_value));
    for (const Reference& exact : pool_["numbers"])
      if (is_correctly_rounded(constant, exact, header_.scalar)) pool.insert(pool.end(), {exact, -exact});
  };
  for (const Coupling& coupling : law.couplings)
    for (std::size_t k = 0; k < coupling.tuned.size(); ++k) add_yield(coupling.tuned[k].yield, coupling.nodes[k].yield);
  for (const SlipNetwork& network : law.networks)
    for (std::size_t k = 0; k < network.links.size(); ++k) {
      const slip_link<double>& link = network.links[k];
      add_yield(network.tuned->yields[k], link.highest);
      if (link.lowest == 0) pool.push_back(link.highest);  // a contact, which holds whatever pushes
    }
}

// By its role: what follows from the network is recomputed from it, what is chosen is compared with a re-emission.
void TunableVerification::add_pool_of(const Coefficient& constant) {
  std::vector<Reference>& pool = pool_[constant.name];
  switch (constant.role) {
    case ConstantRole::element_value:
      pool = pool_["numbers"];
      pool.insert(pool.end(), pool_["shares"].begin(), pool_["shares"].end());
      return;
    case ConstantRole::sampling: pool = {Reference(facts_.rate), 1 / Reference(facts_.rate)}; return;
    case ConstantRole::relaxation_share:
    case ConstantRole::loss: pool = pool_["parts"]; return;
    case ConstantRole::yield: pool = pool_["yields"]; return;
    case ConstantRole::spring_stiffness: pool = pool_["blocks"]; return;
    default:
      if (pool.empty()) pool.assign(constant.values.begin(), constant.values.end());
  }
}

void TunableVerification::recompute_constants() {
  for (const HeaderConstant& constant : header_.all) {
    const auto pool = pool_.find(constant.name);
    if (pool == pool_.end()) diagnostics_.report<DiagnosticCode::unknown_constant>({}, constant.name);
    else if (constant.name == "tunables") compare_ranges(constant);
    else compare_with_pool(constant, pool->second);
  }
}

// In the order of the network's parameters: value, least and largest.
void TunableVerification::compare_ranges(const HeaderConstant& constant) {
  const std::vector<Reference>& expected = pool_["tunables"];
  if (constant.values.size() != expected.size())
    return diagnostics_.report<DiagnosticCode::unknown_constant>({}, constant.name);
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (!is_correctly_rounded(constant.values[i], expected[i], header_.scalar))
      diagnostics_.report<DiagnosticCode::constant_wrong>({}, constant.name, i + 1, constant.values[i],
                                                          expected[i].str(25));
}

void TunableVerification::compare_with_pool(const HeaderConstant& constant, const std::vector<Reference>& pool) {
  for (std::size_t i = 0; i < constant.values.size(); ++i)
    if (std::none_of(pool.begin(), pool.end(), [&](const Reference& exact) {
          return is_correctly_rounded(constant.values[i], exact, header_.scalar);
        }))
      diagnostics_.report<DiagnosticCode::constant_of_nothing>({}, constant.name, i + 1, constant.values[i]);
}

// What is needed may be what is left of the brake's damping, whose rounding, and that of b∞ − b, it then has, beside
// its own.
bool TunableVerification::covers(double stated, const ReferenceBox& box, const Reference& share) const {
  const bool is_double = header_.scalar == ScalarType::float64;
  const Reference found = box.needed(share), size = found + share * box.least_brake + box.largest_brake;
  const Reference rounding = is_double ? 0x1p-49 : 0x1p-20, margin = is_double ? Reference("1e-12") : Reference("1e-4");
  return Reference(stated) >= found - rounding * size &&
         Reference(stated) <= found + margin * size + Reference("1e-60");
}

// The certificate asks for no less than the box once more, but for rounding, and, but for its margin, no more.
void TunableVerification::recompute_bounds() {
  const SampledLoop& loop = compiled_.certificate.loop;
  const auto gain = estimate_gain(loop);
  const Rational exact_share = assured_share(loop);
  const Reference share = Reference(numerator(exact_share)) / Reference(denominator(exact_share));
  const Reference hold = Reference(loop.longest_hold()) / Reference(loop.sample_period);
  const ReferenceLoop around{hold, lateness(loop), share, gain ? std::optional(Reference(*gain)) : std::nullopt,
                             reference_pulse(loop)};
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
