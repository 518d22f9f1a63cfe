// The certificate of a law of two axes as a JSON file: for every port what certificate_file.hpp has for one axis, and
// what is proved over the workspace.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emit/axes_emission.hpp"

namespace dashpot::compiler {

struct AxesCertificateFile {
  std::string network_text;
  std::optional<std::string> device_text;
  Choices choices;                    // with the rate that was taken; the decomposition is the rule of the brakes
  std::vector<double> port_dampings;  // b of each port [N·s/m]
  std::vector<double> added_damping;  // to each brake's command [N·m·s/rad] or [N·s/m]
  bool is_proved = false;
  double needed_damping = 0;   // as a multiple of W, like all of these; infinite if no damping is enough [N·s/m]
  double for_estimates = 0;    // part of it for velocity estimates
  double for_lag = 0;          // part of it for the amplifiers' lag
  double missing_damping = 0;  // beyond what is there already
  bool certified = false;
  std::map<std::string, std::vector<double>> constants;  // as in the header
};

// `header`: the text that the certificate goes with.
std::string axes_certificate_text(const AxesCompilation& compilation, const std::string& network_text,
                                  const std::optional<std::string>& device_text, const std::string& header);

}  // namespace dashpot::compiler
