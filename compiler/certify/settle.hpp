// The candidates weighed by what the sampled loop needs, and with it the choices that hang on it: the state input of
// `auto`, and how much of a capped damping the motor makes (theory, sections 4 and 6).
#pragma once

#include <map>

#include "certify/certificate.hpp"
#include "linear/normal_form.hpp"

namespace dashpot::compiler {

class CandidateSettler {
 public:
  CandidateSettler(const Network& network, const NormalForm& form, const Decomposition& decomposition,
                   const Choices& choices, const PortDevice& device, double rate);

  // Gives every state input its minimum damping. On a device, takes the one that needs least, then the one with the
  // least error, then position. Where damping and minimum damping together are beyond the brake, lowers the damping,
  // and leaves more to the motor, until they fit; where nothing fits, leaves it.
  void settle(Candidate& candidate);

 private:
  const std::optional<MotorConstants>& without_brake(StateInput input);
  PassivityBound bound(StateInput input, double damping, std::size_t terms = most_terms);
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
};

}  // namespace dashpot::compiler
