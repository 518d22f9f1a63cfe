#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "certify/choice_text.hpp"
#include "certify/notes.hpp"
#include "certify/proved_bound.hpp"
#include "commands/explain.hpp"
#include "emit/banner.hpp"
#include "decompose/slip_laws.hpp"
#include "linear/quasi_linear.hpp"
#include "network/port_units.hpp"
#include "law/cost.hpp"
#include "law/walk.hpp"
#include "law/evaluate.hpp"
#include "source/counted.hpp"
#include "source/wrapped_text.hpp"

namespace dashpot::compiler {

double fastest_rate(const Compilation& c) {
  Real fastest = 0;
  const auto look_at = [&](const LinearForm& form) {
    for (const Mode& mode : form.modes) fastest = std::max(fastest, mode.relaxation_rate);
  };
  look_at(c.form.linear);
  for (const ComponentSplit* split : c.decomposition.slips.all())
    for (const Regime& regime : split->regimes.regimes) look_at(regime.form);
  return to_double(fastest);
}

namespace {

std::string kelvin_text(const Compilation& c, const PortUnits& units) {
  const LinearForm& linear = c.form.linear;
  if (linear.is_empty()) return "";
  constexpr std::size_t most_listed = 500;  // the work grows with the square, and is a second here
  if (linear.modes.size() > most_listed)
    return fmt::format("generalised Kelvin form (for creep): of {} modes, left to --json\n", linear.modes.size());
  const KelvinForm creep = kelvin_form(linear);
  std::string text =
      fmt::format("generalised Kelvin form (for creep): glass compliance {:.8g} {}, fluidity {:.8g} {}\n",
                  to_double(creep.glass_compliance), units.compliance, to_double(creep.fluidity), units.fluidity);
  for (const KelvinElement& element : creep.elements)
    text += fmt::format("  Kelvin element      {:.10g} {} and {:.10g} {}\n", to_double(element.stiffness),
                        units.stiffness, to_double(element.damping), units.damping);
  return text;
}

std::string pace_text(const Compilation& c) {
  const double rate = fastest_rate(c);
  if (rate == 0) return "";
  const std::string samples = fmt::format("{:.6g}", c.rate / rate);
  return fmt::format("fastest relaxation    {:.6g} s, {} sample{} at {} Hz\n", 1 / rate, samples,
                     samples == "1" ? "" : "s", c.rate);
}

// What reaches from the tool to ground without a slip.
std::string linear_text(const Compilation& c, const PortUnits& units) {
  if (c.form.is_all_behind_slips())
    return "beside the slips      nothing: no spring or damper joins tool and ground but through a part with a slip\n";
  return (c.form.has_slips() ? "beside the slips:\n" : "") + to_text(c.form.linear, c.network) +
         fmt::format("zero-frequency damping {:.10g} {}\n", to_double(zero_frequency_damping(c.form.linear)),
                     units.damping);
}

// Where the author says that the network is one of what it is to be.
std::string valid_text(const Validity& valid, const PortUnits& units) {
  std::string text;
  const auto add = [&](const char* what, const std::optional<Range>& range, const std::string& unit) {
    if (range) text += fmt::format("{}{} {} to {} {}", text.empty() ? "" : ", ", what, range->low, range->high, unit);
  };
  add("frequency", valid.frequency, "Hz");
  add("rate", valid.rate, units.velocity);
  add("displacement", valid.displacement, units.position);
  return "valid                 " + (text.empty() ? "no range is stated" : text) + "\n";
}

std::string stiffest_spring_text(const Compilation& c, const PortUnits& units) {
  const std::optional<double> stiffest = stiffest_spring(c.certificate.loop);
  if (!stiffest) return "";
  return fmt::format(
      "stiffest spring       {:.4g} {} by itself is certified here, with the brake at its largest damping\n", *stiffest,
      units.stiffness);
}

// What the device's own numbers come to in currents, which shows a ratio that was forgotten.
std::string currents_text(const Compilation& c) {
  if (!c.device) return "";
  const motor_description& motor = c.device->description.motor;
  const brake_description& brake = c.device->description.brake;
  std::string text;
  if (motor.max_torque > 0 && motor.torque_constant > 0)
    text = fmt::format("{:.4g} A make the motor's largest force", motor.max_torque / motor.torque_constant);
  if (brake.max_damping > 0 && brake.damping_per_current_squared > 0)
    text += fmt::format("{}{:.4g} A the brake's largest damping", text.empty() ? "" : ", ",
                        std::sqrt(brake.max_damping / brake.damping_per_current_squared));
  return text.empty() ? "" : "currents              " + text + "\n";
}

// What motor and brake together have to make when the tool is pushed as far and as fast as 'valid' says.
std::string push_text(const Compilation& c, const PortUnits& units) {
  constexpr double most_samples = 1e6;
  if (!c.device || !c.network.valid.displacement) return "";
  const double depth = c.network.valid.displacement->high;
  const double rate = c.network.valid.rate ? c.network.valid.rate->high : 0.1;
  const double samples = std::ceil(depth / rate * c.rate);
  if (!(depth > 0) || !(rate > 0) || !(samples <= most_samples)) return "";
  Choices choices;
  choices.rate = c.rate;
  Diagnostics of_whole;  // its warnings were given when it was compiled for the device
  StageTimes unseen;
  const std::optional<Compilation> whole = compile(c.network, choices, std::nullopt, of_whole, unseen);
  if (!whole) return "";
  const double at = c.network.surface();
  Evaluation<double> run(whole->law);
  run.reset(at);
  double most = 0;
  for (double i = 1; i <= samples; ++i) {
    const command<double> now = run.step(at + depth * i / samples, rate);
    most = std::max(most, std::abs(now.damping * rate + now.force));
  }
  const double limit = c.certificate.loop.max_force;
  std::string text = fmt::format("a push of {:.4g} {} at {:.4g} {} takes up to {:.4g} {} of motor and brake together",
                                 depth, units.position, rate, units.velocity, most, units.force);
  if (limit > 0) text += fmt::format("; the motor gives {:.4g} {}", limit, units.force);
  if (limit > 0 && most > limit) text += ": the rest is felt only as far as the brake makes it";
  return "over 'valid'          " + text + "\n";
}

// How far off the slope of the map is, by which everything but the curve itself is felt.
std::string slope_text(const MotionMap& map, const PortUnits& units) {
  std::string text = fmt::format(
      ", and the map's slope, with which slips, dampers and what relaxes are felt, by {:.2g} % of its largest",
      100 * map.slope_error);
  if (map.unsure_until > 0)
    text +=
        fmt::format(", by more than 1 % only within {:.2g} {} of where it begins", map.unsure_until, units.position);
  return text;
}

// The curve, how well it is met, and what of the numbers that follow is felt at the tool.
std::string static_text(const Compilation& c, const PortUnits& units) {
  if (!c.network.map) return "";
  const MotionMap& map = *c.network.map;
  const double least = map.least_tangent(0, map.reach), most = map.steepest();
  std::string text = "static curve          " + to_text(*c.network.static_curve, c.network.port_motion) + "\n";
  text += fmt::format(
      "emitted as            {} cubics up to {:.6g} {} from where it begins, straight beyond; that force is off by at "
      "most {:.2g} % of the largest{}\n",
      map.cubics(), map.reach, units.position, 100 * map.static_error, slope_text(map, units));
  text += fmt::format(
      "seen through it       b, and every stiffness and damping below, is felt at the tool {:.4g} to {:.4g} times as "
      "large; 'passivity' is about the tool\n",
      least * least, most * most);
  if (c.network.valid.rate && c.network.valid.rate->high > 0)
    text += fmt::format(
        "quasi-linear law      a law of the same curve and relaxation would differ by up to {:.3g} % of the largest "
        "force in a ramp at {:.6g} {}\n",
        100 * distance_from_quasi_linear(c.network, c.form.linear, c.network.valid.rate->high),
        c.network.valid.rate->high, units.velocity);
  return text;
}

std::string notes_text(const Compilation& c) {
  std::string text;
  for (const std::string& note : notes_on_choice(c.decomposition, c.network)) text += "note: " + note + "\n";
  return text;
}

std::string cost_text(const Compilation& c) {
  const Cost output = cost_of(c.law, c.law.output), update = cost_of(c.law, c.law.update);
  std::string text = fmt::format(
      "cost                  output {} and {}, update {} and {} with {}, {}\n", counted(output.additions, "addition"),
      counted(output.multiplications, "multiplication"), update.additions, update.multiplications,
      counted(update.guards, "guard"), counted(output.states, "state"));
  if (output.coupled > 0)
    text += fmt::format("coupled slips         at most {} additions, multiplications and divisions in output\n",
                        output.coupled);
  return text;
}

// What is above holds for the default values.
std::string tunable_text(const UpdateLaw& law) {
  const TunableTables& tables = *law.tunable;
  std::string text, elements;
  for (const Tunable& t : tables.tunables)
    text += fmt::format("tunable               {} {} {}, {} to {}\n", t.name, t.range.value, t.unit, t.range.min,
                        t.range.max);
  text += fmt::format("damping follows       {}\n", tables.brake.text);
  for (const std::string& element : tables.mesh_elements) elements += (elements.empty() ? "" : ", ") + element;
  if (!elements.empty()) text += fmt::format("backward Euler        {}\n", elements);
  return text + fmt::format(
                    "cost at most          output {}, update {}, set {} additions, multiplications and divisions, {}\n",
                    operations_of(cost_of(law, law.output)), operations_of(cost_of(law, law.update)),
                    operations_of(cost_of(law, set_program(law))), counted(cost_of(law, law.output).states, "state"));
}

// What follows a label begins in the same column on every line.
std::string fitted(const std::string& text) {
  constexpr std::size_t widest = 100, label = 22;
  std::string all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const bool is_labelled = line.size() > label && line.compare(label - 2, 2, "  ") == 0 && line[label] != ' ';
    const std::size_t indented = std::min(line.find_first_not_of(' '), line.size());
    for (const std::string& one : wrapped_text(line, widest, is_labelled ? label : indented + 4)) all += one + "\n";
  }
  return all;
}

// b and what is added to it.
std::string brake_text(const Compilation& c, const PortUnits& units) {
  if (!c.device || c.certificate.added_damping == 0) return "";
  std::string told = fmt::format("{}{:.4g}", c.law.tunable ? "at least " : "", c.law.damping);
  if (c.law.brake_changes() && !c.law.tunable) told += fmt::format(" to {:.4g}", c.law.largest_damping);
  return fmt::format("brake command         {} {}, of which {:.4g} are for passivity; the brake can make {:.4g}\n",
                     told, units.damping, c.certificate.added_damping, c.port.at_tool().max_damping().value_or(0));
}

// Behind a contact whose brake does nothing even while the tool touches: why, and what would change it.
std::string why_no_brake(const Compilation& c, const PortUnits& units) {
  if (c.law.damping > 0 || c.law.largest_damping > 0) return "";
  const double feedthrough = to_double(c.form.linear.feedthrough_damping);
  if (feedthrough > 0)
    return fmt::format(
        "why b is 0            '{}' leaves everything to the motor; another --decomposition gives the brake up to "
        "{:.6g} {}\n",
        c.decomposition.choice().name, feedthrough, units.damping);
  const double viscosity = to_double(zero_frequency_damping(c.form.linear));
  std::string text =
      "why b is 0            with a contact b is at most the feedthrough damping, and that is 0 here: every damper "
      "between tool and ground has a spring or a slip in series. More damping than that the motor would have to cancel "
      "with the estimated velocity, also in the samples in which the tool touches or leaves the surface, and that can "
      "inject energy. A damper from the tool to ground, in parallel with the rest, would give the brake its value";
  if (viscosity > 0) text += fmt::format("; without 'contact' it could take up to {:.6g} {}", viscosity, units.damping);
  return text + "\n";
}

// What the lines say that begin so, of those that are there.
std::string legend_of_lines(const std::string& text) {
  const std::pair<const char*, const char*> lines[] = {
      {"share of the device",
       "the part of brake, motor and the device's own damping that this port may use. Each port is chosen for its "
       "share; 'passivity' is about all ports together on the whole device"},
      {"static curve", "the force at rest, or at once, over the displacement, which the file asks for"},
      {"quasi-linear law",
       "QLV: f = ∫ G(t − s) df_e(s), passive along one line, whose damping goes with the curve's slope"},
      {"valid", "where the file says that its numbers were measured"},
      {"generalised Kelvin form",
       "the same network as elements in series, as creep is written: how far it gives at once under a unit force "
       "(glass compliance), how fast it flows on in the end (fluidity), and in between Kelvin elements, each a spring "
       "and a damper side by side"},
      {"static stiffness", "of the spring that is left when everything has relaxed"},
      {"feedthrough damping", "of the damper that is felt at once, however fast the motion"},
      {"mode", "a spring and a damper in series that relax together, and the elements that make them"},
      {"zero-frequency damping", "of the whole network in a slow and steady motion"},
      {"any delay", "the damping to add to b so that a late velocity estimate alone cannot make the law give energy"},
      {"brake command", "at the tool: b, or the sum over the regimes, and the damping that is added for passivity"},
      {"contact", "where the tissue begins, and what is commanded in front of it"},
      {"passivity",
       "the damping that the law needs so that no motion of the tool gets energy out of the loop, and what "
       "the device has for certain. A hold is the time over which the motor's force stays, from one sample to the "
       "next. Where 'what is rendered is D + …' follows: D is the network's own answer to a motion, and s the rate of "
       "change, so that so much damping is felt beside the network"},
      {"energy", "what the law itself can give back, and what rounding may add to it"},
      {"largest force", "what the law may ask of the motor, and what the motor can make"},
      {"over 'valid'", "the network's own force in such a motion, with its parameters as they are in the file"},
      {"stiffest spring",
       "the largest stiffness that this device can render of a lone spring, whatever the network is"},
      {"currents", "what the device file's limits and constants come to"},
      {"slew", "how fast the motor's force has to change, and how fast it can"},
      {"sudden loss", "of what force the motor may lag behind without giving energy"},
      {"at the motor's limit",
       "what happens where the motor cannot make or follow the force, and whether that is passive. Its damping is "
       "counted sample by sample; that of 'passivity' may be counted over all frequencies, and is another number then. "
       "With a contact only the device's own damping counts for both, since the brake leaves a free tool alone"},
      {"quantisation", "what the encoder's steps do: friction has to take what they give"},
      {"tunable", "a value that the program may change while it runs, as it is in the file, and its range"},
      {"damping follows",
       "of the parameters as they are now: the rule by which set() chooses b; the rows above are of the file's own "
       "values"},
      {"backward Euler", "the elements whose states are stepped by it, since a tunable mixes their relaxations"},
      {"cost at most", "of one sample before and after the command leaves, and of a change of parameters"},
      {"cost  ",
       "of one sample, beside each other: additions, multiplications, guards against subnormal numbers, and the "
       "numbers that are kept"}};
  std::string all;
  for (const auto& [label, meaning] : lines) {
    const bool begins = text.starts_with(label) || text.find(std::string("\n") + label) != std::string::npos;
    if (begins) all += fmt::format("{:<22}{}{}\n", label, std::string(label).size() >= 22 ? " " : "", meaning);
  }
  return all + fmt::format("{:<22}{}\n", "a | b, a - b", "elements beside each other, elements in series");
}

// Explains the columns behind slips that the text has.
std::string legend_of_slips(const std::string& text) {
  struct Column {
    const char *table, *name, *meaning;
  };
  const Column columns[] = {
      {"slip rule of ", "slip rule of …:",
       "the rule that was chosen for the part with these slips, and why; below it how many regimes it has, and what "
       "the brake makes in each. Where no table follows, the brake makes no damping of this part in any regime"},
      {"  stuck", "stuck", "the regime: the slips that stick in it; the others slide"},
      {"  stuck", "b",
       "the damping that the brake makes of this part in this regime. It makes the b of the table above and, of each "
       "part, the b of its regime; what is added for passivity is not in it"},
      {"  stuck", "b of the rule",
       "the damping that the rule in the last column gives the brake; `steady` takes the largest of all regimes "
       "instead, and limits may lower it"},
      {"  stuck", "b∞", "the damping that is felt at once in this regime"},
      {"  stuck", "compensation", "the damping of the brake that the motor cancels, with the velocity estimate"},
      {"  stuck", "rule", "what gives the damping of this regime"},
      {"  slip rule ", "slip rule",
       "how the damping is shared between brake and motor while slips slide or stick; the chosen one is named above"},
      {"  slip rule ", "peak error",
       "the largest error of the felt force in a test motion, of the largest force in it"},
      {"  slip rule ", "rms error", "the same of root mean squares"},
      {"  slip rule ", "mean brake",
       "the damping that the brake makes on average, without what is added for passivity"},
      {"  slip rule ", "minimum damping", "what must be added so that the law is certified; -: no proof covers it"},
      {"  slip rule ", "motor noise", "the rms force of the motor that comes from the encoder's steps alone"}};
  std::string all;
  for (const Column& column : columns)
    if (("\n" + text).find(std::string("\n") + column.table) != std::string::npos)
      all += fmt::format("{:<22}{}\n", column.name, column.meaning);
  return all;
}

// The network in its own terms, and what is chosen of it.
std::string choice_text(const Compilation& c, const PortUnits& units, bool with_legend) {
  const Candidate& choice = c.decomposition.choice();
  std::string text;
  for (const Springpot& springpot : c.network.springpots)
    text += "springpot             " + to_text(springpot, c.network.port_motion) + "\n";
  text += static_text(c, units) + linear_text(c, units) + pace_text(c) + valid_text(c.network.valid, units) +
          kelvin_text(c, units) + "\n";
  const bool has_candidates = !c.is_told_slip_by_slip();
  if (has_candidates) text += candidates_text(c.decomposition, c.network);
  if (has_candidates && c.device && c.form.has_slips())
    text += "other rows            with the slip rules that are chosen here; --decomposition chooses them anew\n";
  text += chosen_text(c.decomposition) + brake_text(c, units);
  if (with_legend && has_candidates) text += "\n" + legend(c.device.has_value()) + "\n";
  const std::string slips = to_text(c.decomposition.slips, c.network);
  text += slips;
  if (with_legend && !slips.empty()) text += "\n" + legend_of_slips(slips) + "\n";
  text += "any delay             " + at_any_delay(choice, units.damping) + "\n";
  if (c.network.contact)
    text += "contact               " + contact_text(c.decomposition, c.network) + "\n" + why_no_brake(c, units);
  return text;
}

std::string ports_text(const Compilation& c, const PortUnits& units, bool with_legend) {
  std::string text;
  for (const Compilation& port : c.ports) {
    text += "port " + port.network.name + "\n";
    if (c.device) text += "share of the device   " + to_text(port.share) + "\n";
    text += choice_text(port, units, with_legend && &port == &c.ports.front());
    text += fmt::format("damping it needs      {}\n\n",
                        port.certificate.bound.proof == Proof::none
                            ? "not known: " + port.certificate.bound.reason
                            : fmt::format("{:.6g} {}, from the brake and the device's own damping",
                                          port.certificate.bound.needed, units.damping));
  }
  return text + "all ports together\n";
}

}  // namespace

std::string explain_text(const Compilation& c, bool with_legend) {
  const PortUnits units = port_units(c.network.port_motion);
  std::string text = fmt::format("{}{}\n\n", c.network.name, c.network.title.empty() ? "" : ": " + c.network.title);
  text += calculations_text(c.network);
  text += c.ports.empty() ? choice_text(c, units, with_legend) : ports_text(c, units, with_legend);
  if (!c.ports.empty()) text += brake_text(c, units);
  text += to_text(c.certificate, c.network.port_motion) + push_text(c, units) + stiffest_spring_text(c, units) +
          currents_text(c) + notes_text(c);
  text += c.law.tunable ? tunable_text(c.law) : cost_text(c);
  if (with_legend) text += "\n" + legend_of_lines(text);
  return fitted(text);
}

}  // namespace dashpot::compiler
