#include "certify/settle.hpp"

#include <algorithm>
#include <cmath>

#include "certify/convex_search.hpp"
#include "certify/estimator_factors.hpp"
#include "certify/proved_bound.hpp"
#include "decompose/spectrum.hpp"
#include "discretise/discretise.hpp"
#include "discretise/law_writer.hpp"

namespace dashpot::compiler {
namespace {

// A search computes some hundred bounds. Each is an upper bound even if it is stopped early, so what fits it is safe.
constexpr std::size_t search_terms = most_terms / 10;

// Share of the bound over frequencies by which the storage function that proves it may be above it, and as much again
// for the search for that function, which is a search.
constexpr double proof_reserve = 2 * most_storage_excess;

constexpr double gap_tolerance = 2e-4;  // relative, of the extra damping that jitter needs

constexpr int most_looks = 4;  // recomputations of the damping that jitter needs, after a search with a wrong value

// Less by more than the precision of the bounds.
bool is_noticeably_less(double x, double y) { return x < y * (1 - 1e-6); }

bool is_better(const StateInputMerit& one, const StateInputMerit& other) {
  const double needed = one.minimum_damping.value_or(0), others = other.minimum_damping.value_or(0);
  if (is_noticeably_less(needed, others)) return true;
  if (is_noticeably_less(others, needed)) return false;
  return one.largest_error < other.largest_error * (1 - 1e-9);
}

}  // namespace

CandidateSettler::CandidateSettler(const Network& network, const NormalForm& form, const Decomposition& decomposition,
                                   const Choices& choices, const PortDevice& device, double rate)
    : network_(network),
      form_(form),
      decomposition_(decomposition),
      choices_(choices),
      device_(device),
      rate_(rate),
      loop_(sampled_loop(device, 1 / rate)),
      slips_(slip_motor(network, form, decomposition, choices, loop_)) {}

void CandidateSettler::settle(Candidate& candidate) {
  if (looks_at_gaps_) {
    gaps_.clear();
    gap_.reset();
    is_changed_by_look(candidate.state_input, std::min(candidate.damping, loop_.max_damping));
  }
  if (candidate.name == "faithful" && !device_.is_ideal()) settle_faithful(candidate);
  else settle_named(candidate);
}

void CandidateSettler::settle_named(Candidate& candidate) {
  for (StateInputMerit& merit : candidate.state_inputs) weigh(candidate, merit);
  const auto current = std::find_if(candidate.state_inputs.begin(), candidate.state_inputs.end(),
                                    [&](const auto& merit) { return merit.state_input == candidate.state_input; });
  const StateInputMerit* best = &*current;
  if (!device_.is_ideal()) {
    best = &candidate.state_inputs.front();
    for (const StateInputMerit& merit : candidate.state_inputs)
      if (is_better(merit, *best)) best = &merit;
  }
  take(candidate, *best);
  if (is_changed_by_look(candidate.state_input, candidate.damping)) settle_at(candidate);
  if (!device_.is_ideal()) make_room(candidate);
}

void CandidateSettler::settle_faithful(Candidate& candidate) {
  std::vector<SearchLine> lines;
  for (const StateInputMerit& merit : candidate.state_inputs)
    lines.push_back({merit.state_input, &felt(merit.state_input), [this, input = merit.state_input](double damping) {
                       const PassivityBound found = bound(input, damping, search_terms);
                       return found.proof == Proof::none ? std::nullopt : std::optional(found.needed);
                     }});
  FaithfulFind found = find_faithful(lines, reach(), choices_.tolerance, device_.velocity_noise());
  const auto is_to_be_found_anew = [&] {
    const FoundOption& it = found.options[found.choice.chosen];
    return is_changed_by_look(lines[it.line].state_input, it.option.damping);
  };
  for (int round = 0; round < most_looks && is_to_be_found_anew(); ++round)
    found = find_faithful(lines, reach(), choices_.tolerance, device_.velocity_noise());
  const FoundOption& chosen = found.options[found.choice.chosen];
  place(candidate, chosen.option.damping);
  candidate.state_input = lines[chosen.line].state_input;
  candidate.faithful = found.choice;
  settle_at(candidate);
}

void CandidateSettler::settle_at(Candidate& candidate) {
  for (StateInputMerit& merit : candidate.state_inputs) {
    weigh(candidate, merit);
    if (merit.state_input == candidate.state_input) take(candidate, merit);
  }
}

// The brake's least command in any regime; `beside` is the part that no slip changes.
double CandidateSettler::least_brake(double beside) const { return beside + (slips_ ? slips_->least_brake : 0); }

// What the brake gives, at the tool. Where a surface can be left, more than b∞ would have to be taken back by the motor
// in the samples of a touch, and nothing is added: the brake is off while the tool is free.
SearchReach CandidateSettler::reach() const {
  const double feedthrough = to_double(form_.linear.feedthrough_damping);
  SearchReach reach{feedthrough,
                    loop_.max_damping,
                    0,
                    assured_share(loop_).convert_to<double>(),
                    assured_damping(loop_, least_brake(0)).convert_to<double>(),
                    true,
                    proof_reserve};
  if (network_.contact) {
    reach.most = std::min(reach.most, feedthrough);
    reach.adds = false;
  } else if (slips_) {
    reach.besides = slips_->largest_brake;
  }
  return reach;
}

void CandidateSettler::place(Candidate& candidate, double damping) {
  candidate.damping = candidate.wanted_damping = damping;
  candidate.velocity_gain = std::abs(to_double(form_.linear.feedthrough_damping) - damping);
  if (const std::optional<double> noise = device_.velocity_noise())
    candidate.motor_noise = candidate.velocity_gain * *noise;
  for (StateInputMerit& merit : candidate.state_inputs) {
    const LinearForm& form = merit.state_input == StateInput::nodal ? decomposition_.realisation : form_.linear;
    merit.extra_damping_any_delay = extra_damping_any_delay(form, damping, merit.state_input, device_.tolerance());
  }
}

UpdateLaw CandidateSettler::law_without_brake(const Network& network, StateInput input) const {
  Decomposition single = decomposition_;
  single.choice().damping = 0;
  single.choice().state_input = input;
  return discretise(network, form_, single, choices_, rate_);
}

// The error is relative to the network with all slips holding, if their regimes are listed.
const FeltError& CandidateSettler::felt(StateInput input) {
  std::unique_ptr<FeltError>& known = felt_[input];
  if (known) return *known;
  Network touched = network_;
  touched.contact.reset();
  const UpdateLaw law = law_without_brake(touched, input);
  LinearForm whole = form_.linear;
  for (const ComponentSplit* split : decomposition_.slips.all())
    if (!split->regimes.regimes.empty()) whole = in_parallel(whole, split->regimes.regimes.front().form);
  return *(known = std::make_unique<FeltError>(linear_motor_constants(law), form_.linear, whole, loop_, device_));
}

// What the emitted law adds: all that is lacking, or nothing.
double CandidateSettler::added_in(const StateInputMerit& merit) const {
  if (!merit.minimum_damping || network_.contact) return 0;
  return merit.is_within_brake ? device_.behind_curve(*merit.minimum_damping) : 0;
}

double CandidateSettler::largest_error(const Candidate& candidate, double added) {
  return felt(candidate.state_input).largest(candidate.damping, added);
}

CandidateSettler::ErrorOverBand CandidateSettler::error_over_band(const Candidate& candidate,
                                                                  std::optional<double> added) {
  if (device_.is_ideal()) return {};
  for (const StateInputMerit& merit : candidate.state_inputs)
    if (merit.state_input == candidate.state_input)
      return {felt(merit.state_input).frequencies(),
              felt(merit.state_input).over_band(candidate.damping, added.value_or(added_in(merit)))};
  return {};
}

const std::optional<MotorConstants>& CandidateSettler::without_brake(StateInput input) {
  if (const auto known = motors_.find(input); known != motors_.end()) return known->second;
  const UpdateLaw law = law_without_brake(network_, input);
  const bool needs_whole = !network_.map && (network_.contact || !form_.has_slips());
  return motors_.emplace(input, needs_whole ? motor_constants(law) : linear_motor_constants(law)).first->second;
}

// b only changes the velocity gain, b∞ − b.
std::optional<MotorConstants> CandidateSettler::motor_at(StateInput input, double damping) {
  std::optional<MotorConstants> motor = without_brake(input);
  if (!motor) return motor;
  motor->velocity_gain -= rounded(Real(damping), choices_.scalar);
  return motor;
}

PassivityBound CandidateSettler::bound(StateInput input, double damping, std::size_t terms) {
  const std::optional<MotorConstants> motor = motor_at(input, damping);
  if (!motor) return passivity_bound(motor, loop_, terms);
  if (network_.map) return behind_curve(*motor, damping);
  const double gap = gap_of(input);
  if (!slips_) return bound_by_gap(*motor, loop_, gap, terms);
  return with_slips(bound_beside_slips_by_gap(*motor, *slips_, loop_, gap, terms), *slips_, loop_);
}

double CandidateSettler::gap_of(StateInput input) const {
  const auto known = gaps_.find(input);
  return known != gaps_.end() ? known->second : gap_.value_or(1);
}

// Whether the gap at this damping differs from the one that bound() has used; if so, bound() uses it from now on.
bool CandidateSettler::is_changed_by_look(StateInput input, double damping) {
  const bool is_asked_for = looks_at_gaps_ && needs_jitter_gap(loop_) && !network_.map;
  const std::optional<MotorConstants> motor = is_asked_for ? motor_at(input, damping) : std::nullopt;
  if (!motor || (slips_ && slips_->behind_contact)) return false;
  const auto [look, is_new] = looks_.try_emplace({input, damping});
  if (is_new) look->second = jitter_gap(*motor, loop_) * (1 + gap_tolerance);
  const double before = gap_of(input), is = look->second;
  if (is == before || std::abs(is - before) <= gap_tolerance * before) return false;
  gap_ = gaps_[input] = is;
  return true;
}

void CandidateSettler::assume_jitter_gap(double gap) {
  gap_ = gap;
  gaps_.clear();
  looks_at_gaps_ = false;
}

// The bound of a law without a map that would lack as much damping.
PassivityBound CandidateSettler::behind_curve(MotorConstants motor, double damping) {
  const PortDevice at_tool = device_.at_tool();
  const SampledLoop tool = sampled_loop(at_tool, loop_.sample_period);
  if (curve_stretches_.empty()) curve_stretches_ = curve_stretches(*network_.map, tool, at_tool.coil_lag());
  PassivityBound bound =
      bound_behind_curve(std::move(motor), damping, network_, slips_, at_tool, curve_stretches_, loop_);
  if (bound.proof == Proof::none) return bound;
  bound.needed = assured_damping(loop_, least_brake(damping)).convert_to<double>() +
                 lacking_behind_curve(bound, damping, *network_.map, tool);
  return bound;
}

void CandidateSettler::weigh(Candidate& candidate, StateInputMerit& merit) {
  const PassivityBound needed = bound(merit.state_input, candidate.damping);
  merit.proof = name_of(needed.proof);
  merit.binding_frequency = needed.frequency;
  merit.minimum_damping.reset();
  merit.is_within_brake = false;
  if (needed.proof != Proof::none) {
    merit.minimum_damping = missing_damping(needed, loop_, least_brake(candidate.damping)) / device_.behind_curve(1);
    merit.is_within_brake = is_within_brake(candidate.damping, needed);
  }
  if (!device_.is_ideal()) merit.largest_error = felt(merit.state_input).largest(candidate.damping, added_in(merit));
}

// Includes what the storage function may need beyond the bound over frequencies: near the brake's limit that decides
// whether there is a certificate.
bool CandidateSettler::is_within_brake(double damping, PassivityBound needed) const {
  const double largest_brake = damping + (slips_ ? slips_->largest_brake : 0);
  const double reach = device_.is_ideal() ? largest_brake : loop_.max_damping;
  if (!device_.is_ideal() && needed.proof == Proof::sampled) needed.needed *= 1 + proof_reserve;
  return largest_brake + missing_damping(needed, loop_, least_brake(damping)) <= reach;
}

void CandidateSettler::take(Candidate& candidate, const StateInputMerit& merit) {
  candidate.state_input = merit.state_input;
  candidate.largest_error = merit.largest_error;
  candidate.extra_damping_any_delay = merit.extra_damping_any_delay;
  candidate.minimum_damping = merit.minimum_damping;
  candidate.certified.reset();
  if (merit.minimum_damping) candidate.certified = merit.is_within_brake;
}

void CandidateSettler::make_room(Candidate& candidate) {
  if (!candidate.minimum_damping || candidate.certified == true || slips_) return;
  const double wanted = candidate.wanted_damping;
  std::optional<double> fitting = largest_fitting(candidate.state_input, candidate.damping);
  for (int round = 0; round < most_looks && fitting && is_changed_by_look(candidate.state_input, *fitting); ++round)
    fitting = largest_fitting(candidate.state_input, candidate.damping);
  if (!fitting) return;
  place(candidate, *fitting);
  candidate.wanted_damping = wanted;
  settle_at(candidate);
}

// The needed damping is convex in b, as the largest of functions that are convex in b, one for each frequency.
std::optional<double> CandidateSettler::largest_fitting(StateInput input, double most) {
  const double available = assured_damping(loop_, loop_.max_damping).convert_to<double>() / (1 + proof_reserve);
  const auto lack = [&](double damping) { return bound(input, damping, search_terms).needed - available; };
  const auto fits = [&](double damping) { return lack(damping) <= 0; };
  const double place = golden_section(lack, 0, most, 0, 1e-8).place;
  return fits(place) ? std::optional(boundary(fits, place, most, 1e-9)) : std::nullopt;
}

}  // namespace dashpot::compiler
