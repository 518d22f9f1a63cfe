#include "emit/banner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dashpot/estimators/estimator_names.hpp>

#include "certify/choice_text.hpp"
#include "decompose/slip_laws.hpp"
#include "law/cost.hpp"
#include "law/walk.hpp"
#include "network/port_units.hpp"
#include "source/counted.hpp"
#include "source/wrapped_text.hpp"

namespace dashpot::compiler {
namespace {

// For readers who do not know the theory: explains those terms of the compiler's sentences that occur in `facts`.
std::string words_in(const std::vector<std::string>& facts) {
  const auto are_used = [&](std::string_view word) {
    return std::any_of(facts.begin(), facts.end(),
                       [&](const std::string& fact) { return fact.find(word) != std::string::npos; });
  };
  std::string text =
      "words: passive means that the hand never gets more energy than it has put in; certified, that this is proved";
  if (are_used("mode")) text += ". A mode is a spring in series with a damper, whose force dies away";
  if (are_used("observe"))
    text +=
        ". A damper is observed if its damping is in b; the motor then makes the difference that the spring in series "
        "with it causes";
  return text;
}

std::string cost_line(const char* phase, const Cost& cost) {
  return fmt::format("{} {}, {}, {} against subnormal numbers", phase, counted(cost.additions, "addition"),
                     counted(cost.multiplications, "multiplication"), counted(cost.guards, "guard"));
}

// U+202A to U+202E and U+2066 to U+2069 turn the direction of what follows: code would not read as it is compiled.
bool turns_direction(std::string_view text) {
  return text.starts_with("\xE2\x80")
             ? text.size() > 2 && text[2] >= '\xAA' && text[2] <= '\xAE'
             : text.starts_with("\xE2\x81") && text.size() > 2 && text[2] >= '\xA6' && text[2] <= '\xA9';
}

std::string brake_line(const SlipLikes& likes, const std::string& unit) {
  const std::vector<BrakeShare>& shares = likes.first->shares;
  if (shares.size() != 2) return to_text(likes);
  return to_text(likes) +
         fmt::format("; b = {} {} stuck, {} sliding", shares.front().damping, unit, shares.back().damping);
}

// Where the numbers were measured, as far as the author says.
std::string validity_text(const Network& network) {
  std::string text;
  const auto add = [&](const char* what, const std::optional<Range>& range, const std::string& unit) {
    if (range) text += fmt::format("{}{} {} to {} {}", text.empty() ? "" : ", ", what, range->low, range->high, unit);
  };
  const PortUnits units = port_units(network.port_motion);
  add("displacement", network.valid.displacement, units.position);
  add("rate", network.valid.rate, units.velocity);
  add("frequency", network.valid.frequency, "Hz");
  return text;
}

// How exact the scheme is between two samples.
std::string in_words(Scheme scheme, bool switches, bool behind_map, bool is_mixed) {
  if (scheme == Scheme::backward_euler) return "the paper's own, whose error falls in proportion to the period";
  return std::string(behind_map ? "a motion whose w is straight between two samples is answered exactly"
                                : "a motion that is straight between two samples is answered exactly") +
         (is_mixed ? ", except the elements listed below under 'backward Euler'" : "") +
         (switches ? ", except in samples in which a slip or a contact changes" : "");
}

// What moves the states.
const char* in_words(StateInput input) {
  switch (input) {
    case StateInput::position: return "the measured position";
    case StateInput::velocity: return "the estimated velocity";
    case StateInput::nodal: return "position and velocity, as the network's nodes have it";
  }
  return "";
}

void describe_cost(const UpdateLaw& law, std::vector<std::string>& facts) {
  const Cost output = cost_of(law, law.output), update = cost_of(law, law.update);
  facts.push_back(cost_line("cost of output():", output));
  if (output.coupled > 0)
    facts.push_back(
        fmt::format("  and at most {} additions, multiplications and divisions for the coupled slips", output.coupled));
  facts.push_back(cost_line("cost of update():", update) +
                  fmt::format("; {} kept between samples", counted(output.states, "number")));
}

// What may change, what follows it, and what that costs.
void describe_tunables(const UpdateLaw& law, const SampledLoop& loop, const std::string& damping_unit,
                       std::vector<std::string>& facts) {
  const TunableTables& tables = *law.tunable;
  std::string names, elements;
  for (const Tunable& t : tables.tunables)
    names += fmt::format("{}{} ({} to {} {})", names.empty() ? "" : ", ", t.name, t.range.min, t.range.max, t.unit);
  for (const std::string& element : tables.mesh_elements) elements += (elements.empty() ? "" : ", ") + element;
  facts.push_back("tunable: " + names);
  facts.push_back(
      "  set() itself injects no energy: raising a stiffness under load raises the force only as far as energy that "
      "other springs release allows; but the motor still holds the force of the last sample, so call set() right "
      "after step() and take the command from output() of the same sample");
  if (loop.is_late())
    facts.push_back(fmt::format(
        "  here {}: forces from before a change still act for that time. The energy that a softened spring loses pays "
        "for them, but a spring that stiffens again within that time may inject half the rise of its stiffness times "
        "the square of the tool's way; a certificate covers what happens between changes",
        why_late(loop)));
  facts.push_back(fmt::format("  b [{}] after set(): {}", damping_unit, tables.brake.text));
  if (!elements.empty())
    facts.push_back("  by backward Euler, because their relaxations depend on a tunable or on several slips: " +
                    elements);
  describe_cost(law, facts);
  facts.push_back(
      fmt::format("cost of set(): {} operations for the constants, {} for the forces of springs and their energy",
                  operations_of(cost_of(law, law.tune)), operations_of(cost_of(law, law.carry))));
}

std::string form_text(ModeForm form) {
  return form == ModeForm::product ? "" : fmt::format("in {} form ", name_of(form));
}

std::string loops_line(const UpdateLaw& law, VectorRegisters registers) {
  const std::size_t bytes = bytes_of(registers);
  const std::string room = bytes > 0 ? fmt::format("registers of {} bytes", bytes) : "a machine without vectors";
  const char* flag = bytes == 64 ? ", -mavx512f" : bytes == 32 ? ", -mavx2" : "";
  return fmt::format("loops: laid out for {}{}; sums in {} parts, the same bits on every machine", room, flag,
                     lanes_of_loops(law).count);
}

void describe_curve(const Compilation& c, std::vector<std::string>& facts) {
  if (c.network.map)
    facts.push_back(fmt::format(
        "static curve: {}; the network is stretched by w(u) instead of the position u, and u in the lines below stands "
        "for that w: f = w' F(w), b = w'^2 b_w, with {:.4g} <= w' <= {:.4g}; the curve's force is off by at most "
        "{:.2g} % of the largest, and w' by {:.2g} % of its largest",
        to_text(*c.network.static_curve, c.network.port_motion), c.network.map->least_tangent(0, c.network.map->reach),
        c.network.map->steepest(), 100 * c.network.map->static_error, 100 * c.network.map->slope_error));
}

// What the brake is told, and what the states follow.
void describe_choice(const Compilation& c, const std::string& unit, std::vector<std::string>& facts) {
  const Candidate& choice = c.decomposition.choice();
  const std::vector<SlipLikes> slips = likes_of(c.decomposition.slips, c.network);
  const std::string capped =
      choice.capped() ? fmt::format(", lowered from {} to what the brake can give", choice.wanted_damping) : "";
  if (c.is_told_slip_by_slip())
    facts.push_back(
        "brake: makes the damping that the next lines give for each slip, and the motor the rest of the force");
  else
    facts.push_back(fmt::format(
        "brake: makes b = {} {} of damping{}{}, and the motor the rest of the force; by the rule '{}': {}",
        choice.damping, unit, capped, slips.empty() ? "" : " and, in the parts with slips, what the next lines give",
        choice.name, choice.why()));
  for (const SlipLikes& likes : slips) facts.push_back(brake_line(likes, unit));
  facts.push_back(fmt::format("states: what the law remembers follows {} ({})", in_words(choice.state_input),
                              c.decomposition.reason));
  if (!c.decomposition.in_words.empty()) facts.push_back("choice: " + c.decomposition.in_words);
  if (c.network.contact) facts.push_back("contact: " + contact_text(c.decomposition, c.network));
  facts.push_back("late velocity: " + at_any_delay(choice, unit));
}

void describe_ports(const Compilation& c, const std::string& unit, std::vector<std::string>& facts) {
  for (const Compilation& port : c.ports) {
    facts.push_back(fmt::format("port {}{}", port.network.name,
                                c.device ? ": on its share of the device, " + to_text(port.share) : ""));
    std::vector<std::string> of_port;
    describe_curve(port, of_port);
    describe_choice(port, unit, of_port);
    for (const std::string& fact : of_port) facts.push_back("  " + fact);
  }
}

// Whether a sample may be one in which a slip gives way, or a surface is touched or left.
bool changes_at_once(const Compilation& c) {
  return c.network.contact || !likes_of(c.decomposition.slips, c.network).empty() ||
         std::any_of(c.ports.begin(), c.ports.end(), changes_at_once);
}

}  // namespace

bool mixes_schemes(const UpdateLaw& law) {
  return law.scheme == Scheme::exact && law.tunable && !law.tunable->mesh_elements.empty();
}

std::string comment_text(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  for (std::size_t i = 0; i < text.size(); ++i)
    if (turns_direction(std::string_view(text).substr(i))) text.replace(i, 3, "?");
  return text.ends_with('\\') || text.ends_with("\?\?/") ? text + "." : text;
}

std::string string_text(const std::string& text) {
  std::string result;
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) result += fmt::format("\\{:03o}", byte);
    else if (c == '"' || c == '\\' || c == '?') result += {'\\', c};
    else result += c;
  }
  return result;
}

std::vector<std::string> comment_lines(const std::vector<std::string>& facts) {
  std::vector<std::string> lines;
  for (const std::string& fact : facts)
    for (const std::string& line : wrapped_text(fact, 112, 2)) lines.push_back(comment_text(line));
  return lines;
}

std::vector<Fields> as_list(const std::vector<std::string>& lines) {
  std::vector<Fields> list;
  for (const std::string& line : lines) list.push_back({{"line", line}});
  return list;
}

std::string to_text(const DeviceShare& share) {
  return fmt::format("{:.3g} % of the brake, {:.3g} % of the damping that it has of its own and {:.3g} % of the motor",
                     100 * share.brake, 100 * share.own_damping, 100 * share.motor);
}

std::vector<std::string> banner(const Compilation& c, const UpdateLaw& law, Timing timing) {
  const std::string unit = dotted_units(c.network.port_motion).damping;
  std::vector<std::string> facts;
  if (!c.network.source.empty()) facts.push_back("source: " + c.network.source);
  if (const std::string valid = validity_text(c.network); !valid.empty()) facts.push_back("valid: " + valid);
  describe_curve(c, facts);
  facts.push_back(
      fmt::format("scheme: {} at {} Hz, {}: {}", name_of(c.law.scheme), c.rate, name_of(c.law.scalar),
                  in_words(c.law.scheme, changes_at_once(c), c.network.map.has_value(), mixes_schemes(c.law))));
  if (c.ports.empty()) describe_choice(c, unit, facts);
  else describe_ports(c, unit, facts);
  for (const std::string& line : passivity_lines(c.certificate, unit)) facts.push_back(line);
  if (c.law.sheds() || !c.certificate.limits.is_covered)
    for (const std::string& line :
         to_lines(c.certificate.limits, c.certificate.loop, port_units(c.network.port_motion)))
      facts.push_back(line);
  facts.push_back(fmt::format("device: {}",
                              c.device ? c.device->name
                                       : "none is named: exact brake, no delay, and as velocity the difference of the "
                                         "last two positions over the period. Pass that velocity: a smoother estimate "
                                         "comes later, and the certificate does not cover it"));
  if (law.tunable) describe_tunables(law, c.certificate.loop, unit, facts);
  else describe_cost(law, facts);
  if (timing == Timing::constant) facts.push_back("constant time: output() and update() choose by masks, not by jumps");
  if (has_loops(c.law)) facts.push_back(loops_line(c.law, c.registers));
  if (c.law.relative_error_bound > 0)
    facts.push_back(fmt::format("rounding: {}the force of a mode is off by at most {:.2g} of its peak",
                                form_text(c.law.mode_form), c.law.relative_error_bound));
  facts.push_back(words_in(facts));
  return comment_lines(facts);
}

void describe_device(const Compilation& c, Fields& fields) {
  fields["any_device"] = c.device ? "false" : "true";
  fields["is_certified"] = c.certificate.certified ? "true" : "false";
  fields["added_damping"] = cpp_literal(c.certificate.added_damping, c.law.scalar);
  fields["device"] = c.device ? string_text(c.device->name) : "ideal";
  fields["device_digest"] = c.device ? c.device->digest : "";
  fields["estimator"] = c.device ? name_of(c.device->description.velocity.estimator) : "exact";
  fields["loop_delay"] = std::to_string(c.device ? c.device->description.loop.delay_samples : 0u);
}

void describe_law(const UpdateLaw& law, motion port_motion, Fields& fields) {
  const PortUnits units = port_units(port_motion);
  fields["version"] = DASHPOT_VERSION;
  fields["scalar"] = name_of(law.scalar);
  fields["sample_period"] = cpp_literal(law.sample_period, law.scalar);
  fields["position_unit"] = fmt::format("[{}]", units.position);
  fields["velocity_unit"] = fmt::format("[{}]", units.velocity);
}

void describe_file(const Compilation& c, Fields& fields) {
  describe_law(c.law, c.network.port_motion, fields);
  fields["title"] = comment_text(c.network.title.empty() ? c.network.name : c.network.title);
  fields["digest"] = c.network.digest;
  fields["name"] = c.network.name;
  fields["motion"] = name_of(c.network.port_motion);
  fields["energy_contract"] =
      c.law.tunable ? "Energy in the springs, and set free by changes of parameters, after the last update() [J]."
                    : "Energy in the springs after the last update() [J].";
}

}  // namespace dashpot::compiler
