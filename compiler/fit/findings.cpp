#include "fit/findings.hpp"

#include <algorithm>
#include <cmath>

#include "fit/criterion.hpp"
#include "linear/reach.hpp"

namespace dashpot::compiler::fitting {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// How a tool moved in all recordings together.
struct Travel {
  bool has_reversal = false, has_hold = false, has_return = false;
  double slowest = 0, fastest = 0;  // of the speeds that most of the travel was made with [m/s]
};

// Counts as a reversal where the tool goes back by so much of its range.
constexpr double least_return = 0.02;
constexpr double rest_share = 0.02;  // of the fastest speed: slower is a hold

void add_speeds(const Recording& recording, std::vector<std::pair<double, double>>& speeds) {
  const std::vector<double> steps = steps_of(recording.time);
  for (std::size_t i = 1 + recording.assumed_rows; i < steps.size(); ++i) {
    const double change = std::abs(recording.position[i] - recording.position[i - 1]);
    speeds.emplace_back(change / steps[i], change);
  }
}

bool goes_back(const Recording& recording) {
  const auto [low, high] = std::minmax_element(recording.position.begin(), recording.position.end());
  const double range = *high - *low, direction = std::abs(*high) >= std::abs(*low) ? 1 : -1;
  double furthest = direction * recording.position.front(), back = 0;
  for (const double position : recording.position) {
    furthest = std::max(furthest, direction * position);
    back = std::max(back, furthest - direction * position);
  }
  return back > least_return * range;
}

Travel travel_of(const std::vector<Recording>& recordings) {
  Travel travel;
  std::vector<std::pair<double, double>> speeds;  // with the distance that was covered at each
  for (const Recording& recording : recordings) {
    add_speeds(recording, speeds);
    travel.has_reversal |= goes_back(recording);
  }
  std::sort(speeds.begin(), speeds.end());
  double whole = 0, covered = 0;
  for (const auto& [speed, distance] : speeds) whole += distance;
  for (const auto& [speed, distance] : speeds) {
    covered += distance;
    if (covered < 0.1 * whole) travel.slowest = speed;
    if (covered < 0.9 * whole) travel.fastest = speed;
  }
  for (const auto& [speed, distance] : speeds) travel.has_hold |= speed < rest_share * travel.fastest;
  return travel;
}

class Findings {
 public:
  Findings(const Fit& fit, const Problem& problem, const Uncertainty& uncertainty)
      : fit_(fit), problem_(problem), uncertainty_(uncertainty) {}

  std::vector<Finding> run(bool size_was_met) {
    if (!size_was_met) add(Finding::Kind::size_not_met);
    look_at_starts();
    for (std::size_t file = 0; file < problem_.files(); ++file)
      look_at_touch(problem_.recordings()[file], fit_.files[file]);
    look_at_floor();
    look_at_times();
    look_at_reach(ElementKind::spring);
    look_at_reach(ElementKind::damper);
    if (is_motion()) look_at_travel();
    look_at_curve();
    look_at_intervals();
    look_at_left_out();
    if (!fit_.choices.reduction.beside.empty() && problem_.files() > 1) add(Finding::Kind::offsets_absorb);
    if (fit_.choices.reduction.gains_are_free) add(Finding::Kind::gains_fitted);
    if (fit_.model.count(TermKind::sliding) > 0) add(Finding::Kind::not_exact_in_simulate);
    return std::move(list_);
  }

 private:
  void add(Finding::Kind kind, std::string name = {}, std::vector<double> numbers = {}, std::string other = {}) {
    list_.push_back({kind, std::move(name), std::move(numbers), std::move(other)});
  }

  bool is_motion() const { return problem_.recordings().front().kind == RecordingKind::motion; }

  void look_at_starts() {
    for (const std::size_t file : fit_.choices.assumed_starts)
      add(Finding::Kind::assumed_start, problem_.recordings()[file].name, {problem_.recordings()[file].position[1]});
    if (!is_motion()) return;
    for (std::size_t file = 0; file < problem_.files(); ++file) {
      const Recording& recording = problem_.recordings()[file];
      if (const double delay = force_delay(recording); delay != 0)
        add(Finding::Kind::late_force, recording.name, {delay});
    }
  }

  // Where the tool comes from in front of the tissue, and where it has left it.
  void look_at_touch(const Recording& recording, const FileScore& file) {
    if (!is_motion() || !fit_.noise || fit_.choices.form != Form::stiffness) return;
    if (!fit_.choices.contact) look_at_approach(recording, file);
    const double elsewhere = std::max(*fit_.noise, file.rms);
    if (file.free_rms > 3 * elsewhere)
      add(Finding::Kind::left_out_pushes, file.name,
          {static_cast<double>(file.free_rows), file.free_largest, file.free_rms});
  }

  // Rows in which the force has not yet left its noise though the tool moves and the network would push.
  void look_at_approach(const Recording& recording, const FileScore& file) {
    const std::size_t first = recording.assumed_rows;
    const double unmoved = 5 * std::sqrt(2.0) * *fit_.noise;  // five deviations of a difference of two rows
    double low = recording.position[first], high = low, push = 0;
    for (std::size_t row = first; row < recording.time.size(); ++row) {
      if (std::abs(recording.force[row] - recording.force[first]) > unmoved) break;
      low = std::min(low, recording.position[row]), high = std::max(high, recording.position[row]);
      push = std::max(push, std::abs(file.answer[row] - file.answer[first]));
    }
    const auto [least, most] = std::minmax_element(recording.position.begin(), recording.position.end());
    // If a curve fits badly, it may have absorbed most of the approach: then less of a push counts.
    const double bent = fit_.model.curve && file.rms > 3 * *fit_.noise ? 1 : 2;
    if (push > bent * unmoved && high - low > least_return * (*most - *least) && force_delay(recording) == 0)
      add(Finding::Kind::untouched, file.name, {recording.origin + low, recording.origin + high, push});
  }

  void look_at_floor() {
    if (!fit_.floor.is_certified() && fit_.floor.model.residual_sum > 1e-20 * problem_.target().squaredNorm())
      add(Finding::Kind::floor_not_certified, "", {fit_.floor.largest_cosine});
    const bool is_linear = !fit_.model.curve && fit_.model.slip_count() == 0;
    const Model& least = is_linear ? fit_.floor.model : fit_.model;
    const double left = is_linear ? fit_.floor_rms : fit_.rms;
    if (!fit_.noise || !is_felt(left) || left <= 3 * *fit_.noise) return;
    if (!(lag_one_correlation(residual(problem_, least)) > 0.5)) return;
    add(is_linear ? Finding::Kind::floor_above_noise : Finding::Kind::left_above_noise, "", {left, *fit_.noise});
  }

  // Compared with the force itself. Smaller residuals come from the digits of the file, or from the interpolation
  // between rows.
  bool is_felt(double left) const {
    return left > 1e-3 * problem_.target().norm() / std::sqrt(problem_.weighed_rows());
  }

  std::string name_of(std::size_t term) const {
    for (const FittedElement& element : fit_.elements)
      if (element.quantity.term == term) return element.name;
    return "K";
  }

  void look_at_times() {
    for (std::size_t j = 0; j < fit_.model.terms.size(); ++j) {
      const Term& term = fit_.model.terms[j];
      if (term.kind != TermKind::maxwell) continue;
      if (term.time > problem_.duration())
        add(Finding::Kind::slower_than_record, name_of(j), {term.time, problem_.duration()});
      if (term.time < problem_.shortest_step())
        add(Finding::Kind::faster_than_step, name_of(j), {term.time, problem_.shortest_step()});
    }
  }

  void look_at_reach(ElementKind kind) {
    const FittedElement* least = nullptr;
    const FittedElement* most = nullptr;
    for (const FittedElement& element : fit_.elements) {
      if (element.kind != kind) continue;
      if (least == nullptr || element.value < least->value) least = &element;
      if (most == nullptr || element.value > most->value) most = &element;
    }
    if (least != nullptr && most->value / widest_spread > least->value)
      add(Finding::Kind::beyond_reach, least->name, {widest_spread}, most->name);
  }

  // A table that somewhere rises less than before.
  bool softens() const {
    if (!fit_.model.curve || fit_.model.curve->kind() != CurveShape::Kind::table) return false;
    std::vector<double> slopes = fit_.model.curve->parameters();
    slopes.push_back(0);
    return !std::is_sorted(slopes.begin(), slopes.end());
  }

  // So little bent that a spring would do as well.
  void look_at_curve() {
    if (!fit_.model.curve) return;
    const CurveShape& curve = *fit_.model.curve;
    const double half = curve.reach() / 2, straight = curve.force_at(curve.reach()) / 2;
    if (std::abs(curve.force_at(half) - straight) < 0.005 * straight)
      add(Finding::Kind::shape_is_straight, word_of(curve.kind()));
  }

  void look_at_travel() {
    const Travel travel = travel_of(problem_.recordings());
    const bool has_slips = fit_.model.slip_count() > 0;
    const bool asked = fit_.choices.reduction.slips != SlipChoice::none;
    if ((has_slips || asked || softens()) && !travel.has_reversal) add(Finding::Kind::slips_or_softening);
    const bool is_one_rate = travel.fastest < 1.5 * travel.slowest;
    if (!travel.has_reversal && !travel.has_hold) add(Finding::Kind::loading_only);
    if (is_one_rate) add(Finding::Kind::one_rate, "", {travel.fastest});
    else if (!travel.has_hold && travel.has_reversal && fit_.model.count(TermKind::maxwell) > 0)
      add(Finding::Kind::no_hold);
  }

  void look_at_intervals() {
    const double rows = problem_.weighed_rows();
    if (rows < 4 * static_cast<double>(fit_.parameters))
      add(Finding::Kind::few_rows, "", {rows, static_cast<double>(fit_.parameters)});
    if (!uncertainty_.is_told())
      add(Finding::Kind::no_intervals, "", {fit_.effective_samples, static_cast<double>(fit_.parameters)});
    if (uncertainty_.condition() > 1e3) add(Finding::Kind::ill_conditioned, "", {uncertainty_.condition()});
  }

  // Relaxation times that change by more than half when one of the files is left out.
  void look_at_left_out() {
    for (std::size_t j = 0; j < fit_.model.terms.size(); ++j) {
      if (fit_.model.terms[j].kind != TermKind::maxwell) continue;
      double low = fit_.model.terms[j].time, high = low;
      for (const Model& model : fit_.left_out) {
        low = std::min(low, model.terms[j].time);
        high = std::max(high, model.terms[j].time);
      }
      if (high > 1.5 * fit_.model.terms[j].time || low < fit_.model.terms[j].time / 1.5)
        add(Finding::Kind::unstable_left_out, name_of(j), {low, high, fit_.model.terms[j].time});
    }
  }

  const Fit& fit_;
  const Problem& problem_;
  const Uncertainty& uncertainty_;
  std::vector<Finding> list_;
};

Recording delayed(const Recording& recording, double delay) {
  Recording moved = recording;
  std::size_t j = 0;
  for (std::size_t i = 0; i < recording.time.size(); ++i) {
    const double wanted = std::clamp(recording.time[i] + delay, recording.time.front(), recording.time.back());
    while (j + 2 < recording.time.size() && recording.time[j + 1] < wanted) ++j;
    while (j > 0 && recording.time[j] > wanted) --j;
    const double share = (wanted - recording.time[j]) / (recording.time[j + 1] - recording.time[j]);
    moved.force[i] = recording.force[j] + share * (recording.force[j + 1] - recording.force[j]);
  }
  return moved;
}

double coarse_floor(const Recording& recording) {
  const std::vector<Recording> alone{recording};
  const Problem problem(alone, Form::stiffness, Weighting::uniform, 2000);
  std::vector<Term> terms{{TermKind::spring, 0, 0, 0, 0}};
  for (const double time : even_grid(resolved_times(problem), 3)) terms.push_back({TermKind::maxwell, time, 0, 0, 0});
  return solve_weights(problem, terms, {}).residual_sum;
}

}  // namespace

std::optional<double> noise_of(const Problem& problem) {
  if (problem.recordings().front().kind == RecordingKind::frequency) return std::nullopt;
  std::vector<double> differences;
  for (const Block& block : problem.blocks())
    for (Index row = block.begin + 2; row < block.begin + block.count; ++row) {
      if (problem.weights()[row] == 0 || problem.weights()[row - 1] == 0 || problem.weights()[row - 2] == 0) continue;
      const VectorXd& f = problem.target();
      differences.push_back(std::abs(f[row] - 2 * f[row - 1] + f[row - 2]));
    }
  if (differences.size() < 20) return std::nullopt;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  // The median of |x| of a normal x is 0.6745 σ, and second differences have 6 times the variance.
  return *middle / (0.6745 * std::sqrt(6.0));
}

double force_delay(const Recording& recording) {
  // Of longer recordings the search would take longer than the fit.
  if (recording.measured_rows() < 30 || recording.measured_rows() > 50'000) return 0;
  const double step = usual_step(steps_of(recording.time));
  const double as_it_is = coarse_floor(recording);
  double least = as_it_is, found = 0;
  for (const double rows : {1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 32.0}) {
    const double tried = coarse_floor(delayed(recording, rows * step));
    if (tried < least) least = tried, found = rows * step;
  }
  return least < 0.25 * as_it_is ? found : 0;
}

std::vector<Finding> findings_of(const Fit& fit, const Problem& problem, const Uncertainty& uncertainty,
                                 bool size_was_met) {
  return Findings(fit, problem, uncertainty).run(size_was_met);
}

}  // namespace dashpot::compiler::fitting
