#include "slip_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "brake_beside_slips.hpp"
#include "certify/tunable_choice.hpp"
#include "network/port_units.hpp"
#include "slip_runs.hpp"

namespace dashpot::compiler {
namespace {

// The law behind slips, for one damping beside them.
class SlipChooser {
 public:
  SlipChooser(SlipRuns& runs, const Candidate& beside, const Choices& choices)
      : runs_(runs), beside_(beside), choices_(choices) {}

  // `least_elsewhere`: the least error that another damping beside the slips reaches.
  SlipDecomposition chosen(std::optional<double> least_elsewhere = std::nullopt) {
    const std::vector<SlipLaw>& laws = runs_.laws();
    for (const SlipLaw law : laws) options_.push_back(runs_.run(beside_, runs_.plan(law)));
    std::optional<SlipOption> floor;  // of the steady law, nothing beyond the largest b∞
    if (std::find(laws.begin(), laws.end(), SlipLaw::steady) != laws.end())
      floor = runs_.run(beside_, runs_.plan(SlipLaw::steady, 0));
    least_ = least_elsewhere ? *least_elsewhere : least_error(floor);
    limit_ = allowed_error(choices_.tolerance, least_);
    if (floor) fit_steady(*floor);
    return with_figures(best());
  }

 private:
  // The least reachable; an error that only laws reach which are not certified shuts out none that is.
  double least_error(const std::optional<SlipOption>& floor) const {
    double least = std::numeric_limits<double>::infinity(), least_certified = least;
    const auto look_at = [&](const SlipOption& option) {
      least = std::min(least, option.merit.error());
      if (option.merit.certified) least_certified = std::min(least_certified, option.merit.error());
    };
    for (const SlipOption& option : options_) look_at(option);
    if (floor) look_at(*floor);
    return runs_.is_ideal() || std::isinf(least_certified) ? least : least_certified;
  }

  // What is felt is linear in the excess, so between none and all of it the largest that keeps to the limit is found
  // without further runs; that one is run to be sure.
  void fit_steady(const SlipOption& floor) {
    SlipOption& whole = *std::find_if(options_.begin(), options_.end(),
                                      [](const SlipOption& option) { return option.plan.law == SlipLaw::steady; });
    if (whole.merit.error() <= limit_ || floor.merit.error() > limit_) return;
    const ErrorBetween& error = runs_.between(*floor.tried, *whole.tried);
    double fits = 0, fails = 1;
    for (int i = 0; i < 30; ++i) {
      const double middle = (fits + fails) / 2;
      (error.at(middle) <= limit_ ? fits : fails) = middle;
    }
    for (int i = 0; i < 8 && fits > 0; ++i, fits *= 0.9) {
      SlipOption option = runs_.run(beside_, runs_.plan(SlipLaw::steady, fits));
      if (option.merit.error() > limit_) continue;
      whole = std::move(option);
      return;
    }
    whole = floor;
  }

  // Without a device nothing is added, and nothing has to be certified.
  const SlipOption& best() const {
    std::vector<EvaluatedOption> evaluated;
    std::vector<const SlipOption*> within;
    for (const SlipOption& option : options_) {
      const SlipLawMerit& merit = option.merit;
      if (!is_within(merit.error(), limit_)) continue;
      within.push_back(&option);
      const std::optional<double> added =
          runs_.is_ideal() && merit.minimum_damping ? std::optional(0.0) : merit.minimum_damping;
      evaluated.push_back(
          {merit.mean_damping, merit.error(), added, runs_.is_ideal() || merit.certified, merit.motor_noise});
    }
    return *within[choose_faithful(evaluated, limit_).chosen];
  }

  SlipDecomposition with_figures(const SlipOption& best) const {
    SlipDecomposition slips = best.made.decomposition.slips;
    slips.limit = limit_;
    slips.least_error = least_;
    slips.error = best.merit.error();
    slips.runs = best.runs;
    for (const SlipOption& option : options_) slips.merits.push_back(option.merit);
    if (options_.size() == 1) return with_reasons(std::move(slips), "");
    const std::string reason = fmt::format(
        "of the slip rules with an error of up to {:.3g} %, the one with the largest mean damping of the brake, "
        "{:.3g} {}; its error is {:.3g} %",
        100 * limit_, best.merit.mean_damping, port_units(best.made.network.port_motion).damping,
        100 * best.merit.error());
    return with_reasons(std::move(slips), reason);
  }

  SlipRuns& runs_;
  const Candidate& beside_;
  const Choices& choices_;
  std::vector<SlipOption> options_;
  double least_ = 0, limit_ = 0;
};

SlipDecomposition asked_for(SlipRuns& runs, const Candidate& beside, SlipLaw law) {
  if (runs.is_ideal())
    return with_reasons(runs.made_with_room(beside, runs.plan(law)).decomposition.slips, "asked for");
  const SlipOption option = runs.run(beside, runs.plan(law));
  SlipDecomposition slips = option.made.decomposition.slips;
  slips.limit = slips.least_error = slips.error = option.merit.error();
  slips.runs = option.runs;
  slips.merits = {option.merit};
  return with_reasons(std::move(slips), "asked for");
}

// Whether tunable parameters cost another damping beside the slips the certificate that the present one has.
bool is_lost_over_box(const Compilation& c, const Candidate& other, const Choices& choices) {
  if (c.decomposition.choice().certified != true) return false;
  Decomposition changed = c.decomposition;
  changed.choice() = other;
  return !is_certified_over_box(c.network, c.present, c.form, changed, choices, c.port, c.rate);
}

}  // namespace

void choose_slip_law(Compilation& c, const SlipDecomposer& behind_slips, const Choices& choices) {
  SlipRuns runs(c, behind_slips, choices);
  Candidate beside = c.decomposition.choice();
  SlipDecomposition slips;
  if (const std::optional<SlipLaw> asked = slip_law_asked_for(choices)) {
    slips = asked_for(runs, beside, *asked);
  } else if (runs.laws().size() == 1 && runs.is_ideal()) {
    slips = with_reasons(runs.decomposed(beside, runs.plan(SlipLaw::velocity_free)), "");
  } else {
    slips = SlipChooser(runs, beside, choices).chosen();
    // The damping beside them was chosen over the band alone, while all slips hold. Where the runs with it keep to the
    // tolerance too, it stays.
    if (beside.faithful && !runs.is_ideal() && !is_within(slips.error, choices.tolerance)) {
      const Candidate other = choose_beside_slips(c, choices, runs);
      if (!is_lost_over_box(c, other, choices)) {
        slips = SlipChooser(runs, other, choices).chosen(other.faithful->least_error);
        c.decomposition.choice() = other;
      }
    }
  }
  c.decomposition.slips = std::move(slips);
}

double damping_on_another_device(const Compilation& c, const SlipDecomposer& behind_slips, const Choices& choices) {
  Compilation one = c;
  Candidate& beside = one.decomposition.choice();
  if (!beside.faithful) return beside.damping;
  std::erase_if(beside.state_inputs,
                [&](const StateInputMerit& merit) { return merit.state_input != beside.state_input; });
  SlipLaw law = SlipLaw::velocity_free;
  for (const ComponentSplit* split : c.decomposition.slips.all())
    if (split->law != law) law = split->law;
  SlipRuns runs(one, behind_slips, choices);
  runs.keep_to(law);
  if (is_within(runs.run(beside, runs.plan(law)).merit.error(), choices.tolerance)) return beside.damping;
  return choose_beside_slips(one, choices, runs).damping;
}

}  // namespace dashpot::compiler
