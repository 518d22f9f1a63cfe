// Evaluates the candidates by the damping that the sampled loop needs, and makes the choices that depend on it: the
// state input of `auto`, and how much of a capped damping the motor makes (theory, sections 4 and 6).
#pragma once

#include <map>
#include <memory>
#include <utility>

#include "certify/certificate.hpp"
#include "certify/curve_bound.hpp"
#include "certify/faithful_search.hpp"
#include "linear/normal_form.hpp"

namespace dashpot::compiler {

class CandidateSettler {
 public:
  CandidateSettler(const Network& network, const NormalForm& form, const Decomposition& decomposition,
                   const Choices& choices, const PortDevice& device, double rate);

  // Gives every state input its minimum damping and the error of what is felt. On a device, takes the one that needs
  // least, then the one with the least error, then position. Where damping and minimum damping together are beyond the
  // brake, lowers the damping, and leaves more to the motor, until they fit; where nothing fits, leaves it.
  // `faithful` gets its damping and its state input by faithful_rule.hpp.
  void settle(Candidate& candidate);

  // The error of what is felt of a settled candidate, at each of the frequencies [Hz], [1]; empty without a device.
  // `added`: the damping added for passivity, if it is not the one that settle() found [N·s/m].
  struct ErrorOverBand {
    std::vector<double> frequencies, errors;
  };
  ErrorOverBand error_over_band(const Candidate& candidate, std::optional<double> added = std::nullopt);

  // Gives a candidate another damping, without what settle() and settle_at() compute.
  void place(Candidate& candidate, double damping);
  // Like settle(), but keeps the candidate's damping and state input.
  void settle_at(Candidate& candidate);
  // By default the extra damping that jitter needs beyond what is necessary (proved_bound.hpp) is looked up at the
  // damping that settle() chooses; after this call it is taken to be `gap`.
  void assume_jitter_gap(double gap);
  double last_jitter_gap() const { return gap_.value_or(1); }  // for the candidate that was settled last
  // The largest error over the band of what is felt [1], with `added` on top of the candidate's damping [N·s/m].
  double largest_error(const Candidate& candidate, double added);

 private:
  void settle_faithful(Candidate& candidate);
  void settle_named(Candidate& candidate);
  const FeltError& felt(StateInput input);
  double added_in(const StateInputMerit& merit) const;
  bool is_within_brake(double damping, PassivityBound needed) const;
  double least_brake(double beside) const;
  SearchReach reach() const;
  UpdateLaw law_without_brake(const Network& network, StateInput input) const;
  const std::optional<MotorConstants>& without_brake(StateInput input);
  PassivityBound bound(StateInput input, double damping, std::size_t terms = most_terms);
  std::optional<MotorConstants> motor_at(StateInput input, double damping);
  double gap_of(StateInput input) const;
  bool is_changed_by_look(StateInput input, double damping);
  PassivityBound behind_curve(MotorConstants motor, double damping);
  void weigh(Candidate& candidate, StateInputMerit& merit);
  void take(Candidate& candidate, const StateInputMerit& merit);
  void make_room(Candidate& candidate);
  std::optional<double> largest_fitting(StateInput input, double most);

  const Network& network_;
  const NormalForm& form_;
  const Decomposition& decomposition_;
  const Choices& choices_;
  const PortDevice& device_;
  double rate_;
  SampledLoop loop_;
  std::optional<SlipMotor> slips_;
  std::map<StateInput, std::optional<MotorConstants>> motors_;
  std::map<StateInput, std::unique_ptr<FeltError>> felt_;
  std::map<std::pair<StateInput, double>, double> looks_;  // gaps that jitter causes, by damping
  std::vector<CurveStretch> curve_stretches_;              // of the network's map, on the device
  std::map<StateInput, double> gaps_;                      // for the present candidate
  std::optional<double> gap_;                              // for state inputs without an entry in gaps_
  bool looks_at_gaps_ = true;
};

}  // namespace dashpot::compiler
