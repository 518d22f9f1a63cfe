#include "certify/tunable_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "certify/curve_bound.hpp"
#include "certify/settle.hpp"
#include "discretise/discretise.hpp"

namespace dashpot::compiler {
namespace {

class BoxChoice {
 public:
  BoxChoice(const Network& network, const Network& present, const NormalForm& form, const Decomposition& decomposition,
            const Choices& choices, const PortDevice& port, double rate)
      : network_(network),
        present_(present),
        form_(form),
        decomposition_(decomposition),
        choices_(choices),
        port_(port),
        rate_(rate),
        settler_(present_, form, decomposition_, choices, port, rate) {}

  struct Weighed {
    Candidate candidate;
    EvaluatedOption option;
  };

  // Empty if no such law can be written.
  std::optional<Weighed> weighed(const Candidate& faithful, double damping) {
    Weighed result{faithful, {}};
    settler_.place(result.candidate, damping);
    Decomposition tried = decomposition_;
    tried.choice() = result.candidate;
    Diagnostics of_trial;  // a damping at which no law can be written is not chosen
    std::optional<UpdateLaw> law =
        discretise_tunable(network_, present_, form_, tried, choices_, rate_, port_, of_trial);
    if (!law) return std::nullopt;
    const SampledLoop loop = sampled_loop(port_, 1 / rate_);
    const std::optional<SlipMotor> slips = slip_motor(network_, form_, tried, choices_, loop);
    const Certificate certificate = network_.map ? certify_behind_curve(*law, network_, slips, port_, 1 / rate_)
                                                 : certify_in_search(*law, loop, slips);
    Candidate& candidate = result.candidate;
    candidate.extra_damping_any_delay = candidate.state_inputs.front().extra_damping_any_delay;
    candidate.largest_error = settler_.largest_error(candidate, port_.behind_curve(certificate.added_damping));
    candidate.certified = certificate.certified;
    candidate.minimum_damping.reset();
    if (certificate.bound.proof != Proof::none) candidate.minimum_damping = certificate.minimum_damping;
    result.option = {damping, candidate.largest_error, candidate.minimum_damping, certificate.certified,
                     candidate.motor_noise};
    return result;
  }

 private:
  const Network& network_;
  const Network& present_;
  const NormalForm& form_;
  const Decomposition& decomposition_;
  const Choices& choices_;
  const PortDevice& port_;
  double rate_;
  CandidateSettler settler_;
};

}  // namespace

void choose_over_box(const Network& network, const Network& present, const NormalForm& form,
                     Decomposition& decomposition, const Choices& choices, const PortDevice& port, double rate) {
  if (!has_tunables(network)) return;
  constexpr int halvings = 3;  // of the interval to the next larger damping that was tried
  constexpr double none = std::numeric_limits<double>::infinity();
  constexpr double same = 1e-6;  // relative: two dampings that differ by less are one
  const Candidate& faithful = decomposition.choice();
  const double feedthrough = to_double(form.linear.feedthrough_damping);
  const double most = std::min(feedthrough, port.max_damping().value_or(feedthrough));
  BoxChoice box(network, present, form, decomposition, choices, port, rate);
  std::vector<Candidate> candidates;
  std::vector<EvaluatedOption> options;
  const auto look_at = [&](double damping) {
    for (const EvaluatedOption& known : options)
      if (std::abs(known.damping - damping) <= same * std::max(known.damping, damping)) return;
    const auto weighed = box.weighed(faithful, damping);
    if (!weighed) return;
    candidates.push_back(weighed->candidate);
    options.push_back(weighed->option);
  };
  look_at(faithful.damping);
  for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) look_at(share * most);
  if (options.empty()) return;
  FaithfulChoice choice = choose_faithful(options, choices.tolerance);
  for (int i = 0; i < halvings; ++i) {
    const double chosen = options[choice.chosen].damping;
    double next = none;
    for (const EvaluatedOption& option : options)
      if (option.damping > chosen) next = std::min(next, option.damping);
    if (next == none) break;
    look_at((chosen + next) / 2);
    choice = choose_faithful(options, choices.tolerance);
  }
  decomposition.choice() = candidates[choice.chosen];
  decomposition.choice().faithful = choice;
}

bool is_certified_over_box(const Network& network, const Network& present, const NormalForm& form,
                           const Decomposition& decomposition, const Choices& choices, const PortDevice& port,
                           double rate) {
  if (!has_tunables(network)) return true;
  const Candidate& choice = decomposition.choice();
  const auto weighed =
      BoxChoice(network, present, form, decomposition, choices, port, rate).weighed(choice, choice.damping);
  return weighed && weighed->option.certified;
}

}  // namespace dashpot::compiler
