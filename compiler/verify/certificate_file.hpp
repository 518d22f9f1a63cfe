// A certificate as a JSON file: the network and device it is about, word for word, what was chosen, every emitted
// constant, and what is proved. Enough for somebody else to check an emitted header with, by dashpot or without.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emit/emission.hpp"

namespace dashpot::compiler {

struct CertificateFile {
  std::string network_text;
  std::optional<std::string> device_text;
  Choices choices;                     // with the rate and the state input that were taken
  bool asked_for_state_input = false;  // true: by the user; false: it was chosen
  double damping = 0;                  // b of the decomposition [N·s/m]
  double brake_command = 0;            // b and what is added [N·s/m]
  double added_damping = 0;            // [N·s/m]
  std::string proof;                   // "none", "hold" or "sampled"
  double needed_damping = 0;           // [N·s/m]
  double assured_damping = 0;          // [N·s/m]
  bool certified = false;
  std::optional<double> quantisation_gain;               // K [N/m]
  std::map<std::string, std::vector<double>> constants;  // as in the header

  Choices as_asked() const;  // as the header was compiled
};

// `header`: the text that the certificate goes with.
std::string certificate_text(const Compilation& compilation, const Choices& choices, const std::string& network_text,
                             const std::optional<std::string>& device_text, const std::string& header);

}  // namespace dashpot::compiler
