#include "network/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "network/law.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

std::string value_text(const Network& network, const Element& element) {
  const std::string value = fmt::format("{} {}", value_of(element.law), unit_of(element.law, network.port_motion));
  const std::string& name = element.parameter ? network.parameters[*element.parameter].name : element.calculation;
  if (name.empty()) return value;
  return element.share == 1 ? fmt::format("{} = {}", name, value)
                            : fmt::format("{} * {} = {}", element.share, name, value);
}

void append_header(std::string& out, const Network& network) {
  fmt::format_to(std::back_inserter(out), "network {}: {}\n", network.name, name_of(network.port_motion));
  if (!network.title.empty()) out += "  title: " + network.title + "\n";
  if (!network.source.empty()) out += "  source: " + network.source + "\n";
}

void append_parameter(std::string& out, const Parameter& parameter) {
  fmt::format_to(std::back_inserter(out), "  parameter {} = {}", parameter.name, parameter.value);
  if (!parameter.calculation.empty()) out += " = " + parameter.calculation;
  if (parameter.tunable) fmt::format_to(std::back_inserter(out), ", tunable {} … {}", parameter.min, parameter.max);
  out += "\n";
}

void append_element(std::string& out, const Network& network, const Element& element) {
  fmt::format_to(std::back_inserter(out), "  {} {} {}: {} – {}{}\n", kind_of(element.law), element.name,
                 value_text(network, element), network.nodes[element.a], network.nodes[element.b],
                 element.has_effect ? "" : " (no effect)");
}

void append_range(std::string& out, std::string_view what, const std::optional<Range>& range, std::string_view unit) {
  if (range) fmt::format_to(std::back_inserter(out), "  valid {} {} … {} {}\n", what, range->low, range->high, unit);
}

void append_limits(std::string& out, const Network& network) {
  const PortUnits units = port_units(network.port_motion);
  if (network.static_curve) out += "  static " + to_text(*network.static_curve, network.port_motion) + "\n";
  if (network.contact)
    fmt::format_to(std::back_inserter(out), "  contact at {} {}\n", network.contact->at, units.position);
  append_range(out, "rate", network.valid.rate, units.velocity);
  append_range(out, "displacement", network.valid.displacement, units.position);
  append_range(out, "frequency", network.valid.frequency, "Hz");
}

}  // namespace

bool has_tunables(const Network& network) {
  return std::any_of(network.parameters.begin(), network.parameters.end(),
                     [](const Parameter& parameter) { return parameter.tunable; });
}

bool has_slips(const Network& network) {
  return std::any_of(network.elements.begin(), network.elements.end(),
                     [](const Element& element) { return is_slip(element.law); });
}

const char* beyond_linear(const Network& network) {
  const auto gives_way = [](const Element& element) { return element.has_effect && is_slip(element.law); };
  return has_tunables(network)                                                      ? "tunable parameters"
         : !network.ports.empty()                                                   ? "several ports"
         : std::any_of(network.elements.begin(), network.elements.end(), gives_way) ? "slips"
         : network.contact                                                          ? "a contact"
         : network.static_curve                                                     ? "a static curve"
                                                                                    : nullptr;
}

std::string to_text(const Network& network) {
  std::string out;
  append_header(out, network);
  for (const Parameter& parameter : network.parameters) append_parameter(out, parameter);
  for (const Element& element : network.elements) append_element(out, network, element);
  for (const Springpot& springpot : network.springpots)
    out += "  springpot " + to_text(springpot, network.port_motion) + "\n";
  append_limits(out, network);
  for (const Network& port : network.ports) {
    fmt::format_to(std::back_inserter(out), "  port {}\n", port.name);
    for (const Element& element : port.elements) append_element(out, port, element);
    append_limits(out, port);
  }
  return out;
}

std::string to_text(const Springpot& springpot, motion port_motion) {
  return fmt::format("{}: {} {} at {} s, exponent {}, as {} Maxwell elements within {:.3g} % from {} to {} Hz",
                     springpot.name, springpot.stiffness, unit_of(Spring{}, port_motion), springpot.time,
                     springpot.exponent, springpot.elements, 100 * springpot.error, springpot.band.low,
                     springpot.band.high);
}

std::string calculations_text(const Network& network) {
  std::string text;
  const auto add = [&](const std::string& name, const std::string& calculation, double value, const std::string& unit) {
    if (!calculation.empty())
      text += fmt::format("calculated            {} = {} = {}{}{}\n", name, calculation, value, unit.empty() ? "" : " ",
                          unit);
  };
  for (const Parameter& p : network.parameters) add(p.name, p.calculation, p.value, p.unit);
  for (const Element& e : network.elements)
    add(e.name, e.calculation, value_of(e.law), unit_of(e.law, network.port_motion));
  for (const Network& port : network.ports)
    for (const Element& e : port.elements)
      add(port.name + "." + e.name, e.calculation, value_of(e.law), unit_of(e.law, port.port_motion));
  return text;
}

std::vector<std::size_t> effective_elements(const Network& network) {
  std::vector<std::size_t> effective;
  for (std::size_t i = 0; i < network.elements.size(); ++i)
    if (network.elements[i].has_effect) effective.push_back(i);
  return effective;
}

std::string unit_of(const Law& law, motion port_motion) { return unit_of(dimension_of(law, port_motion)); }

}  // namespace dashpot::compiler
