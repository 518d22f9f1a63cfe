// The canonical form of a linear one-port (theory, section 2; Foster's second form):
//     D(s) = F(s)/U(s) = k0 + b∞ s + Σ k_i s/(s + λ_i),   k0, b∞, k_i, λ_i ≥ 0
// A spring, a damper and Maxwell elements in parallel: every linear spring–damper network equals one of these.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "linear/real.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

struct Mode {
  Real stiffness;        // k_i [N/m] or [N·m/rad]
  Real relaxation_rate;  // λ_i [1/s]
  Real spring_share;     // of the drive that reaches the mode through springs at the tool, the rest through dampers [1]
  std::vector<std::size_t> elements;  // indices into Network::elements: where the mode comes from

  Real damping() const { return stiffness / relaxation_rate; }  // B_i [N·s/m] or [N·m·s/rad]
};

struct LinearForm {
  Real static_stiffness = 0;                      // k0 [N/m] or [N·m/rad]
  Real feedthrough_damping = 0;                   // b∞ [N·s/m] or [N·m·s/rad]
  std::vector<Mode> modes;                        // by ascending relaxation rate, all different
  std::vector<std::size_t> static_elements;       // those that take part in k0
  std::vector<std::size_t> feedthrough_elements;  // those that take part in b∞

  bool is_empty() const { return static_stiffness == 0 && feedthrough_damping == 0 && modes.empty(); }
};

// In: springs and dampers (indices into network.elements) between the nodes `from` and `to`. Out: their canonical form
// as seen at `from` with `to` held. Ensures: all parameters non-negative; rates equal to 1e-12 relative merged, keeping
// Σk and Σk/λ; unobservable modes absent. The elements must be tied to `from` or `to`.
LinearForm linear_form(const Network& network, std::span<const std::size_t> elements, NodeIndex from, NodeIndex to);

// The form of all elements that have an effect, seen at the tool with ground held. All must be springs or dampers.
LinearForm linear_form(const Network& network);

// D(jω) [N/m], exact to a few units in the last place of Real.
struct ComplexReal {
  Real real;
  Real imaginary;
};
ComplexReal dynamic_stiffness(const LinearForm& form, const Real& angular_frequency);

// Z_d(jω) = (D(jω) − k0)/(jω) = b∞ + Σ k_i/(jω + λ_i) [N·s/m]: the impedance with the static spring taken out.
std::complex<double> viscous_impedance(const LinearForm& form, double angular_frequency);

// k0 + Σ k_i [N/m]: the stiffness in a step, in which no damper moves but those of b∞.
Real glass_stiffness(const LinearForm& form);

// Z_d(0) = b∞ + Σ k_i/λ_i [N·s/m]
Real zero_frequency_damping(const LinearForm& form);

// The two forms side by side.
LinearForm in_parallel(LinearForm first, const LinearForm& second);

// s/D(s), which is a form of the same kind: k0 [m/(N·s)], b∞ [m/N], k_i [m/(N·s)], λ_i [1/s]. Its modes are the Kelvin
// elements of the generalised Kelvin form (Foster's first form): B_i = 1/k_i, K_i = λ_i/k_i. Its own inverse.
LinearForm reciprocal(const LinearForm& form);

// Merges two lists of element indices: ascending, each once.
void unite(std::vector<std::size_t>& elements, const std::vector<std::size_t>& more);

// Foster's first form: 1/D(s) = 1/k_g + 1/(b_g s) + Σ 1/(K_i + B_i s), in series.
struct KelvinElement {
  Real stiffness;  // K_i [N/m]
  Real damping;    // B_i [N·s/m]
};
struct KelvinForm {
  Real glass_compliance;                // 1/k_g [m/N], zero where there is no lone spring
  Real fluidity;                        // 1/b_g [m/(N·s)], zero where there is no lone damper
  std::vector<KelvinElement> elements;  // by ascending K/B
};
KelvinForm kelvin_form(const LinearForm& form);
LinearForm linear_form(const KelvinForm& form);

std::string to_text(const LinearForm& form, const Network& network);

}  // namespace dashpot::compiler
