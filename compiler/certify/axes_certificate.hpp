// What is proved about a law of two axes on its device (theory, section 12): the forces that its ports hold from one
// sample to the next, against the damping that is there for certain, over the whole workspace.
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
  const UpdateLaw* law;            // of one axis
  const Certificate* certificate;  // of that law on an ideal device of the same rate
  std::optional<SlipMotor> slips;  // of slips or a contact, on that device
};

struct AxesCertificate {
  bool is_proved = false;  // false: for `reason`
  std::string reason;
  double needed = 0;         // x W that the motors' torques need, W = diag(weight) [N·s/m]
  double for_estimates = 0;  // of that, what follows estimates [N·s/m]
  double contacts = 0;       // in that, Σ κ ‖g gᵀ‖ of those that let go by an estimate κ g·v̂ [N·s/m]
  double for_lag = 0;        // of what is needed, what the motors' amplifiers are behind with [N·s/m]
  double least_rest = 0;     // held forces need no less beside what is there, below 0 where that is more [N·s/m]
  double missing = 0;        // x that has to be added to what is there already; not below it [N·s/m]
  axes::Pair<double> weight{1, 1};  // square of each joint's link [m²]; [1] of joints that slide
  axes::Pair<double> worst{0, 0};   // tip where most is missing [m]
  std::vector<double> added;        // to each brake's command [N·m·s/rad] or [N·s/m]
  double added_at_tip = 0;          // that, where and in which direction most of it is felt at the tip [N·s/m]
  std::string uncovered;            // what of this network on this device no bound covers yet; empty: nothing
  bool lies_in_port = false;        // either of these: another network in a port may have a bound
  bool certified = false;
  // What the encoders' steps change of the motors' torques, no more at each joint [N·m] or [N]; empty where that is not
  // bounded.
  std::optional<axes::Pair<double>> torque_of_steps;
  std::optional<axes::ShareMap> share;  // of the ports' damping by the brakes; empty where there is none

  // Of a field that turns: what lets the brakes pay for what couples them, and what of the field it lets pass. Without
  // a gate the damping that is added for estimates pays for it.
  std::optional<axes::CurlGate> gate;
  std::optional<GatePassage> passage;
  std::string why_no_gate;  // a clause; empty where there is one, or no field that turns

  bool adds() const;

  // Nothing else stands in the way, if anything does.
  bool lacks_only_damping() const { return is_proved && uncovered.empty(); }
};

std::vector<axes::Brake> brakes_of(const AxesDevice& device);

// Of the damping of all ports, where they are pushed, what the brakes make by a rule; nothing where there is no
// damping, no workspace, or so much damping that it cannot be computed.
std::optional<axes::ShareMap> share_of(const AxesNetwork& network, const std::vector<CertifiedPort>& ports,
                                       const AxesDevice& device, axes::BrakeRule rule);

// The same at the centres of `side` × `side` equal parts of the workspace; empty where there is none of it.
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

// Whether it would be certified on a device of which the brakes' limits and the joints' own damping alone are others
// than on that of `like`, which lacks damping.
bool would_be_certified(const AxesNetwork& network, const std::vector<CertifiedPort>& ports, const AxesDevice& device,
                        axes::BrakeRule rule, const AxesCertificate& like);

// The same by some places alone: false where one of them asks for too much. `was` is the device of `like`.
bool may_be_certified(const AxesNetwork& network, const std::vector<CertifiedPort>& ports, const AxesDevice& device,
                      axes::BrakeRule rule, const AxesCertificate& like, const AxesDevice& was);

// Why not, as one clause.
std::string why_not_certified(const AxesCertificate& certificate, const AxesDevice& device);

// One or more lines on what is proved.
std::vector<std::string> passivity_lines(const AxesCertificate& certificate, const AxesDevice& device);

// The same, and what the encoders' steps bring in, where that is known of them.
std::vector<std::string> explained_lines(const AxesCertificate& certificate, const AxesDevice& device);

}  // namespace dashpot::compiler
