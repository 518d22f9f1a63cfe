// What decompose_slips() decides, as values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "decompose/regimes.hpp"
#include "linear/normal_form.hpp"

namespace dashpot::compiler {

enum class SlipLaw {
  by_motor,       // b = 0, m = f: everything computed
  velocity_free,  // b = b∞(regime), m = f′
  gated,          // b = b∞ and the viscosity of the dampers beside the slips, which are left out of m
  compensated,    // where any slip slides the observer's b, m = f′ − β v̂ with a β that the brake has earned
};

// What a component gives to the brake in one regime [N·s/m].
struct BrakeShare {
  double damping = 0;       // b
  Real feedthrough = 0;     // x of f′ = f − x Δu/h, not rounded: what is left of a lone damper is nothing
  double compensation = 0;  // β at most
};

struct SlipLawMerit {
  SlipLaw law;
  double largest_error;               // max |Z_rendered − Z|/|Z| over the band while sliding [1]
  std::optional<double> motor_noise;  // rms, from quantisation through the estimate [N]; empty: not linear
  std::string refusal;                // why it cannot be had; empty where it can
};

struct ComponentSplit {
  NormalTree rendered;  // of a tree what the law computes; under the gated law without the dampers beside the slips
  std::vector<std::size_t> rendered_elements;  // the same of a part that is no tree
  RegimeList regimes;
  std::vector<BrakeShare> shares;  // one a listed regime; where none is listed, one for all of them
  std::vector<SlipLawMerit> merits;
  SlipLaw law = SlipLaw::by_motor;
  std::string reason;
};

struct SlipDecomposition {
  std::vector<ComponentSplit>
      components;  // in the order of NormalForm::components; none where a contact makes one of all
  std::vector<ComponentSplit> networks;  // in the order of NormalForm::networks; behind a contact one for all slips
  double hysteresis = 0;                 // displacement that does not end a slide for the command [m]
  unsigned hold_samples = 0;             // a regime's samples before it is compensated
  double coil_share = 1;     // κ: of what is missing from √b, that the coil makes up in a sample at least [1]
  double assured_share = 0;  // of a damping that no slip changes, what an estimate may make up for; 0 for none [1]
  double make_up = 0;        // what the motor may add or take of a brake on its way, β at most [N·s/m]

  // Components, then networks.
  std::vector<const ComponentSplit*> all() const {
    std::vector<const ComponentSplit*> splits;
    for (const ComponentSplit& split : components) splits.push_back(&split);
    for (const ComponentSplit& split : networks) splits.push_back(&split);
    return splits;
  }
};

}  // namespace dashpot::compiler
