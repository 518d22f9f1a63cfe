// The choice between brake and motor: f = b·u̇ + m (theory, section 4).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "decompose/choices.hpp"
#include "decompose/faithful_rule.hpp"
#include "decompose/port_device.hpp"
#include "decompose/slip_decomposition.hpp"
#include "linear/linear_form.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// One state input for a given damping, with what it costs on the device.
struct StateInputMerit {
  StateInput state_input;
  double largest_error;  // max |Z_rendered − Z|/|Z| over the device's band; once settled, of what is felt [1]
  std::optional<double> extra_damping_any_delay;  // [N·s/m]; empty: not computed
  std::optional<double> minimum_damping = {};     // [N·s/m]; filled in by certify/; empty: nothing is proved
  std::string proof = "";                         // what the minimum damping rests on, "hold" or "sampled"
  bool is_within_brake = false;                   // the brake covers b, the minimum damping and a reserve for its proof
  double binding_frequency = 0;                   // at which the sampled loop needs most damping [Hz]
};

struct Candidate {
  std::string name;       // as explain lists it
  double damping;         // b, what the brake is asked for [N·s/m] or [N·m·s/rad]
  double wanted_damping;  // before capping at what the brake can give
  StateInput state_input;
  double velocity_gain;               // |b∞ − b|, gain from the estimate to the motor [N·s/m]
  double largest_error;               // of the chosen state input [1]
  std::optional<double> motor_noise;  // rms motor force from quantisation through the estimate [N]; empty: not linear
  std::optional<double> extra_damping_any_delay;  // [N·s/m]
  std::optional<double> minimum_damping;          // [N·s/m]; of the chosen state input
  std::optional<bool> certified;                  // the brake can give both; without a device, nothing is to be added
  std::vector<StateInputMerit> state_inputs;      // the pairs that were compared
  std::string reason;
  std::optional<FaithfulChoice> faithful = {};  // only for the candidate `faithful`: how it was chosen
  std::vector<double> error_over_band = {};     // of what is felt, at Decomposition::error_frequencies [1]

  bool capped() const { return damping < wanted_damping; }
  std::string why() const;  // `reason`, adapted if the damping was lowered
};

// How far the chosen b moves while the values that the device file assumes are varied one by one.
struct ChoiceMoves {
  double least, most;  // [N·s/m]
  std::string by;      // the key that moves it most; empty if none does
};

struct Decomposition {
  std::vector<Candidate> candidates;  // the named ones in the order of theory, section 4, then a given damping
  std::size_t chosen;
  double tolerance = 0;                   // of `faithful` [1]
  std::optional<ChoiceMoves> moves;       // of `faithful`; empty where nothing is assumed
  std::vector<double> error_frequencies;  // [Hz]; empty until all candidates are weighed, and without a device
  std::string in_words;                   // what was chosen on a device, and what that gains and costs; whole sentences
  std::string reason;                     // why the chosen state input
  double encoder_step = 0;                // at the tool; 0 of an ideal device [m] or [rad]
  SlipDecomposition slips;                // the split of the parts behind slips
  LinearForm realisation;  // the canonical form with the spring shares of the observer's realisation, for `nodal`

  const Candidate& choice() const { return candidates[chosen]; }
  Candidate& choice() { return candidates[chosen]; }
};

// In: the network, its canonical form, the user's choices with their names (with_names). Ensures: every damping ≥ 0 and
// within the brake's reach. Refuses: nodal with exact, an unknown name.
std::optional<Decomposition> decompose(const Network& network, const LinearForm& form, const Choices& choices,
                                       const PortDevice& device, Diagnostics& diagnostics);

// Warns: capping, b > Z_d(0), more error than `virtual`.
void warn_about_choice(const Decomposition& decomposition, const Network& network, const LinearForm& form,
                       Diagnostics& diagnostics);

// What decided between position, velocity and nodal.
std::string reason_for_input(const Candidate& chosen, const Network& network, const Choices& choices,
                             bool device_is_ideal);
// Why only one state input was possible.
std::string reason_for_only_input(const Candidate& chosen, const Network& network);

// True, with a diagnostic, for choices that no network can satisfy: nodal states with the exact scheme.
bool contradicts_itself(const Choices& choices, Diagnostics& diagnostics);

// What the mark * of a row means, beside the chosen one's, for a network with tunables.
std::string_view meaning_of_marks();
std::string candidates_text(const Decomposition& decomposition, const Network& network);
std::string chosen_text(const Decomposition& decomposition);

// What the columns of the candidates mean, a line or two each.
std::string legend(bool has_device);

// How a contact changes the command; empty without a contact.
std::string contact_text(const Decomposition& decomposition, const Network& network);

}  // namespace dashpot::compiler
