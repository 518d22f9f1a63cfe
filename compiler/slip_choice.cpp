#include "slip_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "certify/certificate.hpp"
#include "certify/estimator_factors.hpp"
#include "decompose/faithful_rule.hpp"
#include "decompose/slip_laws.hpp"
#include "discretise/discretise.hpp"
#include "network/port_units.hpp"
#include "slip_trial.hpp"

namespace dashpot::compiler {
namespace {

struct Option {
  SlipPlan plan;
  Compilation made;
  std::vector<FeltForce> felt;  // one a motion
  SlipLawMerit merit;
};

class SlipChooser {
 public:
  SlipChooser(const Compilation& c, const Choices& choices, const PortDevice& device)
      : c_(c),
        choices_(choices),
        device_(device),
        loop_(sampled_loop(device, 1 / c.rate)),
        gain_(estimate_gain(loop_).value_or(std::numeric_limits<double>::infinity())) {}

  SlipDecomposition decomposed(const SlipPlan& plan) const {
    return decompose_slips(c_.network, c_.form, c_.decomposition.choice(), plan, device_);
  }
  SlipPlan plan(SlipLaw law, double excess = 1) const { return {law, excess, gain_}; }

  // True where some part can have a law.
  bool is_offered(SlipLaw law) const {
    const SlipDecomposition slips = decomposed(plan(law));
    const std::vector<const ComponentSplit*> all = slips.all();
    return std::any_of(all.begin(), all.end(), [=](const ComponentSplit* split) { return split->law == law; });
  }

  // Where nothing else can be had the reason is why not.
  static SlipDecomposition with_reasons(SlipDecomposition slips, const std::string& reason) {
    for (std::vector<ComponentSplit> SlipDecomposition::*parts :
         {&SlipDecomposition::components, &SlipDecomposition::networks})
      for (ComponentSplit& split : slips.*parts)
        if (split.reason.empty()) split.reason = reason.empty() ? split.offers.back().refusal : reason;
    return slips;
  }

  SlipDecomposition chosen() {
    std::vector<SlipLaw> laws;
    for (const SlipLaw law : laws_to_choose_from)
      if (law == SlipLaw::velocity_free || is_offered(law)) laws.push_back(law);
    if (laws.size() == 1) return with_reasons(decomposed(plan(SlipLaw::velocity_free)), "");
    const UpdateLaw coarse = by_motor(1), fine = by_motor(SlipTrial::instants_a_sample(device_));
    const SlipTrial trial(c_.network, coarse, fine, device_, c_.network.contact ? c_.network.contact->at : 0);
    for (const SlipLaw law : laws) options_.push_back(run(plan(law), trial));
    std::optional<Option> floor;  // of the steady law, nothing beyond the largest b∞
    if (std::find(laws.begin(), laws.end(), SlipLaw::steady) != laws.end())
      floor = run(plan(SlipLaw::steady, 0), trial);
    least_ = least_error(floor);
    limit_ = allowed_error(choices_.tolerance, least_);
    if (floor) fit_steady(*floor, trial);
    return with_figures(best());
  }

  // By a plan. Where the brake has no room for what passivity adds, by the same with less of the brake, if that is
  // certified.
  Compilation made_with_room(const SlipPlan& plan) const {
    Compilation whole = made_by(plan);
    if (device_.is_ideal() || c_.network.contact || whole.certificate.certified) return whole;
    SlipPlan roomy = plan;
    const Certificate* last = &whole.certificate;
    Compilation made;
    // What passivity adds falls with what the motor takes back, but for what the sums round.
    for (int attempt = 0; attempt < 4 && last->bound.proof != Proof::none; ++attempt) {
      roomy.reserve = std::max(roomy.reserve, last->minimum_damping) * (1 + 1e-9);
      made = made_by(roomy);
      if (made.certificate.certified) return made;
      last = &made.certificate;
    }
    return whole;
  }

 private:
  // The least reachable; an error that only laws reach which are not certified shuts out none that is.
  double least_error(const std::optional<Option>& floor) const {
    double least = std::numeric_limits<double>::infinity(), least_certified = least;
    const auto look_at = [&](const Option& option) {
      least = std::min(least, option.merit.error());
      if (option.merit.certified) least_certified = std::min(least_certified, option.merit.error());
    };
    for (const Option& option : options_) look_at(option);
    if (floor) look_at(*floor);
    return device_.is_ideal() || std::isinf(least_certified) ? least : least_certified;
  }

  // The motor makes everything, at so many times the rate.
  UpdateLaw by_motor(int times) const {
    Decomposition whole = c_.decomposition;
    whole.candidates[whole.chosen].damping = 0;
    whole.candidates[whole.chosen].state_input = StateInput::position;
    whole.encoder_step = 0;
    whole.slips = decomposed(plan(SlipLaw::by_motor));
    return discretise(c_.network, c_.form, whole, choices_, c_.rate * times);
  }

  Compilation made_by(const SlipPlan& plan) const {
    Compilation made = c_;
    made.decomposition.slips = decomposed(plan);
    made.law = discretise(made.network, made.form, made.decomposition, choices_, made.rate);
    made.certificate =
        certify(made.law, loop_, slip_motor(made.network, made.form, made.decomposition, choices_, loop_));
    return made;
  }

  Option run(const SlipPlan& plan, const SlipTrial& trial) const {
    Option option{plan, made_with_room(plan), {}, {}};
    option.merit.law = plan.law;
    const Compilation& made = option.made;
    double dissipated = 0, square = 0;
    for (std::size_t m = 0; m < trial.motions().size(); ++m) {
      option.felt.push_back(trial.felt(made.law, m));
      dissipated += option.felt.back().dissipated;
      square += option.felt.back().square_velocity;
    }
    const TrialError error = trial_error(trial, option.felt);
    SlipLawMerit& merit = option.merit;
    merit.peak_error = error.peak;
    merit.rms_error = error.rms;
    merit.minimum_damping = made.certificate.minimum_damping;
    merit.certified = made.certificate.certified;
    merit.mean_damping = square > 0 ? std::max(0.0, dissipated / square - made.certificate.added_damping) : 0;
    merit.motor_noise = noise_of(made.decomposition.slips);
    return option;
  }

  std::optional<double> noise_of(const SlipDecomposition& slips) const {
    double compensation = 0;
    for (const ComponentSplit* split : slips.all()) compensation += split->largest_compensation();
    const std::optional<double> noise = device_.velocity_noise();
    if (compensation == 0) return 0;
    return noise ? std::optional(compensation * *noise) : std::nullopt;
  }

  // What is felt is linear in the excess, so between none and all of it the largest that keeps to the limit is found
  // without further runs; that one is run to be sure.
  void fit_steady(const Option& floor, const SlipTrial& trial) {
    Option& whole = *std::find_if(options_.begin(), options_.end(),
                                  [](const Option& option) { return option.plan.law == SlipLaw::steady; });
    if (whole.merit.error() <= limit_ || floor.merit.error() > limit_) return;
    double fits = 0, fails = 1;
    for (int i = 0; i < 30; ++i) {
      const double middle = (fits + fails) / 2;
      (trial_error(trial, between(floor, whole, middle)).worst() <= limit_ ? fits : fails) = middle;
    }
    for (int i = 0; i < 8 && fits > 0; ++i, fits *= 0.9) {
      Option option = run(plan(SlipLaw::steady, fits), trial);
      if (option.merit.error() > limit_) continue;
      whole = std::move(option);
      return;
    }
    whole = floor;
  }

  static std::vector<FeltForce> between(const Option& none, const Option& all, double share) {
    std::vector<FeltForce> felt = none.felt;
    for (std::size_t m = 0; m < felt.size(); ++m)
      for (std::vector<double> FeltForce::*end : {&FeltForce::weak, &FeltForce::strong})
        for (std::size_t i = 0; i < (felt[m].*end).size(); ++i)
          (felt[m].*end)[i] += share * ((all.felt[m].*end)[i] - (felt[m].*end)[i]);
    return felt;
  }

  // Without a device nothing is added, and nothing has to be certified.
  const Option& best() const {
    std::vector<EvaluatedOption> evaluated;
    std::vector<const Option*> within;
    for (const Option& option : options_) {
      const SlipLawMerit& merit = option.merit;
      if (merit.error() > limit_) continue;
      within.push_back(&option);
      const bool is_proved = option.made.certificate.bound.proof != Proof::none;
      const double added = device_.is_ideal() ? 0 : merit.minimum_damping;
      evaluated.push_back({merit.mean_damping, merit.error(), is_proved ? std::optional(added) : std::nullopt,
                           device_.is_ideal() || merit.certified, merit.motor_noise});
    }
    return *within[choose_faithful(evaluated, limit_).chosen];
  }

  SlipDecomposition with_figures(const Option& best) const {
    SlipDecomposition slips = best.made.decomposition.slips;
    slips.limit = limit_;
    slips.least_error = least_;
    slips.error = best.merit.error();
    for (const Option& option : options_) slips.merits.push_back(option.merit);
    const std::string reason = fmt::format(
        "the largest brake, {:.3g} {} on average, of the laws that err by no more than {:.3g} % in a run: {:.3g} %",
        best.merit.mean_damping, port_units(c_.network.port_motion).damping, 100 * limit_, 100 * best.merit.error());
    return with_reasons(std::move(slips), reason);
  }

  const Compilation& c_;
  const Choices& choices_;
  const PortDevice& device_;
  SampledLoop loop_;
  double gain_;
  std::vector<Option> options_;
  double least_ = 0, limit_ = 0;
};

}  // namespace

void choose_slip_law(Compilation& c, const Choices& choices, const PortDevice& device) {
  SlipChooser chooser(c, choices, device);
  const std::optional<SlipLaw> asked = slip_law_asked_for(choices);
  SlipDecomposition slips =
      asked ? SlipChooser::with_reasons(chooser.made_with_room(chooser.plan(*asked)).decomposition.slips, "asked for")
            : chooser.chosen();
  c.decomposition.slips = std::move(slips);
}

}  // namespace dashpot::compiler
