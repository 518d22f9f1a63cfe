#include "fit/reduction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fit/compressed.hpp"
#include "fit/criterion.hpp"
#include "fit/floor.hpp"
#include "fit/non_negative.hpp"
#include "fit/projection.hpp"
#include "fit/uncertainty.hpp"

namespace dashpot::compiler::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double times_per_decade = 4;
constexpr double thresholds_per_decade = 6;
constexpr double neighbours = 2.5;  // grid columns whose shapes differ by at most this factor stand for one element
constexpr std::size_t least_stretches = 4, most_stretches = 16;  // of a table
constexpr ProjectionLimits quick{12, 1e-5};
constexpr ProjectionLimits thorough{60, 1e-11};

bool is_reducible(const Term& term) {
  return term.kind == TermKind::maxwell || term.kind == TermKind::stop || term.kind == TermKind::sliding ||
         term.kind == TermKind::springpot;
}

// What orders terms of one kind.
double shape_of(const Term& term) {
  return term.kind == TermKind::maxwell ? term.time : term.kind == TermKind::springpot ? term.exponent : term.threshold;
}

// With room for as many weights.
Model without_terms(const Model& model) {
  return {{}, VectorXd(model.weights.size()), model.gains, model.residual_sum, model.curve};
}

Model selection(const Model& model, const std::vector<bool>& keep) {
  Model left = without_terms(model);
  Index count = 0;
  for (std::size_t j = 0; j < model.terms.size(); ++j)
    if (keep[j]) left.terms.push_back(model.terms[j]), left.weights[count++] = model.weight(j);
  left.weights.conservativeResize(count);
  return left;
}

// Initial forces of branches that are gone go with them.
std::vector<bool> without_orphans(const Model& model, std::vector<bool> keep) {
  for (std::size_t j = 0; j < model.terms.size(); ++j) {
    if (model.terms[j].kind != TermKind::initial) continue;
    bool has_branch = false;
    for (std::size_t i = 0; i < model.terms.size(); ++i)
      has_branch |= keep[i] && is_initial_of(model.terms[j], model.terms[i]);
    keep[j] = has_branch;
  }
  return keep;
}

Term merged(const Term& a, double weight_a, const Term& b, double weight_b) {
  const double sum = weight_a + weight_b, share = sum > 0 ? weight_b / sum : 0.5;
  const auto mean = [&](double x, double y) { return x > 0 && y > 0 ? x * std::pow(y / x, share) : std::max(x, y); };
  Term term = a;
  term.time = mean(a.time, b.time);
  term.threshold = mean(a.threshold, b.threshold);
  term.exponent = mean(a.exponent, b.exponent);
  return term;
}

// Two columns of a grid that stand for one element between them.
bool are_neighbours(const Term& a, const Term& b) {
  return a.kind == b.kind && is_reducible(a) && shape_of(b) <= neighbours * shape_of(a);
}

// Pairs, never whole runs: a broad spectrum is one long run.
Model merged_in_pairs(const Model& model) {
  Model result = without_terms(model);
  Index count = 0;
  for (std::size_t j = 0; j < model.terms.size(); ++j) {
    const bool pairs = j + 1 < model.terms.size() && are_neighbours(model.terms[j], model.terms[j + 1]);
    result.terms.push_back(pairs ? merged(model.terms[j], model.weight(j), model.terms[j + 1], model.weight(j + 1))
                                 : model.terms[j]);
    result.weights[count++] = model.weight(j) + (pairs ? model.weight(j + 1) : 0);
    j += pairs ? 1 : 0;
  }
  result.weights.conservativeResize(count);
  return result;
}

struct Option {
  Model model;
  double residual_sum;
};

class Reducer {
 public:
  Reducer(const Problem& problem, const ReductionChoices& choices, const std::function<void(std::size_t)>& progress)
      : problem_(problem), choices_(choices), progress_(progress) {}

  Reduction run() {
    std::vector<Model> rich = starts();
    for (Model& model : rich) model = pruned(refine(std::move(model), {30, 1e-7}));
    effective_ = effective_samples(problem_, *std::min_element(rich.begin(), rich.end(), has_less_left));
    Reduction best = reduction_down(std::move(rich.front()));
    std::vector<ShapeTried> shapes;
    add_tried(best.model, shapes);
    for (std::size_t i = 1; i < rich.size(); ++i) {
      Reduction other = reduction_down(std::move(rich[i]));
      add_tried(other.model, shapes);
      take_better(best, std::move(other));
    }
    if (choices_.springpots)
      for (const Model& with : springpot_starts(best)) take_better(best, reduction_from(with));
    if (choices_.slips == SlipChoice::viscous) take_better(best, with_viscous_slips(best));
    if (shapes.size() > 1) best.shapes = std::move(shapes);
    return best;
  }

 private:
  // Spring, damper and offsets.
  std::vector<Term> plain() const {
    std::vector<Term> terms = plain_terms(problem_);
    if (choices_.is_elastic) terms.assign(1, {TermKind::spring, 0, 0, 0, 0});
    terms.insert(terms.end(), choices_.beside.begin(), choices_.beside.end());
    return terms;
  }

  std::vector<Term> grid_terms() const {
    std::vector<Term> terms = plain();
    if (choices_.is_elastic) return terms;
    for (const double time : even_grid(resolved_times(problem_), times_per_decade))
      terms.push_back({TermKind::maxwell, time, 0, 0, 0});
    if (choices_.slips != SlipChoice::none)
      for (const double threshold : even_grid(resolved_thresholds(problem_), thresholds_per_decade))
        terms.push_back({TermKind::stop, 0, threshold, 0, 0});
    return terms;
  }

  static bool has_less_left(const Model& a, const Model& b) { return a.residual_sum < b.residual_sum; }

  std::vector<Model> starts() const {
    const auto wants = [&](ShapeChoice one) {
      return choices_.shape == one || choices_.shape == ShapeChoice::automatic;
    };
    std::vector<Model> list;
    if (wants(ShapeChoice::none)) list.push_back(start({}));
    if (wants(ShapeChoice::power)) list.push_back(best_start(some_powers(problem_.curve_reach())));
    if (wants(ShapeChoice::exponential)) list.push_back(best_start(some_exponentials(problem_.curve_reach())));
    if (wants(ShapeChoice::table)) list.push_back(table_start());
    return list;
  }

  Model best_start(const std::vector<CurveShape>& curves) const {
    Model best;
    best.residual_sum = std::numeric_limits<double>::infinity();
    for (const CurveShape& curve : curves)
      if (Model model = start(curve); best.terms.empty() || has_less_left(model, best)) best = std::move(model);
    return best;
  }

  // From the best closed form, or from a straight line: a table may soften.
  Model table_start() const {
    std::vector<CurveShape> curves = some_powers(problem_.curve_reach());
    for (const CurveShape& curve : some_exponentials(problem_.curve_reach())) curves.push_back(curve);
    curves.push_back(CurveShape::power(1, problem_.curve_reach()));
    Model model = best_start(curves);
    model.curve = model.curve->sampled(least_stretches);
    model = refine(std::move(model), quick);
    for (std::size_t stretches = 2 * least_stretches; stretches <= most_stretches; stretches *= 2) {
      Model finer = model;
      finer.curve = model.curve->sampled(stretches);
      finer = refine(std::move(finer), quick);
      const double effective = effective_samples(problem_, finer);
      if (score(finer, effective) >= score(model, effective)) break;
      model = std::move(finer);
    }
    return model;
  }

  void add_tried(const Model& model, std::vector<ShapeTried>& shapes) const {
    if (!can_be_written(model)) return;
    shapes.push_back({model.curve ? std::optional(model.curve->kind()) : std::nullopt, parameters(model),
                      std::sqrt(model.residual_sum / problem_.weighed_rows()), score(model, effective_)});
  }

  Model start(const std::optional<CurveShape>& curve) const {
    Model model = choices_.gains_are_free ? solve_weights_and_gains(problem_, grid_terms(), curve)
                                          : solve_weights(problem_, grid_terms(), {}, curve);
    model = with_plain_terms(merged_in_pairs(tidied(std::move(model))));
    for (const std::size_t file : choices_.in_motion)
      for (std::size_t j = 0; j < model.terms.size(); ++j)
        if (model.terms[j].kind == TermKind::maxwell) add(model, {TermKind::initial, model.terms[j].time, 0, 0, file});
    return model;
  }

  static void add(Model& model, const Term& term) {
    model.terms.push_back(term);
    model.weights.conservativeResize(model.weights.size() + 1);
    model.weights[model.weights.size() - 1] = 0;
  }

  // Spring, damper and offsets take part in every step, whatever weight they have at first.
  Model with_plain_terms(Model model) const {
    for (const Term& term : plain()) {
      const bool is_there = std::any_of(model.terms.begin(), model.terms.end(), [&](const Term& other) {
        return other.kind == term.kind && other.file == term.file;
      });
      if (!is_there) add(model, term);
    }
    return model;
  }

  Model refine(Model model, const ProjectionLimits& limits) const {
    return refined(problem_, std::move(model), choices_.gains_are_free, limits);
  }

  // A curve in a file is the force of springs, at rest or at once.
  static bool can_be_written(const Model& model) { return !model.curve || curve_stiffness(model).value > 0; }

  double score(const Model& model, double effective) const {
    if (!can_be_written(model)) return std::numeric_limits<double>::infinity();
    return criterion(problem_, model, effective, choices_.gains_are_free);
  }

  Reduction reduction_from(Model model) const { return reduction_down(pruned(refine(std::move(model), {30, 1e-7}))); }

  Reduction reduction_down(Model model) const {
    Reduction result;
    result.effective_samples = effective_;
    for (;; model = pruned(one_fewer(model))) {
      const bool is_last = reducible_count(model) == 0;
      if (can_be_written(model) || (is_last && result.path.empty()))
        result.path.push_back({model, score(model, effective_), parameters(model),
                               std::sqrt(model.residual_sum / problem_.weighed_rows()), is_determined(model)});
      if (progress_) progress_(reducible_count(model));
      if (is_last) break;
    }
    choose(result);
    result.model = tested(refine(result.path[result.chosen].model, thorough));
    return result;
  }

  std::size_t parameters(const Model& model) const { return parameter_count(model, choices_.gains_are_free); }

  bool is_determined(const Model& model) const {
    return static_cast<double>(parameters(model)) + 2 <= problem_.weighed_rows();
  }

  static std::size_t reducible_count(const Model& model) {
    return static_cast<std::size_t>(std::count_if(model.terms.begin(), model.terms.end(), is_reducible));
  }

  // Elements that got no weight.
  Model pruned(const Model& model) const {
    std::vector<bool> keep;
    for (std::size_t j = 0; j < model.terms.size(); ++j)
      keep.push_back(!is_reducible(model.terms[j]) || model.weight(j) > 0);
    return ordered(selection(model, without_orphans(model, keep)));
  }

  static Model ordered(const Model& model) {
    std::vector<std::size_t> order(model.terms.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const Term &x = model.terms[a], &y = model.terms[b];
      return std::pair(x.kind, shape_of(x)) < std::pair(y.kind, shape_of(y));
    });
    Model result = without_terms(model);
    for (std::size_t k = 0; k < order.size(); ++k) {
      result.terms.push_back(model.terms[order[k]]);
      result.weight(k) = model.weight(order[k]);
    }
    return result;
  }

  // Every element left out, every adjacent pair merged: scored with fixed shapes, the best of them refined.
  Model one_fewer(const Model& model) const {
    std::vector<Option> options = scored_options(model);
    std::sort(options.begin(), options.end(),
              [](const Option& a, const Option& b) { return a.residual_sum < b.residual_sum; });
    Model best;
    best.residual_sum = std::numeric_limits<double>::infinity();
    // In a long spectrum the options hardly differ, and each costs more.
    const std::size_t refined_options = options.size() > 25 ? 2 : 3;
    for (std::size_t k = 0; k < std::min(refined_options, options.size()); ++k) {
      Model tried = refine(std::move(options[k].model), quick);
      if (tried.residual_sum < best.residual_sum) best = std::move(tried);
    }
    return best;
  }

  std::vector<Option> scored_options(const Model& model) const {
    std::vector<Model> candidates;
    for (std::size_t j = 0; j < model.terms.size(); ++j) {
      if (!is_reducible(model.terms[j])) continue;
      std::vector<bool> keep(model.terms.size(), true);
      keep[j] = false;
      candidates.push_back(selection(model, without_orphans(model, keep)));
      const bool pairs = j + 1 < model.terms.size() && model.terms[j + 1].kind == model.terms[j].kind;
      if (pairs) candidates.push_back(with_merged(model, j));
    }
    return scored(std::move(candidates), model);
  }

  // All their columns side by side, compressed once.
  std::vector<Option> scored(std::vector<Model> candidates, const Model& from) const {
    Model all{{}, {}, from.gains, 0, from.curve};
    std::vector<std::vector<std::size_t>> places;
    for (const Model& candidate : candidates) {
      places.emplace_back();
      for (const Term& term : candidate.terms) places.back().push_back(place_of(term, all.terms));
    }
    const Compressed small = compressed(model_columns(problem_, all), problem_.target());
    std::vector<Option> options;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      MatrixXd columns(small.columns.rows(), static_cast<Index>(places[i].size()));
      for (std::size_t k = 0; k < places[i].size(); ++k)
        columns.col(static_cast<Index>(k)) = small.columns.col(static_cast<Index>(places[i][k]));
      const NonNegativeSolution solution =
          solve_non_negative(columns, small.target, signed_terms(candidates[i].terms), candidates[i].weights);
      candidates[i].weights = solution.weights;
      options.push_back({std::move(candidates[i]), solution.residual_sum});
    }
    return options;
  }

  static std::size_t place_of(const Term& wanted, std::vector<Term>& terms) {
    for (std::size_t j = 0; j < terms.size(); ++j)
      if (is_same(terms[j], wanted)) return j;
    terms.push_back(wanted);
    return terms.size() - 1;
  }

  static bool is_same(const Term& a, const Term& b) {
    return a.kind == b.kind && a.time == b.time && a.threshold == b.threshold && a.exponent == b.exponent &&
           a.file == b.file;
  }

  Model with_merged(const Model& model, std::size_t j) const {
    std::vector<bool> keep(model.terms.size(), true);
    keep[j + 1] = false;
    Model result = model;
    const Term before = model.terms[j];
    result.terms[j] = merged(model.terms[j], model.weight(j), model.terms[j + 1], model.weight(j + 1));
    result.weight(j) += model.weight(j + 1);
    for (Term& term : result.terms)
      if (is_initial_of(term, before)) term.time = result.terms[j].time;
    return selection(result, without_orphans(result, keep));
  }

  void choose(Reduction& result) const {
    if (choices_.ask_for_a_size()) {
      choose_as_asked(result);
      if (result.is_converged) return;
    }
    result.chosen = result.path.size() - 1;
    for (std::size_t k = 0; k < result.path.size(); ++k)
      if (result.path[k].is_determined && result.path[k].criterion < result.path[result.chosen].criterion)
        result.chosen = k;
  }

  double relative_error(const Model& model) const { return std::sqrt(model.residual_sum) / problem_.target().norm(); }

  bool serves(const Model& model) const {
    return (!choices_.modes || model.count(TermKind::maxwell) == *choices_.modes) &&
           (!choices_.stops || model.count(TermKind::stop) == *choices_.stops) &&
           (!choices_.tolerance || relative_error(model) <= *choices_.tolerance);
  }

  // The path goes from rich to poor: the last that serves has the fewest elements.
  void choose_as_asked(Reduction& result) const {
    result.is_converged = false;
    for (std::size_t k = 0; k < result.path.size(); ++k) {
      const Model& model = result.path[k].model;
      if (!serves(model)) continue;
      const bool is_better =
          !result.is_converged || choices_.tolerance || result.path[k].criterion < result.path[result.chosen].criterion;
      if (is_better) result.chosen = k;
      result.is_converged = true;
    }
  }

  // Spring, damper and offsets, one at a time, the least missed first.
  Model tested(Model model) const {
    for (;;) {
      model = tidied(std::move(model));
      const double now = score(model, effective_);
      Model best = model;
      double best_score = now;
      for (std::size_t j = 0; j < model.terms.size() && model.terms.size() > 1; ++j) {
        if (is_reducible(model.terms[j]) || model.terms[j].kind == TermKind::initial) continue;
        std::vector<bool> keep(model.terms.size(), true);
        keep[j] = false;
        const Model tried = refine(selection(model, keep), thorough);
        if (const double s = score(tried, effective_); s < best_score) best = tried, best_score = s;
      }
      if (best_score >= now) return model;
      model = best;
    }
  }

  // With one springpot in place of much of a spectrum: a few exponents, beside the poorest models of the path.
  std::vector<Model> springpot_starts(const Reduction& linear) const {
    std::vector<Model> starts;
    for (const PathEntry& entry : linear.path) {
      if (entry.model.count(TermKind::maxwell) > 3) continue;
      for (const double exponent : {0.08, 0.25, 0.5, 0.75}) {
        Model with = with_plain_terms(entry.model);
        add(with, {TermKind::springpot, 0, 0, exponent, 0});
        starts.push_back(refine(std::move(with), quick));
      }
    }
    std::sort(starts.begin(), starts.end(),
              [](const Model& a, const Model& b) { return a.residual_sum < b.residual_sum; });
    if (starts.size() > 3) starts.resize(3);
    return starts;
  }

  // Each slip of the chosen model beside a damper of its own, as far as the criterion agrees.
  Reduction with_viscous_slips(const Reduction& best) const {
    Reduction result = best;
    for (std::size_t j = 0; j < result.model.terms.size(); ++j) {
      if (result.model.terms[j].kind != TermKind::stop) continue;
      for (const double share : {1e-3, 1e-2, 1e-1}) {
        Model tried = result.model;
        tried.terms[j].kind = TermKind::sliding;
        tried.terms[j].time = share * problem_.duration();
        tried = refine(std::move(tried), thorough);
        if (score(tried, effective_) < score(result.model, effective_)) result.model = std::move(tried);
      }
    }
    return result;
  }

  void take_better(Reduction& best, Reduction other) const {
    const bool is_less = choices_.tolerance && best.is_converged
                             ? parameters(other.model) < parameters(best.model)
                             : score(other.model, effective_) < score(best.model, effective_);
    const bool is_better = other.is_converged == best.is_converged ? is_less : other.is_converged;
    if (is_better) best = std::move(other);
  }

  const Problem& problem_;
  const ReductionChoices& choices_;
  const std::function<void(std::size_t)>& progress_;
  double effective_ = 0;
};

}  // namespace

Model tidied(Model model) {
  std::vector<bool> keep;
  for (std::size_t j = 0; j < model.terms.size(); ++j) keep.push_back(model.weight(j) != 0);
  return selection(model, keep);
}

Reduction reduce(const Problem& problem, const ReductionChoices& choices,
                 const std::function<void(std::size_t)>& progress) {
  return Reducer(problem, choices, progress).run();
}

}  // namespace dashpot::compiler::fitting
