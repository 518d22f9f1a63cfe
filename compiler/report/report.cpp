#include "report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dashpot/led_device.hpp>

#include "emit/template_text.hpp"
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
#include "report/regime_table.hpp"
#include "report/sampled_margin.hpp"
#include "report/schematic.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t most_drawn_elements = 150;

// Behind a contact a linear network is one for as long as it is touched.
bool is_linear(const Compilation& c) { return c.form.components.empty(); }

Fields fact(const std::string& label, const std::string& value, const std::string& unit, const char* channel = "") {
  return {{"label", label}, {"value", value}, {"unit", unit}, {"channel", channel}};
}

// What a reader looks for first.
std::vector<Fields> facts(const Compilation& c) {
  const PortUnits units = page_units(c.network.port_motion);
  std::vector<Fields> list;
  list.push_back(fact("brake b", brake_text(c.law), units.damping, "brake"));
  if (is_linear(c)) {
    list.push_back(
        fact("motor, velocity gain", number_text(c.decomposition.choice().velocity_gain), units.damping, "motor"));
    list.push_back(fact("static stiffness", number_text(to_double(c.form.linear.static_stiffness)), units.stiffness));
    list.push_back(fact("modes", std::to_string(c.form.linear.modes.size()), ""));
    const double viscosity = to_double(zero_frequency_damping(c.form.linear));
    list.push_back(fact("viscosity at low frequency", number_text(viscosity), units.damping));
  }
  return list;
}

std::string in_words_html(const std::string& words) { return words.empty() ? "" : "<p>" + escaped(words) + ".</p>"; }

void add_linear_parts(const Compilation& c, CodeModel& model) {
  for (const char* list : {"canonical", "agreement", "candidates", "felt_error", "regimes"}) model.lists[list];
  if (!is_linear(c)) {
    model.lists["regimes"].push_back({{"regimes", regimes_html(c)}});
    return;
  }
  model.lists["canonical"].push_back({{"form", canonical_form_html(c)}});
  if (!c.network.contact) model.lists["agreement"].push_back({{"body", agreement_html(c)}});
  model.lists["candidates"].push_back({{"choice", escaped(c.decomposition.choice().name)},
                                       {"reason", escaped(c.decomposition.reason)},
                                       {"in_words", in_words_html(c.decomposition.in_words)},
                                       {"table", candidates_table_html(c)}});
  if (const std::string figure = felt_error_html(c); !figure.empty())
    model.lists["felt_error"].push_back({{"figure", figure}});
}

void add_passivity(const Compilation& c, CodeModel& model) {
  model.fields["passivity"] = certificate_html(c);
  model.fields["margin"] = sampled_margin_html(c) + (is_linear(c) ? delay_margin_html(c) : "");
}

// Two digits of ten times the slowest relaxation, within what a reader waits for.
double live_duration(const Compilation& c) {
  const double slowest = c.form.linear.modes.empty() ? 0.2 : 1 / to_double(c.form.linear.modes.front().relaxation_rate);
  return std::clamp(std::strtod(fmt::format("{:.2g}", 4 * slowest).c_str(), nullptr), 0.5, 20.0);
}

void add_live_part(const Compilation& c, bool there, CodeModel& model) {
  const PortUnits units = page_units(c.network.port_motion);
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
  model.lists["live_controls"].push_back({{"depth", c.network.port_motion == motion::rotation ? "0.1" : "0.001"},
                                          {"duration", fmt::format("{:g}", live_duration(c))},
                                          {"position_unit", units.position}});
  model.lists["live_end"].push_back({});
  if (c.law.tunable) model.lists["sliders"].push_back({{"middle", fmt::format("{:g}", live_duration(c) / 2)}});
}

std::string tunables_json(const UpdateLaw& law) {
  std::string json;
  for (const Tunable& t : law.tunable ? law.tunable->tunables : std::vector<Tunable>())
    json += fmt::format("{}{{\"name\":{},\"unit\":{},\"value\":{},\"min\":{},\"max\":{}}}", json.empty() ? "" : ",",
                        json_literal(t.name), json_literal(t.unit), json_literal(t.range.value),
                        json_literal(t.range.min), json_literal(t.range.max));
  return "[" + json + "]";
}

// What a linear network opposes to a motion, as a page needs it; nothing for another.
std::string form_json(const Compilation& c) {
  if (c.form.has_slips() || c.network.contact || c.law.tunable) return "null";
  std::string modes;
  for (const Mode& mode : c.form.linear.modes)
    modes += fmt::format("{}[{},{}]", modes.empty() ? "" : ",", json_literal(to_double(mode.relaxation_rate)),
                         json_literal(to_double(mode.damping())));
  return fmt::format("{{\"static_stiffness\":{},\"feedthrough_damping\":{},\"modes\":[{}]}}",
                     json_literal(to_double(c.form.linear.static_stiffness)),
                     json_literal(to_double(c.form.linear.feedthrough_damping)), modes);
}

// In samples, what the device has before a motion begins.
std::string device_json(const Compilation& c) {
  if (!c.device) return "null";
  return fmt::format("{{\"name\":{},\"lead_in\":{}}}", json_literal(c.device->name),
                     lead_in_samples(c.device->description));
}

std::string live_json(const Compilation& c, const std::string& module) {
  const PortUnits units = page_units(c.network.port_motion);
  return fmt::format(
      "{{\"period\":{},\"rate\":{},\"scalar\":\"{}\",\"position_unit\":{},\"force_unit\":{},\"tunables\":{},"
      "\"device\":{},\"form\":{},\"module\":\"{}\"}}",
      c.law.sample_period, c.rate, name_of(c.law.scalar), json_literal(units.position), json_literal(units.force),
      tunables_json(c.law), device_json(c), form_json(c), base64(module));
}

std::string data_json(const Compilation& c, const std::optional<std::string>& module) {
  std::string json = "{\"name\":" + json_literal(c.network.name);
  if (is_linear(c)) json += ",\"pareto\":" + candidates_json(c);
  if (const std::string errors = is_linear(c) ? felt_error_json(c) : ""; !errors.empty())
    json += ",\"felt_error\":" + errors;
  if (module) json += ",\"live\":" + live_json(c, *module);
  return json + "}";
}

// Text of a file that was built in; it must be there.
std::string built_in(const char* name, Diagnostics& diagnostics) {
  const SourceFile* file = find_template(name, std::nullopt, diagnostics);
  return file ? std::string(file->text()) : "";
}

void add_page(CodeModel& model, Diagnostics& diagnostics) {
  Fields& fields = model.fields;
  fields["style"] = built_in("report.css", diagnostics);
  fields["uplot_style"] = built_in("uPlot.min.css", diagnostics);
  fields["uplot"] = built_in("uPlot.iife.min.js", diagnostics);
  fields["uplot_licence"] = escaped_lines(built_in("uPlot-LICENSE", diagnostics));
  for (const char* part : {"page.js", "pareto.js", "felt_error.js", "motion.js", "pad.js", "forces.js", "tunables.js",
                           "felt.js", "live.js", "start.js"})
    fields["script"] += built_in(part, diagnostics);
}

std::string drawing(const Network& network) {
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
  fields["responses"] = (is_linear(c) ? linear_responses_html(c) : "") + hysteresis_html(c);
  add_linear_parts(c, model);
  add_passivity(c, model);
  add_live_part(c, module.has_value(), model);
  fields["data"] = data_json(c, module);
  add_page(model, diagnostics);
  const SourceFile* shape = find_template("report.html.in", std::nullopt, diagnostics);
  return shape ? fill(*shape, model, diagnostics) : std::nullopt;
}

}  // namespace dashpot::compiler
