#include "insist.hpp"

#include "certify/settle.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

// How little the chosen candidate can need on this device, with its damping shared out at best.
struct LeastNeed {
  bool fits;
  double needed;  // [N·s/m]
};

LeastNeed least_need(const Compilation& c, const Choices& choices, const Device& device) {
  Diagnostics heard_before;
  const PortDevice port = PortDevice::of(device, c.network, heard_before).value();
  Candidate candidate = c.decomposition.choice();
  CandidateSettler settler(c.network, c.form, c.decomposition, choices, port, 1 / device.description.loop.sample_period);
  settler.settle(candidate);
  return {candidate.certified == true, settler.least_need(candidate)};
}

// The first power of two times the device's own; empty where even a thousandfold does not help.
std::optional<double> rate_that_would_do(const Compilation& c, const Choices& choices) {
  Device faster = *c.device;
  for (int doubling = 1; doubling <= 10; ++doubling) {
    faster.description.loop.sample_period /= 2;
    if (least_need(c, choices, faster).fits) return 1 / faster.description.loop.sample_period;
  }
  return std::nullopt;
}

}  // namespace

bool insist_on_certificate(const Compilation& c, const Choices& choices, Diagnostics& diagnostics) {
  const Certificate& certificate = c.certificate;
  if (!c.device || certificate.certified) return true;
  const std::string& name = c.network.name;
  if (certificate.bound.proof == Proof::none) {
    diagnostics.report<DiagnosticCode::nothing_proved>({}, name, c.device->name, certificate.bound.reason);
    return true;
  }
  const std::string unit = port_units(c.network.port_motion).damping;
  if (c.law.tunable) {
    diagnostics.report<DiagnosticCode::not_certified>({}, name, certificate.bound.needed, unit, c.device->name, certificate.assured);
    diagnostics.note<DiagnosticCode::compile_uncertified>({});
    return false;
  }
  const SampledLoop& loop = certificate.loop;
  const double of_regimes = c.law.largest_damping - c.law.damping;  // what a brake that changes needs above its least
  const double available = assured_damping(loop, loop.max_damping - of_regimes).convert_to<double>();
  const double needed = least_need(c, choices, *c.device).needed;
  diagnostics.report<DiagnosticCode::not_certified>({}, name, needed, unit, c.device->name, available);
  const double brake = missing_damping({Proof::sampled, needed, 0, ""}, loop, 0);
  if (brake < 1e300) diagnostics.note<DiagnosticCode::brake_that_would_do>({}, brake, unit, loop.max_damping);
  if (available > 0) diagnostics.note<DiagnosticCode::scale_that_would_do>({}, available / needed);
  if (const std::optional<double> rate = rate_that_would_do(c, choices))
    diagnostics.note<DiagnosticCode::rate_that_would_do>({}, *rate);
  diagnostics.note<DiagnosticCode::compile_uncertified>({});
  return false;
}

}  // namespace dashpot::compiler
