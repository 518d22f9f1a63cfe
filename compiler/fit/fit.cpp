#include "fit/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
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
constexpr int surface_turns = 40;       // of a network and the surface that it leaves behind a tool
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
        whole_(recordings_, choices.form, choices.weighting, every_row) {
    fit_.choices = choices;
    fit_.network_name = choices.name;
  }

  std::optional<Fit> run(const std::vector<Recording>& held_out) {
    search();
    // Which rows are in contact depends on the network, and the network on these rows: both are found in turns. A
    // structure that was found with other rows is no start, so the search for it begins anew.
    if (follow_surface(fit_.model)) {
      refine_with_surface();
      search_behind_surface();
    }
    measure();
    const bool has_no_curve = fit_.model.curve && curve_stiffness(fit_.model).value == 0;
    if (fit_.model.terms.empty() || elements_of(whole_, fit_.model).empty() || has_no_curve) {
      diagnostics_.report<DiagnosticCode::fit_nothing_resists>({});
      return std::nullopt;
    }
    measure_uncertainty();
    const std::optional<Model> written = write_values();
    if (!written) return std::nullopt;
    follow_surface(*written);
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

  // Enough rows to find a structure and its intervals by: neighbouring rows hold the same information.
  const Problem& searched() const { return thinned_ ? *thinned_ : whole_; }

  bool gains_are_free() const { return fit_.choices.reduction.gains_are_free; }

  // Puts the surface where the network leaves it; whether it has moved.
  bool follow_surface(const Model& model) {
    bool has_moved = false;
    for (Recording& recording : recordings_) has_moved |= follow_surface(recording, model);
    if (has_moved) stack();
    return has_moved;
  }

  bool follow_surface(Recording& recording, const Model& model) const {
    constexpr double same = 1e-10;  // of the reach
    if (!fit_.choices.contact || fit_.choices.form != Form::stiffness) return false;
    std::vector<double> surface = surface_under(recording, model.terms, model.weights, whole_.band(), model.curve);
    const std::vector<double>& before = recording.pushed();
    bool has_moved = false;
    for (std::size_t i = 0; i < surface.size(); ++i)
      has_moved |= std::abs(surface[i] - before[i]) > same * whole_.largest_reach();
    if (has_moved) recording.surface = std::move(surface);
    return has_moved;
  }

  void stack() {
    whole_ = Problem(recordings_, fit_.choices.form, fit_.choices.weighting, every_row);
    if (thinned_) thinned_.emplace(recordings_, fit_.choices.form, fit_.choices.weighting, rows_searched);
  }

  void refine_with_surface() {
    tell("following the surface where the tool leaves it");
    for (int turn = 0; turn < surface_turns && follow_surface(fit_.model); ++turn)
      fit_.model = refined(searched(), fit_.model, gains_are_free(), {10, 1e-9});
    fit_.model = tidied(std::move(fit_.model));
  }

  // Sizes, intervals and criterion have to be those of the rows that the chosen network leaves in contact: as long as
  // following the surface still lowers the residual, the search is repeated.
  void search_behind_surface() {
    constexpr int searches = 6;
    constexpr double settled = 0.01;  // of what is left
    for (int i = 0; i < searches; ++i) {
      search();
      const double found = fit_.model.residual_sum;
      refine_with_surface();
      if (found <= (1 + settled) * fit_.model.residual_sum) break;
    }
  }

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
  }

  void measure() {
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
    // The floor's weights may be of fewer rows: the chosen network, refined on all rows, may leave less. And by
    // rounding, which limits least squares over many columns, so may any network on the path.
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
    fit_.has_intervals = uncertainty_->is_told();
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
      network.weights[network.weights.size() - 1] = fit_.model.weight(j);
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
          one.offset = written.weight(j) * one.gain;
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
        sum += model.weight(j) * unit_column(problem.signal(file, model.curve), model.terms[j]);
      answer.segment(block.begin, block.count) = model.gains[file] * sum;
    }
    return answer;
  }

  static void score_free_rows(FileScore& score, const Recording& recording, const VectorXd& answer) {
    score.is_free.resize(recording.time.size());
    double sum = 0;
    for (std::size_t row = 0; row < recording.time.size(); ++row) {
      score.is_free[row] = recording.is_free(row);
      if (!score.is_free[row]) continue;
      const double left = recording.force[row] - answer[static_cast<Index>(row)];
      sum += left * left;
      score.free_largest = std::max(score.free_largest, std::abs(left));
    }
    if (score.free_rows > 0) score.free_rms = std::sqrt(sum / static_cast<double>(score.free_rows));
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
    score.free_rows = recording.free_rows();
    score_free_rows(score, recording, answer.segment(block.begin, block.count));
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
    std::vector<Recording> alone{recording};
    follow_surface(alone[0], written);
    const Problem problem(alone, fit_.choices.form, fit_.choices.weighting, every_row);
    Model network = written;
    network.gains = {1.0};
    for (std::size_t j = 0; j < network.terms.size(); ++j)
      if (is_signed(network.terms[j])) network.weight(j) = 0;
    return score_of(problem, 0, residual(problem, network), answer_of(problem, network));
  }

  std::vector<Recording> recordings_;  // with the surface, where a tool leaves it
  Diagnostics& diagnostics_;
  const std::function<void(const std::string&)>& progress_;
  Problem whole_;
  std::optional<Problem> thinned_;
  Fit fit_;
  Model on_searched_;
  std::optional<Uncertainty> uncertainty_;
  bool size_was_met_ = true;
};

// The rows before the force has first come back to nearly zero: after them the tool may have left the tissue.
Recording until_free(Recording recording) {
  constexpr double little = 0.01, much = 0.5;  // of the largest force
  double largest = 0;
  for (const double force : recording.force) largest = std::max(largest, std::abs(force - recording.force.front()));
  bool has_pushed = false;
  std::size_t rows = 0;
  for (; rows < recording.force.size(); ++rows) {
    const double push = std::abs(recording.force[rows] - recording.force.front());
    has_pushed |= push > much * largest;
    if (has_pushed && push < little * largest) break;
  }
  for (std::vector<double>* const values : {&recording.time, &recording.position, &recording.force})
    values->resize(rows);
  if (!recording.deviation.empty()) recording.deviation.resize(rows);
  return recording;
}

// Looks for the surface behind curves of one kind, or behind none.
class SurfaceSearch {
 public:
  SurfaceSearch(const std::vector<Recording>& recordings, const ReductionChoices& choices,
                std::vector<std::optional<CurveShape>> curves)
      : recordings_(recordings), choices_(choices), curves_(std::move(curves)) {
    for (const Recording& recording : recordings_)
      for (const double position : recording.position)
        furthest_ = std::max(furthest_, position), nearest_ = std::min(nearest_, position);
    // A tool that is pressed in at its first row may have come from 0, but not from further away than it goes.
    if (nearest_ > 0 && nearest_ <= furthest_ - nearest_) nearest_ = 0;
  }

  struct Found {
    double at, criterion;
  };

  // A scan of the whole way, with curves as they are at first, finds the valley. With refined curves it may lie some
  // steps further on; golden sections then find its bottom.
  Found run() const {
    constexpr int steps = 40;
    const double width = 0.9 * (furthest_ - nearest_) / steps;
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= steps; ++i)
      if (const double left = left_behind(nearest_ + i * width, false); left < least) least = left, best = i;
    double here = left_behind(nearest_ + best * width, true);
    for (const int way : {-1, 1})
      for (double next = 0; best + way >= 0 && best + way <= steps; best += way, here = next)
        if (next = left_behind(nearest_ + (best + way) * width, true); !(next < here)) break;
    constexpr double golden = 0.6180339887498949;
    double low = nearest_ + (best - 1) * width, high = nearest_ + (best + 1) * width;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double left_a = left_behind(a, true), left_b = left_behind(b, true);
    for (int i = 0; i < 24; ++i)
      if (left_a < left_b) {
        high = b, b = a, left_b = left_a;
        left_a = left_behind(a = high - golden * (high - low), true);
      } else {
        low = a, a = b, left_a = left_b;
        left_b = left_behind(b = low + golden * (high - low), true);
      }
    const double at = (low + high) / 2;
    const std::vector<Recording> moved = behind_surface(recordings_, at);
    const Problem problem(moved, Form::stiffness, Weighting::uniform, rows);
    const Model model = network_behind(problem, true);
    return {at, criterion(problem, model, effective_samples(problem, model), false)};
  }

 private:
  static constexpr std::size_t rows = 2000;

  double left_behind(double contact, bool is_refined) const {
    const std::vector<Recording> moved = behind_surface(recordings_, contact);
    const Problem problem(moved, Form::stiffness, Weighting::uniform, rows);
    if (problem.largest_reach() <= 0) return problem.target().squaredNorm();
    return network_behind(problem, is_refined).residual_sum;
  }

  Model network_behind(const Problem& problem, bool is_refined) const {
    std::vector<Term> terms = plain_terms(problem);
    if (choices_.is_elastic) terms.resize(1);
    else
      for (const double time : even_grid(resolved_times(problem), 3))
        terms.push_back({TermKind::maxwell, time, 0, 0, 0});
    terms.insert(terms.end(), choices_.beside.begin(), choices_.beside.end());
    Model best;
    best.residual_sum = std::numeric_limits<double>::infinity();
    for (std::optional<CurveShape> curve : curves_) {
      if (curve) curve = curve->over(problem.curve_reach());
      Model model = solve_weights(problem, terms, {}, curve);
      if (model.residual_sum < best.residual_sum) best = std::move(model);
    }
    return is_refined ? refined(problem, tidied(std::move(best)), false, {12, 1e-6}) : best;
  }

  const std::vector<Recording>& recordings_;
  const ReductionChoices& choices_;
  std::vector<std::optional<CurveShape>> curves_;
  double furthest_ = -std::numeric_limits<double>::infinity(), nearest_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<Fit> fit(const std::vector<Recording>& recordings, const std::vector<Recording>& held_out,
                       const FitChoices& choices, Diagnostics& diagnostics,
                       const std::function<void(const std::string&)>& progress) {
  return Fitter(recordings, choices, diagnostics, progress).run(held_out);
}

std::vector<Recording> behind_surface(std::vector<Recording> recordings, double contact) {
  for (Recording& recording : recordings)
    for (double& position : recording.position) {
      recording.in_front = std::max(recording.in_front, contact - position);
      position = std::max(0.0, position - contact);
    }
  return recordings;
}

double find_contact(const std::vector<Recording>& recordings, const ReductionChoices& choices) {
  std::vector<Recording> touching;
  for (const Recording& recording : recordings) touching.push_back(until_free(recording));
  const auto tries = [&](ShapeChoice one) {
    return choices.shape == one || choices.shape == ShapeChoice::table || choices.shape == ShapeChoice::automatic;
  };
  std::vector<std::vector<std::optional<CurveShape>>> kinds;
  if (tries(ShapeChoice::none)) kinds.push_back({std::nullopt});
  if (tries(ShapeChoice::power)) {
    kinds.emplace_back();
    for (const CurveShape& curve : some_powers(1)) kinds.back().emplace_back(curve);
  }
  if (tries(ShapeChoice::exponential)) {
    kinds.emplace_back();
    for (const CurveShape& curve : some_exponentials(1)) kinds.back().emplace_back(curve);
  }
  SurfaceSearch::Found best{0, std::numeric_limits<double>::infinity()};
  for (auto& curves : kinds)
    if (const auto found = SurfaceSearch(touching, choices, std::move(curves)).run(); found.criterion < best.criterion)
      best = found;
  return best.at;
}

}  // namespace dashpot::compiler::fitting
