#include "slip_runs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "certify/certificate.hpp"
#include "certify/curve_bound.hpp"
#include "certify/estimator_factors.hpp"
#include "certify/proved_bound.hpp"
#include "discretise/discretise.hpp"
#include "lower/behind_map.hpp"

namespace dashpot::compiler {
namespace {

constexpr double gap_spread = 1 + 1e-3;  // by which the gap at another damping may be above the one that was looked at

}  // namespace

SlipRuns::SlipRuns(const Compilation& c, const SlipDecomposer& behind_slips, const Choices& choices)
    : c_(c),
      choices_(choices),
      device_(c.port),
      at_tool_(c.port.at_tool()),
      behind_slips_(behind_slips),
      loop_(sampled_loop(c.port, 1 / c.rate)),
      gain_(estimate_gain(loop_).value_or(std::numeric_limits<double>::infinity())) {
  for (const SlipLaw law : laws_to_choose_from) {
    const SlipDecomposition slips = decomposed(chosen_beside(), plan(law));
    const std::vector<const ComponentSplit*> all = slips.all();
    const bool is_offered =
        std::any_of(all.begin(), all.end(), [=](const ComponentSplit* split) { return split->law == law; });
    if (law == SlipLaw::velocity_free || is_offered) laws_.push_back(law);
  }
}

SlipDecomposition SlipRuns::decomposed(const Candidate& beside, const SlipPlan& plan) const {
  return behind_slips_.decomposed(beside, plan, device_);
}

Compilation SlipRuns::made_with_room(const Candidate& beside, const SlipPlan& plan) {
  Compilation whole = made_by(beside, plan);
  if (device_.is_ideal() || c_.network.contact || whole.certificate.certified) return whole;
  SlipPlan roomy = plan;
  const Certificate* last = &whole.certificate;
  Compilation made;
  // What passivity adds falls with what the motor takes back, but for what the sums round.
  for (int attempt = 0; attempt < 4 && last->bound.proof != Proof::none; ++attempt) {
    roomy.reserve = std::max(roomy.reserve, device_.behind_curve(last->minimum_damping)) * (1 + 1e-9);
    made = made_by(beside, roomy);
    if (made.certificate.certified) return made;
    last = &made.certificate;
  }
  return whole;
}

std::shared_ptr<const TriedLaw> SlipRuns::tried(const UpdateLaw& law) {
  UpdateLaw key = law;
  key.state_input = StateInput::position;  // says how its constants were found; a run does not read it
  for (const std::shared_ptr<const TriedLaw>& known : tried_)
    if (known->law == key) return known;
  if (!trial_) {
    coarse_ = by_motor(1);
    fine_ = behind_curve(by_motor(SlipTrial::instants_a_sample(device_)), 0);
    trial_.emplace(c_.network, coarse_, fine_, at_tool_);
  }
  TriedLaw now{std::move(key), {}, {}};
  for (std::size_t m = 0; m < trial_->motions().size(); ++m) now.felt.push_back(trial_->felt(law, m));
  now.error = trial_error(*trial_, now.felt);
  return tried_.emplace_back(std::make_shared<const TriedLaw>(std::move(now)));
}

const ErrorBetween& SlipRuns::between(const TriedLaw& first, const TriedLaw& second) {
  return between_.try_emplace({&first, &second}, *trial_, first.felt, second.felt).first->second;
}

SlipOption SlipRuns::run(const Candidate& beside, const SlipPlan& plan) {
  SlipOption option{plan, made_with_room(beside, plan), {}, {}, {}};
  option.merit.law = plan.law;
  const Compilation& made = option.made;
  option.tried = tried(made.law);
  double dissipated = 0, square = 0;
  for (const FeltForce& felt : option.tried->felt) {
    dissipated += felt.dissipated;
    square += felt.square_velocity;
  }
  const TrialError& error = option.tried->error;
  for (std::size_t m = 0; m < error.by_motion.size(); ++m)
    option.runs.push_back({trial_->motions()[m].name, error.by_motion[m]});
  SlipLawMerit& merit = option.merit;
  merit.peak_error = error.peak;
  merit.rms_error = error.rms;
  if (made.certificate.bound.proof != Proof::none) merit.minimum_damping = made.certificate.minimum_damping;
  merit.certified = made.certificate.certified;
  merit.mean_damping = square > 0 ? std::max(0.0, dissipated / square - made.certificate.added_damping) : 0;
  merit.motor_noise = noise_of(made.decomposition.slips);
  return option;
}

// The motor makes everything, at so many times the rate.
UpdateLaw SlipRuns::by_motor(int times) const {
  Decomposition whole = c_.decomposition;
  Candidate& choice = whole.choice();
  choice.damping = 0;
  choice.state_input = StateInput::position;
  whole.encoder_step = 0;
  whole.slips = decomposed(chosen_beside(), plan(SlipLaw::by_motor));
  return discretise(c_.network, c_.form, whole, choices_, c_.rate * times);
}

UpdateLaw SlipRuns::behind_curve(UpdateLaw law, double added_damping) const {
  const std::optional<MotionMap>& map = c_.network.map;
  return map ? behind_map(std::move(law), *map, added_damping, c_.network.port_motion) : law;
}

Compilation SlipRuns::made_by(const Candidate& beside, const SlipPlan& plan) {
  Compilation made = c_;
  made.decomposition.choice() = beside;
  made.decomposition.slips = decomposed(beside, plan);
  made.law = discretise(made.network, made.form, made.decomposition, choices_, made.rate);
  const auto slips = slip_motor(made.network, made.form, made.decomposition, choices_, loop_);
  if (made.network.map) {
    made.certificate = certify_behind_curve(made.law, made.network, slips, device_, made.law.sample_period);
    made.law = behind_curve(std::move(made.law), made.certificate.added_damping);
    return made;
  }
  if (!slips || made.law.tunable) {
    made.certificate = certify_in_search(made.law, loop_, slips);
    return made;
  }
  auto gap = gaps_.find(beside.state_input);
  if (gap == gaps_.end())
    gap = gaps_.emplace(beside.state_input, jitter_gap(linear_motor_constants(made.law), loop_) * gap_spread).first;
  made.certificate = weighed_by_gap(made.law, loop_, *slips, gap->second);
  return made;
}

std::optional<double> SlipRuns::noise_of(const SlipDecomposition& slips) const {
  double compensation = 0;
  for (const ComponentSplit* split : slips.all()) compensation += split->largest_compensation();
  const std::optional<double> noise = device_.velocity_noise();
  if (compensation == 0) return 0;
  return noise ? std::optional(compensation * *noise) : std::nullopt;
}

}  // namespace dashpot::compiler
