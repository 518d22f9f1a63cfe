// What a SlipDecomposer decides, as values.
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
  steady,         // one b in every regime, m = f′ − β v̂ with one β: nothing switches
  ramped,         // b rises and falls by small steps to that of the regime's observer, and m = f′ − β v̂ with it
  gated,          // b = b∞ and the viscosity of the dampers beside the slips, which are left out of m
};

inline constexpr SlipLaw laws_to_choose_from[] = {SlipLaw::velocity_free, SlipLaw::steady, SlipLaw::ramped,
                                                  SlipLaw::gated};

// Settings that hold for all parts.
struct SlipPlan {
  SlipLaw law = SlipLaw::velocity_free;
  double excess = 1;         // of the steady law: which share of the possible excess over the largest b∞ it takes [1]
  double estimate_gain = 1;  // upper bound of γ in ‖v̂‖₂ ≤ γ ‖Δu/h‖₂; infinite if not known [1]
  double reserve = 0;        // part of the brake that is kept for passivity [N·s/m]
};

// What a component gives to the brake in one regime [N·s/m].
struct BrakeShare {
  double damping = 0;       // b
  Real feedthrough = 0;     // x of f′ = f − x Δu/h, not rounded, so that nothing is left of a lone damper
  double compensation = 0;  // β; for the ramped law its largest value
};

// Whether a part can have a law.
struct SlipLawOffer {
  SlipLaw law;
  std::string refusal;  // why it cannot be had; empty where it can
};

// How a law does in runs of the whole network: used in all parts that can have it, velocity-free elsewhere.
struct SlipLawMerit {
  SlipLaw law;
  double peak_error = 0;  // largest |f_law − f_network| of a motion over the largest |f_network| in it, the worst [1]
  double rms_error = 0;   // the same of root mean squares [1]
  double mean_damping = 0;  // Σ b u̇²/Σ u̇² over all motions, without what is added for passivity [N·s/m]
  std::optional<double> minimum_damping;  // damping to be added for passivity; empty: not proved [N·s/m]
  bool certified = false;                 // on the device, with what has been added
  std::optional<double> motor_noise;  // rms, from quantisation through the estimate behind slips [N]; empty: not linear

  double error() const { return peak_error > rms_error ? peak_error : rms_error; }
};

// How much a law errs in one motion.
struct SlipRunError {
  std::string motion;  // "a sine of 5 Hz and ±0.001 m"
  double error = 0;    // the larger of peak and root mean square [1]
};

struct ExtremeRuns {
  const SlipRunError& mildest;
  const SlipRunError& worst;
};

// In: one run at least. Refers to `runs`.
ExtremeRuns extreme_runs(const std::vector<SlipRunError>& runs);

struct ComponentSplit {
  NormalTree rendered;  // for a tree: what the law computes; in the gated law without the dampers beside the slips
  std::vector<std::size_t> rendered_elements;  // the same for a part that is no tree
  RegimeList regimes;
  std::vector<BrakeShare> shares;  // one for each listed regime; if none is listed, one for all
  std::vector<SlipLawOffer> offers;
  SlipLaw law = SlipLaw::by_motor;
  std::string reason;

  // The largest over its regimes; 0 if it leaves nothing to the brake.
  double largest_damping() const { return largest(&BrakeShare::damping); }
  double largest_compensation() const { return largest(&BrakeShare::compensation); }

 private:
  double largest(double BrakeShare::*number) const {
    double most = 0;
    for (const BrakeShare& share : shares) most = share.*number > most ? share.*number : most;
    return most;
  }
};

struct SlipDecomposition {
  std::vector<ComponentSplit>
      components;  // in the order of NormalForm::components; none where a contact makes one of all
  std::vector<ComponentSplit> networks;  // in the order of NormalForm::networks; behind a contact one for all slips
  std::vector<SlipLawMerit> merits;      // of the laws that have been run; none where there was nothing to choose
  double limit = 0;                      // the error that the choice among them kept to [1]
  double least_error = 0;                // of the laws that it could choose from [1]
  double error = 0;                      // of the choice [1]
  std::vector<SlipRunError> runs;        // of the choice; none where it has not been run
  double hysteresis = 0;                 // how far the tool must move before the command takes a slide as ended [m]
  unsigned memory = 0;                   // N + n: samples that an estimate reaches back from the hold that it acts in
  double ramp = 1;           // ρ: the largest step of a ramp in one sample, as a share of its whole length [1]
  double coil_share = 1;     // κ: the least share of the difference in √b that the coil covers in a sample [1]
  double assured_share = 0;  // share of a damping that no slip changes, up to which an estimate may replace it [1]
  double make_up = 0;        // largest damping that the motor may add or take while the coil lags [N·s/m]

  // Components, then networks.
  std::vector<const ComponentSplit*> all() const {
    std::vector<const ComponentSplit*> splits;
    for (const ComponentSplit& split : components) splits.push_back(&split);
    for (const ComponentSplit& split : networks) splits.push_back(&split);
    return splits;
  }
};

}  // namespace dashpot::compiler
