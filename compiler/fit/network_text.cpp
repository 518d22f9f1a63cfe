#include "fit/network_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "network/port_units.hpp"
#include "source/counted.hpp"
#include "syntax/json.hpp"

namespace dashpot::compiler::fitting {
namespace {

using std::numbers::pi;

std::string range_text(double low, double high, const std::string& unit) {
  return fmt::format("[{}, {}]", json_string(quantity_text(low, unit, 4)), json_string(quantity_text(high, unit, 4)));
}

// As the file writes numbers: a power bare, all else with its unit.
std::string range_text(const Interval& interval, const std::string& unit) {
  const auto [low, high] = interval_ends(interval, unit);
  return unit.empty() ? fmt::format("[{}, {}]", low, high)
                      : fmt::format("[{}, {}]", json_string(low), json_string(high));
}

// A bound of three digits, rounded outwards so that it includes what was measured.
double bound(double value, double direction) { return outwards(value, direction, 3); }

struct Covered {
  double fastest = 0, low = 0, high = 0;
};

// Displacements count as for readers of the file: from the tool's zero, wherever the surface lies.
Covered covered_by(const std::vector<Recording>& recordings, double surface) {
  Covered covered;
  for (const Recording& recording : recordings) {
    const std::vector<double> steps = steps_of(recording.time);
    covered.low = std::min(covered.low, surface - recording.in_front);
    for (std::size_t i = 0; i < recording.position.size(); ++i) {
      covered.low = std::min(covered.low, surface + recording.position[i]);
      covered.high = std::max(covered.high, surface + recording.position[i]);
      if (i > recording.assumed_rows)
        covered.fastest =
            std::max(covered.fastest, std::abs(recording.position[i] - recording.position[i - 1]) / steps[i]);
    }
  }
  return covered;
}

std::string valid_text(const Fit& fit, const Problem& problem) {
  const PortUnits units = port_units(fit.choices.port_motion);
  const double low = 1 / (2 * pi * problem.duration()), high = 1 / (2 * pi * problem.shortest_step());
  const std::string frequency = "\"frequency\": " + range_text(bound(low, -1), bound(high, 1), "Hz");
  if (problem.recordings().front().kind != RecordingKind::motion) return "{ " + frequency + " }";
  const Covered covered = covered_by(problem.recordings(), fit.choices.contact.value_or(0));
  return fmt::format("{{ \"rate\": {}, \"displacement\": {},\n             {} }}",
                     json_string(quantity_text(bound(covered.fastest, 1), units.velocity, 4)),
                     range_text(bound(covered.low, -1), bound(covered.high, 1), units.position), frequency);
}

std::string recordings_text(const Fit& fit, const Problem& problem) {
  std::string text;
  for (const FileScore& file : fit.files) {
    text +=
        fmt::format("      {{ \"file\": {}, \"digest\": \"{}\", \"rows\": {}, \"rms\": \"{}\", \"r_squared\": {:.6g}",
                    json_string(std::filesystem::path(file.name).filename().string()), file.digest, file.rows,
                    error_text(file.rms, fit, problem), file.r_squared);
    if (file.free_rows > 0) text += fmt::format(", \"free_rows\": {}", file.free_rows);
    if (file.gain != 1) text += fmt::format(", \"gain\": {:.5g}", file.gain);
    if (file.offset != 0)
      text += fmt::format(", \"offset\": \"{}\"", quantity_text(file.offset, measured_unit(fit, problem), 4));
    text += &file == &fit.files.back() ? " } ]" : " },\n";
  }
  return text;
}

// `which` of the elements that have it.
std::string intervals_text(const Fit& fit, const char* key, std::optional<Interval> FittedElement::*which,
                           std::optional<Interval> FittedCurveValue::*of_curve) {
  const PortUnits units = port_units(fit.choices.port_motion);
  std::string text;
  for (const FittedCurveValue& value : fit.curve_values)
    if (const std::optional<Interval>& interval = value.*of_curve)
      text += fmt::format("{}\"{}\": {}", text.empty() ? "" : ",\n      ", value.name,
                          range_text(*interval, unit_of(value.quantity, units)));
  for (const FittedElement& element : fit.elements)
    if (const std::optional<Interval>& interval = element.*which)
      text += fmt::format("{}\"{}\": {}", text.empty() ? "" : ",\n      ", element.name,
                          range_text(*interval, unit_of(element.kind, units)));
  return text.empty() ? "" : fmt::format(",\n    \"{}\": {{\n      {} }}", key, text);
}

std::string static_line(const Fit& fit) {
  if (fit.curve_values.empty() || fit.curve_values.front().text.empty()) return "";
  return fmt::format("  \"static\": {},\n", static_text(fit.curve_values, fit.model, fit.choices.port_motion));
}

}  // namespace

std::string place_text(double place, motion port_motion) {
  return quantity_text(place, port_units(port_motion).position, std::numeric_limits<double>::digits10);
}

std::string measured_unit(const Fit& fit, const Problem& problem) {
  const PortUnits units = port_units(fit.choices.port_motion);
  switch (problem.recordings().front().kind) {
    case RecordingKind::motion: return fit.choices.form == Form::compliance ? units.position : units.force;
    case RecordingKind::relaxation:
    case RecordingKind::frequency: return units.stiffness;
    case RecordingKind::creep: return units.compliance;
  }
  return "";
}

std::string error_unit(const Fit& fit, const Problem& problem) {
  switch (fit.choices.weighting) {
    case Weighting::uniform: return measured_unit(fit, problem);
    case Weighting::relative: return "%";
    case Weighting::deviation: return "deviations";
  }
  return "";
}

std::string error_text(double rms, const Fit& fit, const Problem& problem, int digits) {
  const std::string unit = error_unit(fit, problem);
  if (unit == "%") return fmt::format("{:.{}g} %", 100 * rms, digits);
  if (unit == "deviations") return fmt::format("{:.{}g}", rms, digits);
  return quantity_text(rms, unit, digits);
}

std::string bare_network_text(const Fit& fit) {
  return fmt::format("{{\n  \"dashpot\": 1,\n  \"name\": \"{}\",\n  \"motion\": \"{}\",\n{}  \"network\": {}\n}}\n",
                     fit.network_name, name_of(fit.choices.port_motion), static_line(fit),
                     tree_text(fit.elements, fit.choices.form));
}

std::string network_text(const Fit& fit, const Problem& problem) {
  const std::size_t count = fit.files.size();
  std::string text = fmt::format("{{\n  \"dashpot\": 1,\n  \"name\": \"{}\",\n", fit.network_name);
  text += fmt::format(
      "  \"title\": {},\n",
      json_string(fit.choices.title.empty() ? "Fitted to " + counted(count, "recording") : fit.choices.title));
  text += fmt::format("  \"source\": {},\n", json_string(fit.choices.source));
  text += fmt::format("  \"motion\": \"{}\",\n", name_of(fit.choices.port_motion));
  text += static_line(fit);
  text += fmt::format("  \"network\": {},\n", tree_text(fit.elements, fit.choices.form));
  if (fit.choices.contact)
    text += fmt::format("  \"contact\": {{ \"at\": \"{}\" }},\n",
                        place_text(*fit.choices.contact, fit.choices.port_motion));
  text += fmt::format("  \"valid\": {},\n", valid_text(fit, problem));
  text += fmt::format("  \"fit\": {{\n    \"command\": {},\n", json_string(fit.choices.command));
  text += fmt::format("    \"recordings\": [\n{},\n", recordings_text(fit, problem));
  text += fmt::format("    \"rms\": \"{}\", \"r_squared\": {:.6g}, \"linear_floor\": \"{}\",\n",
                      error_text(fit.rms, fit, problem), fit.r_squared, error_text(fit.floor_rms, fit, problem));
  text += fmt::format("    \"parameters\": {}, \"effective_samples\": {:.4g}", fit.parameters, fit.effective_samples);
  text += intervals_text(fit, "intervals", &FittedElement::interval, &FittedCurveValue::interval);
  text += intervals_text(fit, "bootstrap", &FittedElement::spread, &FittedCurveValue::spread);
  text += intervals_text(fit, "leaving_a_file_out", &FittedElement::left_out, &FittedCurveValue::left_out);
  return text + " }\n}\n";
}

}  // namespace dashpot::compiler::fitting
