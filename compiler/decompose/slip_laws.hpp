// How the force of what is behind slips is shared between brake and motor, regime by regime (theory, section 5).
//
// In every regime V_k − V_{k−1} ≤ f′Δu, where f′ = f − x Δu/h for any x up to the regime's feedthrough damping b∞. So a
// motor that makes f′ is passive with any brake, whatever the slips, the coil and the tolerance do. Only the
// compensation, which the motor takes back by a velocity estimate, has to stay below the damping that the brake surely
// makes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "decompose/decomposition.hpp"
#include "decompose/part_decomposer.hpp"
#include "decompose/port_device.hpp"
#include "decompose/regimes.hpp"

namespace dashpot::compiler {

// The share of a ramp's final excess that may stay uncompensated because the estimate reaches back, and again because
// the coil lags [1].
inline constexpr double ramp_error = 0.01;
inline constexpr double ramp_error_of_coil = 0.04;

// How far the tool must move back before the command takes the slips for stuck, in encoder steps.
inline constexpr double hysteresis_steps = 1.5;

std::string_view name_of(SlipLaw law);

// The law that a name of --decomposition (with_names) asks for; empty if runs decide. For a damping and for `virtual`
// the motor makes everything.
std::optional<SlipLaw> slip_law_asked_for(const Choices& choices);

// Splits all parts of a network that are behind slips. The regimes, which every plan needs, are computed once.
class SlipDecomposer {
 public:
  // In: the frequency at which shares of dissipation are compared [rad/s].
  SlipDecomposer(const Network& network, const NormalForm& form, double reference_frequency);

  // In: the decomposition of what reaches ground without a slip. Ensures: together with that part no regime asks for
  // more than the brake gives; every feedthrough ≤ b∞ and ≤ b of its regime, every compensation ≤ (1 − ε) (h/T_max) of
  // what b has beyond the largest b∞ of all regimes.
  SlipDecomposition decomposed(const Candidate& linear_part, const SlipPlan& plan, const PortDevice& device) const;

 private:
  // One part, and the elements that the law computes: all, or without the dampers beside slips.
  template <class Elements>
  struct Part {
    PartDecomposer decomposer;
    Elements whole;
    std::optional<Elements> gated;

    const Elements& rendered(SlipLaw law) const { return law == SlipLaw::gated ? *gated : whole; }
  };
  using Component = Part<NormalTree>;
  using InNoTree = Part<std::vector<std::size_t>>;  // slips that meet in no tree

  static Component component(const Network& network, const NormalTree& tree, double reference_frequency);
  static InNoTree in_no_tree(const Network& network, const std::vector<std::size_t>& elements,
                             double reference_frequency);

  std::vector<Component> components_;
  std::vector<InNoTree> networks_;
};

// Gives this reason to parts without another reason for their law; if it is empty, says why there is no other law.
SlipDecomposition with_reasons(SlipDecomposition slips, const std::string& reason);

// Both: what reaches ground without a slip, then the rest by the law asked for, velocity-free where a run has to
// decide. Warns and refuses as decompose() of linear networks.
std::optional<Decomposition> decompose(const Network& network, const NormalForm& form,
                                       const SlipDecomposer& behind_slips, const Choices& choices,
                                       const PortDevice& device, Diagnostics& diagnostics);

// The elements of the slips that slide, or hold, in a regime.
std::vector<std::string> slip_names(const RegimeList& list, const Regime& regime, bool sliding, const Network& network);
// A component is called after its slips.
std::string name_of(const ComponentSplit& split, const Network& network);

// Components with the same decision.
struct SlipLikes {
  const ComponentSplit* first;
  std::vector<std::string> names;
};
std::vector<SlipLikes> likes_of(const SlipDecomposition& slips, const Network& network);
std::string to_text(const SlipLikes& likes);  // their slips, the law and the reason

std::string to_text(const SlipDecomposition& slips, const Network& network);

}  // namespace dashpot::compiler
