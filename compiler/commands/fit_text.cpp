#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands/fit_output.hpp"
#include "fit/network_text.hpp"
#include "network/port_units.hpp"
#include "source/counted.hpp"

namespace dashpot::compiler {
namespace {

using namespace fitting;

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

class FitText {
 public:
  FitText(const Fit& fit, const std::vector<Recording>& recordings)
      : fit_(fit),
        problem_(recordings, fit.choices.form, fit.choices.weighting, 2),
        units_(port_units(fit.choices.port_motion)) {}

  std::string run() {
    std::string text = fmt::format("{}: {} from {} of {}\n", fit_.network_name, counted(fit_.parameters, "parameter"),
                                   rows(), counted(fit_.files.size(), "recording"));
    text += fmt::format("rms {}, R² {:.5f}; no linear network has an rms below {}", error(fit_.rms), fit_.r_squared,
                        error(fit_.floor_rms));
    if (fit_.noise && fit_.choices.weighting == Weighting::uniform)
      text += fmt::format("; the noise is about {}", error(*fit_.noise));
    text += fmt::format(
        "\n{:.4g} effective samples in all, by the error of the largest network that was tried, for intervals and BIC; "
        "condition {:.3g}\n",
        fit_.effective_samples, fit_.condition);
    if (fit_.choices.contact)
      text += fmt::format("surface {} at {}\n", fit_.choices.contact_is_found ? "found" : "given",
                          place_text(*fit_.choices.contact, fit_.choices.port_motion));
    text += "\nrecordings\n";
    for (const FileScore& file : fit_.files) text += file_text(file);
    if (!fit_.held_out.empty()) text += "\nheld out\n";
    for (const FileScore& file : fit_.held_out) text += file_text(file);
    return text + elements() + shapes() + path();
  }

 private:
  std::string rows() const {
    std::size_t count = 0;
    for (const FileScore& file : fit_.files) count += file.rows;
    return fmt::format("{} rows", count);
  }

  std::string error(double rms) const { return error_text(rms, fit_, problem_); }

  std::string file_text(const FileScore& file) const {
    const bool is_motion = problem_.recordings().front().kind == RecordingKind::motion;
    std::string text = fmt::format("  {}: {} rows, rms {}", file.name, file.rows, error(file.rms));
    if (fit_.choices.weighting == Weighting::uniform && file.range > 0)
      text += fmt::format(" ({} of its range)", percent(file.rms / file.range));
    text += fmt::format(", R² {:.5f}\n    largest error {}", file.r_squared, error(file.largest_error));
    const bool is_spectrum = problem_.recordings().front().kind == RecordingKind::frequency;
    text += fmt::format(" at {:.6g} {}", file.largest_time, is_spectrum ? "rad/s" : "s");
    if (is_motion) text += fmt::format(", {}", quantity_text(file.largest_position, units_.position, 4));
    text += fmt::format(
        "; errors of neighbouring rows correlate by {:.3f}, {:.4g} effective samples; scaled by {:.4f} the network "
        "would fit best",
        file.lag_one, file.effective_samples, file.best_gain);
    if (file.gain != 1) text += fmt::format("; gain {:.4f}", file.gain);
    if (file.offset != 0)
      text += fmt::format("; offset {}", quantity_text(file.offset, measured_unit(fit_, problem_), 4));
    if (file.left_out_rms)
      text += fmt::format("\n    rms {} when only the other files are fitted", error(*file.left_out_rms));
    if (file.free_rows > 0)
      text += fmt::format(
          "\n    {} of the rows are left out: there the tool moves back faster than the tissue recovers and has left "
          "it, so that the force, {} rms, carries no information on it",
          file.free_rows, quantity_text(file.free_rms, measured_unit(fit_, problem_), 4));
    return text + "\n";
  }

  std::string between(const Interval& interval, const FittedElement& element) const {
    return interval_text(interval, unit_of(element.kind, units_));
  }

  std::string known(const auto& told) const {
    if (told.interval) return ", 95 %: " + between(*told.interval, told);
    return fit_.has_intervals ? ", 95 %: not known, not to a factor of a million" : "";
  }

  std::string elements() const {
    std::string text;
    if (!fit_.curve_values.empty()) {
      text += fmt::format("\nstatic curve, {}, {}\n", word_of(fit_.model.curve->kind()),
                          curve_stiffness(fit_.model).is_instantaneous ? "at once" : "at rest");
      for (const FittedCurveValue& value : fit_.curve_values) {
        text += fmt::format("  {} {}", value.name, value.text);
        text += known(value);
        if (value.spread) text += ", bootstrap: " + between(*value.spread, value);
        if (value.left_out) text += ", leaving a file out: " + between(*value.left_out, value);
        text += "\n";
      }
    }
    text += "\nelements\n";
    for (const FittedElement& element : fit_.elements) {
      text += fmt::format("  {} {}", element.name, element.text);
      text += known(element);
      if (element.spread) text += ", bootstrap: " + between(*element.spread, element);
      if (element.left_out) text += ", leaving a file out: " + between(*element.left_out, element);
      text += "\n";
    }
    return text;
  }

  std::string between(const Interval& interval, const FittedCurveValue& value) const {
    return interval_text(interval, unit_of(value.quantity, units_));
  }

  std::string shapes() const {
    if (fit_.shapes.empty()) return "";
    std::string text =
        "\nshapes that were tried, each at its best size\n  shape        parameters         rms        BIC\n";
    for (const ShapeTried& one : fit_.shapes) {
      const bool is_chosen = one.kind == (fit_.model.curve ? std::optional(fit_.model.curve->kind()) : std::nullopt);
      text += fmt::format("{} {:<11}  {:>10}  {:>10}  {:>9.2f}\n", is_chosen ? "*" : " ",
                          one.kind ? word_of(*one.kind) : "straight", one.parameters, error(one.rms), one.criterion);
    }
    return text;
  }

  std::string how_a_size_is_taken() const {
    const char* const least = "the least BIC (Bayesian information criterion)";
    const bool is_missed = std::any_of(fit_.findings.begin(), fit_.findings.end(), [](const Finding& finding) {
      return finding.kind == Finding::Kind::size_not_met;
    });
    const ReductionChoices& asked = fit_.choices.reduction;
    if (asked.ask_for_a_size() && !is_missed)
      return fmt::format("Of what was asked for the size with {} is taken (*)",
                         asked.tolerance ? "the fewest elements" : least);
    const bool are_determined =
        std::all_of(fit_.path.begin(), fit_.path.end(), [](const PathEntry& entry) { return entry.is_determined; });
    return fmt::format("The size with {} is taken (*)", least) +
           (are_determined ? "" : ", but none whose parameters are too many for so few rows (-)");
  }

  std::string path() const {
    std::string text = "\nsizes that were tried; afterwards elements that the data do not need are dropped. " +
                       how_a_size_is_taken() +
                       "\n  relaxations  slips  springpots  parameters         rms        BIC\n";
    for (std::size_t i = 0; i < fit_.path.size(); ++i) {
      const PathEntry& entry = fit_.path[i];
      const std::size_t slips = entry.model.slip_count();
      const char* const mark = i == fit_.chosen ? "*" : entry.is_determined ? " " : "-";
      text += fmt::format("{} {:>11}  {:>5}  {:>10}  {:>10}  {:>10}  {:>9.2f}\n", mark,
                          entry.model.count(TermKind::maxwell), slips, entry.model.count(TermKind::springpot),
                          entry.parameters, error(entry.rms), entry.criterion);
    }
    return text;
  }

  const Fit& fit_;
  Problem problem_;
  PortUnits units_;
};

}  // namespace

std::string fit_text(const Fit& fit, const std::vector<Recording>& recordings) {
  return FitText(fit, recordings).run();
}

void report_findings(const Fit& fit, const std::vector<Recording>& recordings, Diagnostics& diagnostics) {
  using Kind = Finding::Kind;
  const Problem problem(recordings, fit.choices.form, fit.choices.weighting, 2);
  const PortUnits units = port_units(fit.choices.port_motion);
  const auto count = [](double number) { return static_cast<std::size_t>(std::lround(number)); };
  for (const Finding& found : fit.findings) {
    const auto& n = found.numbers;
    switch (found.kind) {
      case Kind::untouched:
        diagnostics.report<DiagnosticCode::fit_untouched>({}, found.name, quantity_text(n[0], units.position, 4),
                                                          quantity_text(n[1], units.position, 4),
                                                          quantity_text(n[2], units.force, 4));
        diagnostics.note<DiagnosticCode::fit_contact_remedy>({});
        break;
      case Kind::floor_above_noise:
        diagnostics.report<DiagnosticCode::fit_floor_above_noise>({}, error_text(n[0], fit, problem),
                                                                  error_text(n[1], fit, problem));
        // Its advice is about options; with a shape it would name one that was taken.
        if (recordings.front().kind != RecordingKind::motion)
          diagnostics.note<DiagnosticCode::fit_floor_remedy_after_step>({});
        else if (fit.choices.reduction.shape == ShapeChoice::none)
          diagnostics.note<DiagnosticCode::fit_floor_remedy>({});
        break;
      case Kind::left_above_noise:
        diagnostics.report<DiagnosticCode::fit_left_above_noise>({}, error_text(n[0], fit, problem),
                                                                 error_text(n[1], fit, problem));
        if (fit.choices.contact_is_found && fit.choices.reduction.slips != SlipChoice::none)
          diagnostics.note<DiagnosticCode::fit_found_surface_remedy>({});
        break;
      case Kind::floor_not_certified: diagnostics.report<DiagnosticCode::fit_floor_not_certified>({}, n[0]); break;
      case Kind::slower_than_record:
        diagnostics.report<DiagnosticCode::fit_slower_than_record>({}, found.name, n[0], n[1]);
        diagnostics.note<DiagnosticCode::fit_time_remedy>({});
        break;
      case Kind::faster_than_step:
        diagnostics.report<DiagnosticCode::fit_faster_than_step>({}, found.name, n[0], n[1]);
        diagnostics.note<DiagnosticCode::fit_step_remedy>({});
        break;
      case Kind::ill_conditioned: diagnostics.report<DiagnosticCode::fit_ill_conditioned>({}, n[0]); break;
      case Kind::beyond_reach:
        diagnostics.report<DiagnosticCode::fit_beyond_reach>({}, found.name, found.other, n[0]);
        diagnostics.note<DiagnosticCode::fit_reach_remedy>({});
        break;
      case Kind::no_intervals:
        diagnostics.report<DiagnosticCode::fit_no_intervals>({}, n[0], count(n[1]));
        diagnostics.note<DiagnosticCode::fit_spread_instead>({});
        break;
      case Kind::left_out_pushes:
        diagnostics.report<DiagnosticCode::fit_left_out_pushes>(
            {}, count(n[0]), found.name, quantity_text(n[1], units.force, 4), quantity_text(n[2], units.force, 4));
        diagnostics.note<DiagnosticCode::fit_left_out_remedy>({});
        break;
      case Kind::slips_or_softening:
        diagnostics.report<DiagnosticCode::fit_slips_or_softening>({});
        diagnostics.note<DiagnosticCode::fit_reversal_remedy>({});
        break;
      case Kind::shape_is_straight: diagnostics.report<DiagnosticCode::fit_shape_is_straight>({}, found.name); break;
      case Kind::loading_only:
        diagnostics.report<DiagnosticCode::fit_loading_only>({});
        diagnostics.note<DiagnosticCode::fit_reversal_remedy>({});
        break;
      case Kind::one_rate:
        diagnostics.report<DiagnosticCode::fit_one_rate>({}, quantity_text(n[0], units.velocity, 3));
        diagnostics.note<DiagnosticCode::fit_rate_remedy>({});
        break;
      case Kind::no_hold:
        diagnostics.report<DiagnosticCode::fit_no_hold>({});
        diagnostics.note<DiagnosticCode::fit_hold_remedy>({});
        break;
      case Kind::unstable_left_out:
        diagnostics.report<DiagnosticCode::fit_unstable_left_out>({}, found.name, n[2], n[0], n[1]);
        break;
      case Kind::few_rows: {
        const bool is_spectrum = recordings.front().kind == RecordingKind::frequency;  // a storage and a loss each row
        diagnostics.report<DiagnosticCode::fit_few_rows>({}, counted(count(n[0]) / (is_spectrum ? 2 : 1), "row"),
                                                         counted(count(n[1]), "parameter"));
        break;
      }
      case Kind::in_motion:
        diagnostics.report<DiagnosticCode::fit_in_motion>({}, found.name);
        diagnostics.note<DiagnosticCode::fit_start_remedy>({});
        break;
      case Kind::assumed_start:
        diagnostics.report<DiagnosticCode::fit_assumed_start>({}, found.name, quantity_text(n[0], units.position, 4));
        diagnostics.note<DiagnosticCode::fit_assumed_start_remedy>({});
        break;
      case Kind::late_force:
        diagnostics.report<DiagnosticCode::fit_late_force>({}, found.name, n[0]);
        diagnostics.note<DiagnosticCode::fit_delay_remedy>({}, n[0]);
        break;
      case Kind::size_not_met:
        diagnostics.report<DiagnosticCode::fit_size_not_met>({});
        diagnostics.note<DiagnosticCode::fit_path_remedy>({});
        break;
      case Kind::offsets_absorb: diagnostics.report<DiagnosticCode::fit_offsets_absorb>({}); break;
      case Kind::gains_fitted: diagnostics.report<DiagnosticCode::fit_gains_fitted>({}); break;
      case Kind::not_exact_in_simulate: diagnostics.report<DiagnosticCode::fit_not_exact_in_simulate>({}); break;
    }
  }
}

}  // namespace dashpot::compiler
