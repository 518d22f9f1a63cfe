// Random networks on random devices, compiled, and run in closed loop on the simulated device with random passive
// hands.
#pragma once

#include <dashpot/simulated/scenario.hpp>

#include <memory>
#include <optional>

#include "compile.hpp"
#include "support/random.hpp"

namespace dashpot::testing {

// A law and what it was compiled from.
struct CompiledCase {
  std::unique_ptr<compiler::SourceFile> source;
  compiler::Device device;
  compiler::Choices choices;
  std::optional<compiler::Compilation> compilation;
};

// Linear, with every estimator that something is proved for, delays and lags; the encoder and the coil are ideal.
compiler::Device random_device(Random& random);
CompiledCase random_case(std::uint64_t seed);

// None, light, stiff, or resonant near `frequency` [Hz].
simulated::hand random_hand(Random& random, double inertia, double frequency);

// What the certificate leaves open about a loop.
struct Conditions {
  simulated::brake_gain gain = simulated::brake_gain::nominal;  // the end of the brake's tolerance
  bool encoder_steps = false;                                   // else the encoder is ideal
  quantiser rounding = quantiser::floor;
  double friction = 0;      // Coulomb's [N]
  double unpaid_force = 0;  // that the encoder's step may bring in beyond friction [N]
  double size = 1;          // of all motions
  double changes = 0;       // of parameters, for each sample
};

struct RunOfLoop {
  double least_energy = 0;      // that motor, brake and mechanics together have taken up, at its least [J]
  double least_margin = 0;      // the same and `unpaid_force` times the travel, and `jumps`, until then [J]
  double jumps = 0;             // what changes of parameters that could not keep the force may have brought [J]
  double largest_exchange = 0;  // the largest of the amounts it is the sum of [J]
};

// The law on the device for `samples`, in the hands of a random user.
RunOfLoop run_loop(const CompiledCase& one, Random& random, const Conditions& conditions, int samples);

// Fails where the loop, with ideal sensors and the brake at either end of its tolerance, gives out more energy than it
// has taken up, with so many changes of parameters a sample; a force that a change could not keep is one jump, held
// until the next command acts. Whether it holds without that. Rounding: 1e-9 of what went to and fro.
bool expect_no_energy_given_out(const CompiledCase& one, Random random, double changes = 0);

// Fails where the loop, with an encoder of steps, motions of two to two hundred of them, and friction that pays for
// `share` of what they stir up, gives out more than the certificate states. Whether it gave out any: with little
// friction some loops do.
bool gives_out_no_more_than_unpaid(const CompiledCase& one, Random& random, double share);

}  // namespace dashpot::testing
