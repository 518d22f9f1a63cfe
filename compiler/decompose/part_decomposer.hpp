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
  // All outlive this. `beside`: what reaches ground without a slip.
  PartDecomposer(SlipPart part, const LinearForm& beside, const PortDevice& device, bool is_tunable);

  // All but what is rendered.
  ComponentSplit split(const std::variant<std::string, double>& decomposition) const;

 private:
  bool is_listed() const { return !part_.regimes.regimes.empty(); }
  const Regime& regime(std::size_t i) const { return part_.regimes.regimes[i]; }
  double excess_brake(std::size_t i) const;
  double compensation(std::size_t i) const;
  double largest_excess_brake() const;
  double largest_compensation() const;
  void choose(const std::variant<std::string, double>& decomposition, ComponentSplit& split) const;
  void choose_most_dissipative(ComponentSplit& split) const;
  void take(SlipLaw law, std::string reason, ComponentSplit& split) const;
  std::string hindrance_to_choice() const;
  std::string refusal_of(SlipLaw law) const;
  SlipLawMerit merit(SlipLaw law) const;
  double error(SlipLaw law, std::size_t i, double w) const;
  std::vector<BrakeShare> shares(SlipLaw law) const;
  BrakeShare share(SlipLaw law, std::size_t i) const;

  SlipPart part_;
  std::vector<Real>
      gated_brakes_;  // b∞ of what is computed, and the viscosity that the dampers left out have at low frequency
  const LinearForm& beside_;
  const PortDevice& device_;
  bool is_tunable_;
};

}  // namespace dashpot::compiler
