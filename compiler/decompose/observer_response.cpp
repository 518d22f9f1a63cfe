#include "decompose/observer_response.hpp"

#include <algorithm>
#include <utility>

#include "network/match.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t places = 16;

ComplexReal inverse(const ComplexReal& d) {
  const Real square = d.real * d.real + d.imaginary * d.imaginary;
  if (square == 0) return {0, 0};  // without a reference frequency the value is not used
  return {d.real / square, -d.imaginary / square};
}

struct Extent {
  Real least = 0, most = 0;  // zero if there are none
  void take(const Real& value) {
    if (value == 0) return;
    least = least == 0 ? value : std::min(least, value);
    most = std::max(most, value);
  }
};

}  // namespace

ObserverPlaces::ObserverPlaces(const Network& network, double reference_frequency) : reference_(reference_frequency) {
  Extent stiffness, damping;
  for (const Element& element : network.elements) {
    match(
        element.law, [&](const Spring& spring) { stiffness.take(spring.stiffness); },
        [&](const Damper& damper) { damping.take(damper.damping); }, [](const Slip&) {});
  }
  const bool has_both = stiffness.most > 0 && damping.most > 0;
  const Real low = has_both ? Real(stiffness.least / damping.most / 100) : Real(1);
  const Real high = has_both ? Real(stiffness.most / damping.least * 100) : Real(1);
  const Real onward = pow(high / low, Real(1) / (places - 1));
  along_.push_back(low);
  while (along_.size() < places) along_.push_back(along_.back() * onward);
}

ObserverResponse ObserverPlaces::of(const Law& law) const {
  ObserverResponse response{0, 0, {0, 0}, std::vector<Real>(along_.size(), Real(0))};
  match(
      law,
      [&](const Spring& spring) {
        response.stiffness = response.at_reference.real = spring.stiffness;
        std::fill(response.along.begin(), response.along.end(), response.stiffness);
      },
      [&](const Damper& damper) {
        response.viscosity = damper.damping;
        response.at_reference.imaginary = reference_ * response.viscosity;
        for (std::size_t i = 0; i < along_.size(); ++i) response.along[i] = along_[i] * response.viscosity;
      },
      [](const Slip&) {});
  return response;
}

ObserverResponse in_parallel(const std::vector<ObserverResponse>& parts) {
  if (parts.empty()) return {};
  ObserverResponse whole = parts.front();
  for (auto part = parts.begin() + 1; part != parts.end(); ++part) {
    whole.stiffness += part->stiffness;
    whole.viscosity += part->viscosity;
    whole.at_reference.real += part->at_reference.real;
    whole.at_reference.imaginary += part->at_reference.imaginary;
    for (std::size_t i = 0; i < whole.along.size(); ++i) whole.along[i] += part->along[i];
  }
  return whole;
}

// 1/D = Σ 1/D_i. For s → 0 the parts without static stiffness decide: z = 1/Σ 1/z_i; where there is none,
// k0 = 1/Σ 1/k_i and z = k0² Σ z_i/k_i².
ObserverResponse in_series(const std::vector<ObserverResponse>& parts) {
  Real compliance = 0, fluidity = 0, weighted = 0;
  ComplexReal at_reference{0, 0};
  std::vector<Real> along(parts.front().along.size(), Real(0));
  for (const ObserverResponse& part : parts) {
    if (part.stiffness == 0) {
      fluidity += 1 / part.viscosity;
    } else {
      compliance += 1 / part.stiffness;
      weighted += part.viscosity / (part.stiffness * part.stiffness);
    }
    const ComplexReal share = inverse(part.at_reference);
    at_reference.real += share.real;
    at_reference.imaginary += share.imaginary;
    for (std::size_t i = 0; i < along.size(); ++i) along[i] += 1 / part.along[i];
  }
  for (Real& value : along) value = 1 / value;
  const Real stiffness = fluidity > 0 ? Real(0) : Real(1 / compliance);
  const Real viscosity = fluidity > 0 ? Real(1 / fluidity) : Real(stiffness * stiffness * weighted);
  return {stiffness, viscosity, inverse(at_reference), std::move(along)};
}

ObserverResponse scaled(ObserverResponse response, const Real& factor) {
  response.stiffness *= factor;
  response.viscosity *= factor;
  response.at_reference.real *= factor;
  response.at_reference.imaginary *= factor;
  for (Real& value : response.along) value *= factor;
  return response;
}

Real constant_ratio(const ObserverResponse& first, const ObserverResponse& second) {
  const Real ratio = first.along.front() / second.along.front();
  for (std::size_t i = 0; i < first.along.size(); ++i)
    if (abs(first.along[i] - ratio * second.along[i]) > equal_to * first.along[i]) return 0;
  return ratio;
}

}  // namespace dashpot::compiler
