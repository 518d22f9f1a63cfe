// Networks behind a contact, and their laws with the surface in sight.
#pragma once

#include <string>

#include "slips/slip_run.hpp"
#include "support/written_network.hpp"

namespace dashpot::testing {

inline compiler::Network behind_contact(compiler::Network network, double at) {
  network.contact = compiler::Contact{at, {}};
  return network;
}

inline compiler::Network behind_contact(const std::string& structure, double at) {
  return behind_contact(written_network(structure), at);
}

// A law whose brake is given the velocity of the surface: then brake and motor make the force f of the network itself.
class TouchedForce {
 public:
  explicit TouchedForce(const compiler::Compilation& compilation) : TouchedForce(compilation.law) {}
  explicit TouchedForce(const compiler::UpdateLaw& law) : at_(law.surface_at.value()), law_(law), run_(law) {
    run_.reset(at_);
  }

  // In: the tool's displacement [m]. Out: f [N].
  double step(double position) {
    const double before = surface(), velocity = (position - at_ - before) / law_.sample_period;
    const auto [damping, force] = run_.step(position, velocity);
    return damping * velocity + force;
  }

  double surface() const { return run_.value_of(law_.rest_position); }  // [m]
  double gap(double position) const { return surface() - (position - at_); }
  double stored_energy() { return run_.stored_energy(); }

 private:
  double at_;
  const compiler::UpdateLaw& law_;
  compiler::Evaluation<double> run_;
};

}  // namespace dashpot::testing
