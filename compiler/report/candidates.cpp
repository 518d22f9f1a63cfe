#include "report/candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <vector>

#include "report/markup.hpp"
#include "report/number_text.hpp"
#include "report/plot.hpp"

namespace dashpot::compiler {
namespace {

constexpr double not_computed = std::numeric_limits<double>::quiet_NaN();

struct FigureOfMerit {
  std::string label;
  std::string unit;
  std::function<double(const Candidate&)> value;  // not_computed where it is not there
};

// In the order of the table: the error comes first, so that it is there on a narrow screen too.
std::vector<FigureOfMerit> figures_of_merit(const Compilation& c) {
  const PortUnits units = dotted_units(c.network.port_motion);
  const auto known = [](const std::optional<double>& figure) { return figure.value_or(not_computed); };
  std::vector<FigureOfMerit> all = {
      {"largest felt error", "%", [](const Candidate& k) { return 100 * k.largest_error; }},
      {"motor noise", units.force, [=](const Candidate& k) { return known(k.motor_noise); }},
      {"velocity gain of the motor", units.damping, [](const Candidate& k) { return k.velocity_gain; }},
      {"minimum damping", units.damping, [=](const Candidate& k) { return known(k.minimum_damping); }},
      {"damping needed for any delay", units.damping,
       [=](const Candidate& k) { return known(k.extra_damping_any_delay); }},
      {"damping asked of the brake", units.damping, [](const Candidate& k) { return k.damping; }}};
  const auto is_known = [&](const FigureOfMerit& figure) {
    return std::any_of(c.decomposition.candidates.begin(), c.decomposition.candidates.end(),
                       [&](const Candidate& k) { return figure.value(k) == figure.value(k); });
  };
  std::erase_if(all, [&](const FigureOfMerit& figure) { return !is_known(figure); });
  if (c.device) return all;
  // The ideal one has neither noise nor error.
  std::erase_if(all, [](const FigureOfMerit& figure) { return figure.unit == "%" || figure.label == "motor noise"; });
  return all;
}

std::string cell(double value) { return "<td>" + (value == value ? number_text(value) : std::string("–")) + "</td>"; }

std::string reason(const Candidate& candidate) {
  if (!candidate.capped()) return candidate.why();
  return fmt::format("{} (lowered from {} to what the brake can give beside the damping that must be added)",
                     candidate.why(), number_text(candidate.wanted_damping));
}

// The figures, and under them why this damping. `mark` follows the name.
std::string rows(const Candidate& candidate, bool chosen, const char* mark, const std::vector<FigureOfMerit>& figures) {
  std::string html =
      fmt::format("<tbody{}>\n<tr><th scope=\"row\">{}{}</th><td class=\"word\">{}</td>",
                  chosen ? " class=\"chosen\"" : "", escaped(candidate.name), mark, name_of(candidate.state_input));
  for (const FigureOfMerit& figure : figures) html += cell(figure.value(candidate));
  return html + fmt::format("</tr>\n<tr class=\"why\"><td colspan=\"{}\"><span>{}</span></td></tr>\n</tbody>\n",
                            figures.size() + 2, escaped(in_four_digits(reason(candidate))));
}

}  // namespace

std::string candidates_table_html(const Compilation& c) {
  const std::vector<FigureOfMerit> figures = figures_of_merit(c);
  std::string html =
      "<div class=\"wide\"><table class=\"candidates\"><thead><tr><th>candidate</th><th class=\"word\">states driven "
      "by</th>";
  for (const FigureOfMerit& figure : figures) html += fmt::format("<th>{} [{}]</th>", figure.label, figure.unit);
  html += "</tr></thead>\n";
  // As `explain` has them.
  const bool has_marks = has_tunables(c.network) && c.decomposition.candidates.size() > 1;
  for (const Candidate& candidate : c.decomposition.candidates) {
    const bool is_chosen = &candidate == &c.decomposition.choice();
    html += rows(candidate, is_chosen, has_marks && !is_chosen ? "*" : "", figures);
  }
  html += "</table></div>\n";
  if (has_marks) html += fmt::format("<p class=\"note\">rows with * {}</p>\n", meaning_of_marks());
  return html;
}

std::string candidates_json(const Compilation& c) {
  const std::vector<FigureOfMerit> figures = figures_of_merit(c);
  std::string labels, candidates;
  for (const FigureOfMerit& figure : figures)
    labels += fmt::format("{}{{\"label\":{},\"unit\":{}}}", labels.empty() ? "" : ",", json_literal(figure.label),
                          json_literal(figure.unit));
  for (const Candidate& candidate : c.decomposition.candidates) {
    std::string values;
    for (const FigureOfMerit& figure : figures)
      values += (values.empty() ? "" : ",") + json_literal(figure.value(candidate));
    candidates += fmt::format("{}{{\"name\":{},\"chosen\":{},\"values\":[{}]}}", candidates.empty() ? "" : ",",
                              json_literal(candidate.name), &candidate == &c.decomposition.choice(), values);
  }
  return "{\"figures\":[" + labels + "],\"candidates\":[" + candidates + "]}";
}

namespace {

// Candidates that err alike, to the digits that are shown.
struct ErrorCurve {
  std::vector<std::string> names;
  std::vector<double> errors;  // over Decomposition::error_frequencies [%]
  bool chosen = false;
};

bool is_the_same(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double shown = 1e-3;
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return std::abs(x - y) <= shown * std::max(std::abs(x), std::abs(y)); });
}

// The chosen one first.
std::vector<ErrorCurve> error_curves(const Compilation& c) {
  std::vector<ErrorCurve> curves;
  const auto add = [&](const Candidate& candidate) {
    std::vector<double> errors;
    for (const double error : candidate.error_over_band) errors.push_back(100 * error);
    const auto same = std::find_if(curves.begin(), curves.end(),
                                   [&](const ErrorCurve& curve) { return is_the_same(curve.errors, errors); });
    if (same != curves.end()) same->names.push_back(candidate.name);
    else curves.push_back({{candidate.name}, std::move(errors), curves.empty()});
  };
  add(c.decomposition.choice());
  for (const Candidate& candidate : c.decomposition.candidates)
    if (&candidate != &c.decomposition.choice()) add(candidate);
  return curves;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

std::string felt_error_html(const Compilation& c) {
  if (c.decomposition.error_frequencies.empty()) return "";
  Plot plot{"Felt error", {"frequency", "Hz"}, {"error", "%"}, AxisScale::logarithmic, AxisScale::logarithmic, {}};
  constexpr Channel channels[] = {Channel::brake, Channel::motor, Channel::closed_form};
  std::size_t next = 0;
  for (const ErrorCurve& curve : error_curves(c)) {
    const Channel channel = curve.chosen ? Channel::total : channels[next % std::size(channels)];
    const bool dashed = !curve.chosen && next++ >= std::size(channels);
    plot.curves.push_back({joined(curve.names), channel, c.decomposition.error_frequencies, curve.errors, dashed});
  }
  return plot_figure(plot);
}

std::string felt_error_json(const Compilation& c) {
  const auto list = [](const std::vector<double>& values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ",") + fmt::format("{:.4g}", value);
    return "[" + text + "]";
  };
  if (c.decomposition.error_frequencies.empty()) return "";
  std::string candidates;
  for (const ErrorCurve& curve : error_curves(c))
    candidates += fmt::format("{}{{\"name\":{},\"chosen\":{},\"errors\":{}}}", candidates.empty() ? "" : ",",
                              json_literal(joined(curve.names)), curve.chosen, list(curve.errors));
  return "{\"frequencies\":" + list(c.decomposition.error_frequencies) + ",\"candidates\":[" + candidates + "]}";
}

}  // namespace dashpot::compiler
