// A network written out, taken as far as its decomposition.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "decompose/decomposition.hpp"
#include "support/written_network.hpp"

namespace dashpot::compiler {

inline const char* const kelvin_structure = R"({ "parallel": [ { "spring": 1000 }, { "damper": 10 } ] })";
inline const char* const stiff_and_soft_kelvins = R"({ "series": [
    { "parallel": [ { "spring": 1000 }, { "damper": 10 } ] }, { "parallel": [ { "spring": 1 }, { "damper": 0.1 } ] } ] })";

struct Decomposed {
  Network network;
  LinearForm form;
  Diagnostics diagnostics;
  std::optional<Decomposition> result;  // empty where the choices were refused

  bool reports(DiagnosticCode code) const {
    const std::vector<Diagnostic> all = diagnostics.in_file_order();
    return std::any_of(all.begin(), all.end(), [code](const Diagnostic& d) { return d.code == code; });
  }

  const Candidate& operator[](const std::string& name) const {
    for (const Candidate& candidate : result.value().candidates)
      if (candidate.name == name) return candidate;
    throw std::out_of_range("no candidate '" + name + "'");
  }
};

inline Decomposed decomposed(Network network, const Choices& choices = {}, const Device* device = nullptr) {
  Decomposed all{std::move(network), {}, {}, {}};
  all.form = linear_form(all.network);
  const std::optional<PortDevice> port =
      device ? PortDevice::of(*device, all.network, all.diagnostics) : PortDevice::ideal();
  if (port) all.result = decompose(all.network, all.form, with_names(choices, false), *port, all.diagnostics);
  if (all.result) warn_about_choice(*all.result, all.network, all.form, all.diagnostics);
  return all;
}

inline Decomposed decomposed(const std::string& structure, const Choices& choices = {},
                             const Device* device = nullptr) {
  return decomposed(testing::written_network(structure), choices, device);
}

inline Choices choosing(std::variant<std::string, double> decomposition) {
  Choices choices;
  choices.decomposition = std::move(decomposition);
  return choices;
}

// The paper's estimate: the difference of positions through a Butterworth filter, here at 1 kHz.
inline Device late_device(double max_damping) {
  Device device;
  device.name = "late";
  device_description& d = device.description;
  d.motion = motion::translation;
  d.loop.sample_period = 0.001;
  d.encoder.step = 1e-5;
  d.velocity.estimator = estimator_kind::butterworth;
  d.velocity.order = 4;
  d.velocity.cutoff = 120;
  d.brake.kind = brake_kind::eddy_current;
  d.brake.max_damping = max_damping;
  return device;
}

// One whose estimates need not sum to the displacement.
inline Device drifting_device() {
  Device device = late_device(100);
  device.name = "drifting";
  device.description.velocity = {};
  device.description.velocity.estimator = estimator_kind::foaw;
  device.description.velocity.window = 15;
  return device;
}

}  // namespace dashpot::compiler
