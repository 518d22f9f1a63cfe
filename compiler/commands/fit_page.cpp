#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "commands/fit_output.hpp"
#include "emit/template_text.hpp"
#include "fit/network_text.hpp"
#include "network/port_units.hpp"
#include "report/markup.hpp"
#include "report/number_text.hpp"
#include "report/plot.hpp"
#include "source/counted.hpp"

namespace dashpot::compiler {
namespace {

using namespace fitting;

// Of a path: figures are narrow, and folders belong to the command.
std::string file_name(const FileScore& score) { return std::filesystem::path(score.name).filename().string(); }

constexpr std::size_t most_points = 1500;  // of a curve: a page stays small, whatever the recording

// No script runs on this page: a shade lies at each edge, and one of paper, which scrolls with the table, over it at
// the table's ends.
constexpr const char* scroll_cues =
    "\n.wide { background: linear-gradient(to right, var(--paper) 50%, transparent) 0 0 / 2.6rem 100% no-repeat "
    "local,\n"
    "  linear-gradient(to left, var(--paper) 50%, transparent) 100% 0 / 2.6rem 100% no-repeat local,\n"
    "  linear-gradient(to right, var(--rule), transparent) 0 0 / 1rem 100% no-repeat scroll,\n"
    "  linear-gradient(to left, var(--rule), transparent) 100% 0 / 1rem 100% no-repeat scroll; }\n"
    ".wide td { white-space: nowrap; }\n";

struct Points {
  std::vector<double> x, y;
};

// Every so manieth point, the last included.
Points thinned(const std::vector<double>& x, const std::vector<double>& y) {
  Points points;
  const std::size_t stride = std::max<std::size_t>(1, x.size() / most_points);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (i % stride == 0 || i + 1 == x.size()) points.x.push_back(x[i]), points.y.push_back(y[i]);
  return points;
}

Curve curve(const std::string& name, Channel channel, const std::vector<double>& x, const std::vector<double>& y,
            bool dots) {
  Points points = thinned(x, y);
  return {name, channel, std::move(points.x), std::move(points.y), false, dots};
}

class FitPage {
 public:
  FitPage(const Fit& fit, const std::vector<Recording>& recordings, const std::vector<Recording>& held_out)
      : fit_(fit),
        recordings_(recordings),
        held_out_(held_out),
        problem_(recordings, fit.choices.form, fit.choices.weighting, 2),
        units_(port_units(fit.choices.port_motion)) {}

  std::string body() const {
    std::string text = "<header>\n<p class=\"kind\">dashpot fit · " + escaped(fit_.network_name) + "</p>\n<h1>" +
                       escaped(title()) + "</h1>\n<p class=\"source\">" + escaped(fit_.choices.source) + "</p>\n" +
                       facts() + "</header>\n<main>\n";
    text += section("Data and model", data_figures(recordings_, fit_.files));
    text += section("What is left", left_figures());
    text += section("Elements", elements_table() + "<div class=\"figures\">\n" + plot_figure(spectrum()) + "</div>\n");
    text +=
        section("How many elements", "<div class=\"figures\">\n" + plot_figure(sizes()) + "</div>\n" + sizes_table());
    if (!held_out_.empty()) text += section("Held out", data_figures(held_out_, fit_.held_out));
    text += section("What the recordings cannot tell", findings());
    return text + "</main>\n";
  }

 private:
  static std::string section(const std::string& title, const std::string& body) {
    return "<section>\n<h2>" + title + "</h2>\n" + body + "</section>\n";
  }

  std::string title() const {
    if (!fit_.choices.title.empty()) return fit_.choices.title;
    return "Fitted to " + counted(fit_.files.size(), "recording");
  }

  std::string error(double rms) const { return error_text(rms, fit_, problem_); }

  std::string surface_fact() const {
    if (!fit_.choices.contact) return "";
    return fact(fit_.choices.contact_is_found ? "surface, found" : "surface, given",
                place_text(*fit_.choices.contact, fit_.choices.port_motion));
  }

  static std::string fact(const std::string& label, const std::string& value) {
    return "<div><dt>" + label + "</dt><dd>" + escaped(value) + "</dd></div>\n";
  }

  std::string facts() const {
    return "<dl class=\"facts-strip\">\n" + fact("rms", error(fit_.rms)) +
           fact("R²", fmt::format("{:.5f}", fit_.r_squared)) +
           fact("least of any linear network", error(fit_.floor_rms)) +
           fact("parameters", std::to_string(fit_.parameters)) +
           fact("effective samples", fmt::format("{:.4g}", fit_.effective_samples)) + surface_fact() + "</dl>\n";
  }

  bool is_spectrum() const { return recordings_.front().kind == RecordingKind::frequency; }

  AxisTitle time_title() const {
    return is_spectrum() ? AxisTitle{"angular frequency", "rad/s"} : AxisTitle{"time", "s"};
  }
  AxisTitle answer_title() const {
    static constexpr const char* names[] = {"force", "stiffness", "compliance", "stiffness"};
    const bool follows = fit_.choices.form == Form::compliance && recordings_.front().kind == RecordingKind::motion;
    return {follows ? "position" : names[static_cast<int>(recordings_.front().kind)], measured_unit(fit_, problem_)};
  }

  std::vector<double> measured(const Recording& recording) const {
    const bool follows = fit_.choices.form == Form::compliance && recording.kind == RecordingKind::motion;
    return follows ? recording.position : recording.force;
  }

  Plot data_plot(const Recording& recording, const FileScore& score) const {
    const std::size_t rows = recording.time.size();
    const std::vector<double> answer(score.answer.begin(), score.answer.begin() + static_cast<std::ptrdiff_t>(rows));
    const bool is_wide = recording.kind != RecordingKind::motion;
    Plot plot{file_name(score),
              time_title(),
              answer_title(),
              is_wide ? AxisScale::logarithmic : AxisScale::linear,
              is_spectrum() ? AxisScale::logarithmic : AxisScale::linear,
              {}};
    plot.curves.push_back(
        curve(is_spectrum() ? "storage" : "measured", Channel::motor, recording.time, measured(recording), true));
    plot.curves.push_back(curve("written network", Channel::total, recording.time, answer, false));
    if (is_spectrum()) {
      const std::vector<double> loss(score.answer.begin() + static_cast<std::ptrdiff_t>(rows), score.answer.end());
      plot.curves.push_back(curve("loss", Channel::brake, recording.time, recording.loss, true));
      plot.curves.push_back(curve("", Channel::total, recording.time, loss, false));
    }
    plot.note = fmt::format("rms {}, R² {:.5f}", error(score.rms), score.r_squared);
    if (score.free_rows > 0)
      *plot.note +=
          fmt::format("; {} of {} rows left out, where the tool has left the tissue", score.free_rows, score.rows);
    if (score.left_out_rms)
      *plot.note += fmt::format("; rms {} by a network fitted to the other files", error(*score.left_out_rms));
    return plot;
  }

  std::string data_figures(const std::vector<Recording>& recordings, const std::vector<FileScore>& scores) const {
    std::string text = "<div class=\"figures\">\n";
    for (std::size_t i = 0; i < recordings.size(); ++i) text += plot_figure(data_plot(recordings[i], scores[i]));
    return text + "</div>\n";
  }

  std::vector<double> left_of(const Recording& recording, const FileScore& score) const {
    std::vector<double> left = measured(recording);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= score.answer[i];
    for (std::size_t i = 0; i < recording.assumed_rows; ++i) left[i] = 0;
    return left;
  }

  // Of rows that were fitted, or of those that were left out.
  static Points rows_of(const FileScore& score, const std::vector<double>& x, const std::vector<double>& left,
                        bool are_free) {
    Points points;
    for (std::size_t row = 0; row < x.size(); ++row)
      if (score.is_free[row] == are_free) points.x.push_back(x[row]), points.y.push_back(left[row]);
    return points;
  }

  static void add_left(Plot& plot, const FileScore& score, Channel channel, const std::vector<double>& x,
                       const std::vector<double>& left) {
    const Points fitted = rows_of(score, x, left, false), free = rows_of(score, x, left, true);
    plot.curves.push_back(curve(file_name(score), channel, fitted.x, fitted.y, true));
    if (free.x.empty()) return;
    const bool is_named = std::any_of(plot.curves.begin(), plot.curves.end(),
                                      [](const Curve& one) { return one.channel == Channel::left_out; });
    plot.curves.push_back(curve(is_named ? "" : "left out", Channel::left_out, free.x, free.y, true));
  }

  std::string left_figures() const {
    Plot over_time{"Measured less written network, over time",
                   time_title(),
                   answer_title(),
                   recordings_.front().kind == RecordingKind::motion ? AxisScale::linear : AxisScale::logarithmic,
                   AxisScale::linear,
                   {},
                   true};
    Plot over_position{"The same, over displacement",
                       {"displacement", units_.position},
                       answer_title(),
                       AxisScale::linear,
                       AxisScale::linear,
                       {},
                       true};
    static constexpr Channel channels[] = {Channel::motor, Channel::brake, Channel::closed_form, Channel::total};
    for (std::size_t i = 0; i < recordings_.size(); ++i) {
      const std::vector<double> left = left_of(recordings_[i], fit_.files[i]);
      add_left(over_time, fit_.files[i], channels[i % 4], recordings_[i].time, left);
      if (!recordings_[i].position.empty())
        add_left(over_position, fit_.files[i], channels[i % 4], recordings_[i].position, left);
    }
    return "<div class=\"figures\">\n" + plot_figure(over_time) + plot_figure(over_position) + "</div>\n";
  }

  // Stiffness over relaxation time: dots with their intervals; crosses where a file is left out.
  Plot spectrum() const {
    Plot plot{"Spectrum",
              {"relaxation time", "s"},
              {"stiffness", units_.stiffness},
              AxisScale::logarithmic,
              AxisScale::logarithmic,
              {}};
    Curve dots{has(&FittedElement::interval) ? "fitted, with 95 % interval"
               : has(&FittedElement::spread) ? "fitted, with bootstrap"
                                             : "fitted",
               Channel::total,
               {},
               {},
               false,
               true};
    std::vector<Curve> bars;
    Curve left_out{"a file left out", Channel::motor, {}, {}, false, true};
    for (const FittedElement& element : fit_.elements) {
      if (element.kind != ElementKind::spring) continue;
      const std::size_t term = element.quantity.term;
      if (fit_.model.terms[term].kind != TermKind::maxwell) continue;
      const double time = fit_.model.terms[term].time;
      dots.x.push_back(time), dots.y.push_back(value_of(fit_.model, element.quantity));
      const std::optional<fitting::Interval> known = element.interval ? element.interval : element.spread;
      if (known) bars.push_back({"", Channel::total, {time, time}, {known->low, known->high}});
      for (const Model& model : fit_.left_out)
        left_out.x.push_back(model.terms[term].time), left_out.y.push_back(value_of(model, element.quantity));
    }
    plot.curves = std::move(bars);
    if (!left_out.x.empty()) plot.curves.push_back(std::move(left_out));
    plot.curves.push_back(std::move(dots));
    return plot;
  }

  Plot sizes() const {
    const bool is_share = error_unit(fit_, problem_) == "%";
    Plot plot{"What is left, by the number of parameters",
              {"parameters", "1"},
              {"rms", is_share ? "%" : error_unit(fit_, problem_)},
              AxisScale::linear,
              AxisScale::logarithmic,
              {}};
    const double scale = is_share ? 100 : 1;
    Curve tried{"best of each size", Channel::total, {}, {}, false, true}, line{"", Channel::total, {}, {}};
    for (const PathEntry& entry : fit_.path)
      for (Curve* c : {&tried, &line})
        c->x.push_back(static_cast<double>(entry.parameters)), c->y.push_back(scale * entry.rms);
    const double least = static_cast<double>(fit_.path.back().parameters),
                 most = static_cast<double>(fit_.path.front().parameters);
    Curve floor{"no linear network does better",
                Channel::closed_form,
                {least, most},
                {scale * fit_.floor_rms, scale * fit_.floor_rms},
                true};
    Curve chosen{"chosen", Channel::motor, {static_cast<double>(fit_.parameters)}, {scale * fit_.rms}, false, true};
    plot.curves = {line, tried, floor, chosen};
    return plot;
  }

  std::string sizes_table() const {
    std::string text =
        "<p>Sizes that were tried, before elements that the data do without are left out.</p>\n<div "
        "class=\"wide\"><table><thead><tr><th>relaxations</th><th>slips</th><th>springpots</th><th>parameters</"
        "th><th>rms</th><th>BIC</th></tr></thead><tbody>\n";
    for (std::size_t i = 0; i < fit_.path.size(); ++i) {
      const PathEntry& entry = fit_.path[i];
      text += fmt::format("<tr><td>{}{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.2f}</td></tr>\n",
                          entry.model.count(TermKind::maxwell), i == fit_.chosen ? " (chosen)" : "",
                          entry.model.slip_count(), entry.model.count(TermKind::springpot), entry.parameters,
                          escaped(error(entry.rms)), entry.criterion);
    }
    return text + "</tbody></table></div>\n";
  }

  bool has(std::optional<fitting::Interval> FittedElement::*which) const {
    return std::any_of(fit_.elements.begin(), fit_.elements.end(),
                       [&](const FittedElement& element) { return (element.*which).has_value(); });
  }

  std::string cell(std::optional<fitting::Interval> FittedElement::*which, const FittedElement& element) const {
    if (!has(which)) return "";
    const std::optional<fitting::Interval>& interval = element.*which;
    if (!interval) return which == &FittedElement::interval ? "<td>not known</td>" : "<td></td>";
    return "<td>" + escaped(interval_text(*interval, unit_of(element.kind, units_))) + "</td>";
  }

  std::string elements_table() const {
    const auto head = [&](std::optional<fitting::Interval> FittedElement::*which, const char* title) {
      return has(which) ? fmt::format("<th>{}</th>", title) : std::string();
    };
    std::string text = curve_text() + "<div class=\"wide\"><table><thead><tr><th>element</th><th>value</th>" +
                       head(&FittedElement::interval, "95 %") + head(&FittedElement::spread, "bootstrap") +
                       head(&FittedElement::left_out, "leaving a file out") + "</tr></thead><tbody>\n";
    for (const FittedElement& element : fit_.elements)
      text += "<tr><th>" + element.name + "</th><td>" + escaped(element.text) + "</td>" +
              cell(&FittedElement::interval, element) + cell(&FittedElement::spread, element) +
              cell(&FittedElement::left_out, element) + "</tr>\n";
    return text + "</tbody></table></div>\n";
  }

  std::string curve_text() const {
    if (fit_.curve_values.empty()) return "";
    std::string text = fmt::format("<p>Behind a static curve, {}:", word_of(fit_.model.curve->kind()));
    for (const FittedCurveValue& value : fit_.curve_values) {
      text += (&value == &fit_.curve_values.front() ? " " : "; ") + escaped(value.name + " " + value.text);
      if (value.interval)
        text += escaped(fmt::format(" ({:.4g} … {:.4g}, 95 %)", value.interval->low, value.interval->high));
      else if (fit_.has_intervals) text += " (95 %: not known)";
    }
    return text + ".</p>\n";
  }

  std::string findings() const {
    Diagnostics said;
    report_findings(fit_, recordings_, said);
    std::string text;
    for (const Diagnostic& diagnostic : said.in_file_order()) {
      text += "<p>" + escaped(diagnostic.text) + ".";
      for (const Note& note : diagnostic.notes) text += " <span class=\"note\">" + escaped(note.text) + ".</span>";
      text += "</p>\n";
    }
    return text.empty() ? "<p>Nothing that this program knows how to ask.</p>\n" : text;
  }

  const Fit& fit_;
  const std::vector<Recording>& recordings_;
  const std::vector<Recording>& held_out_;
  Problem problem_;
  PortUnits units_;
};

}  // namespace

std::string fit_page(const Fit& fit, const std::vector<Recording>& recordings, const std::vector<Recording>& held_out,
                     Diagnostics& diagnostics) {
  const SourceFile* style = find_template("report.css", std::nullopt, diagnostics);
  return "<!doctype html>\n<html lang=\"en\" class=\"static\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" "
         "content=\"light dark\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
         "'unsafe-inline'\">\n"
         "<link rel=\"icon\" href=\"data:,\">\n<title>" +
         escaped(fit.network_name) + "</title>\n<style>\n" + (style ? std::string(style->text()) : "") + scroll_cues +
         "</style>\n</head>\n<body>\n" + FitPage(fit, recordings, held_out).body() +
         "<footer>\n<p>Written by dashpot " DASHPOT_VERSION ": <code>" + escaped(fit.choices.command) +
         "</code></p>\n</footer>\n</body>\n</html>\n";
}

}  // namespace dashpot::compiler
