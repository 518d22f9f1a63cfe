#include "insist.hpp"

#include "certify/settle.hpp"
#include "certify/slip_motor.hpp"
#include "decompose/slip_laws.hpp"
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

// The same network with tunable parameters on another device: what its brake is told at most, and whether it is certified.
struct OtherDevice {
  bool certified = false;
  double largest_damping = 0;  // [N·s/m]
};

OtherDevice on_another(const Compilation& c, const Choices& asked, const Device& device) {
  Diagnostics unheard;
  Choices choices = asked;
  choices.state_input = StateInput::position;
  const double period = device.description.loop.sample_period;
  const auto port = PortDevice::of(device, c.network, unheard);
  const auto decomposition = decompose(at_default(c.network), c.form, choices, &device, unheard);
  if (!port || !decomposition) return {};
  auto law = discretise_tunable(c.network, c.form, *decomposition, choices, 1 / period, &device, unheard);
  if (!law) return {};
  const SampledLoop loop = sampled_loop(*port, period);
  const Certificate certificate = certify(*law, loop, slip_motor(c.network, c.form, *decomposition, choices, loop));
  return {certificate.certified, law->largest_damping};
}

// A brake with room for all that it would be told; a network that asks for so much less of it; a faster loop.
void say_what_would_do_for_tunables(const Compilation& c, const Choices& choices, const std::string& unit, Diagnostics& diagnostics) {
  const double has = c.certificate.loop.max_damping, scale = has > 0 ? c.device->description.brake.max_damping / has : 0;
  Device stronger = *c.device;
  stronger.description.brake.max_damping = 1e30;
  if (const OtherDevice unlimited = on_another(c, choices, stronger); unlimited.certified && scale > 0) {
    const double enough = unlimited.largest_damping * (1 + 1e-6);
    stronger.description.brake.max_damping = enough * scale;
    if (on_another(c, choices, stronger).certified) {
      diagnostics.note<DiagnosticCode::brake_that_would_do>({}, enough, unit, has);
      diagnostics.note<DiagnosticCode::scale_that_would_do>({}, has / enough);
    }
  }
  Device faster = *c.device;
  for (int doubling = 1; doubling <= 10; ++doubling) {
    faster.description.loop.sample_period /= 2;
    if (!on_another(c, choices, faster).certified) continue;
    diagnostics.note<DiagnosticCode::rate_that_would_do>({}, 1 / faster.description.loop.sample_period);
    return;
  }
}

}  // namespace

bool insist_on_certificate(const Compilation& c, const Choices& choices, Diagnostics& diagnostics) {
  const Certificate& certificate = c.certificate;
  if (!c.device || certificate.certified) return true;
  const std::string& name = c.network.name;
  if (certificate.bound.proof == Proof::none) {
    diagnostics.report<DiagnosticCode::nothing_proved>(c.network.name_span, name, c.device->name, certificate.bound.reason);
    return true;
  }
  const std::string unit = port_units(c.network.port_motion).damping;
  if (c.law.tunable) {
    diagnostics.report<DiagnosticCode::not_certified>(c.network.name_span, name, certificate.bound.needed, unit, c.device->name, certificate.assured);
    say_what_would_do_for_tunables(c, choices, unit, diagnostics);
    diagnostics.note<DiagnosticCode::compile_uncertified>({});
    return false;
  }
  const SampledLoop& loop = certificate.loop;
  const double of_regimes = c.law.largest_damping - c.law.damping;  // what a brake that changes needs above its least
  const double available = assured_damping(loop, loop.max_damping - of_regimes).convert_to<double>();
  const double needed = least_need(c, choices, *c.device).needed;
  diagnostics.report<DiagnosticCode::not_certified>(c.network.name_span, name, needed, unit, c.device->name, available);
  const double brake = missing_damping({Proof::sampled, needed, 0, ""}, loop, 0);
  if (brake < 1e300) diagnostics.note<DiagnosticCode::brake_that_would_do>({}, brake, unit, loop.max_damping);
  if (available > 0) diagnostics.note<DiagnosticCode::scale_that_would_do>({}, available / needed);
  if (const std::optional<double> rate = rate_that_would_do(c, choices))
    diagnostics.note<DiagnosticCode::rate_that_would_do>({}, *rate);
  diagnostics.note<DiagnosticCode::compile_uncertified>({});
  return false;
}

void warn_of_driving_uncertified(const Compilation& c, Diagnostics& diagnostics) {
  const Certificate& certificate = c.certificate;
  if (!c.device || certificate.certified) return;
  const Span place = c.network.name_span;
  if (certificate.bound.proof == Proof::none)
    return diagnostics.report<DiagnosticCode::nothing_proved>(place, c.network.name, c.device->name, certificate.bound.reason);
  diagnostics.report<DiagnosticCode::drives_uncertified>(place, c.network.name, c.device->name, certificate.bound.needed,
                                                         port_units(c.network.port_motion).damping, certificate.assured);
  diagnostics.note<DiagnosticCode::compile_says_what_would_do>({});
}

}  // namespace dashpot::compiler
