#include "slip_run.hpp"

#include <algorithm>
#include <stdexcept>

#include "decompose/slip_laws.hpp"
#include "discretise/discretise.hpp"
#include "lower/drop_unread.hpp"
#include "linear/validity.hpp"
#include "slip_choice.hpp"
#include "source/render.hpp"
#include "support/random.hpp"

namespace dashpot::testing {
namespace {

// A displacement at which a slip of the network is about to give way.
double typical_displacement(const compiler::Network& network, Random& random) {
  std::vector<double> yields, stiffness;
  for (const compiler::Element& element : network.elements) {
    if (const auto* slip = std::get_if<compiler::Slip>(&element.law)) yields.push_back(slip->yield_force);
    if (const auto* spring = std::get_if<compiler::Spring>(&element.law)) stiffness.push_back(spring->stiffness);
    if (const auto* damper = std::get_if<compiler::Damper>(&element.law))
      stiffness.push_back(damper->damping / slip_period);
  }
  if (yields.empty() || stiffness.empty()) return 1;
  return yields[random.index(yields.size())] / stiffness[random.index(stiffness.size())];
}

compiler::PortDevice port_of(const compiler::Device* device, const compiler::Network& network) {
  compiler::Diagnostics diagnostics;
  return device ? compiler::PortDevice::of(*device, network, diagnostics).value() : compiler::PortDevice::ideal();
}

}  // namespace

compiler::Compilation compiled(const compiler::Network& network, compiler::Scheme scheme, compiler::ScalarType scalar) {
  compiler::Choices choices;
  choices.scheme = scheme;
  choices.scalar = scalar;
  choices.state_input = compiler::StateInput::position;
  choices.decomposition = "velocity-free";
  return compiled(network, choices, nullptr);
}

compiler::Compilation compiled(const compiler::Network& network, const compiler::Choices& asked,
                               const compiler::Device* device) {
  compiler::Diagnostics diagnostics;
  compiler::Compilation result;
  result.network = network;
  result.rate = 1 / slip_period;
  std::optional<compiler::NormalForm> form = compiler::closed_normal_form(network, diagnostics);
  if (!form) throw std::runtime_error(compiler::render_text(diagnostics));
  result.form = std::move(*form);
  const compiler::Choices choices = compiler::with_names(asked, device != nullptr || result.form.has_slips());
  result.port = port_of(device, network);
  const compiler::SlipDecomposer behind_slips(network, result.form, result.port.reference_frequency());
  const auto decomposition = compiler::decompose(network, result.form, behind_slips, choices, result.port, diagnostics);
  if (!decomposition) throw std::runtime_error(compiler::render_text(diagnostics));
  result.decomposition = *decomposition;
  if (result.form.has_slips()) compiler::choose_slip_law(result, behind_slips, choices);
  result.law = compiler::without_unread_locals(
      compiler::discretise(result.network, result.form, result.decomposition, choices, result.rate));
  return result;
}

bool can_have(const compiler::Network& network, const std::string& law, const compiler::Device* device) {
  compiler::Choices choices;
  choices.decomposition = law;
  compiler::Diagnostics diagnostics;
  const std::optional<compiler::NormalForm> form = compiler::closed_normal_form(network, diagnostics);
  if (!form) return false;
  const compiler::PortDevice port = port_of(device, network);
  const compiler::SlipDecomposer behind_slips(network, *form, port.reference_frequency());
  return compiler::decompose(network, *form, behind_slips, choices, port, diagnostics).has_value();
}

double stiffest(const compiler::Network& network) {
  double most = 0;
  for (const compiler::Element& element : network.elements) {
    if (const auto* spring = std::get_if<compiler::Spring>(&element.law)) most = std::max(most, spring->stiffness);
    if (const auto* damper = std::get_if<compiler::Damper>(&element.law))
      most = std::max(most, damper->damping / slip_period);
  }
  return most;
}

std::vector<double> random_motion(const compiler::Network& network, std::uint64_t seed, std::size_t samples) {
  Random random(seed);
  std::vector<double> motion;
  double here = 0, pace = typical_displacement(network, random);
  for (std::size_t i = 0; i < samples; ++i) {
    if (random.chance(0.1)) pace = typical_displacement(network, random) * random.log_uniform(0.01, 10);
    if (random.chance(0.2)) pace = -pace;
    if (random.chance(0.05) && !motion.empty()) here = motion[random.index(motion.size())];
    else if (!random.chance(0.1)) here += random.chance(0.5) ? pace : pace * random.uniform();
    motion.push_back(here);
  }
  return motion;
}

std::size_t most_coupled(const compiler::Compilation& compilation) {
  std::size_t most = 0;
  for (const compiler::NormalTree& component : compilation.form.components)
    most = std::max(most, compiler::slip_count(component));
  return most;
}

}  // namespace dashpot::testing
