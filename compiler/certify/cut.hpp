// A cut between tool and ground that no slip crosses. The tool's force is the sum of the forces of the parts on the
// cut, whatever slides behind them. There is such a cut if the force is unique (theory, sections 5 and 6).
//
// Parts are springs k0, dampers b∞ and modes F ← a F + c δ of their own elongation δ, which slips may keep apart from
// Δu. With V = Σ ½ k0 d² + Σ F²/2c over the whole network, and m the force of the cut without its dampers,
//     V_{k+1} − V_k ≤ m_k Δu_{k+1} + β Δu_{k+1}²,      β = Σ k0/2 + Σ c/(1 + a)   over the cut:
// the work of all parts is at least V_{k+1} − V_k + Σ [(1 − a²) F²/2c + c δ²/2], and of every part on the cut
//     (F_{k+1} − F_k) Δu − (1 − a²) F_k²/2c − c δ²/2 ≤ c/(1 + a) Δu²    for any F_k and δ.
// A spring that touches the tool gives theory's ½K. Any cut proves a bound; the least is searched for.
#pragma once

#include <optional>

#include "decompose/choices.hpp"
#include "linear/multiport_form.hpp"
#include "linear/normal_form.hpp"

namespace dashpot::compiler {

struct Cut {
  Real stiffness = 0;  // Σ k0/2 + Σ c/(1 + a) [N/m]
  Real damping = 0;    // Σ b∞ [N·s/m]

  Cut& operator+=(const Cut& other) {
    stiffness += other.stiffness;
    damping += other.damping;
    return *this;
  }
};

struct CutSettings {
  Scheme scheme;
  Real sample_period;  // [s]
  double lateness;     // weight of the stiffness: a cut needs the damping stiffness·lateness² h + damping
};

Cut cut_of(const LinearForm& form, const CutSettings& settings);

// The least cut of a tree; empty if slips alone cross it.
std::optional<Cut> least_cut(const NormalTree& tree, const CutSettings& settings);

// The least cut of a part that is no tree, given by its elements.
std::optional<Cut> least_cut(const Network& network, const std::vector<std::size_t>& elements,
                             const CutSettings& settings);

}  // namespace dashpot::compiler
