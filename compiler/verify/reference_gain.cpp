#include "verify/reference_gain.hpp"

#include <algorithm>
#include <cmath>
#include <dashpot/estimators/any_estimator.hpp>
#include <limits>

#include "decompose/regimes.hpp"
#include "network/disjoint_sets.hpp"
#include "network/law.hpp"
#include "verify/reference_network.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t longest_pulse = 200'000;  // samples
constexpr std::size_t quiet_samples = 200;      // in which an estimate that is over has stayed at rest

// T v̂ under a unit step of position, sample by sample, until it is at rest: it sums to 1.
std::vector<double> answer_to_step(const SampledLoop& loop) {
  any_estimator<double> estimator(loop.velocity, loop.sample_period, loop.joint_encoder_step);
  estimator.reset(0);
  std::vector<double> answers;
  for (std::size_t quiet = 0; quiet < quiet_samples && answers.size() < longest_pulse;) {
    device_sample sample{};
    sample.position = 1;
    answers.push_back(estimator.update(sample) * loop.sample_period);
    quiet = std::abs(answers.back()) < 1e-16 ? quiet + 1 : 0;
  }
  return answers;
}

struct PulseMode {
  long double decay, loss, drive, velocity_drive;
};

// k0 q + s Δq + g v̂ + Σ G, with what drives a mode summed by parts: G = x − α P, P ← a P + x.
struct PulseLaw {
  long double static_stiffness = 0, step_stiffness = 0, velocity_gain = 0;
  std::vector<PulseMode> modes;

  bool follows_estimate() const { return velocity_gain != 0 || estimate_drives_modes(); }
  bool estimate_drives_modes() const {
    return std::any_of(modes.begin(), modes.end(), [](const PulseMode& mode) { return mode.velocity_drive != 0; });
  }
};

ReferenceGain pulse_of(const PulseLaw& law, const std::vector<double>& averages, long double period) {
  std::vector<long double> sums(law.modes.size(), 0);
  long double total = 0, modes_force = 0, last = 0, last_average = 0;
  long double addends = 0, modes_addends = 0;  // sums of their sizes, which bound the rounding of a sum in doubles
  for (std::size_t j = 0; j < std::max<std::size_t>(averages.size(), 2); ++j) {
    const long double q = j == 0 ? 1 : 0, average = j < averages.size() ? averages[j] : 0;
    const long double held = law.static_stiffness * q, stepped = law.step_stiffness * (q - last);
    const long double estimated = law.velocity_gain * (average - last_average) / period;
    total += std::abs(held + stepped + estimated + modes_force);
    addends += std::abs(held) + std::abs(stepped) + std::abs(estimated) + modes_addends;
    modes_force = modes_addends = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const long double drive = law.modes[i].drive * q + law.modes[i].velocity_drive / period * average;
      modes_force += drive - law.modes[i].loss * sums[i];
      modes_addends += std::abs(drive) + std::abs(law.modes[i].loss * sums[i]);
      sums[i] = law.modes[i].decay * sums[i] + drive;
    }
    last = q;
    last_average = average;
  }
  long double to_come = std::abs(modes_force);
  for (const long double sum : sums) to_come += std::abs(sum);
  const long double rounding =
      addends * std::numeric_limits<double>::epsilon() * static_cast<long double>(sums.size() + 4);
  return {Reference(total - rounding), Reference(total + to_come + rounding)};
}

PulseLaw pulse_law(const ReferenceForm& form, const LawFacts& facts) {
  const auto constants = reference_constants(form, facts);
  const auto numbers = [&](const char* kind) {
    return constants.count(kind) > 0 ? constants.at(kind) : std::vector<Reference>{};
  };
  const auto number = [&](const Reference& value) { return value.convert_to<long double>(); };
  PulseLaw law{number(numbers("static_stiffness").front()),
               number(numbers("step_stiffness").front()),
               number(numbers("velocity_gain").front()),
               {}};
  const auto decays = numbers("decay"), losses = numbers("loss"), gains = numbers("gain"),
             drives = numbers("velocity_drive");
  for (std::size_t i = 0; i < decays.size(); ++i)
    law.modes.push_back({number(decays[i]), number(losses[i]), number(gains[i]), number(drives[i])});
  return law;
}

std::optional<ReferenceGain> gain_of(PulseLaw law, const SampledLoop& loop) {
  const long double period = loop.sample_period;
  if (!law.follows_estimate()) return pulse_of(law, {}, period);
  const estimator_kind kind = loop.velocity.estimator;
  if (!loop.has_device) return pulse_of(law, {1, 0}, period);
  const bool divides = kind == estimator_kind::interval_difference;
  if (divides && loop.jitter == 0) return pulse_of(law, {1, 0}, period);
  if (kind != estimator_kind::foaw && !divides) {
    const bool is_linear = kind == estimator_kind::backward_difference || kind == estimator_kind::least_squares ||
                           kind == estimator_kind::butterworth || kind == estimator_kind::kalman;
    return is_linear ? std::optional(pulse_of(law, answer_to_step(loop), period)) : std::nullopt;
  }
  // v̂ is off by Δ/T, whatever its window, or over the shortest interval.
  const long double shortest = divides ? period - loop.jitter : period;
  if (law.estimate_drives_modes() || !(shortest > 0)) return std::nullopt;
  const long double widest = 2 * std::abs(law.velocity_gain) / shortest;
  law.velocity_gain = 0;
  const ReferenceGain rest = pulse_of(law, {}, period);
  return ReferenceGain{rest.least + Reference(widest), rest.most + Reference(widest)};
}

// The stiffness of a part over one sample while its slips hold; empty if it is rigid.
std::optional<Reference> held_companion(const ReferencePart& part, const LawFacts& facts) {
  if (part.kind == ReferencePart::Kind::block) return companion(part.form, facts);
  if (part.kind == ReferencePart::Kind::slip) return std::nullopt;
  Reference sum = 0, inverse = 0;
  bool is_held = false;
  for (const ReferencePart& child : part.children) {
    const std::optional<Reference> g = held_companion(child, facts);
    is_held = is_held || !g;
    if (g) sum += *g, inverse += 1 / *g;
  }
  if (part.kind == ReferencePart::Kind::series) return 1 / inverse;
  return is_held ? std::nullopt : std::optional(sum);
}

// The same of a part that is no tree: ends that slips join are one, and those that are neither tool nor ground are
// eliminated.
Reference held_companion(const ReferenceNetwork& form, const Network& network, const std::vector<std::size_t>& elements,
                         const LawFacts& facts) {
  const std::size_t count = form.ends.size();
  DisjointSets joined(count);
  const auto place = [&](NodeIndex node) {
    return std::size_t(std::find(form.ends.begin(), form.ends.end(), node) - form.ends.begin());
  };
  for (std::size_t i : elements) {
    const Element& e = network.elements[i];
    if (!is_slip(e.law)) continue;
    const std::size_t a = joined.find(place(e.a)), b = joined.find(place(e.b));
    joined.unite(std::min(a, b), std::max(a, b));  // tool and ground come last
  }
  ReferenceMatrix ties(count, ReferenceVector(count, 0));
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) {
      if (joined.find(a) == joined.find(b)) continue;
      Reference& tie = ties[joined.find(a)][joined.find(b)];
      tie += form.springs[a][b] + form.dampers[a][b] * Reference(facts.rate);
      for (const ReferenceNetworkMode& mode : form.modes)
        tie -= mode_factors({mode.stiffness, mode.relaxation_rate, 1}, facts).gain * mode.weights[a] * mode.weights[b];
    }
  for (std::size_t i = 0; i + 2 < count; ++i) {  // a star becomes a mesh
    Reference all = 0;
    for (std::size_t b = i + 1; b < count; ++b) all += ties[i][b];
    for (std::size_t a = i + 1; all > 0 && a < count; ++a)
      for (std::size_t b = i + 1; b < count; ++b)
        if (a != b) ties[a][b] += ties[i][a] * ties[i][b] / all;
  }
  return ties[count - 2][count - 1];
}

// The linear network that is left while all slips hold.
ReferenceForm held_form(const Network& network, const std::vector<std::size_t>& elements) {
  const std::vector<SlipElements> slips = slips_together(network, elements);
  return reference_form(network_in_regime(network, elements, slips, std::vector<bool>(slips.size(), false)));
}

// k0 + 2 Σ c + 2 |b∞ − x|/h, with g = k0 + Σ c + b∞/h.
Reference gain_of(const Reference& g, const ReferenceForm& held, const std::vector<BrakeShare>* shares,
                  const LawFacts& facts) {
  const Reference rate(facts.rate), b = held.feedthrough_damping;
  Reference left = shares == nullptr || shares->empty() ? b : Reference(0);
  if (shares != nullptr)
    for (const BrakeShare& share : *shares) left = std::max(left, Reference(abs(b - Reference(share.feedthrough))));
  return 2 * g - held.static_stiffness - 2 * b * rate + 2 * left * rate;
}

}  // namespace

std::optional<ReferenceGain> reference_gain(const MotorConstants& motor, const SampledLoop& loop) {
  PulseLaw law{motor.static_stiffness, motor.step_stiffness, motor.velocity_gain, {}};
  for (const MotorMode& mode : motor.modes)
    law.modes.push_back({mode.decay, mode.loss, mode.position_drive, mode.velocity_drive});
  return gain_of(std::move(law), loop);
}

std::optional<ReferenceGain> reference_pulse(const SampledLoop& loop) { return gain_of(PulseLaw{0, 0, 1, {}}, loop); }

std::optional<ReferenceGain> reference_gain(const ReferenceTree& tree, const ReferenceForm& linear,
                                            const Network& network, const SlipDecomposition& slips,
                                            const SlipMotor& motor, const LawFacts& facts, const SampledLoop& loop) {
  const bool touches = network.contact.has_value();
  ReferenceForm behind = linear;  // f′ is without the dampers
  behind.feedthrough_damping = 0;
  const Reference of_surface = 2 * companion(behind, facts) - behind.static_stiffness;
  std::optional<ReferenceGain> sum =
      touches ? ReferenceGain{of_surface, of_surface} : gain_of(pulse_law(linear, facts), loop);
  const Reference compensation(motor.compensation + motor.held_compensation);
  const std::optional<ReferenceGain> pulse = compensation > 0 ? reference_pulse(loop) : ReferenceGain{0, 0};
  if (!sum || !pulse) return std::nullopt;
  Reference held = 0;
  const auto add = [&](const Reference& g, const std::vector<std::size_t>& part, const auto& splits, std::size_t i) {
    const bool is_split = !touches && i < splits.size();
    held += gain_of(g, held_form(network, part), is_split ? &splits[i].shares : nullptr, facts);
  };
  for (std::size_t i = 0; i < tree.components.size(); ++i)
    add(held_companion(tree.components[i], facts).value(), elements_of(tree.components[i]), slips.components, i);
  for (std::size_t i = 0; i < tree.networks.size(); ++i) {
    const std::vector<std::size_t>& part = tree.networks[i];
    add(held_companion(reference_network(network, part), network, part, facts), part, slips.networks, i);
  }
  return ReferenceGain{sum->least + held + compensation * pulse->least, sum->most + held + compensation * pulse->most};
}

bool agrees(const std::optional<double>& stated, const std::optional<double>& compiled,
            const std::optional<ReferenceGain>& gain, ScalarType scalar) {
  if (stated != compiled) return false;
  return !stated || (gain && is_within(*stated, *gain, scalar));
}

bool is_within(double stated, const ReferenceGain& gain, ScalarType scalar) {
  const Reference margin = scalar == ScalarType::float64 ? Reference("1e-9") : Reference("1e-4");
  return Reference(stated) >= gain.least * (1 - margin) && Reference(stated) <= gain.most * (1 + margin);
}

}  // namespace dashpot::compiler
