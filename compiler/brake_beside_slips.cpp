#include "brake_beside_slips.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "certify/convex_search.hpp"
#include "certify/settle.hpp"

namespace dashpot::compiler {
namespace {

constexpr double closely = 3e-3;       // of a damping that is looked for between two runs, relative
constexpr int most_rounds = 3;         // what is found may draw in the bounds that it was found by
constexpr int most_steps_back = 6;     // from a damping that should have been allowed and is not
constexpr double same_damping = 1e-9;  // of the brake's reach

// A damping beside the slips that has been run.
struct PlaceOnLine {
  Candidate beside;
  std::shared_ptr<const TriedLaw> tried;
  double added;  // for passivity [N·s/m]
  EvaluatedOption option;
};

// One state input and one law behind the slips.
struct Line {
  StateInput input;
  SlipPlan plan;
  std::vector<PlaceOnLine> places;  // by damping
};

class BesideSearch {
 public:
  BesideSearch(const Compilation& c, const Choices& choices, SlipRuns& runs)
      : runs_(runs),
        settler_(c.present, c.form, c.decomposition, choices, c.port, c.rate),
        choices_(choices),
        device_(c.port),
        before_(runs.chosen_beside()) {
    const double feedthrough = to_double(c.form.linear.feedthrough_damping);
    most_ = device_.max_damping().value_or(0);
    if (c.network.contact) most_ = std::min(most_, feedthrough);
    for (const StateInputMerit& merit : before_.state_inputs)
      for (const SlipLaw law : runs.laws()) {
        lines_.push_back({merit.state_input, runs.plan(law), {}});
        if (law == SlipLaw::steady) lines_.push_back({merit.state_input, runs.plan(law, 0), {}});
      }
    for (Line& line : lines_)
      for (const double damping : {0.0, before_.damping, feedthrough, most_})
        if (damping <= most_) look_at(line, damping);
  }

  Candidate chosen() {
    for (Line& line : lines_) look_for_least_error(line);
    FaithfulChoice choice = by_rule();
    for (int round = 0; round < most_rounds; ++round) {
      const std::size_t known = all_.size();
      for (Line& line : lines_) look_for_most_damping(line, choice);
      if (all_.size() == known) break;
      choice = by_rule();
    }
    Candidate beside = all_[choice.chosen];
    choice.in_runs = true;
    beside.faithful = choice;
    settler_.settle_at(beside);
    return beside;
  }

 private:
  void look_at(Line& line, double damping) {
    const auto after = std::lower_bound(line.places.begin(), line.places.end(), damping,
                                        [](const PlaceOnLine& p, double value) { return p.beside.damping < value; });
    const auto is_there = [&](const PlaceOnLine& p) {
      return std::abs(p.beside.damping - damping) <= same_damping * most_;
    };
    if ((after != line.places.end() && is_there(*after)) || (after != line.places.begin() && is_there(*(after - 1))))
      return;
    PlaceOnLine place{before_, {}, 0, {}};
    settler_.place(place.beside, damping);
    place.beside.state_input = line.input;
    SlipOption run = runs_.run(place.beside, line.plan);
    const Certificate& certificate = run.made.certificate;
    const bool is_proved = certificate.bound.proof != Proof::none;
    place.added = device_.behind_curve(certificate.added_damping);
    place.tried = run.tried;
    place.option = {run.merit.mean_damping, std::max(run.merit.error(), band_error(line, damping, place.added)),
                    is_proved ? std::optional(run.merit.minimum_damping) : std::nullopt, run.merit.certified,
                    run.merit.motor_noise};
    if (place.option.motor_noise && place.beside.motor_noise) *place.option.motor_noise += *place.beside.motor_noise;
    all_.push_back(place.beside);
    options_.push_back(place.option);
    line.places.insert(after, std::move(place));
  }

  FaithfulChoice by_rule() const { return choose_faithful(options_, choices_.tolerance); }

  double band_error(const Line& line, double damping, double added) {
    Candidate candidate = before_;
    candidate.state_input = line.input;
    candidate.damping = damping;
    return settler_.largest_error(candidate, added);
  }

  // Between two neighbouring places, by interpolation.
  auto error_after(const Line& line, std::size_t i) {
    const ErrorBetween& in_runs = runs_.between(*line.places[i].tried, *line.places[i + 1].tried);
    return [&, i](double share) {
      const PlaceOnLine &low = line.places[i], &high = line.places[i + 1];
      const double band = band_error(line, damping_at(line, i, share), low.added + share * (high.added - low.added));
      return std::max(band, in_runs.at(share));
    };
  }

  // On either side of the best place so far: the error is convex.
  void look_for_least_error(Line& line) {
    const auto at = std::min_element(
        line.places.begin(), line.places.end(),
        [](const PlaceOnLine& one, const PlaceOnLine& other) { return one.option.error < other.option.error; });
    double best = at->beside.damping, least = at->option.error;
    const auto here = static_cast<std::size_t>(at - line.places.begin());
    for (std::size_t i = here > 0 ? here - 1 : 0; i <= here && i + 1 < line.places.size(); ++i) {
      const ValueAt found = golden_section(error_after(line, i), 0, 1, 0, closely);
      if (found.value >= least) continue;
      least = found.value;
      best = damping_at(line, i, found.place);
    }
    look_at(line, best);
  }

  static double damping_at(const Line& line, std::size_t i, double share) {
    const double low = line.places[i].beside.damping, high = line.places[i + 1].beside.damping;
    return low + share * (high - low);
  }

  static bool is_allowed(const EvaluatedOption& option, const FaithfulChoice& choice) {
    if (!is_within(option.error, choice.allowed_error)) return false;
    return !choice.certified || (option.certified && is_within(option.added.value_or(0), leeway * choice.least_added));
  }

  // The largest damping that interpolation allows, then back from it to where a run does.
  void look_for_most_damping(Line& line, const FaithfulChoice& choice) {
    const double allowed = choice.allowed_error;
    for (std::size_t i = line.places.size() - 1; i-- > 0;) {
      if (is_allowed(line.places[i + 1].option, choice)) return;
      const auto here = error_after(line, i);
      const ValueAt least = golden_section(here, 0, 1, allowed, closely);
      const bool is_inside = least.value <= allowed;
      if (!is_inside && line.places[i].option.error > allowed) continue;
      const double inside = is_inside ? least.place : 0;
      const double end = boundary([&](double share) { return here(share) <= allowed; }, inside, 1, closely);
      double damping = damping_at(line, i, end);
      const double low = line.places[i].beside.damping;
      for (int step = 0; step < most_steps_back; ++step) {
        const std::size_t known = options_.size();
        look_at(line, damping);
        if (options_.size() == known || is_allowed(options_.back(), choice)) return;
        damping = (low + damping) / 2;
      }
      return;
    }
  }

  SlipRuns& runs_;
  CandidateSettler settler_;
  const Choices& choices_;
  const PortDevice& device_;
  Candidate before_;
  double most_ = 0;
  std::vector<Line> lines_;
  std::vector<Candidate> all_;
  std::vector<EvaluatedOption> options_;  // of all_
};

}  // namespace

Candidate choose_beside_slips(const Compilation& c, const Choices& choices, SlipRuns& runs) {
  return BesideSearch(c, choices, runs).chosen();
}

}  // namespace dashpot::compiler
