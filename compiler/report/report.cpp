#include "report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dashpot/led_device.hpp>

#include "emit/banner.hpp"
#include "emit/template_text.hpp"
#include "fit/column_choice.hpp"
#include "network/decimal.hpp"
#include "network/law.hpp"
#include "network/rate_limits.hpp"
#include "network/unit.hpp"
#include "report/agreement.hpp"
#include "report/base64.hpp"
#include "report/candidates.hpp"
#include "report/certificate_table.hpp"
#include "report/delay_margin.hpp"
#include "report/equations.hpp"
#include "report/hysteresis.hpp"
#include "report/linear_responses.hpp"
#include "report/markup.hpp"
#include "report/number_text.hpp"
#include "report/page_parts.hpp"
#include "report/regime_table.hpp"
#include "report/sampled_margin.hpp"
#include "report/schematic.hpp"
#include "report/static_curve.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t most_drawn_elements = 150;

// Behind a contact a linear network is one for as long as it is touched.
bool is_linear(const Compilation& c) { return !c.form.has_slips(); }

// What a reader looks for first.
std::vector<Fields> facts(const Compilation& c) {
  const PortUnits units = dotted_units(c.network.port_motion);
  std::vector<Fields> list;
  list.push_back(fact("brake b", brake_text(c.law), units.damping, "brake"));
  if (!c.ports.empty()) {
    list.push_back(fact("ports", std::to_string(c.ports.size()), ""));
    return list;
  }
  if (is_linear(c)) {
    list.push_back(
        fact("motor, velocity gain", number_text(c.decomposition.choice().velocity_gain), units.damping, "motor"));
    list.push_back(fact("static stiffness", number_text(to_double(c.form.linear.static_stiffness)), units.stiffness));
    list.push_back(fact("modes", std::to_string(c.form.linear.modes.size()), ""));
    const double viscosity = to_double(zero_frequency_damping(c.form.linear));
    list.push_back(fact("zero-frequency damping", number_text(viscosity), units.damping));
  } else {
    const auto gives_way = [](const Element& e) { return e.has_effect && is_slip(e.law); };
    const auto slips = std::count_if(c.network.elements.begin(), c.network.elements.end(), gives_way);
    list.push_back(fact("slips", std::to_string(slips), ""));
  }
  if (c.network.static_curve)
    list.push_back(
        fact("static curve", escaped(in_four_digits(to_text(*c.network.static_curve, c.network.port_motion))), ""));
  if (c.network.contact)
    list.push_back(fact("surface of the contact", number_text(c.network.contact->at), units.position));
  return list;
}

std::string in_words_html(const std::string& words) {
  if (words.empty()) return "";
  return "<p>" + escaped(in_four_digits(words)) + (words.ends_with('.') ? "" : ".") + "</p>";
}

// Candidates are of what is beside the slips. Without a device they differ by nothing that can be shown there.
bool has_candidates(const Compilation& c) {
  if (!c.ports.empty()) return false;  // each port has its own
  return is_linear(c) || (c.device && !c.form.is_all_behind_slips());
}

std::string heading_of(const Compilation& port) { return "<h3>" + escaped("Port " + port.network.name) + "</h3>\n"; }

// Each port in the terms of its own, and the force at rest that its curve asks for.
void add_ports(const Compilation& c, CodeModel& model) {
  std::string forms, choices;
  for (const Compilation& port : c.ports) {
    if (is_linear(port)) forms += heading_of(port) + canonical_form_html(port);
    choices += heading_of(port);
    if (c.device) choices += "<p>On its share of the device: " + escaped(to_text(port.share)) + ".</p>\n";
    choices += in_words_html(port.decomposition.in_words);
    if (has_candidates(port)) choices += candidates_table_html(port);
    if (!is_linear(port)) choices += regimes_html(port);
  }
  if (!forms.empty()) model.lists["canonical"].push_back({{"form", forms}});
  model.lists["ports"].push_back({{"choices", choices}});
}

void add_linear_parts(const Compilation& c, CodeModel& model) {
  for (const char* list : {"canonical", "agreement", "candidates", "felt_error", "regimes", "ports"}) model.lists[list];
  if (!c.ports.empty()) return add_ports(c, model);
  if (!is_linear(c)) model.lists["regimes"].push_back({{"regimes", regimes_html(c)}});
  else model.lists["canonical"].push_back({{"form", canonical_form_html(c)}});
  if (is_linear(c) && !c.network.contact && !c.network.map)
    model.lists["agreement"].push_back({{"body", agreement_html(c)}});
  if (!has_candidates(c)) return;
  model.lists["candidates"].push_back({{"where", is_linear(c) ? "" : " in parallel with the slips"},
                                       {"choice", escaped(c.decomposition.choice().name)},
                                       {"reason", escaped(in_four_digits(c.decomposition.reason))},
                                       {"in_words", in_words_html(c.decomposition.in_words)},
                                       {"table", candidates_table_html(c)}});
  if (const std::string figure = felt_error_html(c); !figure.empty())
    model.lists["felt_error"].push_back({{"figure", figure}});
}

void add_passivity(const Compilation& c, CodeModel& model) {
  model.fields["passivity"] = certificate_html(c);
  // Both are of linear laws; behind a static curve the certificate's words are all there is.
  model.fields["margin"] =
      c.network.map || !c.ports.empty() ? "" : sampled_margin_html(c) + (is_linear(c) ? delay_margin_html(c) : "");
}

// Two digits of ten times the slowest relaxation, within what a reader waits for.
double live_duration(const Compilation& c) {
  const double slowest = c.form.linear.modes.empty() ? 0.2 : 1 / to_double(c.form.linear.modes.front().relaxation_rate);
  return std::clamp(std::strtod(fmt::format("{:.2g}", 4 * slowest).c_str(), nullptr), 0.5, 20.0);
}

// Two digits of what lets slips yield even where a motion is slower than the loops that are drawn, within the network's
// range.
double live_depth(const Compilation& c, double amplitude) {
  double depth = c.form.has_slips() ? 2 * amplitude : amplitude;
  const double surface = c.network.surface();
  if (const auto& range = c.network.valid.displacement; range && range->high > surface)
    depth = std::min(depth, range->high - surface);
  return std::strtod(fmt::format("{:.2g}", depth).c_str(), nullptr);
}

void add_live_part(const Compilation& c, bool there, double amplitude, CodeModel& model) {
  const PortUnits units = dotted_units(c.network.port_motion);
  for (const char* list : {"live", "led", "live_controls", "live_end", "still", "sliders"}) model.lists[list];
  if (!there) {
    model.lists["still"].push_back({{"why",
                                     "Left out: when this page was written there was no clang with lld to compile the "
                                     "emitted code to WebAssembly."}});
    return;
  }
  const std::string felt =
      c.device ? fmt::format(
                     "What is felt of it on {} is computed beside it, by the encoder, estimator, delay, amplifier "
                     "and coil of the device, without jitter; a recording may have any uniform rate.",
                     escaped(c.device->name))
               : "";
  model.lists["live"].push_back({{"felt", felt}});
  if (c.device) model.lists["led"].push_back({});
  model.lists["live_controls"].push_back({{"depth", fmt::format("{}", live_depth(c, amplitude))},
                                          {"depth_of_what", c.network.contact ? "depth beyond the surface" : "depth"},
                                          {"duration", fmt::format("{:g}", live_duration(c))},
                                          {"position_unit", units.position}});
  model.lists["live_end"].push_back({});
  if (c.law.tunable) model.lists["sliders"].push_back({{"middle", fmt::format("{:g}", live_duration(c) / 2)}});
}

std::string tunables_json(const UpdateLaw& law) {
  std::string json;
  for (const Tunable& t : law.parameters())
    json += fmt::format("{}{{\"name\":{},\"unit\":{},\"value\":{},\"min\":{},\"max\":{}}}", json.empty() ? "" : ",",
                        json_literal(t.name), json_literal(t.unit), json_literal(t.range.value),
                        json_literal(t.range.min), json_literal(t.range.max));
  return "[" + json + "]";
}

// What a linear network opposes to a motion, as a page needs it; nothing for another.
std::string form_json(const Compilation& c) {
  if (c.beyond_linear()) return "null";
  std::string modes;
  for (const Mode& mode : c.form.linear.modes)
    modes += fmt::format("{}[{},{}]", modes.empty() ? "" : ",", json_literal(to_double(mode.relaxation_rate)),
                         json_literal(to_double(mode.damping())));
  return fmt::format("{{\"static_stiffness\":{},\"feedthrough_damping\":{},\"modes\":[{}]}}",
                     json_literal(to_double(c.form.linear.static_stiffness)),
                     json_literal(to_double(c.form.linear.feedthrough_damping)), modes);
}

// Symbols and prefixes that a unit in a table's header may be made of, for the page's own reader.
std::string units_json() {
  std::string known, scales;
  for (const UnitSymbol& symbol : unit_symbols()) {
    const Dimension& d = symbol.unit.dimension;
    known += fmt::format("{}{}:[[{},{},{},{},{}],{},{},{},{}]", known.empty() ? "" : ",", json_literal(symbol.text),
                         d.kilogram, d.metre, d.second, d.ampere, d.radian, symbol.unit.power_of_ten,
                         symbol.unit.power_of_sixty, symbol.unit.power_of_degree, symbol.takes_prefix);
  }
  for (const UnitPrefix& prefix : unit_prefixes())
    scales += fmt::format("{}[{},{}]", scales.empty() ? "" : ",", json_literal(prefix.text), prefix.power_of_ten);
  return fmt::format("{{\"symbols\":{{{}}},\"prefixes\":[{}],\"degree\":{}}}", known, scales,
                     json_literal(round_decimal("1", Unit{dimensions::angle, 0, 0, 1}).value));
}

// The columns of a motion as the page's reader looks for them: names that each may have, letters and digits only.
std::string columns_json() {
  std::string json;
  for (const fitting::Role role : {fitting::Role::time, fitting::Role::position, fitting::Role::velocity}) {
    std::string names;
    for (const std::string& name : fitting::names_of(role)) names += (names.empty() ? "" : ",") + json_literal(name);
    json += fmt::format("{}\"{}\":[{}]", json.empty() ? "" : ",", fitting::name_of(role), names);
  }
  return "{" + json + "}";
}

// In samples, what the device has before a motion begins.
std::string device_json(const Compilation& c) {
  if (!c.device) return "null";
  return fmt::format("{{\"name\":{},\"lead_in\":{}}}", json_literal(c.device->name),
                     lead_in_samples(c.device->description));
}

std::string live_json(const Compilation& c, const std::string& module) {
  const PortUnits units = dotted_units(c.network.port_motion);
  return fmt::format(
      "{{\"period\":{},\"rate\":{},\"rates\":[{},{}],\"scalar\":\"{}\",\"surface\":{},\"position_unit\":{},"
      "\"force_unit\":{},\"tunables\":{},\"device\":{},\"form\":{},\"units\":{},\"columns\":{},\"module\":\"{}\"}}",
      c.law.sample_period, c.rate, lowest_rate, highest_rate, name_of(c.law.scalar),
      c.network.contact ? fmt::format("{}", c.network.contact->at) : "null", json_literal(units.position),
      json_literal(units.force), tunables_json(c.law), device_json(c), form_json(c), units_json(), columns_json(),
      base64(module));
}

std::string data_json(const Compilation& c, const std::optional<std::string>& module) {
  std::string json = "{\"name\":" + json_literal(c.network.name);
  if (has_candidates(c)) json += ",\"pareto\":" + candidates_json(c);
  if (const std::string errors = has_candidates(c) ? felt_error_json(c) : ""; !errors.empty())
    json += ",\"felt_error\":" + errors;
  if (module) json += ",\"live\":" + live_json(c, *module);
  return json + "}";
}

// Text of a file that was built in; it must be there.
void add_page(CodeModel& model, Diagnostics& diagnostics) {
  Fields& fields = model.fields;
  fields["style"] = built_in("report.css", diagnostics);
  fields["uplot_style"] = built_in("uPlot.min.css", diagnostics);
  fields["uplot"] = built_in("uPlot.iife.min.js", diagnostics);
  fields["uplot_licence"] = escaped_lines(built_in("uPlot-LICENSE", diagnostics));
  for (const char* part : {"page.js", "pareto.js", "felt_error.js", "units.js", "table.js", "period.js", "motion.js",
                           "pad.js", "forces.js", "tunables.js", "felt.js", "live.js", "start.js"})
    fields["script"] += built_in(part, diagnostics);
}

std::string drawing(const Network& network) {
  if (!network.ports.empty()) {
    std::string drawings;
    for (const Network& port : network.ports)
      drawings += "<h3>" + escaped("Port " + port.name) + "</h3>\n" + drawing(port);
    return drawings;
  }
  const auto has_effect = [](const Element& e) { return e.has_effect; };
  const auto drawn = std::count_if(network.elements.begin(), network.elements.end(), has_effect);
  if (static_cast<std::size_t>(drawn) <= most_drawn_elements) return schematic(network);
  return fmt::format("<p class=\"note\">{} elements are too many to draw.</p>", drawn);
}

}  // namespace

std::optional<std::string> report(const Compilation& c, const std::optional<std::string>& module,
                                  Diagnostics& diagnostics) {
  CodeModel model;
  Fields& fields = model.fields;
  fields["title"] = escaped(c.network.title.empty() ? c.network.name : c.network.title);
  fields["name"] = escaped(c.network.name);
  fields["choices"] = escaped(fmt::format("{} at {} Hz, {}, for {}", name_of(c.law.scheme), number_text(c.rate, 6),
                                          name_of(c.law.scalar), c.device ? c.device->name : "an ideal device"));
  fields["source"] = escaped(c.network.source);
  fields["version"] = DASHPOT_VERSION;
  fields["digest"] = c.network.digest;
  model.lists["facts"] = facts(c);
  fields["schematic"] = drawing(c.network);
  fields["law"] = update_law_html(c);
  const double amplitude = telling_amplitude(c);
  std::string curves = static_curve_html(c);
  for (const Compilation& port : c.ports) curves += static_curve_html(port, ", port " + escaped(port.network.name));
  const bool has_linear_responses = c.ports.empty() && is_linear(c);
  fields["responses"] = curves + (has_linear_responses ? linear_responses_html(c) : "") + hysteresis_html(c, amplitude);
  add_comments(c.network.comments, model);
  add_linear_parts(c, model);
  add_passivity(c, model);
  add_live_part(c, module.has_value(), amplitude, model);
  fields["data"] = data_json(c, module);
  add_page(model, diagnostics);
  return filled("report.html.in", model, std::nullopt, diagnostics);
}

}  // namespace dashpot::compiler
