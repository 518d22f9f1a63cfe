#include "insist.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dashpot/estimators/estimator_names.hpp>
#include <functional>
#include <future>
#include <initializer_list>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "certify/choice_text.hpp"
#include "certify/settle.hpp"
#include "compile.hpp"
#include "network/law.hpp"
#include "network/port_units.hpp"
#include "slip_runs.hpp"

namespace dashpot::compiler {
namespace {

constexpr double some_more = 1 + 1e-9;  // than what is needed, which is rounded
constexpr double noticeably = 0.9;      // of an error, what is worth another choice [1]
constexpr double ruinous = 0.5;         // of the network's force: what errs by so much feels like something else [1]

// What makes a loop late, and a device without it in words.
struct Lateness {
  const char* without_it;
  void (*leave_out)(device_description&);
};

const Lateness amplifier_lag{"its motor's amplifier had no lag (\"amplifier_lag\")",
                             [](device_description& d) { d.motor.amplifier_lag = 0; }};
const Lateness loop_delay{"its loop had no delay (\"delay_samples\")",
                          [](device_description& d) { d.loop.delay_samples = 0; }};
const Lateness write_delay{"its commands acted at once (\"write_delay\")",
                           [](device_description& d) { d.loop.write_earliest = d.loop.write_latest = 0; }};
const Lateness limited_slew{"its motor's force could change at once (\"slew\")",
                            [](device_description& d) { d.motor.slew = 0; }};

// The network compiled on another device, or another network on the same: whatever is recommended has been tried.
std::optional<Compilation> compiled(const Network& network, Choices choices, const Device& device) {
  Diagnostics of_trial;  // what does not compile is not recommended
  StageTimes unseen;
  choices.compared = Compared::nothing;
  return compile(network, choices, device, of_trial, unseen);
}

// Of what is felt: in the band or, where slips give way, in the test motions.
struct WorstError {
  double share;       // [1]
  const char* where;  // empty where there are no such runs
};

WorstError felt_error(const Compilation& c) {
  const double in_band = c.decomposition.choice().largest_error, in_runs = c.decomposition.slips.error;
  if (c.decomposition.slips.merits.empty()) return {in_band, ""};
  return in_runs > in_band ? WorstError{in_runs, " where slips yield"} : WorstError{in_band, " in the band"};
}

// "77.5 % where slips yield"
std::string in_words(const WorstError& error) { return in_percent(error.share) + " %" + error.where; }

// What has been tried and is certified.
struct Remedy {
  double value;
  WorstError error;  // of what is felt with it
};

// With what is felt; empty where it is not certified.
std::optional<WorstError> error_where_certified(const Network& network, const Choices& choices, const Device& device) {
  const std::optional<Compilation> again = compiled(network, choices, device);
  return again && again->certificate.certified ? std::optional(felt_error(*again)) : std::nullopt;
}

bool is_proved_at_the_limit(const std::optional<Compilation>& c) {
  return c && c->certificate.certified && c->certificate.limits.is_covered;
}

double as_told(double value, int digits) { return std::stod(fmt::format("{:.{}g}", value, digits)); }

// Of the last of so many digits.
double unit_of_last(double value, int digits) { return std::pow(10, std::floor(std::log10(value)) + 1 - digits); }

double rounded_up(double value, int digits) {
  const double unit = unit_of_last(value, digits);
  return as_told(std::ceil(value / unit * (1 - 1e-12)) * unit, digits);
}

double rounded_down(double value, int digits) {
  const double unit = unit_of_last(value, digits);
  return as_told(std::floor(value / unit * (1 + 1e-12)) * unit, digits);
}

// In as many digits as it takes to see which is larger, four at least.
std::pair<std::string, std::string> told_apart(double x, double y) {
  std::pair<std::string, std::string> told;
  for (int digits = 4; digits <= 17 && told.first == told.second; ++digits)
    told = {fmt::format("{:.{}g}", x, digits), fmt::format("{:.{}g}", y, digits)};
  return told;
}

// `damping` in the device's own unit. One without a brake gets one.
Device with_brake(Device device, double damping) {
  if (device.description.brake.kind == brake_kind::none) device.description.brake.kind = brake_kind::eddy_current;
  device.description.brake.max_damping = damping;
  return device;
}

// As the device file has it, in the device's own unit.
std::string brake_as_written(const Device& device, double damping) {
  const std::string value = fmt::format("{:.6g} {}", damping, port_units(device.description.motion).damping);
  return device.description.brake.kind == brake_kind::none
             ? fmt::format(R"("brake": {{ "kind": "eddy_current", "max_damping": "{}" }})", value)
             : fmt::format(R"("max_damping": "{}" in "brake")", value);
}

class Remedies {
 public:
  Remedies(const Compilation& c, const Choices& choices)
      : c_(c),
        choices_(choices),
        scale_(c.port.at_tool().replaced_by(with_brake(*c.device, 1)).max_damping().value_or(0)) {}

  // At the tool, in four digits: what the law as it is lacks, or somewhat more, since with a brake another b may be
  // chosen; else enough for everything that the law would command.
  std::optional<Remedy> brake(double enough) const {
    for (const double more : {1.0, 1.02, 1.2, 2.0, 4.0, 8.0, 16.0})
      if (const std::optional<Remedy> told = brake_as_told(more * enough)) return told;
    const std::optional<Compilation> unlimited = compiled(c_.network, choices_, with_brake_at_tool(1e30));
    return unlimited && unlimited->certificate.certified ? brake_as_told(unlimited->law.largest_damping) : std::nullopt;
  }

  // In the device's own unit, of a damping at the tool.
  double at_joint(double damping) const { return damping / scale_; }
  double at_tool(double damping) const { return damping * scale_; }

  // At the tool, in four digits: the damping of the device itself that is enough whatever the brake does, if the loop
  // is freed of `left_out`, the causes of its lateness in the words of the file.
  std::optional<Remedy> own_damping(const std::vector<Lateness>& left_out) const {
    Device device = without(left_out);
    mechanics_description& mechanics = device.description.mechanics;
    const double own = mechanics.damping;
    std::optional<Compilation> again = left_out.empty() ? std::nullopt : compiled(c_.network, choices_, device);
    if (again && again->certificate.certified) return Remedy{own * scale_, felt_error(*again)};  // the loop is enough
    mechanics.damping = own + 1e9;  // more than any network needs
    again = compiled(c_.network, choices_, device);
    if (!again || !again->certificate.certified) return std::nullopt;
    mechanics.damping = own;
    // With less damping another b may be chosen, which needs more.
    for (int attempt = 0; attempt < 4; ++attempt) {
      mechanics.damping =
          std::max(mechanics.damping, rounded_up(again->certificate.bound.needed * some_more, 4) / scale_);
      again = compiled(c_.network, choices_, device);
      if (again && again->certificate.certified) return Remedy{mechanics.damping * scale_, felt_error(*again)};
      if (!again) break;
    }
    return std::nullopt;
  }

  // In the device's own unit, in four digits: damping of the device itself for a law that keeps to its motor's limit.
  std::optional<Remedy> own_damping_at_the_limit() const {
    Device device = *c_.device;
    double& own = device.description.mechanics.damping;
    std::optional<MotorLimits> limits = c_.certificate.limits;
    // With more damping of its own another b may be chosen, which needs more.
    for (int attempt = 0; attempt < 4 && limits && limits->available; ++attempt) {
      const double lack = std::max(limits->needed - *limits->available, 0.0);
      own = rounded_up((own * scale_ + lack) * (1 + 1e-9) / scale_, 4);
      const std::optional<Compilation> again = compiled(c_.network, choices_, device);
      if (is_proved_at_the_limit(again)) return Remedy{own, felt_error(*again)};
      limits = again ? std::optional(again->certificate.limits) : std::nullopt;
    }
    return std::nullopt;
  }

  // Of all springs and dampers, in three digits. Behind a static curve it is the curve that says how large forces are.
  std::optional<Remedy> share(std::initializer_list<double> guesses) const {
    if (c_.network.static_curve || !c_.ports.empty()) return std::nullopt;
    for (const double guess : guesses)
      for (const double careful : {1.0, 0.9, 0.75, 0.5}) {
        if (!(guess * careful > 1e-6 && guess * careful < 1)) continue;
        const double told = rounded_down(guess * careful, 3);
        if (const auto error = error_where_certified(scaled(told), choices_, *c_.device)) return Remedy{told, *error};
      }
    return std::nullopt;
  }

  // The largest of a half, a quarter or an eighth of the device's own, in four digits [s]. Without any, a law behind an
  // amplifier's lag would be certified for a constant period only.
  std::optional<Remedy> jitter() const {
    Device calmer = *c_.device;
    const double own = calmer.description.loop.jitter;
    for (const double share : {0.5, 0.25, 0.125}) {
      if (own == 0) break;
      const double told = as_told(share * own * 1e3, 4) * 1e-3;
      calmer.description.loop.jitter = told;
      if (!may_do(calmer)) continue;
      if (const auto error = error_where_certified(c_.network, choices_, calmer)) return Remedy{told, *error};
    }
    return std::nullopt;
  }

  // As the device file writes it; of those that every certificate knows. With what is felt.
  std::optional<std::pair<std::string, WorstError>> estimator() const {
    const auto error_with = [this](estimator_kind kind, unsigned window) -> std::optional<WorstError> {
      Device other = *c_.device;
      const velocity_description own = std::exchange(other.description.velocity, {});
      other.description.velocity.estimator = kind;
      other.description.velocity.window = window;
      if ((own.estimator == kind && own.window == window) || !may_do(other)) return std::nullopt;
      return error_where_certified(c_.network, choices_, other);
    };
    if (c_.device->description.loop.jitter > 0)
      if (const auto error = error_with(estimator_kind::interval_difference, 1))
        return std::pair(fmt::format(R"("estimator": "{}")", name_of(estimator_kind::interval_difference)), *error);
    for (const unsigned window : {15, 10, 5, 2, 1})
      if (const auto error = error_with(estimator_kind::backward_difference, window))
        return std::pair(
            fmt::format(R"("estimator": "{}", "window": {})", name_of(estimator_kind::backward_difference), window),
            *error);
    return std::nullopt;
  }

  // In the words of the file, what makes the loop late and would do if it were left out; each errs noticeably less than
  // the one before.
  std::vector<std::pair<std::string, WorstError>> prompt_loops() const {
    std::vector<std::pair<std::string, WorstError>> all;
    const device_description& own = c_.device->description;
    const bool has_lag = own.motor.amplifier_lag > 0, has_delay = own.loop.delay_samples > 0,
               writes_late = own.loop.write_latest > 0;
    const auto attempt = [&](bool is_there, const std::vector<Lateness>& left_out) {
      if (!is_there) return;
      const Device prompt = without(left_out);
      if (!may_do(prompt)) return;
      const std::optional<WorstError> error = error_where_certified(c_.network, choices_, prompt);
      if (error && (all.empty() || error->share < noticeably * all.back().second.share))
        all.emplace_back(joined(left_out), *error);
    };
    attempt(has_lag, {amplifier_lag});
    attempt(writes_late, {write_delay});
    attempt(has_delay, {loop_delay});
    attempt(has_lag && has_delay, {loop_delay, amplifier_lag});
    std::vector<Lateness> all_late = {loop_delay, write_delay, amplifier_lag};
    if (!has_delay) all_late.erase(all_late.begin());
    if (!has_lag) all_late.pop_back();
    attempt(writes_late && all_late.size() > 1, all_late);
    return all;
  }

  // Of the motor, in its own unit and four digits: what the force of the law that is chosen then surely asks for; empty
  // where none is stated and where even a thousandfold does not help.
  std::optional<Remedy> slew() const {
    Device quicker = *c_.device;
    double& slew = quicker.description.motor.slew;
    const double own = slew, needed = c_.certificate.limits.slew_needed.value_or(0);
    double told = own > 0 ? std::max(own, needed * some_more * own / c_.certificate.loop.motor_slew) : 0;
    for (int doubling = 0; doubling <= 10 && told > 0; ++doubling, told *= 2) {
      slew = rounded_up(told, 4);
      if (!(slew > own) || !may_do(quicker)) continue;
      const std::optional<Compilation> again = compiled(c_.network, choices_, quicker);
      if (!again || !again->certificate.certified) continue;
      const Remedy enough{slew, felt_error(*again)};
      const double asked = again->certificate.limits.slew_needed.value_or(0) / again->certificate.loop.motor_slew;
      slew = std::max(own, rounded_up(enough.value * asked * some_more, 4));
      if (!(slew > own && slew < enough.value)) return enough;
      const std::optional<WorstError> error = error_where_certified(c_.network, choices_, quicker);
      return error ? Remedy{slew, *error} : enough;
    }
    return std::nullopt;
  }

  // Of the same device, if its motor's force could follow at once.
  std::optional<WorstError> without_slew() const {
    if (c_.device->description.motor.slew == 0) return std::nullopt;
    const Device prompt = without({limited_slew});
    if (!c_.network.contact && !may_do(prompt)) return std::nullopt;
    return error_where_certified(c_.network, choices_, prompt);
  }

  // The first power of two times the device's own; empty where even a thousandfold does not help.
  std::optional<Remedy> rate() const {
    Device faster = *c_.device;
    for (int doubling = 1; doubling <= 10; ++doubling) {
      faster.description.loop.sample_period /= 2;
      const double told = as_told(1 / faster.description.loop.sample_period, 6);
      if (!may_do(faster)) continue;
      if (const auto error = error_where_certified(c_.network, choices_, faster)) return Remedy{told, *error};
    }
    return std::nullopt;
  }

  static std::string joined(const std::vector<Lateness>& left_out) {
    std::string words;
    for (const Lateness& one : left_out) words += (words.empty() ? "" : " and ") + std::string(one.without_it);
    return words;
  }

 private:
  Device without(const std::vector<Lateness>& left_out) const {
    Device device = *c_.device;
    for (const Lateness& one : left_out) one.leave_out(device.description);
    return device;
  }

  Device with_brake_at_tool(double damping) const { return with_brake(*c_.device, damping / scale_); }

  std::optional<Remedy> brake_as_told(double damping) const {
    if (!(damping > 0 && damping < 1e300)) return std::nullopt;
    const double told = rounded_up(damping, 4);
    const std::optional<WorstError> error = error_where_certified(c_.network, choices_, with_brake_at_tool(told));
    return error ? std::optional(Remedy{told, *error}) : std::nullopt;
  }

  Network scaled(double share) const {
    Network network = c_.network;
    std::set<std::size_t> parameters;
    for (Element& element : network.elements) {
      if (is_slip(element.law)) continue;
      element.law = with_value(element.law, value_of(element.law) * share);
      if (element.parameter) parameters.insert(*element.parameter);
    }
    for (const std::size_t i : parameters)
      for (double Parameter::*value : {&Parameter::value, &Parameter::min, &Parameter::max})
        network.parameters[i].*value *= share;
    return network;
  }

  // Sooner known than by compiling all: with its damping shared out at best the chosen candidate needs no more than
  // there is.
  bool may_do(const Device& device) const {
    if (c_.law.tunable || !c_.ports.empty()) return true;
    Candidate candidate = c_.decomposition.choice();
    const PortDevice port = c_.port.replaced_by(device);  // which the settler looks at
    CandidateSettler settler(c_.network, c_.form, c_.decomposition, choices_, port,
                             1 / device.description.loop.sample_period);
    settler.assume_jitter_gap(1);  // with what is necessary
    settler.settle(candidate);
    return candidate.certified == true;
  }

  const Compilation& c_;
  const Choices& choices_;
  double scale_;  // what a device's own unit of damping is worth at the tool
};

// Notes on what would do, told with what errs least first. What would ruin the feel is told where there is no other.
class RemedyNotes {
 public:
  template <DiagnosticCode code, class... Arguments>
  void add(const WorstError& error, Arguments... arguments) {
    notes_.emplace_back(error.share,
                        [=](Diagnostics& diagnostics) { diagnostics.note<code>({}, arguments..., in_words(error)); });
  }

  void tell(Diagnostics& diagnostics) {
    std::stable_sort(notes_.begin(), notes_.end(),
                     [](const auto& one, const auto& other) { return one.first < other.first; });
    if (notes_.empty()) return diagnostics.note<DiagnosticCode::nothing_would_do>({});
    const bool all_ruin = notes_.front().first > ruinous;
    for (const auto& [error, tell_it] : notes_)
      if (all_ruin || error <= ruinous) tell_it(diagnostics);
    if (all_ruin)
      diagnostics.note<DiagnosticCode::remedies_ruin_the_feel>({}, notes_.size() == 1 ? "this" : "each of these");
  }

 private:
  std::vector<std::pair<double, std::function<void(Diagnostics&)>>> notes_;
};

void add_jitter(const Compilation& c, const Remedies& remedies, RemedyNotes& notes) {
  if (const std::optional<Remedy> jitter = remedies.jitter())
    notes.add<DiagnosticCode::jitter_that_would_do>(jitter->error, jitter->value * 1e3,
                                                    c.device->description.loop.jitter * 1e3, jitter->value * 1e3);
}

// A slew that would do, else that none would have to be stated; whether there is anything to tell.
bool add_slew(const Compilation& c, const Remedies& remedies, RemedyNotes& notes) {
  const motor_description& motor = c.device->description.motor;
  const std::optional<Remedy> slew = remedies.slew();
  const std::optional<WorstError> without = slew ? std::nullopt : remedies.without_slew();
  if (slew)
    notes.add<DiagnosticCode::slew_that_would_do>(
        slew->error, slew->value, std::string(port_units(c.device->description.motion).force), motor.slew);
  if (without) notes.add<DiagnosticCode::prompt_loop_that_would_do>(*without, std::string(limited_slew.without_it));
  return slew || without;
}

// What the device itself would have to be like: with more of the damping that a brake cannot replace, or with a loop
// that is not late.
void tell_of_other_devices(const Compilation& c, const Choices& choices, Diagnostics& diagnostics) {
  const device_description& device = c.device->description;
  const Remedies remedies(c, choices);
  const std::string at_tool = port_units(c.network.port_motion).damping, at_joint = port_units(device.motion).damping;
  const double own = device.mechanics.damping;
  RemedyNotes notes;
  if (c.certificate.loop.amplifier_lag > 0) add_jitter(c, remedies, notes);
  const bool is_slew_told = add_slew(c, remedies, notes);
  const auto add_without = [&](const std::vector<Lateness>& left_out) {
    const auto damping = remedies.own_damping(left_out);
    if (!damping) return false;
    const std::string condition = left_out.empty() ? "" : " if " + Remedies::joined(left_out);
    if (remedies.at_joint(damping->value) > own)
      notes.add<DiagnosticCode::own_damping_that_would_do>(damping->error, damping->value, at_tool,
                                                           remedies.at_tool(own), condition,
                                                           remedies.at_joint(damping->value), at_joint);
    else notes.add<DiagnosticCode::prompt_loop_that_would_do>(damping->error, Remedies::joined(left_out));
    return true;
  };
  // The least change first: often the lag alone stands in the way.
  std::vector<std::vector<Lateness>> attempts = {{}};
  std::vector<Lateness> all;
  const auto attempt = [&](bool is_there, const Lateness& one) {
    if (!is_there) return;
    attempts.push_back({one});
    all.push_back(one);
  };
  attempt(device.motor.amplifier_lag > 0, amplifier_lag);
  attempt(device.motor.slew > 0 && !is_slew_told, limited_slew);
  attempt(device.loop.write_latest > 0, write_delay);
  attempt(device.loop.delay_samples > 0, loop_delay);
  if (all.size() > 1) attempts.push_back(all);
  std::any_of(attempts.begin(), attempts.end(), add_without);
  notes.tell(diagnostics);
}

}  // namespace

void warn_of_uncertified(const Compilation& c, const Choices& choices, Diagnostics& diagnostics) {
  const Certificate& certificate = c.certificate;
  if (certificate.certified) return;
  const std::string device = c.device ? fmt::format("device '{}'", c.device->name) : "an ideal device";
  const std::string reason = why_not_certified(certificate, c.network.port_motion);
  if (certificate.bound.proof == Proof::none)
    diagnostics.report<DiagnosticCode::nothing_proved>(c.network.name_span, c.network.name, device, reason);
  else diagnostics.report<DiagnosticCode::lacks_damping>(c.network.name_span, c.network.name, device, reason);
  if (!c.device) diagnostics.note<DiagnosticCode::name_a_device>({});
  else if (diagnostics.wants_advice()) tell_of_other_devices(c, choices, diagnostics);
}

namespace {

struct OtherChoices {
  Choices choices;
  std::string options;  // as they are written on the command line
};

// From the smallest change of what was asked to the largest.
std::vector<OtherChoices> other_choices(const Compilation& c, const Choices& asked) {
  std::vector<OtherChoices> all;
  const Candidate& choice = c.decomposition.choice();
  for (const StateInputMerit& merit : choice.state_inputs)
    if (!asked.state_input && !choice.faithful && merit.largest_error < noticeably * choice.largest_error) {
      all.push_back({asked, "--state-input " + std::string(name_of(merit.state_input))});
      all.back().choices.state_input = merit.state_input;
    }
  OtherChoices other{asked, ""};
  const auto change = [&](const char* option) {
    other.options += (other.options.empty() ? "" : " ") + std::string(option);
    all.push_back(other);
  };
  other.choices.decomposition = "faithful";
  if (c.decomposition.choice().name != "faithful") change("--decomposition faithful");
  if (asked.state_input && !c.law.tunable) {
    other.choices.state_input.reset();
    change("--state-input auto");
  }
  if (asked.scheme == Scheme::backward_euler && other.choices.state_input != StateInput::nodal) {
    other.choices.scheme = Scheme::exact;
    change("--scheme exact");
  }
  return all;
}

RemedyNotes notes_on_remedies(const Compilation& c, const Choices& choices, double available, double of_regimes) {
  RemedyNotes notes;
  const Certificate& certificate = c.certificate;
  const SampledLoop& loop = certificate.loop;
  const std::string unit = port_units(c.network.port_motion).damping;
  for (const OtherChoices& other : other_choices(c, choices)) {
    const std::optional<Compilation> again = compiled(c.network, other.choices, *c.device);
    if (!again || !again->certificate.certified) continue;
    notes.add<DiagnosticCode::choice_that_would_do>(felt_error(*again), other.options,
                                                    again->decomposition.choice().damping, unit);
    break;
  }
  const Remedies remedies(c, choices);
  const std::optional<Remedy> brake = remedies.brake(missing_damping(certificate.bound, loop, 0) + of_regimes);
  if (brake)
    notes.add<DiagnosticCode::brake_that_would_do>(brake->error, brake->value, unit, loop.max_damping,
                                                   brake_as_written(*c.device, remedies.at_joint(brake->value)));
  const double by_loop = available / certificate.bound.needed, by_brake = brake ? loop.max_damping / brake->value : 0;
  if (const auto share = remedies.share({std::max(by_loop, by_brake), std::min(by_loop, by_brake)}))
    notes.add<DiagnosticCode::scale_that_would_do>(
        share->error, share->value,
        std::string(c.law.tunable        ? ", ranges of tunables too,"
                    : c.form.has_slips() ? ", and its yield forces as they are,"
                                         : ""));
  if (const std::optional<Remedy> rate = remedies.rate())
    notes.add<DiagnosticCode::rate_that_would_do>(rate->error, rate->value);
  add_jitter(c, remedies, notes);
  add_slew(c, remedies, notes);
  const bool follows = c.decomposition.choice().velocity_gain > 0;
  if (const auto estimator = follows ? remedies.estimator() : std::nullopt)
    notes.add<DiagnosticCode::estimator_that_would_do>(estimator->second, estimator->first);
  for (const auto& [lateness, error] : remedies.prompt_loops())
    notes.add<DiagnosticCode::prompt_loop_that_would_do>(error, std::string(lateness));
  return notes;
}

}  // namespace

bool insist_on_certificate(const Compilation& c, const Choices& choices, Diagnostics& diagnostics) {
  const Certificate& certificate = c.certificate;
  if (!c.device || certificate.certified || certificate.bound.proof == Proof::none) {
    warn_of_uncertified(c, choices, diagnostics);
    return true;
  }
  const SampledLoop& loop = certificate.loop;
  const double of_regimes = c.law.largest_damping - c.law.damping;  // what a brake that changes needs above its least
  const double available =
      c.law.tunable ? certificate.assured : assured_damping(loop, loop.max_damping - of_regimes).convert_to<double>();
  const auto [needed_words, available_words] = told_apart(certificate.bound.needed, available);
  diagnostics.report<DiagnosticCode::not_certified>(
      c.network.name_span, c.network.name, needed_words, port_units(c.network.port_motion).damping, c.device->name,
      c.law.tunable ? fmt::format("for some values of the parameters only {} is guaranteed", available_words)
                    : fmt::format("only {} is guaranteed{}", available_words,
                                  loop.max_damping > 0 ? ", even with the brake at its maximum" : ""));
  if (diagnostics.wants_advice()) notes_on_remedies(c, choices, available, of_regimes).tell(diagnostics);
  diagnostics.note<DiagnosticCode::compile_uncertified>({});
  return false;
}

namespace {

// One value of the device file made harmless, or better.
struct MendedDevice {
  std::string change;
  Device device;
  bool is_of_estimator = false;
  double error = 0;                        // of what is felt [1]
  std::optional<double> motor_noise = {};  // rms [N]
};

std::vector<MendedDevice> mended(const Device& device) {
  std::vector<MendedDevice> all;
  const device_description& is = device.description;
  const auto mend = [&](bool is_there, std::string change, auto apply) {
    if (!is_there) return;
    all.push_back({std::move(change), device});
    apply(all.back().device.description);
  };
  const velocity_description& velocity = is.velocity;
  const bool has_window =
      velocity.estimator == estimator_kind::backward_difference || velocity.estimator == estimator_kind::least_squares;
  const unsigned window = std::max(velocity.window / 2, velocity.estimator == estimator_kind::least_squares ? 2U : 1U);
  mend(has_window && window < velocity.window, fmt::format("with a \"window\" of {}", window),
       [=](device_description& d) { d.velocity.window = window; });
  mend(velocity.cutoff > 0 && 2 * velocity.cutoff < 0.5 / is.loop.sample_period,
       fmt::format("with a \"cutoff\" of {:.6g} Hz", 2 * velocity.cutoff),
       [](device_description& d) { d.velocity.cutoff *= 2; });
  for (MendedDevice& other : all) other.is_of_estimator = true;
  mend(is.encoder.step > 0, "with a 16th of the encoder's step", [](device_description& d) { d.encoder.step /= 16; });
  mend(is.loop.delay_samples > 0, "without the loop's delay", loop_delay.leave_out);
  mend(is.loop.write_latest > 0, "with commands that act at once", write_delay.leave_out);
  mend(is.motor.slew > 0, "without the motor's slew", limited_slew.leave_out);
  mend(is.motor.amplifier_lag > 0, "without the amplifier's lag", amplifier_lag.leave_out);
  mend(is.brake.coil_lag > 0, "without the lag of the brake's coil",
       [](device_description& d) { d.brake.coil_lag = 0; });
  mend(is.brake.tolerance > 0, "without the brake's tolerance", [](device_description& d) { d.brake.tolerance = 0; });
  mend(is.brake.residual_damping > 0, "without the brake's residual damping",
       [](device_description& d) { d.brake.residual_damping = 0; });
  return all;
}

// Best first, with what a quicker estimate costs.
std::string changes_text(std::vector<MendedDevice> changes, const Candidate& choice, const std::string& force) {
  std::sort(changes.begin(), changes.end(),
            [](const MendedDevice& one, const MendedDevice& other) { return one.error < other.error; });
  std::string text;
  for (const MendedDevice& other : changes) {
    text += fmt::format("{}{} % {}", text.empty() ? "" : ", ", in_percent(other.error), other.change);
    if (other.is_of_estimator && other.motor_noise && choice.motor_noise)
      text += fmt::format(" (where the motor's noise is {:.3g} {} in place of {:.3g})", *other.motor_noise, force,
                          *choice.motor_noise);
  }
  return text;
}

// An error that is felt: of which kind, and what is said of a choice that errs less.
struct FeltError {
  std::optional<double> (*of)(const Compilation&);  // [1]; empty where it has not been looked at
  void (*tell_choice)(const Compilation& is, const Compilation& better, const std::string& options, Diagnostics&);
  bool is_soon_tried;  // else no devices for tunables, where each trial takes long
};

const FeltError where_slips_give_way{
    [](const Compilation& c) {
      const SlipDecomposition& slips = c.decomposition.slips;
      return slips.merits.empty() ? std::nullopt : std::optional(slips.error);
    },
    [](const Compilation&, const Compilation& better, const std::string& options, Diagnostics& diagnostics) {
      diagnostics.note<DiagnosticCode::errs_less_in_runs>({}, options, in_percent(better.decomposition.slips.error));
    },
    false};

const FeltError in_the_band{
    [](const Compilation& c) { return std::optional(c.decomposition.choice().largest_error); },
    [](const Compilation& is, const Compilation& better, const std::string& options, Diagnostics& diagnostics) {
      const Candidate& choice = better.decomposition.choice();
      diagnostics.note<DiagnosticCode::errs_less>({}, options, in_percent(choice.largest_error), choice.damping,
                                                  port_units(better.network.port_motion).damping,
                                                  is.decomposition.choice().damping);
    },
    true};

// Compiles the network under changed conditions, once for each change however often it is asked for.
class Trials {
 public:
  explicit Trials(const Network& network) : network_(network) {}

  // All at the same time, as far as there are threads, for `with` to find.
  void make(const std::vector<MendedDevice>& changes, const Choices& choices) {
    std::map<std::string, std::future<std::optional<Compilation>>> running;
    for (const MendedDevice& other : changes)
      if (made_.count(other.change) == 0)
        running.emplace(other.change, std::async(std::launch::async | std::launch::deferred, compiled, network_,
                                                 choices, other.device));
    for (auto& [change, trial] : running) made_.emplace(change, trial.get());
  }

  // `change` tells one trial from another.
  const std::optional<Compilation>& with(const std::string& change, const Choices& choices, const Device& device) {
    const auto found = made_.find(change);
    return found != made_.end() ? found->second
                                : made_.emplace(change, compiled(network_, choices, device)).first->second;
  }

 private:
  const Network& network_;
  std::map<std::string, std::optional<Compilation>> made_;
};

// The network compiled otherwise, where it errs noticeably less than `c` and its largest felt error is no larger.
class Improvement {
 public:
  Improvement(const Compilation& c, const FeltError& error, Trials& trials)
      : c_(c), error_(error), trials_(trials), limit_(noticeably * *error.of(c)) {}

  // Null where it does not.
  const Compilation* by(const std::string& change, const Choices& choices, const Device& device) const {
    const std::optional<Compilation>& again = trials_.with(change, choices, device);
    if (!again || (c_.certificate.certified && !again->certificate.certified)) return nullptr;
    const std::optional<double> error = error_.of(*again);
    if (!error || !(*error < limit_) || felt_error(*again).share > felt_error(c_).share) return nullptr;
    return &*again;
  }

 private:
  const Compilation& c_;
  const FeltError& error_;
  Trials& trials_;
  double limit_;
};

// In the unit of a device without any: an eighth of the most damping that a candidate asks for.
double smallest_brake_worth_having(const Compilation& c, const Remedies& remedies) {
  double most = 0;
  for (const Candidate& candidate : c.decomposition.candidates) most = std::max(most, candidate.wanted_damping);
  return remedies.at_joint(most / 8);
}

// What would err less: another choice, else another device.
void tell_what_errs_less(const Compilation& c, const Choices& choices, const FeltError& error, Trials& trials,
                         Diagnostics& diagnostics) {
  if (!diagnostics.wants_advice()) return;
  const Improvement improvement(c, error, trials);
  std::vector<OtherChoices> others = other_choices(c, choices);
  if (c.decomposition.choice().name != "virtual") {
    others.push_back({choices, "--decomposition virtual"});
    others.back().choices.decomposition = "virtual";
  }
  for (const OtherChoices& other : others)
    if (const Compilation* again = improvement.by(other.options, other.choices, *c.device))
      return error.tell_choice(c, *again, other.options, diagnostics);
  if (c.law.tunable && !error.is_soon_tried) return;
  const PortUnits units = port_units(c.network.port_motion);
  Device faster = *c.device;
  const auto at_rate = [&] { return fmt::format("at a rate of {:.6g} Hz", 1 / faster.description.loop.sample_period); };
  std::vector<MendedDevice> changes = mended(*c.device);
  if (error.is_soon_tried) {
    faster.description.loop.sample_period /= 2;
    changes.push_back({at_rate(), faster});
  }
  // Compiled again: less may then be added to the brake for passivity, and what is added is felt.
  trials.make(changes, choices);
  std::erase_if(changes, [&](MendedDevice& other) {
    const Compilation* again = improvement.by(other.change, choices, other.device);
    if (again) other.error = *error.of(*again), other.motor_noise = again->decomposition.choice().motor_noise;
    return !again;
  });
  if (!changes.empty())
    return diagnostics.note<DiagnosticCode::errs_less_on_another_device>(
        {}, changes_text(std::move(changes), c.decomposition.choice(), units.force));
  for (int doubling = error.is_soon_tried ? 2 : 1; doubling <= 4; ++doubling) {
    faster.description.loop.sample_period /= 2;
    if (const Compilation* again = improvement.by(at_rate(), choices, faster))
      return diagnostics.note<DiagnosticCode::errs_less_at_another_rate>({}, 1 / faster.description.loop.sample_period,
                                                                         in_percent(*error.of(*again)));
  }
  const double own = c.device->description.brake.max_damping;
  for (int doubling = 1; doubling <= 4; ++doubling) {
    const double most = std::ldexp(own > 0 ? own : smallest_brake_worth_having(c, Remedies(c, choices)), doubling);
    if (most == 0) break;
    const std::string brake = brake_as_written(*c.device, most);
    if (const Compilation* again = improvement.by(brake, choices, with_brake(*c.device, most)))
      return diagnostics.note<DiagnosticCode::errs_less_with_a_brake>(
          {}, again->port.max_damping().value_or(0), units.damping, brake, in_percent(*error.of(*again)));
  }
  diagnostics.note<DiagnosticCode::errs_less_nowhere>({}, own > 0 ? "a brake up to 16 times as strong" : "a brake");
}

}  // namespace

void warn_of_felt_error(const Compilation& c, const Choices& choices, Diagnostics& diagnostics) {
  if (!c.device) return;
  Trials trials(c.network);
  const SlipDecomposition& slips = c.decomposition.slips;
  if (slips.error > choices.tolerance * (1 + 1e-9)) {
    diagnostics.report<DiagnosticCode::felt_error_behind_slips>(c.network.name_span, in_percent(slips.error),
                                                                in_percent(choices.tolerance));
    const auto [mildest, worst] = extreme_runs(slips.runs);
    diagnostics.note<DiagnosticCode::worst_and_mildest_run>({}, worst.motion, in_percent(worst.error), mildest.motion,
                                                            in_percent(mildest.error));
    tell_what_errs_less(c, choices, where_slips_give_way, trials, diagnostics);
    diagnostics.note<DiagnosticCode::runs_of_ones_own>({});
  }
  const Candidate& choice = c.decomposition.choice();
  if (!(noticeably * choice.largest_error > choices.tolerance)) return;
  diagnostics.report<DiagnosticCode::felt_error>(c.network.name_span, choice.name, in_percent(choice.largest_error),
                                                 c.device->name, in_percent(choices.tolerance));
  // Where damping is missing, what would do is told with the error that is felt then.
  if (c.certificate.certified || c.certificate.bound.proof == Proof::none)
    tell_what_errs_less(c, choices, in_the_band, trials, diagnostics);
}

void tell_what_is_proved_at_the_limit(const Compilation& c, const Choices& choices, Diagnostics& diagnostics) {
  const MotorLimits& limits = c.certificate.limits;
  if (!diagnostics.wants_advice()) return;
  if (!c.device || !c.certificate.certified || limits.rule == LimitRule::none || limits.is_covered) return;
  const std::string unit = port_units(c.network.port_motion).damping;
  if (c.decomposition.choice().name != "velocity-free") {
    Choices other = choices;
    other.decomposition = "velocity-free";
    if (const auto again = compiled(c.network, other, *c.device); is_proved_at_the_limit(again))
      diagnostics.report<DiagnosticCode::proved_at_the_limit>(
          {}, "--decomposition velocity-free", again->certificate.limits.needed, unit, in_words(felt_error(*again)));
  }
  const Remedies remedies(c, choices);
  if (const std::optional<Remedy> own = remedies.own_damping_at_the_limit())
    diagnostics.report<DiagnosticCode::own_damping_at_the_limit>(
        {}, remedies.at_tool(own->value), unit, remedies.at_tool(c.device->description.mechanics.damping), own->value,
        port_units(c.device->description.motion).damping, in_words(own->error));
}

void warn_of_driving_uncertified(const Compilation& c, const Choices& choices, Diagnostics& diagnostics) {
  const Certificate& certificate = c.certificate;
  if (!c.device || certificate.certified) return;
  const Span place = c.network.name_span;
  if (certificate.bound.proof == Proof::none) return warn_of_uncertified(c, choices, diagnostics);
  diagnostics.report<DiagnosticCode::drives_uncertified>(
      place, c.network.name, c.device->name, certificate.bound.needed, port_units(c.network.port_motion).damping,
      certificate.assured);
  if (diagnostics.wants_advice()) diagnostics.note<DiagnosticCode::compile_says_what_would_do>({});
}

}  // namespace dashpot::compiler
