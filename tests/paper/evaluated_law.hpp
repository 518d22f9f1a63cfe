// Laws of networks that are made while the program runs, for sweeps over their values. evaluate() gives what the
// emitted code gives, bit for bit (tests/agreement).
#pragma once

#include <memory>
#include <string>

#include "decompose/choices.hpp"
#include "emit/emission.hpp"
#include "certify/certificate.hpp"
#include "law.hpp"

namespace dashpot::paper {

using Compiled = std::shared_ptr<const compiler::Compilation>;

// Throws with the compiler's own words where a network is refused.
Compiled compiled(const std::string& network, const compiler::Choices& choices,
                  const std::optional<compiler::Device>& device = std::nullopt);

LawMaker law_of(const Compiled& compilation);

// Network files: elements in series or in parallel, [N/m] and [N·s/m].
std::string kelvin_element(double stiffness, double damping);
std::string maxwell_element(double stiffness, double damping);

// The loop of that device around the law, as the certificate sees it.
compiler::SampledLoop loop_around(const Compiled& compilation, const compiler::Device& device);

}  // namespace dashpot::paper
