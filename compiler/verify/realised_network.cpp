#include "verify/realised_network.hpp"

#include "decompose/observer.hpp"

namespace dashpot::compiler {

LawFacts facts_of(const CertificateFile& certificate) {
  const Choices& c = certificate.choices;
  return {*c.rate, c.scheme, c.scalar, *c.state_input, certificate.damping};
}

Network realised(const Network& network, const CertificateFile& certificate, const PortDevice& device) {
  const std::optional<Tree> tree = series_parallel_tree(network);
  if (certificate.choices.state_input != StateInput::nodal || !tree) return network;
  const ObserverRule rule =
      is_named(certificate.choices, "largest-observer") ? ObserverRule::largest : ObserverRule::most_dissipative;
  return observe(*tree, network, rule, device.reference_frequency()).realisation;
}

}  // namespace dashpot::compiler
