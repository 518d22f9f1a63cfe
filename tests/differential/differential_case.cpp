#include "differential_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "compile.hpp"
#include "law/evaluate.hpp"
#include "discretise/rounding.hpp"
#include "ramp_response.hpp"
#include "slips/element_reference.hpp"
#include "slips/slip_run.hpp"
#include "source/render.hpp"
#include "support/random.hpp"
#include "support/random_network.hpp"

namespace dashpot::testing {
namespace {

using compiler::Choices;
using compiler::Network;
using compiler::ScalarType;
using compiler::Scheme;
using compiler::StateInput;

constexpr std::size_t exact_samples = 32, stepped_samples = 100;

template <class T, std::size_t count>
const T& one_of(const T (&all)[count], Random& random) {
  return all[random.index(count)];
}

NetworkRecipe recipe_of(Family family, Random& random) {
  NetworkRecipe recipe;
  recipe.topology = random.chance(0.5) ? Topology::tree : Topology::graph;
  const bool is_linear = family == Family::linear_exact || family == Family::linear_backward_euler;
  recipe.most_nodes = is_linear && random.chance(0.1) ? 16 : 9;
  if (family == Family::slips || (family == Family::contact && random.chance(0.5)))
    recipe.most_slips = recipe.topology == Topology::tree ? 6 : 5;
  return recipe;
}

Choices linear_choices(Scheme scheme, Random& random) {
  static const char* const decompositions[] = {"paper",         "zero-frequency",   "quietest-passive",
                                               "velocity-free", "largest-observer", "virtual"};
  Choices choices;
  choices.scheme = scheme;
  choices.decomposition = one_of(decompositions, random);
  if (random.chance(0.15)) choices.decomposition = random.log_uniform(1e-3, 1e3);
  switch (random.index(4)) {
    case 0: break;
    case 1: choices.state_input = StateInput::position; break;
    case 2: choices.state_input = StateInput::velocity; break;
    default:
      if (scheme == Scheme::backward_euler) choices.state_input = StateInput::nodal;
  }
  return choices;
}

Choices slip_choices(Family family, Random& random) {
  static const char* const laws[] = {"steady", "gated", "ramped"};
  Choices choices;
  choices.scheme = random.chance(0.7) ? Scheme::backward_euler : Scheme::exact;
  choices.decomposition = family == Family::contact || random.chance(0.8) ? "velocity-free" : one_of(laws, random);
  return choices;
}

Choices choices_of(Family family, Random& random) {
  static const double rates[] = {1000, 100, 10000, 333.25, 5};
  const bool exact = family == Family::linear_exact, linear = exact || family == Family::linear_backward_euler;
  Choices choices =
      linear ? linear_choices(exact ? Scheme::exact : Scheme::backward_euler, random) : slip_choices(family, random);
  choices.rate = one_of(rates, random);
  if (random.chance(0.2)) choices.scalar = ScalarType::float32;
  return choices;
}

std::string text_of(const Network& network) {
  std::string text = json_text(network);
  if (network.contact)
    text.insert(text.find(',') + 1, fmt::format(" \"contact\": {{ \"at\": {:#} }},", network.contact->at));
  return text;
}

// Brakes that are too weak for the network, and loops that are late: a law then gives the brake less, or adds damping.
compiler::Device random_device(double rate, Random& random) {
  compiler::Device device;
  device.name = "random";
  device.description.loop.sample_period = 1 / rate;
  device.description.loop.delay_samples = static_cast<unsigned>(random.index(3));
  device.description.encoder.step = random.chance(0.5) ? 0 : 1e-5;
  device.description.velocity.window = static_cast<unsigned>(random.between(1, 5));
  device.description.brake = {brake_kind::eddy_current,
                              random.log_uniform(1e-2, 1e3),
                              0,
                              0,
                              random.uniform(0, 0.2),
                              random.chance(0.5) ? 0 : 0.01,
                              0,
                              0,
                              0};
  return device;
}

bool is_refused_law(const compiler::Diagnostics& diagnostics) {
  return compiler::render_text(diagnostics).find("[no-such-slip-law]") != std::string::npos;
}

compiler::Compilation compiled_text(const std::string& text, const Choices& choices,
                                    const std::optional<compiler::Device>& device) {
  const compiler::SourceFile file("random.json", text);
  compiler::Diagnostics diagnostics;
  std::optional<compiler::Compilation> compilation = compiler::compile(file, choices, device, diagnostics);
  if (!compilation && is_refused_law(diagnostics)) {  // its slips have no other law
    Choices other = choices;
    other.decomposition = "velocity-free";
    return compiled_text(text, other, device);
  }
  if (!compilation) throw std::runtime_error(compiler::render_text(diagnostics) + text);
  return std::move(*compilation);
}

double rounded(double value, ScalarType scalar) { return scalar == ScalarType::float64 ? value : double(float(value)); }

// The velocity is the slope to this sample from the tool's last position, or with a contact from that of the surface:
// then brake and motor make the network's own force.
template <class Scalar>
void evaluate(DifferentialCase& one, const std::vector<double>& positions) {
  const compiler::UpdateLaw& law = one.compilation.law;
  compiler::Evaluation<Scalar> run(law);
  const double at = law.surface_at.value_or(0);
  run.reset(static_cast<Scalar>(at));
  double last = at;
  for (const double exact_position : positions) {
    const double position = rounded(exact_position + at, law.scalar);
    if (law.surface_at) last = at + double(run.value_of(law.rest_position));
    const double velocity = rounded((position - last) / law.sample_period, law.scalar);
    const auto [damping, force] = run.step(static_cast<Scalar>(position), static_cast<Scalar>(velocity));
    one.motion.push_back({position, velocity});
    one.evaluated.push_back({double(damping), double(force), double(run.stored_energy())});
    last = position;
  }
}

bool is_linear(const Network& network) {
  return !network.contact &&
         std::none_of(network.elements.begin(), network.elements.end(),
                      [](const compiler::Element& e) { return std::holds_alternative<compiler::Slip>(e.law); });
}

bool has_modes(const compiler::NormalTree& tree) {
  return !tree.form.modes.empty() || std::any_of(tree.children.begin(), tree.children.end(), has_modes);
}

// Where every linear part is a spring, a damper or both side by side, the schemes are one.
bool schemes_are_one(const compiler::NormalForm& form) {
  return form.networks.empty() && form.linear.modes.empty() &&
         std::none_of(form.components.begin(), form.components.end(), has_modes);
}

std::vector<double> reference_forces(const DifferentialCase& one) {
  const compiler::UpdateLaw& law = one.compilation.law;
  std::vector<double> positions, forces;
  for (const Sample& sample : one.motion) positions.push_back(sample.position);
  if (law.scheme == Scheme::exact && is_linear(one.compilation.network))
    return force_by_ramps(ramp_response(one.compilation.network, law.sample_period, positions.size()), positions,
                          law.sample_period);
  ElementReference elements(one.compilation.network, law.sample_period);
  for (const double position : positions) forces.push_back(elements.step(position));
  return forces;
}

// The force of the stiffest spring, or damper as backward Euler sees it, under the largest move of a sample; the law
// subtracts from such forces what slips do not hold [N].
double largest_trial(const DifferentialCase& one) {
  const double period = one.compilation.law.sample_period;
  double stiffest = 0,
         move = std::abs(one.compilation.law.surface_at.value_or(0));  // against which positions are rounded
  for (const compiler::Element& element : one.compilation.network.elements) {
    if (const auto* spring = std::get_if<compiler::Spring>(&element.law))
      stiffest = std::max(stiffest, spring->stiffness);
    if (const auto* damper = std::get_if<compiler::Damper>(&element.law))
      stiffest = std::max(stiffest, damper->damping / period);
  }
  for (const Sample& sample : one.motion) move = std::max(move, std::abs(sample.velocity) * period);
  return stiffest * move;
}

}  // namespace

std::string name_of(Family family) {
  static const char* const names[] = {"LinearExact", "LinearBackwardEuler", "Slips", "Contact"};
  return names[static_cast<int>(family)];
}

DifferentialCase differential_case(Family family, std::uint64_t seed) {
  Random random(4 * seed + static_cast<std::uint64_t>(family));
  const NetworkRecipe recipe = recipe_of(family, random);
  Network network = random_network(4 * seed + static_cast<std::uint64_t>(family), recipe);
  for (std::uint64_t more = seed << 32; family == Family::slips && is_linear(network); ++more)
    network = random_network(more, recipe);
  network.name = fmt::format("network_{}_{}", static_cast<int>(family), seed);
  if (family == Family::contact)
    network.contact = compiler::Contact{random.chance(0.5) ? 0 : random.uniform(-1, 1), {}};
  Choices choices = choices_of(family, random);
  std::optional<compiler::Device> device;
  if (random.chance(0.25)) device = random_device(*std::exchange(choices.rate, std::nullopt), random);
  DifferentialCase one;
  const std::string text = text_of(network);
  one.compilation = compiled_text(text, choices, device);
  const compiler::UpdateLaw& law = one.compilation.law;
  one.description = fmt::format("seed {} of {}: {}, {}, {}, {} Hz{}\n{}", seed, name_of(family), name_of(law.scheme),
                                name_of(law.scalar), one.compilation.decomposition.choice().name, one.compilation.rate,
                                device ? ", on a device" : "", text);
  const std::size_t samples = family == Family::linear_exact ? exact_samples : stepped_samples;
  const std::vector<double> positions = random_motion(network, seed, samples);
  law.scalar == ScalarType::float64 ? evaluate<double>(one, positions) : evaluate<float>(one, positions);
  return one;
}

bool has_reference(const DifferentialCase& one) {
  const compiler::Compilation& c = one.compilation;
  if (is_linear(c.network)) return true;
  if (c.law.scheme == Scheme::exact && !schemes_are_one(c.form)) return false;
  // A brake that waits for its coil, or does not follow single counts of the encoder, is not quite the network.
  if (c.device && (c.device->description.brake.coil_lag > 0 || c.device->description.encoder.step > 0)) return false;
  return c.decomposition.choice().name == "velocity-free";
}

std::string departure_from_reference(const DifferentialCase& one) {
  const std::vector<double> expected = reference_forces(one);
  double scale = 0;
  for (std::size_t k = 0; k < expected.size(); ++k)
    scale = std::max({scale, std::abs(expected[k]), std::abs(one.evaluated[k].damping * one.motion[k].velocity)});
  const double added = one.compilation.certificate.added_damping;  // what is rendered is the network and this
  // For the modes what the law states; for the sum of their forces, and for closed forms that subtract, a few
  // roundoffs.
  const compiler::UpdateLaw& law = one.compilation.law;
  const double few = 32 * compiler::unit_roundoff(law.scalar);
  const double tolerance = law.relative_error_bound * scale + few * (scale + largest_trial(one));
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double actual = (one.evaluated[k].damping - added) * one.motion[k].velocity + one.evaluated[k].force;
    if (!(std::abs(actual - expected[k]) <= tolerance))
      return fmt::format("sample {}: force {} for {} at a scale of {}", k, actual, expected[k], scale);
  }
  return "";
}

}  // namespace dashpot::testing
