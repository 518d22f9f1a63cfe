#include "linear/linear_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linear/modal_reduction.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

const Real equal_rates{"1e-12"};

// |k s/(s + λ)| weighs most against the rest near ω = λ: below, the rest falls no faster; above, it does not fall.
// No mode adds more than twice its stiffness to that weight, so that hardly any has to be weighed against all others.
bool is_negligible(const Mode& mode, const LinearForm& form, const Real& glass_stiffness) {
  const Real most = 2 * glass_stiffness + form.feedthrough_damping * mode.relaxation_rate;
  if (mode.stiffness > negligible_share * most) return false;
  const ComplexReal whole = dynamic_stiffness(form, mode.relaxation_rate);
  return mode.stiffness <= negligible_share * (whole.real + whole.imaginary);
}

void drop_unobservable(LinearForm& form) {
  const Real glass = glass_stiffness(form);
  std::vector<Mode> kept;
  for (const Mode& mode : form.modes)
    if (!is_negligible(mode, form, glass)) kept.push_back(mode);
  form.modes = std::move(kept);
}

// Keeps Σk and Σk/λ, and so D at very high and very low frequency.
Mode merged(const Mode& first, const Mode& second) {
  Mode both = first;
  both.stiffness = first.stiffness + second.stiffness;
  both.relaxation_rate = both.stiffness / (first.damping() + second.damping());
  both.spring_share = (first.stiffness * first.spring_share + second.stiffness * second.spring_share) / both.stiffness;
  unite(both.elements, second.elements);
  return both;
}

void sort_and_merge(std::vector<Mode>& modes) {
  std::stable_sort(modes.begin(), modes.end(),
                   [](const Mode& x, const Mode& y) { return x.relaxation_rate < y.relaxation_rate; });
  std::vector<Mode> distinct;
  for (const Mode& mode : modes) {
    const bool repeated = !distinct.empty() &&
                          mode.relaxation_rate - distinct.back().relaxation_rate <= equal_rates * mode.relaxation_rate;
    if (repeated) distinct.back() = merged(distinct.back(), mode);
    else distinct.push_back(mode);
  }
  modes = std::move(distinct);
}

}  // namespace

LinearForm linear_form(const Network& network, std::span<const std::size_t> elements, NodeIndex from, NodeIndex to) {
  LinearForm form;
  for (const Part& part : independent_parts(network, elements, from, to)) add_part(form, part, network);
  drop_unobservable(form);
  sort_and_merge(form.modes);
  return form;
}

LinearForm linear_form(const Network& network) {
  const std::vector<std::size_t> elements = effective_elements(network);
  return linear_form(network, elements, tool, ground);
}

ComplexReal dynamic_stiffness(const LinearForm& form, const Real& angular_frequency) {
  const Real& w = angular_frequency;
  ComplexReal d{form.static_stiffness, form.feedthrough_damping * w};
  for (const Mode& mode : form.modes) {
    const Real share = mode.stiffness * w / (w * w + mode.relaxation_rate * mode.relaxation_rate);
    d.real += share * w;
    d.imaginary += share * mode.relaxation_rate;
  }
  return d;
}

std::complex<double> viscous_impedance(const LinearForm& form, double angular_frequency) {
  std::complex<double> z = to_double(form.feedthrough_damping);
  for (const Mode& mode : form.modes)
    z += to_double(mode.stiffness) / std::complex<double>(to_double(mode.relaxation_rate), angular_frequency);
  return z;
}

Real glass_stiffness(const LinearForm& form) {
  return std::accumulate(form.modes.begin(), form.modes.end(), form.static_stiffness,
                         [](const Real& sum, const Mode& mode) -> Real { return sum + mode.stiffness; });
}

Real zero_frequency_damping(const LinearForm& form) {
  return std::accumulate(form.modes.begin(), form.modes.end(), form.feedthrough_damping,
                         [](const Real& sum, const Mode& mode) -> Real { return sum + mode.damping(); });
}

LinearForm in_parallel(LinearForm first, const LinearForm& second) {
  first.static_stiffness += second.static_stiffness;
  first.feedthrough_damping += second.feedthrough_damping;
  first.modes.insert(first.modes.end(), second.modes.begin(), second.modes.end());
  unite(first.static_elements, second.static_elements);
  unite(first.feedthrough_elements, second.feedthrough_elements);
  sort_and_merge(first.modes);
  return first;
}

void unite(std::vector<std::size_t>& elements, const std::vector<std::size_t>& more) {
  elements.insert(elements.end(), more.begin(), more.end());
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
}

KelvinForm kelvin_form(const LinearForm& form) {
  const LinearForm mobility = reciprocal(form);
  KelvinForm kelvin{mobility.feedthrough_damping, mobility.static_stiffness, {}};
  for (const Mode& mode : mobility.modes)
    kelvin.elements.push_back({mode.relaxation_rate / mode.stiffness, 1 / mode.stiffness});
  return kelvin;
}

LinearForm linear_form(const KelvinForm& form) {
  LinearForm mobility;
  mobility.static_stiffness = form.fluidity;
  mobility.feedthrough_damping = form.glass_compliance;
  for (const KelvinElement& element : form.elements)
    mobility.modes.push_back({1 / element.damping, element.stiffness / element.damping, 1, {}});
  sort_and_merge(mobility.modes);
  return reciprocal(mobility);
}

std::string to_text(const LinearForm& form, const Network& network) {
  const PortUnits units = port_units(network.port_motion);
  std::string text = fmt::format("static stiffness      {:.10g} {}\nfeedthrough damping   {:.10g} {}\n",
                                 to_double(form.static_stiffness), units.stiffness, to_double(form.feedthrough_damping),
                                 units.damping);
  for (const Mode& mode : form.modes) {
    std::string names;
    for (std::size_t element : mode.elements) names += " " + network.elements[element].name;
    text += fmt::format("mode                  {:.10g} {}, relaxation rate {:.10g} 1/s, from{}\n",
                        to_double(mode.stiffness), units.stiffness, to_double(mode.relaxation_rate), names);
  }
  return text;
}

}  // namespace dashpot::compiler
