// One sample of a law with tunable parameters: where the tool, or the surface that it pushes, goes, and the command.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/tunable/tables.hpp>

namespace dashpot {

template <class Scalar>
struct tunable_sample {
  Scalar change;    // Δu; of a contact Δs, of its surface [m]
  Scalar position;  // u; s, of the surface from where it lies unloaded [m]
  Scalar damping;   // b [N·s/m]
  Scalar force;     // m, within what the motor can make [N]
  Scalar wanted;    // m, were there no limit [N]
};

// What the tool and the network know of each other in a sample.
template <class Scalar>
struct tunable_answer {
  Scalar opposing;  // f′ = f − b∞ Δu/h, also without what slips leave to the brake [N]
  Scalar gain;      // b∞ − b of it, and what the motor makes up for a coil on its way [N·s/m]
  Scalar damping;   // b of it, and of the slips [N·s/m]
};

// A tool that is always in touch.
template <class Scalar>
constexpr tunable_sample<Scalar> held_sample(Scalar change, Scalar position, Scalar velocity,
                                             const tunable_answer<Scalar>& answer) noexcept {
  const Scalar force = answer.opposing + answer.gain * velocity;
  return {change, position, answer.damping, force, force};
}

// A surface that may be left (theory, section 5, "Contact"). `approach` is what its change would be if it stuck to the
// tool, `change` what it is. The state lets go with the force; the command only where the tool would be pulled, beyond
// a gap that the encoder tells from none, or where nothing pushes any more.
template <class Scalar>
constexpr tunable_sample<Scalar> touching_sample(const tunable_contact<Scalar>& contact, Scalar threshold,
                                                 Scalar surface, Scalar depth, Scalar change, Scalar velocity,
                                                 const tunable_answer<Scalar>& answer) noexcept {
  const Scalar gap = change - (depth - surface);
  const bool is_open = gap > Scalar(0);
  const Scalar now = is_open ? flush_below(threshold, surface + change) : depth;
  const Scalar felt = answer.opposing + answer.damping * velocity + answer.gain * velocity;
  const bool is_free = felt < Scalar(0) || gap > contact.encoder_step || (is_open && !(answer.opposing > Scalar(0)));
  if (is_free) return {change, now, Scalar(0), Scalar(0), Scalar(0)};
  const Scalar force = answer.opposing + answer.gain * velocity;
  return {change, now, answer.damping, force, force};
}

}  // namespace dashpot
