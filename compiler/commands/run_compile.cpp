#include <algorithm>
#include <filesystem>
#include <iostream>
#include <utility>

#include <fmt/ranges.h>

#include "certify/storage_instance.hpp"
#include "commands/axes_commands.hpp"
#include "commands/changed_network.hpp"
#include "commands/commands.hpp"
#include "commands/explain.hpp"
#include "compile.hpp"
#include "emit/response_test.hpp"
#include "emit/write_files.hpp"
#include "insist.hpp"
#include "linear/reach.hpp"
#include "network/law.hpp"
#include "network/tree.hpp"
#include "verify/axes_certificate_file.hpp"
#include "verify/certificate_file.hpp"
#include "verify/verify_header.hpp"
#include "law/law_text.hpp"

namespace dashpot::compiler {
namespace {

std::string stage_text(const Compilation& c, const std::string& stage) {
  const bool is_of_each_port = stage == "network" || stage == "linear" || stage == "decomposition";
  if (is_of_each_port && !c.ports.empty()) {
    std::string text;
    for (const Compilation& port : c.ports) text += "port " + port.network.name + "\n" + stage_text(port, stage);
    return text;
  }
  if (stage == "network") {
    const std::optional<Tree> tree = series_parallel_tree(c.network);
    return to_text(c.network) + (tree ? to_text(*tree, c.network) + "\n" : "no series-parallel tree\n");
  }
  if (stage == "linear") return to_text(c.form.linear, c.network);
  if (stage == "decomposition") return candidates_text(c.decomposition, c.network) + chosen_text(c.decomposition);
  if (stage == "law") return to_text(c.law, c.network);
  return "certificate of " + c.network.name + "\n" + to_text(c.certificate, c.network.port_motion);
}

// Spaces, colons and dollars mean something in a makefile.
std::string escaped(const std::string& path) {
  std::string text;
  for (char c : path) {
    if (c == ' ' || c == '#') text += '\\';
    if (c == '$') text += '$';
    text += c;
  }
  return text;
}

// Of networks of one axis and of two, as far as there are any.
struct Axes {
  bool one = false, two = false;
};

std::vector<std::string> templates_of(const Options& options, Axes axes) {
  std::vector<std::string> names;
  if (axes.one) names.assign(options.target->templates.begin(), options.target->templates.end());
  if (axes.one && options.emission.batch) names.push_back("batch.hpp.in");
  if (axes.two) names.insert(names.end(), options.target->axes_templates.begin(), options.target->axes_templates.end());
  return names;
}

// A makefile with one rule.
std::string dependencies(const Options& options, const std::vector<OutputFile>& files, Axes axes) {
  std::string text;
  for (const OutputFile& file : files) text += escaped(file.name) + " ";
  text.back() = ':';
  for (const std::string& network : options.networks) text += " \\\n  " + escaped(network);
  if (options.device) text += " \\\n  " + escaped(*options.device);
  if (options.emission.templates)
    for (const std::string& name : templates_of(options, axes))
      text += " \\\n  " + escaped((std::filesystem::path(*options.emission.templates) / name).string());
  return text + "\n";
}

// In the output folder, with the depfile wherever it is wanted.
std::vector<OutputFile> placed(std::vector<OutputFile> files, const Options& options, Axes axes) {
  const std::filesystem::path folder = options.output.value_or(".");
  for (OutputFile& file : files) file.name = (folder / file.name).string();
  if (options.depfile) files.push_back({*options.depfile, dependencies(options, files, axes)});
  return files;
}

// A file's name after -o would else become a folder that is called like a file.
void refuse_file_for_folder(const Options& options, const std::vector<OutputFile>& files, Diagnostics& diagnostics) {
  const std::filesystem::path folder = options.output.value_or(".");
  const auto has_its_ending = [&](const OutputFile& file) {
    return std::filesystem::path(file.name).extension() == folder.extension();
  };
  if (folder.extension().empty() || std::filesystem::is_directory(folder)) return;
  const auto like_it = std::find_if(files.begin(), files.end(), has_its_ending);
  if (like_it != files.end())
    diagnostics.report<DiagnosticCode::output_like_a_file>({}, folder.string(), like_it->name);
}

std::vector<std::string> names_in(const std::vector<OutputFile>& files) {
  std::vector<std::string> names;
  for (const OutputFile& file : files) names.push_back(file.name);
  return names;
}

bool has_option(const Target& target, std::string_view option) {
  return std::find(target.options.begin(), target.options.end(), option) != target.options.end();
}

// False, with a diagnostic each, where an option is asked for that the target has nothing for.
bool target_has_all(const Options& options, Diagnostics& diagnostics) {
  bool all = true;
  for (const auto& [is_asked, name] : {std::pair(options.emission.constant_time, "--constant-time"),
                                       {options.emission.batch, "--batch"},
                                       {options.emission.with_test, "--with-test"},
                                       {options.certificate.has_value(), "--certificate"}})
    if (is_asked && !has_option(*options.target, name)) {
      diagnostics.report<DiagnosticCode::target_lacks_option>({}, std::string(options.target->name), name);
      for (const Target& target : targets())
        if (has_option(target, name))
          diagnostics.report<DiagnosticCode::target_with_option>({}, std::string(target.name));
      all = false;
    }
  return all;
}

EmissionOptions emission_of(const Compilation& compilation, const Options& options) {
  EmissionOptions emission = options.emission;
  if (!options.target->explains) return emission;
  Compilation weighed = compilation;
  weigh_all_candidates(weighed, options.choices);
  emission.explanation = explain_json(weighed);
  return emission;
}

// What of a network has a proof of another kind than --proof writes; empty where nothing does.
std::string parts_with_other_proofs(const Network& network) {
  std::vector<std::string> parts;
  for (const Element& element : network.elements)
    if (kind_of(element.law) == "slip") parts.push_back(fmt::format("the slip '{}'", element.name));
  if (has_tunables(network)) parts.push_back("tunable parameters");
  if (network.contact) parts.push_back("a contact");
  if (network.static_curve) parts.push_back("a static curve");
  for (const Network& port : network.ports) {
    const std::string of_port = parts_with_other_proofs(port);
    parts.push_back(fmt::format("port '{}'{}{}", port.name, of_port.empty() ? "" : " with ", of_port));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string proof_text(const Compilation& c, Diagnostics& diagnostics) {
  const std::optional<std::string> text =
      coq_instance(c.network.name, c.certificate.bound, motor_constants(c.law), c.certificate.loop);
  if (text) return *text;
  diagnostics.report<DiagnosticCode::no_storage_function>({}, c.network.name);
  if (const std::string parts = parts_with_other_proofs(c.network); !parts.empty())
    diagnostics.note<DiagnosticCode::proved_by_energy>({}, parts);
  return "";
}

void warn_of_unverifiable(const Network& network, Diagnostics& diagnostics) {
  const std::size_t nodes = largest_part(network).internal.size();
  if (nodes > most_verified_nodes)
    diagnostics.report<DiagnosticCode::certificate_beyond_verify>(network.name_span, network.name, nodes,
                                                                  most_verified_nodes);
}

ExitStatus compile_all(const Options& options, SourceFiles& files, Diagnostics& diagnostics, StageTimes& times) {
  if (!target_has_all(options, diagnostics)) return ExitStatus::command_line_wrong;
  times.enter("files");
  const DeviceChoice device = open_any_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  std::vector<OutputFile> outputs;
  std::string shown, certificate, proof;
  Axes axes;
  if (options.name && options.networks.size() > 1) {
    diagnostics.report<DiagnosticCode::name_of_several>({}, options.networks.size());
    return ExitStatus::command_line_wrong;
  }
  if ((options.certificate || options.proof) && options.networks.size() > 1) {
    const char* option = options.certificate ? "--certificate" : "--proof";
    diagnostics.report<DiagnosticCode::certificate_of_several>({}, option, options.networks.size());
    return ExitStatus::command_line_wrong;
  }
  for (const std::string& path : options.networks) {
    const SourceFile* file = open_network(path, options, files, diagnostics);
    if (file && has_two_axes(*file)) {
      const auto compiled = compile_axes(*file, options, device, diagnostics, times);
      times.enter("emission");
      if (compiled && options.print) shown += axes_stage_text(*compiled, *options.print);
      else if (const auto emitted = compiled ? emit_axes(*compiled, options, diagnostics) : std::nullopt) {
        axes.two = true;
        outputs.insert(outputs.end(), emitted->begin(), emitted->end());
        if (options.certificate) {
          for (const Compilation& port : compiled->ports) warn_of_unverifiable(port.network, diagnostics);
          certificate = axes_certificate_text(*compiled, file->text(), device.text, emitted->front().text);
        }
      }
      continue;
    }
    if (file && !as_many_axes(*file, device, diagnostics)) continue;
    Choices choices = options.choices;
    if (options.target->explains) choices.compared = Compared::variations;  // as `explain` does
    const std::optional<Compilation> compilation =
        file ? compile(*file, choices, device.device, diagnostics, times) : std::nullopt;
    if (!compilation) continue;
    times.enter("advice");
    warn_of_felt_error(*compilation, options.choices, diagnostics);
    const bool is_insisted_on = !options.print && !options.uncertified;
    if (is_insisted_on && !insist_on_certificate(*compilation, options.choices, diagnostics)) continue;
    times.enter("emission");
    if (options.print) {
      shown += stage_text(*compilation, *options.print);
    } else if (const auto emitted =
                   options.target->emit(*compilation, emission_of(*compilation, options), diagnostics)) {
      if (const std::string why = why_no_motion_is_played(*compilation); options.emission.with_test && !why.empty())
        diagnostics.report<DiagnosticCode::test_without_motion>({}, compilation->network.name, why);
      if (options.uncertified) {
        times.enter("advice");
        warn_of_uncertified(*compilation, options.choices, diagnostics);
        times.enter("emission");
      }
      axes.one = true;
      outputs.insert(outputs.end(), emitted->begin(), emitted->end());
      if (options.certificate) {
        warn_of_unverifiable(compilation->network, diagnostics);
        certificate = certificate_text(*compilation, options.choices, file->text(), device.text, emitted->front().text);
      }
      if (options.proof) proof = proof_text(*compilation, diagnostics);
    }
  }
  times.enter("files");
  if (diagnostics.has_errors()) return ExitStatus::input_refused;
  if (options.print) return write_standard_output(shown, diagnostics);
  refuse_file_for_folder(options, outputs, diagnostics);
  std::vector<OutputFile> all = placed(std::move(outputs), options, axes);
  if (options.certificate) all.push_back({*options.certificate, certificate});
  if (options.proof) all.push_back({*options.proof, proof});
  if (!are_apart(names_in(all), diagnostics) || diagnostics.has_errors()) return ExitStatus::input_refused;
  if (!spares_inputs(options, names_in(all), diagnostics)) return ExitStatus::command_line_wrong;
  return write_files("", all, diagnostics) ? ExitStatus::done : ExitStatus::input_refused;
}

}  // namespace

ExitStatus run_compile(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  StageTimes times;
  const ExitStatus status = compile_all(options, files, diagnostics, times);
  times.end();
  if (options.timings) std::cerr << (*options.timings == "json" ? times.to_json() : times.to_text());
  return status;
}

}  // namespace dashpot::compiler
