#include "compile_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "axes/workspace.hpp"
#include "compile.hpp"
#include "discretise/discretise.hpp"
#include "discretise/element_names.hpp"
#include "law/representable.hpp"
#include "lower/drop_unread.hpp"
#include "lower/joint_law.hpp"
#include "lower/begun_at_rest.hpp"
#include "syntax/parse_axes.hpp"

namespace dashpot::compiler {
namespace {

// Of the ports, with the brakes by `diagonal`.
constexpr const char *paper_rule = "paper", *faithful_rule = "faithful";

// `diagonal` where nothing is asked for, or a rule of the ports; nothing, reported, for another rule of one axis.
std::optional<axes::BrakeRule> brake_rule(const Choices& choices, Diagnostics& diagnostics) {
  for (const char* of_ports : {"", paper_rule, faithful_rule})
    if (is_named(choices, of_ports)) return axes::BrakeRule::diagonal;
  std::string names;
  for (const axes::BrakeRule rule : axes::all_brake_rules) {
    if (is_named(choices, name_of(rule))) return rule;
    names += std::string(name_of(rule)) + ", ";
  }
  names += fmt::format("{}, {}", faithful_rule, paper_rule);
  const auto* const asked = std::get_if<std::string>(&choices.decomposition);
  diagnostics.report<DiagnosticCode::rule_of_brakes>(
      {}, asked ? *asked : fmt::format("{}", std::get<double>(choices.decomposition)), names);
  return std::nullopt;
}

// Of each port on its own, driven by the position. `faithful`, and what is chosen behind slips and contacts without it,
// leaves the states of the port to positions alone.
Choices choices_of_port(const Port& port, const Choices& asked, double rate) {
  const bool is_chosen_by_itself = port.network.contact || has_slips(port.network);
  Choices choices = asked;
  choices.decomposition = is_named(asked, faithful_rule) && !is_chosen_by_itself ? "velocity-free" : "";
  choices.state_input = StateInput::position;
  choices.rate = rate;
  return choices;
}

// False, with a diagnostic, where a map has a peak in the arm's workspace: there the direction of the force turns at
// once, and no damping is enough for a held one. Of a contact only a peak that can be touched counts.
bool are_smooth(const AxesNetwork& network, const axes::Box& workspace, Diagnostics& diagnostics) {
  bool all = true;
  for (const Port& port : network.ports) {
    const std::optional<axes::Pair<double>> peak = axes::peak_in(port.map, workspace);
    const std::optional<Contact>& contact = port.network.contact;
    if (!peak || (contact && axes::depth(port.map, *peak).value <= contact->at)) continue;
    diagnostics.report<DiagnosticCode::map_not_differentiable>(port.span, port.name, 1e3 * (*peak)[0],
                                                               1e3 * (*peak)[1]);
    diagnostics.note<DiagnosticCode::map_tangent_remedy>({});
    all = false;
  }
  return all;
}

bool compile_ports(AxesCompilation& c, const Choices& asked, Diagnostics& diagnostics, StageTimes& times) {
  for (const Port& port : c.network.ports) {
    const Choices choices = choices_of_port(port, asked, c.rate);
    c.choices_of_ports.push_back(choices);
    std::optional<Compilation> compiled = compile(port.network, choices, std::nullopt, diagnostics, times);
    if (!compiled) return false;
    c.port_laws.push_back(
        without_unread_locals(discretise(compiled->network, compiled->form, compiled->decomposition, choices, c.rate)));
    c.ports.push_back(std::move(*compiled));
  }
  return true;
}

// The loop that a port's slips are in: what an estimate and a lag do to it is asked of the whole device.
SampledLoop loop_of_ports(const AxesCompilation& c) {
  SampledLoop loop;
  loop.sample_period = 1 / c.rate;
  return loop;
}

// What the encoders' ranges say of joints that turn, where the workspace lies within them.
axes::Pair<std::pair<double, double>> known_ranges(const AxesDevice& device) {
  axes::Pair<std::pair<double, double>> known{};
  if (device.joint_motion() != motion::rotation) return known;
  const axes::Box needed = axes::joint_ranges(device.arm, device.workspace);
  for (std::size_t j = 0; j < known.size(); ++j) {
    const encoder_description& encoder = device.joints[j].encoder;
    if (encoder.range_low <= needed[j].low && needed[j].high <= encoder.range_high)
      known[j] = {encoder.range_low, encoder.range_high};
  }
  return known;
}

JointPlan plan_of(const AxesCompilation& c) {
  JointPlan plan{c.device.arm,    brakes_of(c.device),     c.certificate.added, c.rule,
                 c.network.field, c.device.joint_motion(), c.certificate.gate};
  plan.ranges = c.joint_ranges;
  for (std::size_t k = 0; k < plan.brakes.size(); ++k)
    if (plan.brakes[k].most < axes::unlimited) plan.brakes[k].most -= c.certificate.added[k];
  return plan;
}

UpdateLaw law_of_all(const AxesCompilation& c) {
  std::vector<PortLaw> ports;
  for (std::size_t i = 0; i < c.ports.size(); ++i)
    ports.push_back({c.network.ports[i].name, c.network.ports[i].map, c.port_laws[i]});
  return without_unread_locals(joint_law(ports, plan_of(c)));
}

}  // namespace

std::string_view axes::name_of(BrakeRule rule) {
  switch (rule) {
    case axes::BrakeRule::diagonal: return "diagonal";
    case axes::BrakeRule::non_injecting: return "non-injecting";
    case axes::BrakeRule::virtual_brake: return "virtual";
  }
  return "";
}

std::vector<CertifiedPort> certified_ports(const AxesCompilation& c) {
  std::vector<CertifiedPort> ports;
  for (std::size_t i = 0; i < c.ports.size(); ++i) {
    const Compilation& port = c.ports[i];
    ports.push_back({&c.network.ports[i], &port.form, &c.port_laws[i], &port.certificate,
                     slip_motor(port.network, port.form, port.decomposition, c.choices_of_ports[i], loop_of_ports(c))});
  }
  return ports;
}

std::vector<RuleShare> shares_by_rule(const AxesCompilation& c, const std::vector<CertifiedPort>& ports) {
  std::vector<RuleShare> all;
  for (const axes::BrakeRule rule : axes::all_brake_rules) {
    const auto share = rule == c.rule ? c.certificate.share : share_of(c.network, ports, c.device, rule);
    if (share) all.push_back({rule, *share});
  }
  return all;
}

std::optional<axes::ShareMap> share_with(const AxesCompilation& c, const std::vector<CertifiedPort>& ports,
                                         axes::BrakeRule rule, const std::vector<AlongBrake>& more) {
  AxesDevice device = c.device;
  device.brakes.insert(device.brakes.end(), more.begin(), more.end());
  return share_of(c.network, ports, device, rule);
}

namespace {

// The least sufficient factor lies in between; found by doubling `enough` and a few halvings.
struct Bracket {
  double less, enough;
};
template <class Does>
std::optional<Bracket> least_factor(double less, double enough, const Does& does) {
  constexpr int most_doublings = 7, halvings = 4;
  if (!does(std::ldexp(enough, most_doublings))) return std::nullopt;
  for (; !does(enough); enough *= 2) less = enough;
  for (int halving = 0; halving < halvings; ++halving) {
    const double middle = (less + enough) / 2;
    (does(middle) ? enough : less) = middle;
  }
  return Bracket{less, enough};
}

// The device with the least factor for which the network would be certified. A check at some places finds the factor,
// nearly always to within a step; from there on the whole workspace is checked.
template <class DeviceOf>
std::optional<AxesDevice> device_that_would_do(const AxesCompilation& c, double less, double enough,
                                               const DeviceOf& device_of) {
  constexpr int most_steps = 8;
  const std::vector<CertifiedPort> ports = certified_ports(c);
  const auto may_do = [&](double factor) {
    return may_be_certified(c.network, ports, device_of(factor), c.rule, c.certificate, c.device);
  };
  const auto does = [&](double factor) {
    return would_be_certified(c.network, ports, device_of(factor), c.rule, c.certificate);
  };
  const std::optional<Bracket> at_places = least_factor(less, enough, may_do);
  if (!at_places) return std::nullopt;
  const double step = at_places->enough - at_places->less;
  auto [lacks, factor] = *at_places;
  for (int steps = 0; !does(factor); ++steps) {
    if (steps == most_steps) return std::nullopt;
    lacks = factor, factor += std::ldexp(step, steps);
  }
  while (factor - lacks > 1.5 * step) {
    const double middle = (lacks + factor) / 2;
    (does(middle) ? factor : lacks) = middle;
  }
  return device_of(factor);
}

}  // namespace

std::optional<axes::Pair<double>> own_damping_that_would_do(const AxesCompilation& c) {
  if (!c.certificate.lacks_only_damping() || !std::isfinite(c.certificate.missing)) return std::nullopt;
  const auto with_more = [&](double factor) {
    AxesDevice device = c.device;
    for (std::size_t joint = 0; joint < 2; ++joint) {
      double& own = device.mechanics.damping[joint];
      own += factor * c.certificate.missing * c.certificate.weight[joint];
      if (own > 0) own = std::stod(fmt::format("{:.3g}", own * (1 + 5e-3)));  // rounded up to what is told
    }
    return device;
  };
  const std::optional<AxesDevice> device = device_that_would_do(c, 0, 1, with_more);
  return device ? std::optional(device->mechanics.damping) : std::nullopt;
}

std::optional<std::vector<double>> brakes_that_would_do(const AxesCompilation& c) {
  if (!c.certificate.lacks_only_damping()) return std::nullopt;
  const auto stronger = [&](double factor) {
    AxesDevice device = c.device;
    for (AlongBrake& brake : device.brakes) {
      const double wanted = factor * brake.brake.max_damping;
      if (wanted > 0) brake.brake.max_damping = std::stod(fmt::format("{:.2g}", wanted));
    }
    return device;
  };
  const std::optional<AxesDevice> device = device_that_would_do(c, 1, 2, stronger);
  if (!device) return std::nullopt;
  std::vector<double> limits;
  for (const AlongBrake& brake : device->brakes) limits.push_back(brake.brake.max_damping);
  return limits;
}

std::optional<AxesCompilation> compile_axes(const SourceFile& source, const Choices& asked,
                                            const std::optional<AxesDevice>& device, Diagnostics& diagnostics,
                                            StageTimes& times) {
  times.enter("front end");
  const std::size_t errors_before = diagnostics.error_count();
  const std::optional<AxesNetworkDecl> decl = parse_axes_network(source, diagnostics);
  if (!decl) return std::nullopt;
  const std::optional<Range> band =
      device ? std::optional(Range{device->loop().band_low, device->loop().band_high}) : std::nullopt;
  std::optional<AxesNetwork> network = build_axes_network(*decl, diagnostics, band);
  const std::optional<axes::BrakeRule> rule = brake_rule(asked, diagnostics);
  if (asked.state_input && *asked.state_input != StateInput::position)
    diagnostics.report<DiagnosticCode::ports_follow_position>({}, name_of(*asked.state_input));
  if (!network || !rule || diagnostics.error_count() > errors_before) return std::nullopt;
  AxesCompilation c;
  c.network = std::move(*network);
  c.registers = asked.registers;
  c.rate = asked.rate.value_or(device ? 1 / device->loop().sample_period : default_rate);
  c.has_device = device.has_value();
  c.device = device ? *device : ideal_axes_device(1 / c.rate);
  c.rule = *rule;
  if (device && !are_smooth(c.network, device->workspace, diagnostics)) return std::nullopt;
  const auto* const named = std::get_if<std::string>(&asked.decomposition);
  c.decomposition = named && !named->empty() ? *named : std::string(name_of(c.rule));
  if (!compile_ports(c, asked, diagnostics, times)) return std::nullopt;
  times.enter("certificate");
  c.certificate = certify_axes(c.network, certified_ports(c), c.device, c.rule);
  times.enter("discretisation");
  c.joint_ranges = known_ranges(c.device);
  c.law = begun_at_rest(law_of_all(c));
  Network whole;
  whole.name = c.network.name, whole.name_span = c.network.name_span;
  whole.port_motion = c.device.joint_motion();
  if (!is_representable(c.law, whole, diagnostics) || !class_differs_from_members(c.law, whole, diagnostics))
    return std::nullopt;
  return c;
}

}  // namespace dashpot::compiler
