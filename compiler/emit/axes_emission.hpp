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
  double rate = 0;  // [Hz]
};

namespace axes {

// "diagonal", "non-injecting", "virtual".
std::string_view name_of(BrakeRule rule);
inline constexpr BrakeRule all_brake_rules[] = {BrakeRule::diagonal, BrakeRule::non_injecting,
                                                BrakeRule::virtual_brake};

}  // namespace axes

// What the brakes would make of the ports' damping by another rule, or with `more` of them; nothing without a
// workspace.
std::optional<axes::ShareMap> share_by(const AxesCompilation& compilation, axes::BrakeRule rule,
                                       const std::vector<AlongBrake>& more = {});

// The same at the centres of `side` × `side` equal parts of the workspace.
std::vector<PlacedShare> shares_over(const AxesCompilation& compilation, axes::BrakeRule rule, int side);

// <name>.hpp, and <name>_live.cpp where it is asked for. Refuses: templates that do not fit.
std::optional<std::vector<OutputFile>> emit_axes_cpp(const AxesCompilation& compilation, const EmissionOptions& options,
                                                     Diagnostics& diagnostics);

}  // namespace dashpot::compiler
