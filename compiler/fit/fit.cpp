#include "fit/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/criterion.hpp"
#include "fit/findings.hpp"
#include "fit/network_text.hpp"
#include "fit/projection.hpp"
#include "syntax/parse_network.hpp"

namespace dashpot::compiler::fitting {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t rows_searched = 20'000;  // of a recording, while the structure is looked for
constexpr std::size_t every_row = static_cast<std::size_t>(-1) / 2;
constexpr int bootstrap_draws = 60;
constexpr double rounding_cost = 1e-3;  // relative, of the rms: what the digits of the file may add

double rms_of(double residual_sum, const Problem& problem) { return std::sqrt(residual_sum / problem.weighed_rows()); }

// 1 − RSS/TSS, TSS about the weighted mean.
double r_squared(const VectorXd& left, const VectorXd& target, const VectorXd& weights) {
  const double power = weights.squaredNorm();
  const double mean = power > 0 ? weights.dot(target) / power : 0;
  const double total = (target - mean * weights).squaredNorm();
  return total > 0 ? 1 - left.squaredNorm() / total : 0;
}

std::optional<Network> read_back(const std::string& text, Diagnostics& diagnostics) {
  const SourceFile& file = diagnostics.keep(SourceFile("the fitted network", text));
  const std::optional<NetworkDecl> decl = parse_network(file, diagnostics);
  return decl ? build_network(*decl, diagnostics) : std::nullopt;
}

class Fitter {
 public:
  Fitter(const std::vector<Recording>& recordings, const FitChoices& choices, Diagnostics& diagnostics,
         const std::function<void(const std::string&)>& progress)
      : recordings_(recordings),
        diagnostics_(diagnostics),
        progress_(progress),
        whole_(recordings, choices.form, choices.weighting, every_row) {
    fit_.choices = choices;
    fit_.network_name = choices.name;
  }

  std::optional<Fit> run(const std::vector<Recording>& held_out) {
    search();
    const bool has_no_curve = fit_.model.curve && curve_stiffness(fit_.model).value == 0;
    if (fit_.model.terms.empty() || elements_of(whole_, fit_.model).empty() || has_no_curve) {
      diagnostics_.report<DiagnosticCode::fit_nothing_resists>({});
      return std::nullopt;
    }
    measure_uncertainty();
    const std::optional<Model> written = write_values();
    if (!written) return std::nullopt;
    score(*written);
    for (const Recording& recording : held_out) fit_.held_out.push_back(score_held_out(recording, *written));
    fit_.findings = findings_of(fit_, whole_, *uncertainty_, size_was_met_);
    fit_.text = network_text(fit_, whole_);
    return std::move(fit_);
  }

 private:
  void tell(const std::string& what) const {
    if (progress_) progress_(what);
  }

  // Rows enough to find a structure and its intervals by: neighbours say the same.
  const Problem& searched() const { return thinned_ ? *thinned_ : whole_; }

  bool gains_are_free() const { return fit_.choices.reduction.gains_are_free; }

  void search() {
    const bool is_thinned = static_cast<std::size_t>(whole_.rows()) > rows_searched * recordings_.size();
    if (is_thinned) thinned_.emplace(recordings_, fit_.choices.form, fit_.choices.weighting, rows_searched);
    const Problem& problem = searched();
    fit_.noise = noise_of(whole_);
    Reduction reduction = reduce(problem, fit_.choices.reduction, [this](std::size_t left) {
      tell(fmt::format("{} relaxations, slips and springpots left", left));
    });
    fit_.path = std::move(reduction.path);
    fit_.chosen = reduction.chosen;
    size_was_met_ = reduction.is_converged;
    fit_.effective_samples = reduction.effective_samples;
    fit_.shapes = std::move(reduction.shapes);
    fit_.model = std::move(reduction.model);
    if (is_thinned) fit_.model = tidied(refined(whole_, fit_.model, gains_are_free(), {3, 1e-5}));
    fit_.parameters = parameter_count(fit_.model, gains_are_free());
    fit_.criterion = criterion(whole_, fit_.model, fit_.effective_samples, gains_are_free());
    find_floor();
  }

  void find_floor() {
    tell("bounding every linear network from below");
    const std::vector<Term>& beside = fit_.choices.reduction.beside;
    const auto least = std::min_element(fit_.path.begin(), fit_.path.end(),
                                        [](const PathEntry& a, const PathEntry& b) { return a.rms < b.rms; });
    std::vector<Term> known = branches_of(least->model);
    const std::vector<Term> chosen = branches_of(fit_.model);
    known.insert(known.end(), chosen.begin(), chosen.end());
    fit_.floor = linear_floor(searched(), beside, gains_are_free(), 8, known);
    // By weights of fewer rows: the chosen network, refined on all of them, may leave less. And in rounding, which is
    // where least squares over many columns ends, so may any network on the way.
    if (thinned_) fit_.floor.model.residual_sum = residual(whole_, fit_.floor.model).squaredNorm();
    else
      for (const PathEntry& entry : fit_.path) lower_floor_to(entry.model);
    lower_floor_to(fit_.model);
    fit_.floor_rms = rms_of(fit_.floor.model.residual_sum, whole_);
  }

  static std::vector<Term> branches_of(const Model& model) {
    std::vector<Term> branches;
    for (const Term& term : model.terms)
      if (term.kind == TermKind::maxwell || term.kind == TermKind::initial) branches.push_back(term);
    return branches;
  }

  void lower_floor_to(const Model& model) {
    const std::size_t plain =
        model.count(TermKind::spring) + model.count(TermKind::damper) + model.count(TermKind::offset);
    const bool is_linear = !model.curve && plain + branches_of(model).size() == model.terms.size();
    if (is_linear && model.residual_sum < fit_.floor.model.residual_sum) fit_.floor.model = model;
  }

  void measure_uncertainty() {
    on_searched_ = fit_.model;
    if (thinned_) on_searched_.residual_sum = residual(*thinned_, fit_.model).squaredNorm();
    uncertainty_.emplace(searched(), on_searched_, fit_.effective_samples, gains_are_free());
    fit_.condition = uncertainty_->condition();
    tell("leaving each file out");
    fit_.left_out = leave_one_out(searched(), fit_.model, gains_are_free());
    std::vector<Model> drawn;
    const bool is_small = searched().rows() * static_cast<Index>(fit_.model.terms.size()) < 200'000;
    if (!uncertainty_->is_told() && is_small) {
      tell("drawing blocks of what is left");
      drawn = block_bootstrap(searched(), on_searched_, fit_.effective_samples, gains_are_free(), bootstrap_draws);
    }
    fit_.elements = elements_of(whole_, fit_.model);
    for (FittedElement& element : fit_.elements) {
      element.interval = uncertainty_->interval(element.quantity);
      element.spread = spread(drawn, element.quantity);
      if (fit_.left_out.size() > 1) element.left_out = spread(fit_.left_out, element.quantity);
    }
    fit_.curve_values = curve_values_of(fit_.model, fit_.choices.port_motion);
    for (FittedCurveValue& value : fit_.curve_values) {
      value.interval = uncertainty_->interval(value.quantity);
      value.spread = spread(drawn, value.quantity);
      if (fit_.left_out.size() > 1) value.left_out = spread(fit_.left_out, value.quantity);
    }
  }

  // As few digits as the intervals ask for, more only where they would cost residual.
  std::optional<Model> write_values() {
    for (int extra = 0;; ++extra) {
      round_values(fit_.elements, fit_.model, fit_.choices.port_motion, extra);
      for (FittedCurveValue& value : fit_.curve_values) value.text.clear();
      std::optional<Network> network = read_back(bare_network_text(fit_), diagnostics_);
      if (network && !fit_.curve_values.empty()) {
        const double stiffness = curve_stiffness(model_of(*network, fit_.choices.form)).value;
        round_values(fit_.curve_values, fit_.model, stiffness, fit_.choices.port_motion, extra);
        network = read_back(bare_network_text(fit_), diagnostics_);
      }
      if (!network) return std::nullopt;
      for (FittedElement& element : fit_.elements)
        for (const Element& read : network->elements)
          if (read.name == element.name)
            element.value = std::visit([](const auto& law) { return value_in(law); }, read.law);
      Model written = with_sensors(model_of(*network, fit_.choices.form));
      written.residual_sum = residual(whole_, written).squaredNorm();
      const double allowed = (1 + 2 * rounding_cost) * fit_.model.residual_sum + 1e-20 * whole_.target().squaredNorm();
      if (written.residual_sum <= allowed || extra == 13) return written;
    }
  }

  static double value_in(const Spring& spring) { return spring.stiffness; }
  static double value_in(const Damper& damper) { return damper.damping; }
  static double value_in(const Slip& slip) { return slip.yield_force; }

  // What belongs to the sensors and not to the network: offsets, gains, and forces at the first rows.
  Model with_sensors(Model network) const {
    network.gains = fit_.model.gains;
    for (std::size_t j = 0; j < fit_.model.terms.size(); ++j) {
      if (!is_signed(fit_.model.terms[j])) continue;
      network.terms.push_back(fit_.model.terms[j]);
      network.weights.conservativeResize(network.weights.size() + 1);
      network.weights[network.weights.size() - 1] = fit_.model.weights[static_cast<Index>(j)];
    }
    return network;
  }

  void score(const Model& written) {
    tell("holding the written file against the recordings");
    const VectorXd left = residual(whole_, written);
    fit_.rms = rms_of(left.squaredNorm(), whole_);
    fit_.r_squared = r_squared(left, whole_.target(), whole_.weights());
    const VectorXd answer = answer_of(whole_, written);
    for (std::size_t file = 0; file < whole_.files(); ++file) {
      FileScore one = score_of(whole_, file, left, answer);
      one.gain = written.gains[file];
      for (std::size_t j = 0; j < written.terms.size(); ++j)
        if (written.terms[j].kind == TermKind::offset && written.terms[j].file == file)
          one.offset = written.weights[static_cast<Index>(j)] * one.gain;
      if (file < fit_.left_out.size()) {
        const Block& block = whole_.blocks()[file];
        const VectorXd rows = residual(whole_, fit_.left_out[file]).segment(block.begin, block.count);
        one.left_out_rms = std::sqrt(rows.squaredNorm() / weighed(block));
      }
      fit_.files.push_back(std::move(one));
    }
  }

  double weighed(const Block& block) const {
    return static_cast<double>((whole_.weights().segment(block.begin, block.count).array() > 0).count());
  }

  // Without weights.
  static VectorXd answer_of(const Problem& problem, const Model& model) {
    VectorXd answer(problem.rows());
    for (std::size_t file = 0; file < problem.files(); ++file) {
      const Block& block = problem.blocks()[file];
      VectorXd sum = VectorXd::Zero(block.count);
      for (std::size_t j = 0; j < model.terms.size(); ++j)
        sum += model.weights[static_cast<Index>(j)] * unit_column(problem.signal(file, model.curve), model.terms[j]);
      answer.segment(block.begin, block.count) = model.gains[file] * sum;
    }
    return answer;
  }

  static FileScore score_of(const Problem& problem, std::size_t file, const VectorXd& left, const VectorXd& answer) {
    const Recording& recording = problem.recordings()[file];
    const Block& block = problem.blocks()[file];
    const VectorXd own = left.segment(block.begin, block.count);
    const VectorXd weights = problem.weights().segment(block.begin, block.count);
    const VectorXd target = problem.target().segment(block.begin, block.count);
    FileScore score;
    score.name = recording.name;
    score.digest = recording.digest;
    score.rows = recording.measured_rows();
    const double weighed = std::max<double>(1, static_cast<double>((weights.array() > 0).count()));
    score.rms = std::sqrt(own.squaredNorm() / weighed);
    const auto [low, high] = std::minmax_element(recording.force.begin(), recording.force.end());
    score.range = *high - *low;
    score.r_squared = r_squared(own, target, weights);
    Index worst = 0;
    score.largest_error = own.cwiseAbs().maxCoeff(&worst);
    const std::size_t row = static_cast<std::size_t>(worst) % recording.time.size();
    score.largest_time = recording.time[row];
    if (row < recording.position.size()) score.largest_position = recording.position[row];
    const Index assumed = static_cast<Index>(recording.assumed_rows);
    score.lag_one = lag_one_correlation(own.tail(own.size() - assumed));
    score.effective_samples = effective_samples(VectorXd(own.tail(own.size() - assumed)));
    const VectorXd modelled = target - own;
    const double power = modelled.squaredNorm();
    score.best_gain = power > 0 ? modelled.dot(target) / power : 1;
    const VectorXd rows = answer.segment(block.begin, block.count);
    score.answer.assign(rows.data(), rows.data() + rows.size());
    return score;
  }

  FileScore score_held_out(const Recording& recording, const Model& written) const {
    const std::vector<Recording> alone{recording};
    const Problem problem(alone, fit_.choices.form, fit_.choices.weighting, every_row);
    Model network = written;
    network.gains = {1.0};
    for (std::size_t j = 0; j < network.terms.size(); ++j)
      if (is_signed(network.terms[j])) network.weights[static_cast<Index>(j)] = 0;
    return score_of(problem, 0, residual(problem, network), answer_of(problem, network));
  }

  const std::vector<Recording>& recordings_;
  Diagnostics& diagnostics_;
  const std::function<void(const std::string&)>& progress_;
  Problem whole_;
  std::optional<Problem> thinned_;
  Fit fit_;
  Model on_searched_;
  std::optional<Uncertainty> uncertainty_;
  bool size_was_met_ = true;
};

double floor_behind(const std::vector<Recording>& recordings, double contact) {
  const std::vector<Recording> moved = behind_surface(recordings, contact);
  const Problem problem(moved, Form::stiffness, Weighting::uniform, 4000);
  if (problem.largest_reach() <= 0) return problem.target().squaredNorm();
  std::vector<Term> terms = plain_terms(problem);
  for (const double time : even_grid(resolved_times(problem), 4)) terms.push_back({TermKind::maxwell, time, 0, 0, 0});
  return solve_weights(problem, terms, {}).residual_sum;
}

}  // namespace

std::optional<Fit> fit(const std::vector<Recording>& recordings, const std::vector<Recording>& held_out,
                       const FitChoices& choices, Diagnostics& diagnostics,
                       const std::function<void(const std::string&)>& progress) {
  return Fitter(recordings, choices, diagnostics, progress).run(held_out);
}

std::vector<Recording> behind_surface(std::vector<Recording> recordings, double contact) {
  for (Recording& recording : recordings)
    for (double& position : recording.position) position = std::max(0.0, position - contact);
  return recordings;
}

// Over the whole way a scan finds the valley, then golden sections its bottom.
double find_contact(const std::vector<Recording>& recordings) {
  double furthest = 0, nearest = 0;
  for (const Recording& recording : recordings)
    for (const double position : recording.position)
      furthest = std::max(furthest, position), nearest = std::min(nearest, position);
  constexpr int steps = 40;
  const double width = 0.9 * (furthest - nearest) / steps;
  int best = 0;
  double least = floor_behind(recordings, nearest);
  for (int i = 1; i <= steps; ++i)
    if (const double left = floor_behind(recordings, nearest + i * width); left < least) least = left, best = i;
  constexpr double golden = 0.6180339887498949;
  double low = nearest + (best - 1) * width, high = nearest + (best + 1) * width;
  for (int i = 0; i < 24; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (floor_behind(recordings, a) < floor_behind(recordings, b)) high = b;
    else low = a;
  }
  return (low + high) / 2;
}

}  // namespace dashpot::compiler::fitting
