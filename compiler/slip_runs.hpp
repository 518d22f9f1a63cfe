// One way to share a network with slips between brake and motor - what is beside the slips, and a law behind them -
// made, certified and run.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certify/sampled_loop.hpp"
#include "decompose/slip_laws.hpp"
#include "emit/emission.hpp"
#include "slip_trial.hpp"

namespace dashpot::compiler {

// What is felt with a law in the test motions.
struct TriedLaw {
  UpdateLaw law;
  std::vector<FeltForce> felt;  // one a motion
  TrialError error;
};

struct SlipOption {
  SlipPlan plan;
  Compilation made;
  std::shared_ptr<const TriedLaw> tried;
  SlipLawMerit merit;
  std::vector<SlipRunError> runs;
};

class SlipRuns {
 public:
  // In: a network with slips and what is chosen for what reaches ground without one. All outlive this.
  SlipRuns(const Compilation& c, const SlipDecomposer& behind_slips, const Choices& choices);

  SlipPlan plan(SlipLaw law, double excess = 1) const { return {law, excess, gain_}; }
  // velocity_free first, then the others that some part can have.
  const std::vector<SlipLaw>& laws() const { return laws_; }
  // Restricts laws() to this one.
  void keep_to(SlipLaw law) { laws_ = {law}; }
  bool is_ideal() const { return device_.is_ideal(); }
  const Candidate& chosen_beside() const { return c_.decomposition.choice(); }

  SlipDecomposition decomposed(const Candidate& beside, const SlipPlan& plan) const;

  // By a plan. Where the brake has no room for what passivity adds, by the same with less of the brake, if that is
  // certified.
  Compilation made_with_room(const Candidate& beside, const SlipPlan& plan);

  // Made with room, and run through all motions.
  SlipOption run(const Candidate& beside, const SlipPlan& plan);

  // The error of what lies between two laws that were run.
  const ErrorBetween& between(const TriedLaw& first, const TriedLaw& second);

 private:
  std::shared_ptr<const TriedLaw> tried(const UpdateLaw& law);
  UpdateLaw by_motor(int times) const;
  UpdateLaw behind_curve(UpdateLaw law, double added_damping) const;
  Compilation made_by(const Candidate& beside, const SlipPlan& plan);
  std::optional<double> noise_of(const SlipDecomposition& slips) const;

  const Compilation& c_;
  const Choices& choices_;
  const PortDevice& device_;
  PortDevice at_tool_;
  const SlipDecomposer& behind_slips_;
  SampledLoop loop_;
  double gain_;
  std::vector<SlipLaw> laws_;
  UpdateLaw coarse_, fine_;
  std::optional<SlipTrial> trial_;  // made before the first run
  // All laws that were run: different plans often come to the same one.
  std::vector<std::shared_ptr<const TriedLaw>> tried_;
  std::map<std::pair<const TriedLaw*, const TriedLaw*>, ErrorBetween> between_;
  // Gaps of jitter (certify/proved_bound.hpp) as first found, so that a repeated run gives the same result.
  std::map<StateInput, double> gaps_;
};

}  // namespace dashpot::compiler
