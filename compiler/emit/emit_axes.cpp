#include <fmt/format.h>

#include <algorithm>

#include <dashpot/estimators/estimator_names.hpp>

#include "emit/axes_emission.hpp"
#include "emit/axes_response_test.hpp"
#include "emit/banner.hpp"
#include "emit/c99_parts.hpp"
#include "emit/c99_program.hpp"
#include "emit/cpp_program.hpp"
#include "emit/step_shape.hpp"
#include "emit/template_text.hpp"
#include "law/cost.hpp"
#include "lower/term_writer.hpp"
#include "network/port_units.hpp"
#include "source/counted.hpp"

namespace dashpot::compiler {
namespace {

// Explains the words of the sentences below to readers who have not read the theory.
const char* const words_of_ports =
    "words: a port is a network of one axis behind a map w of the tool's position, which says how far the tool has "
    "gone "
    "into what the network resists; B* is the damping that all ports ask for, as a matrix over the joints. Passive "
    "means "
    "that the hand never gets more energy than it has put in; certified, that this is proved";

std::string rule_line(const AxesCompilation& c) {
  const char* what = c.rule == axes::BrakeRule::diagonal ? "each brake makes the damping of its joint, and the motors "
                                                           "the forces by which one joint's velocity acts on the other"
                     : c.rule == axes::BrakeRule::non_injecting
                         ? "the brakes make as much of B* as leaves the motors nothing to inject"
                         : "the motors make all of B*";
  return fmt::format("brakes: by the rule '{}' {}", name_of(c.rule), what);
}

std::string share_line(const axes::ShareMap& share) {
  return fmt::format(
      "share: of the ports' damping the brakes make {:.3g} % in the median over the workspace, {:.3g} % at least, at "
      "({:.4g}, {:.4g}) mm, averaged over all directions of motion",
      100 * share.median, 100 * share.worst, 1e3 * share.worst_at[0], 1e3 * share.worst_at[1]);
}

std::string joint_cost_line(const char* phase, const Cost& cost) {
  return fmt::format("cost of {}: {}, {}, {}, {} against subnormal numbers", phase, counted(cost.additions, "addition"),
                     counted(cost.multiplications, "multiplication"), counted(cost.selections, "selection"),
                     counted(cost.guards, "guard"));
}

std::vector<std::string> banner(const AxesCompilation& c) {
  std::vector<std::string> facts;
  if (!c.network.source.empty()) facts.push_back("source: " + c.network.source);
  for (std::size_t i = 0; i < c.ports.size(); ++i) {
    const Candidate& choice = c.ports[i].decomposition.choice();
    facts.push_back(fmt::format("port {}: behind the map '{}'{}; b = {} N·s/m by the rule '{}'",
                                c.network.ports[i].name, c.network.ports[i].map_kind,
                                c.network.ports[i].network.contact ? ", pushed and never pulled" : "", choice.damping,
                                choice.name));
  }
  const bool has_range = std::any_of(c.joint_ranges.begin(), c.joint_ranges.end(),
                                     [](const auto& range) { return range.first < range.second; });
  facts.push_back(fmt::format("kinematics: {}; sine and cosine by polynomials that are off by less than {:.0e}{}",
                              name_of(c.device.arm.kind), sine_error(c.law.scalar),
                              has_range ? ", of joints that stay within their encoders' ranges" : ""));
  facts.push_back(fmt::format("scheme: {} at {} Hz, {}; what the law remembers follows the measured position",
                              name_of(c.law.scheme), c.rate, name_of(c.law.scalar)));
  facts.push_back(rule_line(c));
  if (c.certificate.share) facts.push_back(share_line(*c.certificate.share));
  for (const std::string& line : passivity_lines(c.certificate, c.device)) facts.push_back(line);
  facts.push_back(
      fmt::format("device: {}", c.has_device ? c.device.name : "none is named: the joints are the tool's own axes"));
  facts.push_back(joint_cost_line("output()", cost_of(c.law, c.law.output)));
  facts.push_back(joint_cost_line("update()", cost_of(c.law, c.law.update)));
  facts.push_back(words_of_ports);
  return comment_lines(facts);
}

std::string list_of(const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "{" : ", ") + value;
  return text + "}";
}

void describe(const AxesCompilation& c, Fields& fields) {
  std::vector<std::string> added, estimators;
  for (const double damping : c.certificate.added) added.push_back(cpp_literal(damping, c.law.scalar));
  for (const device_description& joint : c.device.joints)
    estimators.push_back(c.has_device ? fmt::format("\"{}\"", name_of(joint.velocity.estimator)) : "\"exact\"");
  describe_law(c.law, c.device.joint_motion(), fields);
  fields["title"] = comment_text(c.network.title.empty() ? c.network.name : c.network.title);
  fields["digest"] = c.network.digest;
  fields["name"] = c.network.name;
  fields["damping_unit"] = fmt::format("[{}]", dotted_units(c.device.joint_motion()).damping);
  fields["brakes"] = std::to_string(c.device.brakes.size());
  fields["added_damping"] = list_of(added);
  fields["device"] = string_text(c.device.name);
  fields["device_digest"] = c.device.digest;
  fields["estimators"] = list_of(estimators);
  fields["loop_delay"] = std::to_string(c.device.loop().delay_samples);
}

CodeModel cpp_model(const AxesCompilation& c) {
  Network whole;
  whole.name = c.network.name;
  const CppProgram program = cpp_program(c.law, whole, c.registers);
  CodeModel model;
  describe(c, model.fields);
  model.fields["motion"] = name_of(c.device.joint_motion());
  model.fields["any_device"] = c.has_device ? "false" : "true";
  model.fields["is_certified"] = c.certificate.certified ? "true" : "false";
  add_program(program, model);
  model.lists["banner"] = as_list(banner(c));
  return model;
}

CodeModel c99_model(const AxesCompilation& c) {
  const C99Program program = c99_program(c.law, c.network.name);
  CodeModel model;
  describe(c, model.fields);
  const motion joint_motion = c.device.joint_motion();
  model.fields["is_rotation"] = joint_motion == motion::rotation ? "1" : "0";
  model.fields["torque_unit"] = fmt::format("[{}]", dotted_units(joint_motion).force);
  model.fields["is_certified"] = c.certificate.certified ? "1" : "0";
  model.lists["banner"] = as_list(banner(c));
  model.lists["command"] = as_list(c99_command_header());
  add_program(program, model);
  return model;
}

}  // namespace

std::optional<std::vector<OutputFile>> emit_axes_cpp(const AxesCompilation& compilation, const EmissionOptions& options,
                                                     Diagnostics& diagnostics) {
  const std::string& name = compilation.network.name;
  std::vector<OutputFile> files;
  const auto is_appended = [&](const char* shape, const char* ending, const CodeModel& model) {
    return append_filled(shape, name + ending, model, options, files, diagnostics);
  };
  bool ok = is_appended("axes.hpp.in", ".hpp", cpp_model(compilation));
  if (options.with_live) ok = ok && is_appended("axes_live.cpp.in", "_live.cpp", {{{"name", name}}, {}});
  if (options.with_test) ok = ok && is_appended("axes_test.cpp.in", "_test.cpp", axes_response_test_model(compilation));
  return ok ? std::optional(std::move(files)) : std::nullopt;
}

std::optional<std::vector<OutputFile>> emit_axes_c99(const AxesCompilation& compilation, const EmissionOptions& options,
                                                     Diagnostics& diagnostics) {
  const AxesNetwork& network = compilation.network;
  if (!can_be_c99(network.name, network.name_span, diagnostics)) return std::nullopt;
  std::vector<OutputFile> files;
  if (!append_filled("axes.h.in", network.name + ".h", c99_model(compilation), options, files, diagnostics))
    return std::nullopt;
  return files;
}

}  // namespace dashpot::compiler
