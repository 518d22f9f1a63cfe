// Network files of what was computed: a Prony series, or a linear form as Maxwell or Kelvin elements.
#pragma once

#include <dashpot/command.hpp>

#include <string>

#include "linear/linear_form.hpp"
#include "network/passive_prony.hpp"

namespace dashpot::compiler {

// What stands above the elements.
struct NetworkHead {
  std::string name;
  std::string source;
  motion port_motion = motion::translation;
};

std::string prony_network(const NetworkHead& head, const PronySeries& series);
std::string maxwell_network(const NetworkHead& head, const LinearForm& form);
std::string kelvin_network(const NetworkHead& head, const KelvinForm& form);

// The relaxation function of a form without feedthrough damping.
PronySeries prony_series(const LinearForm& form);

}  // namespace dashpot::compiler
