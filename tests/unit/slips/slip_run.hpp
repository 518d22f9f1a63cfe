// Networks with slips, run by evaluate() along random motions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "law/evaluate.hpp"
#include "emit/emission.hpp"

namespace dashpot::testing {

inline constexpr double slip_period = 1e-3;  // [s]

// All stages behind the front end at 1 kHz, without a device, `position` driven and without an estimate in the motor.
// Throws std::runtime_error where a stage refuses.
compiler::Compilation compiled(const compiler::Network& network, compiler::Scheme scheme,
                               compiler::ScalarType scalar = compiler::ScalarType::float64);

// The same with any choices but the rate, for a device or the ideal one.
compiler::Compilation compiled(const compiler::Network& network, const compiler::Choices& choices,
                               const compiler::Device* device);

// True where some part of the network has that law of slips; with another it is refused.
bool can_have(const compiler::Network& network, const std::string& law, const compiler::Device* device = nullptr);

// Displacements [m]: rests, steps over many decades about what makes the slips give way, reversals, returns to where it
// was before.
std::vector<double> random_motion(const compiler::Network& network, std::uint64_t seed, std::size_t samples);

// The stiffest element in a sample, springs, and dampers as backward Euler sees them [N/m].
double stiffest(const compiler::Network& network);

// The law with the brake's part at the true velocity: the whole force that the network opposes [N].
class WholeForce {
 public:
  explicit WholeForce(const compiler::UpdateLaw& law) : law_(law) { law_.reset(0); }

  double step(double position) {
    const double change = position - position_;
    position_ = position;
    const command<double> now = law_.step(position, change / slip_period);
    return now.damping * (change / slip_period) + now.force;
  }
  double stored_energy() { return law_.stored_energy(); }

 private:
  compiler::Evaluation<double> law_;
  double position_ = 0;
};

// Slips in the component that has most.
std::size_t most_coupled(const compiler::Compilation& compilation);

}  // namespace dashpot::testing
