// What is proved about a law of two axes on its device (theory, section 12): that the damping which is there for
// certain covers the forces that the ports hold from one sample to the next, over the whole workspace.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "axes/brake_share.hpp"
#include "axes/brakes.hpp"
#include "axes/workspace_bound.hpp"
#include "certify/certificate.hpp"
#include "certify/curl_gate.hpp"
#include "certify/slip_motor.hpp"
#include "linear/normal_form.hpp"
#include "network/axes_device.hpp"
#include "network/axes_network.hpp"

namespace dashpot::compiler {

// What the certificate needs of a port's compilation.
struct CertifiedPort {
  const Port* port;
  const NormalForm* form;
  const UpdateLaw* law;            // for one axis
  const Certificate* certificate;  // of that law on an ideal device of the same rate
  std::optional<SlipMotor> slips;  // if it has slips or a contact; on that device
};

struct AxesCertificate {
  bool is_proved = false;  // false: for `reason`
  std::string reason;
  double needed = 0;         // x of the damping x W that the motors' torques need, W = diag(weight) [N·s/m]
  double for_estimates = 0;  // share of `needed` that is due to velocity estimates [N·s/m]
  double contacts = 0;  // in `for_estimates`, Σ κ ‖g gᵀ‖ of contacts that are released by an estimate κ g·v̂ [N·s/m]
  double for_lag = 0;     // share of `needed` that is due to the lag of the motors' amplifiers [N·s/m]
  double least_rest = 0;  // lower bound of what held forces need beyond the damping there; may be negative [N·s/m]
  double missing = 0;     // upper bound of the x that has to be added to the damping there [N·s/m]
  axes::Pair<double> weight{1, 1};  // square of each joint's link [m²]; [1] of joints that slide
  axes::Pair<double> worst{0, 0};   // tip where most is missing [m]
  std::vector<double> added;        // to each brake's command [N·m·s/rad] or [N·s/m]
  double added_at_tip = 0;  // the largest damping that `added` makes at the tip, over all places and directions [N·s/m]
  std::string uncovered;    // the part of this network on this device that no bound covers yet; empty if there is none
  bool lies_in_port = false;  // the reason lies in a port's network: another network may have a bound
  bool certified = false;
  // Upper bounds of how much the encoders' steps change the motors' torques, one for each joint [N·m] or [N]; empty if
  // they are not bounded.
  std::optional<axes::Pair<double>> torque_of_steps;
  std::optional<axes::ShareMap> share;  // of the ports' damping that the brakes make; empty if there is none

  // For a field with an antisymmetric part: the gate that lets the brakes pay for the coupling between them, and how
  // much of the field passes it. Without a gate the damping that is added for estimates pays for the coupling.
  std::optional<axes::CurlGate> gate;
  std::optional<GatePassage> passage;
  std::string why_no_gate;  // a clause; empty if there is a gate or no need for one

  bool adds() const;

  // Whether missing damping is the only obstacle to a certificate, if there is any obstacle.
  bool lacks_only_damping() const { return is_proved && uncovered.empty(); }
};

std::vector<axes::Brake> brakes_of(const AxesDevice& device);

// The brakes' share, under a rule, of the damping of all ports while all of them are pushed; empty if there is no
// damping, no workspace, or so much damping that it cannot be computed.
std::optional<axes::ShareMap> share_of(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                                       const AxesDevice& device, axes::BrakeRule rule);

// The share at the centres of `side` × `side` equal parts of the workspace; empty if there is none.
struct PlacedShare {
  axes::Pair<double> tip;  // [m]
  axes::Share share;
};
std::vector<PlacedShare> shares_over(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                                     const AxesDevice& device, axes::BrakeRule rule, int side);

// In: a network's ports, the device, and by what rule its brakes take part. Out: the certificate, with what has to be
// added to the brakes' commands, as far as they reach.
AxesCertificate certify_axes(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                             const AxesDevice& device, axes::BrakeRule rule);

// Whether the network would be certified on a device that differs from that of `like`, a certificate that lacks
// damping, in the brakes' limits and the joints' own damping only.
bool would_be_certified(const AxesNetwork& network, const std::vector<CertifiedPort>& ports, const AxesDevice& device,
                        axes::BrakeRule rule, const AxesCertificate& like);

// A quick check at some places only: false if one of them asks for too much. `was` is the device of `like`.
bool may_be_certified(const AxesNetwork& network, const std::vector<CertifiedPort>& ports, const AxesDevice& device,
                      axes::BrakeRule rule, const AxesCertificate& like, const AxesDevice& was);

// Why the law is not certified, as one clause.
std::string why_not_certified(const AxesCertificate& certificate, const AxesDevice& device);

// One or more lines on what is proved.
std::vector<std::string> passivity_lines(const AxesCertificate& certificate, const AxesDevice& device);

// The same lines, and what is known of the energy that the encoders' steps bring in.
std::vector<std::string> explained_lines(const AxesCertificate& certificate, const AxesDevice& device);

}  // namespace dashpot::compiler
