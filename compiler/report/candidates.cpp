#include "report/candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
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

// In the order of the plot's menus.
std::vector<FigureOfMerit> figures_of_merit(const Compilation& c) {
  const PortUnits units = page_units(c.network.port_motion);
  const auto known = [](const std::optional<double>& figure) { return figure.value_or(not_computed); };
  std::vector<FigureOfMerit> all = {
      {"motor noise", units.force, [=](const Candidate& k) { return known(k.motor_noise); }},
      {"velocity gain of the motor", units.damping, [](const Candidate& k) { return k.velocity_gain; }},
      {"minimum damping", units.damping, [=](const Candidate& k) { return known(k.minimum_damping); }},
      {"extra damping under any delay", units.damping,
       [=](const Candidate& k) { return known(k.extra_damping_any_delay); }},
      {"largest error of what is felt", "%", [](const Candidate& k) { return 100 * k.largest_error; }},
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
  if (!candidate.capped()) return candidate.reason;
  return fmt::format("{} (capped from {} at what the brake can give)", candidate.reason,
                     number_text(candidate.wanted_damping));
}

// The figures, and under them why this damping.
std::string rows(const Candidate& candidate, bool chosen, const std::vector<FigureOfMerit>& figures) {
  std::string html =
      fmt::format("<tbody{}>\n<tr><th scope=\"row\">{}</th><td class=\"word\">{}</td>",
                  chosen ? " class=\"chosen\"" : "", escaped(candidate.name), name_of(candidate.state_input));
  for (const FigureOfMerit& figure : figures) html += cell(figure.value(candidate));
  return html + fmt::format("</tr>\n<tr class=\"why\"><td colspan=\"{}\">{}</td></tr>\n</tbody>\n", figures.size() + 2,
                            escaped(reason(candidate)));
}

}  // namespace

std::string candidates_table_html(const Compilation& c) {
  const std::vector<FigureOfMerit> figures = figures_of_merit(c);
  std::string html =
      "<div class=\"wide\"><table class=\"candidates\"><thead><tr><th>candidate</th><th class=\"word\">states driven "
      "by</th>";
  for (const FigureOfMerit& figure : figures) html += fmt::format("<th>{} [{}]</th>", figure.label, figure.unit);
  html += "</tr></thead>\n";
  for (const Candidate& candidate : c.decomposition.candidates)
    html += rows(candidate, &candidate == &c.decomposition.choice(), figures);
  return html + "</table></div>\n";
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

std::string felt_error_html(const Compilation& c) {
  const Candidate& choice = c.decomposition.choice();
  if (c.decomposition.error_frequencies.empty()) return "";
  Plot plot{"Error of what is felt", {"frequency", "Hz"},    {"error", "%"},
            AxisScale::logarithmic,  AxisScale::logarithmic, {}};
  const auto add = [&](const Candidate& candidate, const std::string& name, Channel channel, bool dashed) {
    Curve curve{name, channel, c.decomposition.error_frequencies, {}, dashed};
    for (const double error : candidate.error_over_band) curve.y.push_back(100 * error);
    plot.curves.push_back(std::move(curve));
  };
  add(choice, choice.name, Channel::total, false);
  for (const Candidate& candidate : c.decomposition.candidates)
    if (&candidate != &choice && (candidate.name == "paper" || candidate.name == "virtual"))
      add(candidate, candidate.name, candidate.name == "paper" ? Channel::brake : Channel::motor, true);
  plot.note = "Hold, estimator, delay, amplifier lag, brake tolerance and added damping included.";
  return plot_figure(plot);
}

std::string felt_error_json(const Compilation& c) {
  const auto list = [](const std::vector<double>& values, double factor) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ",") + fmt::format("{:.4g}", factor * value);
    return "[" + text + "]";
  };
  if (c.decomposition.error_frequencies.empty()) return "";
  std::string candidates;
  for (const Candidate& candidate : c.decomposition.candidates)
    candidates += fmt::format("{}{{\"name\":{},\"chosen\":{},\"errors\":{}}}", candidates.empty() ? "" : ",",
                              json_literal(candidate.name), &candidate == &c.decomposition.choice(),
                              list(candidate.error_over_band, 100));
  return "{\"frequencies\":" + list(c.decomposition.error_frequencies, 1) + ",\"candidates\":[" + candidates + "]}";
}

}  // namespace dashpot::compiler
