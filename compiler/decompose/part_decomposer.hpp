// What one part with slips leaves to the brake under each law, and which law is taken (theory, section 5).
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "decompose/port_device.hpp"
#include "decompose/slip_decomposition.hpp"

namespace dashpot::compiler {

struct SlipPart {
  RegimeList regimes;
  std::vector<LinearForm> gated;  // by regime, without the dampers beside the slips; empty where none lies there
  LinearForm sliding;             // where all slips slide
};

class PartDecomposer {
 public:
  PartDecomposer(SlipPart part, bool is_tunable, bool behind_contact);

  // Everything except `rendered` and `rendered_elements`.
  ComponentSplit split(const SlipPlan& plan, const PortDevice& device) const;

 private:
  bool is_listed() const { return !part_.regimes.regimes.empty(); }
  const Regime& regime(std::size_t i) const { return part_.regimes.regimes[i]; }
  const Real& largest_feedthrough() const;
  double excess_of(std::size_t i) const;
  double largest_excess() const;
  std::string hindrance_to_choice() const;
  std::string refusal_of(SlipLaw law, const SlipPlan& plan, const PortDevice& device) const;
  std::vector<BrakeShare> shares(SlipLaw law, const SlipPlan& plan, const PortDevice& device) const;
  BrakeShare share(SlipLaw law, const SlipPlan& plan, const PortDevice& device, std::size_t i) const;

  SlipPart part_;
  // b∞ of the part that is computed, plus the damping at low frequency of the dampers left out.
  std::vector<Real> gated_brakes_;
  bool is_tunable_, behind_contact_;
};

// The share of an excess of the brake that the motor may take back through an estimate (theory, section 5):
// (1 − ε) h/T_max of the command, where ε includes what the brake loses at the largest speed.
double compensated_share(const PortDevice& device);

}  // namespace dashpot::compiler
