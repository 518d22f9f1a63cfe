// From a law of two axes to the text of files.
#pragma once

#include <optional>
#include <vector>

#include "certify/axes_certificate.hpp"
#include "emit/emission.hpp"

namespace dashpot::compiler {

// Everything that the stages before found out about a network of two axes.
struct AxesCompilation {
  AxesNetwork network;
  std::vector<Compilation> ports;  // each on an ideal device of one axis
  std::vector<UpdateLaw> port_laws;
  std::vector<Choices> choices_of_ports;
  std::string decomposition;  // as asked for: a rule of the brakes, or of the ports with the brakes by `diagonal`
  bool has_device = false;
  AxesDevice device;  // ideal where none is named
  axes::BrakeRule rule = axes::BrakeRule::diagonal;
  UpdateLaw law;
  AxesCertificate certificate;
  axes::Pair<std::pair<double, double>> joint_ranges = {};  // that the law counts on [rad]; low == high: none
  double rate = 0;                                          // [Hz]
  VectorRegisters registers = VectorRegisters::none;        // that loops are laid out for
};

namespace axes {

// "diagonal", "non-injecting", "virtual".
std::string_view name_of(BrakeRule rule);
inline constexpr BrakeRule all_brake_rules[] = {BrakeRule::diagonal, BrakeRule::non_injecting,
                                                BrakeRule::virtual_brake};

}  // namespace axes

// What is asked of the ports on the device; points into `compilation`.
std::vector<CertifiedPort> certified_ports(const AxesCompilation& compilation);

// What the brakes make of the ports' damping by each rule, in the order of all_brake_rules; nothing without a
// workspace.
struct RuleShare {
  axes::BrakeRule rule;
  axes::ShareMap share;
};
std::vector<RuleShare> shares_by_rule(const AxesCompilation& compilation, const std::vector<CertifiedPort>& ports);

// The same by one rule with `more` brakes.
std::optional<axes::ShareMap> share_with(const AxesCompilation& compilation, const std::vector<CertifiedPort>& ports,
                                         axes::BrakeRule rule, const std::vector<AlongBrake>& more);

// <name>.hpp, and <name>_live.cpp and <name>_test.cpp where asked for. Refuses: templates that do not fit.
std::optional<std::vector<OutputFile>> emit_axes_cpp(const AxesCompilation& compilation, const EmissionOptions& options,
                                                     Diagnostics& diagnostics);

// <name>.h. Refuses: templates that do not fit, and names that C keeps for itself.
std::optional<std::vector<OutputFile>> emit_axes_c99(const AxesCompilation& compilation, const EmissionOptions& options,
                                                     Diagnostics& diagnostics);

}  // namespace dashpot::compiler
