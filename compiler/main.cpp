// The command line of dashpot: architecture, section 4.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>

#include "commands/commands.hpp"
#include "commands/completion.hpp"
#include "commands/manual.hpp"
#include "network/rate_limits.hpp"
#include "source/nearest_name.hpp"
#include "source/render.hpp"

namespace {

using namespace dashpot::compiler;

using Command = ExitStatus (*)(const Options&, SourceFiles&, Diagnostics&);

const std::string command_of_completion = "completion", command_of_manual = "manual";

// Of two axes alone are the last two; 'virtual' is of both.
const std::vector<std::string> decompositions = {
    "faithful", "paper",  "zero-frequency", "quietest-passive", "velocity-free", "largest-observer",
    "steady",   "ramped", "gated",          "virtual",          "diagonal",      "non-injecting"};
const std::string old_name_of_paper = "most-dissipative";

struct CommandLine {
  Options options;
  std::string scheme = "exact";
  std::string scalar = "double";
  std::string state_input = "auto";
  std::string vector = "sse2";
  std::string decomposition;
  std::string tolerance = "5 %";
  std::string diagnostics = "text";
  std::string target = "cpp";
  std::string shell;       // completion
  std::string page_about;  // manual; empty: dashpot itself
  std::string device_target;
};

// The whole text as a number in decimal notation.
std::optional<double> decimal(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

// "1kHz", "0.5 MHz" and "200 Hz" in hertz; anything else as it is.
std::string in_hertz(const std::string& text) {
  constexpr std::string_view unit = "Hz";
  if (!text.ends_with(unit)) return text;
  std::string number = text.substr(0, text.size() - unit.size());
  double factor = 1;
  if (number.ends_with('k')) factor = 1e3;
  if (number.ends_with('M')) factor = 1e6;
  if (factor != 1) number.pop_back();
  while (number.ends_with(' ')) number.pop_back();
  const std::optional<double> value = decimal(number);
  return value ? fmt::format("{}", factor * *value) : text;
}

std::string check_rate(const std::string& text) {
  const std::optional<double> rate = decimal(text);
  const bool ok = rate && *rate >= lowest_rate && *rate <= highest_rate;
  return ok ? ""
            : fmt::format("'{}' is no rate; a number of hertz from {:g} to {:g} is expected, as 1000 or 1kHz", text,
                          lowest_rate, highest_rate);
}

constexpr double longest_run = 1e9;  // [s]

std::string check_duration(const std::string& text) {
  const std::optional<double> duration = decimal(text);
  if (!duration || !(*duration > 0)) return "'" + text + "' is no duration; a number of seconds above 0 is expected";
  return *duration <= longest_run ? "" : "'" + text + "' is longer than 30 years; without --for it runs until Ctrl-C";
}

std::string check_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  const bool ok = error == std::errc() && end == text.data() + text.size();
  return ok ? ""
            : fmt::format("'{}' is no seed; a whole number from 0 to {} is expected", text,
                          std::numeric_limits<std::uint64_t>::max());
}

// "5%", "5 %" or 0.05.
std::optional<double> share(std::string text) {
  const bool is_percent = !text.empty() && text.back() == '%';
  if (is_percent) text.pop_back();
  while (is_percent && !text.empty() && text.back() == ' ') text.pop_back();
  const std::optional<double> number = decimal(text);
  return number && is_percent ? *number / 100 : number;
}

std::string check_tolerance(const std::string& text) {
  const std::optional<double> tolerance = share(text);
  const bool ok = tolerance && *tolerance > 0 && *tolerance <= 1;
  return ok ? "" : "'" + text + "' is no tolerance; a share above 0 and up to 100 % is expected, as 5% or 0.05";
}

std::string check_decomposition(const std::string& text) {
  if (text == old_name_of_paper ||
      std::find(decompositions.begin(), decompositions.end(), text) != decompositions.end())
    return "";
  const std::optional<double> damping = decimal(text);
  if (damping && *damping >= 0) return "";
  const std::optional<std::string> nearest = nearest_name(text, decompositions);
  return "'" + text + "' is no decomposition; " + (nearest ? "'" + *nearest + "' is the nearest; " : "") + "one of " +
         CLI::detail::join(decompositions) + " or a damping of zero or more is expected";
}

void add_choices(CLI::App& command, CommandLine& line) {
  Choices& choices = line.options.choices;
  command
      .add_option("--name", line.options.name,
                  "Name of the network and of the emitted class, default the name in the file")
      ->option_text("NAME");
  command
      .add_option("--set", line.options.set,
                  "Value of a parameter or an element, in SI or with its unit; again for more")
      ->option_text("NAME=VALUE");
  command.add_option("--device", line.options.device, "Device file; without one an ideal device at --rate");
  command.add_option("--rate", choices.rate, "Rate of the servo loop [Hz], default 1000 or the device's")
      ->transform(in_hertz)
      ->check(check_rate);
  command.add_option("--scheme", line.scheme, "How states are advanced, default exact")
      ->check(CLI::IsMember({"exact", "backward-euler"}))
      ->option_text("exact|backward-euler");
  command.add_option("--state-input", line.state_input, "What drives the states")
      ->check(CLI::IsMember({"auto", "position", "velocity", "nodal"}))
      ->option_text("auto|position|velocity|nodal");
  command
      .add_option(
          "--decomposition", line.decomposition,
          "What the brake takes over, default faithful on a device and with slips, else paper. With two axes a rule "
          "for the brakes (diagonal, the default, non-injecting or virtual) or for each port (faithful or "
          "paper)")
      ->check(check_decomposition)
      ->option_text("NAME|DAMPING (" + CLI::detail::join(decompositions) + ", or a number in SI)");
  command
      .add_option("--tolerance", line.tolerance,
                  "Largest deviation of the felt force that 'faithful' allows, default 5 %")
      ->check(check_tolerance)
      ->option_text("SHARE");
  command.add_option("--scalar", line.scalar, "Type of the emitted numbers, default double")
      ->check(CLI::IsMember({"double", "float"}))
      ->option_text("double|float");
  command.add_option("--vector", line.vector, "Registers that loops over many states are for, default sse2")
      ->check(CLI::IsMember({"none", "sse2", "avx2", "avx512", "neon"}))
      ->option_text("none|sse2|avx2|avx512|neon");
}

CLI::App* add_command(CLI::App& app, CommandLine& line, const char* name, const char* what) {
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("--diagnostics", line.diagnostics, "Form of errors and warnings on standard error")
      ->check(CLI::IsMember({"text", "json"}))
      ->option_text("text|json");
  return command;
}

void add_advice(CLI::App& command, CommandLine& line) {
  command.add_flag("--no-advice", line.options.without_advice,
                   "Tell errors and warnings only, without the search for remedies, which compiles many times");
}

void add_networks(CLI::App& command, CommandLine& line, bool several) {
  CLI::Option* networks = command.add_option("NETWORK", line.options.networks, "Network file")->required();
  networks->expected(several ? -1 : 1);
}

// How a recording is to be read.
void add_reading(CLI::App& command, FitWords& fit) {
  command.add_option("--columns", fit.columns, "Which column is what: ROLE=[-]NAME[+NUMBER][:UNIT],…")
      ->option_text("time=T:s,position=X:mm,force=F:N");
  command.add_flag("--no-header", fit.no_header, "Columns have no names: --columns takes their numbers");
  command
      .add_option("--geometry", fit.geometry,
                  "Geometry that turns stress and strain into force and displacement of a tool")
      ->option_text("column|shear|punch|sphere|needle:KEY=LENGTH,…");
}

void describe_fit(CLI::App& app, CommandLine& line) {
  CLI::App* command = add_command(app, line, "fit", "Fit a network to recordings");
  FitWords& fit = line.options.fit;
  command->add_option("RECORDING", fit.recordings, "Table of a motion, a relaxation, creep or a spectrum")
      ->required()
      ->expected(-1);
  command->add_option("-o,--output", line.options.output, "Network file to write")->option_text("FILE.json");
  command->add_option("--report", fit.report, "Page to write: data, model, residual, spectrum")
      ->option_text("FILE.html");
  command->add_flag("--json", fit.json, "As JSON, SI units");
  command->add_option("--name", fit.name, "Name of the network, default that of its file")->option_text("NAME");
  command->add_option("--title", fit.title, "Title of the network, default the number of recordings")
      ->option_text("TEXT");
  command->add_option("--source", fit.source, "Where the recordings are from, for the network's source")
      ->option_text("TEXT");
  add_reading(*command, fit);
  command->add_option("--scale", fit.scale, "Quantity that a value of 1 without a unit stands for")
      ->option_text("QUANTITY");
  command->add_flag("--relaxation", fit.relaxation, "Stiffness or modulus over the time since a step of position");
  command->add_flag("--creep", fit.creep, "Compliance over the time since a step of force");
  command->add_option("--control", fit.control, "What the machine controlled, default position")
      ->check(CLI::IsMember({"position", "force"}))
      ->option_text("position|force");
  command->add_option("--weight", fit.weight, "Weighting of rows, default uniform, of a spectrum relative")
      ->check(CLI::IsMember({"auto", "uniform", "relative", "deviation"}))
      ->option_text("uniform|relative|deviation");
  command->add_option("--start", fit.start, "State before the first row: at rest there, at rest at 0, or moving")
      ->check(CLI::IsMember({"auto", "rest", "zero", "moving"}))
      ->option_text("auto|rest|zero|moving");
  command->add_flag("--tare", fit.tare, "Fit an offset of the force of each recording");
  command->add_option("--contact", fit.contact, "Where the surface lies; find looks for it")
      ->option_text("find|POSITION");
  command->add_option("--force-delay", fit.force_delay, "Delay of the recorded force")->option_text("TIME");
  command->add_option("--slips", fit.slips, "Springs in series with slips, default none")
      ->option_text("none|auto|viscous|N");
  command->add_option("--springpots", fit.springpots, "Springpots, default none")
      ->check(CLI::IsMember({"none", "auto"}))
      ->option_text("none|auto");
  command->add_option("--shape", fit.shape, "Static curve of the network, default none")
      ->check(CLI::IsMember({"none", "power", "exponential", "table", "auto"}))
      ->option_text("none|power|exponential|table|auto");
  command->add_flag("--elastic", fit.elastic, "One spring alone");
  command->add_flag("--gain-per-file", fit.gain_per_file,
                    "Fit a gain for each file, for specimens that differ by a factor");
  command->add_option("--modes", fit.modes, "Number of relaxations, instead of the one with the least BIC")
      ->check(CLI::Range(0, 1000))
      ->option_text("N");
  command
      ->add_option("--tolerance", fit.tolerance, "Take the fewest elements whose relative error is no more than this")
      ->option_text("1%");
  command->add_option("--hold-out", fit.hold_out, "Recordings that are predicted and not fitted")
      ->expected(-1)
      ->option_text("RECORDING…");
}

const std::map<std::string, PronyFormat> prony_formats = {{"abaqus", PronyFormat::abaqus},
                                                          {"febio", PronyFormat::febio},
                                                          {"ansys", PronyFormat::ansys},
                                                          {"ls-dyna", PronyFormat::ls_dyna},
                                                          {"generic", PronyFormat::generic}};

// Of a name in any case the number of what it names; numbers themselves are no names.
template <class Named>
auto named_number(const std::map<std::string, Named>& names) {
  return [&names](const std::string& text) {
    const auto found = names.find(CLI::detail::to_lower(text));
    if (found == names.end()) {
      std::string known;
      for (const auto& [name, value] : names) known += (known.empty() ? "" : ", ") + name;
      throw CLI::ValidationError("'" + text + "' is not one of " + known);
    }
    return std::to_string(static_cast<int>(found->second));
  };
}

void add_format(CLI::App& command, CommandLine& line, const char* option, const char* what) {
  command.add_option(option, line.options.exchange.format, what)
      ->required()
      ->transform(named_number(prony_formats))
      ->option_text("abaqus|febio|ansys|ls-dyna|generic");
}

void describe_exchange(CLI::App& app, CommandLine& line) {
  static const std::map<std::string, PronyOf> conventions = {
      {"instantaneous", PronyOf::instantaneous}, {"long-term", PronyOf::long_term}, {"absolute", PronyOf::absolute}};
  ExchangeWords& words = line.options.exchange;
  CLI::App* in = add_command(app, line, "import", "Make a network of a finite-element program's Prony series");
  in->add_option("FILE", line.options.input, "Input deck, material file or table")->required();
  add_format(*in, line, "--from", "What wrote the file");
  in->add_option("--stiffness", words.stiffness, "Stiffness that the file's weights are fractions of, as \"1.2 kN/m\"");
  in->add_option("--modulus", words.modulus, "Stiffness that a modulus of 1 in the file stands for, as \"24 mN/m\"");
  in->add_option("--of", words.of, "generic: the stiffness that the weights are fractions of")
      ->transform(named_number(conventions))
      ->option_text("instantaneous|long-term|absolute");
  in->add_option("--material", words.material, "Name or number of the material, where the file has several");
  in->add_option("--time-unit", words.time_unit, "Unit of the file's times, default s");
  in->add_option("--name", words.name, "Name of the network, default after the file");
  in->add_option("-o,--output", line.options.output, "File to write to, default standard output")
      ->option_text("FILE.json");

  CLI::App* out = add_command(app, line, "export", "Write a network as a finite-element program's Prony series");
  add_networks(*out, line, false);
  add_format(*out, line, "--to", "What is to read the file");
  out->add_option("-o,--output", line.options.output, "File to write to, default standard output")->option_text("FILE");
}

void describe_device(CLI::App& app, CommandLine& line) {
  Options& options = line.options;
  CLI::App* device =
      add_command(app, line, "device",
                  "Print a device, write it as code for its loop, or fill in its brake from the geometry of its blade");
  BladeWords& blade = options.blade;
  device->add_option("DEVICE", options.device, "Device file")->required();
  CLI::Option* target =
      device->add_option("--target", line.device_target, "Write what a loop has to know of the device")
          ->check(CLI::IsMember({"cpp", "c99"}))
          ->option_text("cpp|c99");
  const std::vector<CLI::Option*> needed = {
      device->add_option("--blade", blade.thickness, "Thickness of the blade, as \"1.59 mm\""),
      device->add_option("--pole-length", blade.pole_length, "Pole across the motion"),
      device->add_option("--pole-width", blade.pole_width, "Pole along the motion"),
      device->add_option("--field", blade.field, "Magnetic field in the gap, as \"1 T\"")};
  device
      ->add_option("--resistivity", blade.resistivity,
                   "Resistivity of the blade, default that of aluminium, \"28.2 nohm m\"")
      ->needs(needed[0]);
  device
      ->add_option("--correction", blade.correction,
                   "Alpha of the eddy currents' return path, default by the pole's shape")
      ->needs(needed[0])
      ->check(CLI::Range(0.0, 1.0));
  device
      ->add_option("--radius", blade.radius,
                   "Distance of the pole from the axis of rotation, default the device's arm_radius")
      ->needs(needed[0]);
  device
      ->add_option("--current", blade.current,
                   "Coil current that makes the field: also fills in damping_per_current_squared")
      ->needs(needed[0]);
  for (CLI::Option* one : needed) {
    one->excludes(target);
    for (CLI::Option* other : needed)
      if (one != other) one->needs(other);
  }
  device->add_option("-o,--output", options.output, "File to write to, default standard output")->option_text("FILE");
}

void describe(CLI::App& app, CommandLine& line) {
  Options& options = line.options;
  CLI::App* check =
      add_command(app, line, "check", "Report errors and warnings of networks, devices, motions and recordings");
  check->footer(
      "The program dashpot-check, with a hyphen, is a separate one: it checks independently what a certificate states "
      "of a header.");
  check->add_option("FILE", options.networks, "Network or device files, or tables")->required()->expected(-1);
  add_choices(*check, line);
  add_advice(*check, line);
  add_reading(*check, options.fit);

  CLI::App* explain =
      add_command(app, line, "explain", "Show canonical form, candidate decompositions, and the choice");
  add_networks(*explain, line, false);
  add_choices(*explain, line);
  add_advice(*explain, line);
  explain->add_flag("--json", options.json, "As JSON, SI units");
  explain->add_flag("--legend", options.legend, "Say what the columns mean");
  explain->add_option("--as", options.as, "Print the same network in another form instead, as a network file")
      ->check(CLI::IsMember({"kelvin", "maxwell", "prony"}))
      ->option_text("kelvin|maxwell|prony");

  CLI::App* compile = add_command(app, line, "compile", "Write the update law as C++, as C99 or for another target");
  add_networks(*compile, line, true);
  add_choices(*compile, line);
  add_advice(*compile, line);
  compile->add_option("-o,--output", options.output, "Folder to write to, default the current one")->option_text("DIR");
  compile->add_option("--target", line.target, "What to write, default cpp; all are listed below")
      ->check(check_target)
      ->option_text("NAME");
  compile->footer(help_on_targets());
  compile->add_flag("--constant-time", options.emission.constant_time,
                    "No jump, division or call in a step depends on its values");
  compile->add_flag("--batch", options.emission.batch,
                    "Also write NAME_batch.hpp, a class for many points of the network");
  compile->add_flag("--with-test", options.emission.with_test,
                    "Also write NAME_test.cpp, or NAME_test.c, against the closed forms");
  compile->add_flag("--uncertified", options.uncertified,
                    "Also write a law that lacks damping for passivity on its device");
  compile->add_option("--templates", options.emission.templates, "Folder of templates in place of the built-in ones")
      ->check(CLI::ExistingDirectory)
      ->option_text("DIR");
  compile
      ->add_option("--certificate", options.certificate,
                   "Also write what is proved, with all that is needed to check it")
      ->option_text("FILE.json");
  compile->add_option("--proof", options.proof, "Also write what is proved as a theorem that Coq checks")
      ->option_text("FILE.v");
  compile->add_option("--depfile", options.depfile, "Also write a makefile of what the output depends on")
      ->option_text("FILE");
  compile->add_option("--timings", options.timings, "Print on standard error the time of each stage")
      ->check(CLI::IsMember({"text", "json"}))
      ->option_text("text|json");
  compile->add_option("--print", options.print, "Print a stage and write nothing")
      ->check(CLI::IsMember({"network", "linear", "decomposition", "law", "certificate"}))
      ->option_text("network|linear|decomposition|law|certificate")
      ->excludes("--certificate")
      ->excludes("--proof");

  CLI::App* simulate = add_command(app, line, "simulate", "Run the law over a recorded motion");
  add_networks(*simulate, line, false);
  add_choices(*simulate, line);
  simulate
      ->add_option("--input", options.input,
                   "Motion: columns time, position, perhaps velocity, with or without units, at a uniform period")
      ->required()
      ->option_text("FILE.csv");
  simulate->footer(
      "Columns of the output, in SI:\n"
      "  force        on the tool, against its motion: what brake and motor make together\n"
      "  damping      command to the brake\n"
      "  motor_force  command to the motor: force - damping * velocity");
  simulate->add_flag("--batch", options.emission.batch,
                     "Compute as the class of compile --batch does, which sets tiny states to zero in each sample");
  simulate->add_option("-o,--output", options.output, "File to write to, default standard output")
      ->option_text("FILE.csv");

  describe_fit(app, line);

  CLI::App* report =
      add_command(app, line, "report", "Draw the network, its responses and the choice as one HTML page");
  add_networks(*report, line, false);
  add_choices(*report, line);
  add_advice(*report, line);
  report->add_option("-o,--output", options.output, "File to write to")->required()->option_text("FILE.html");

  CLI::App* verify = add_command(app, line, "verify", "Check a header and its certificate against the network");
  verify->add_option("CERTIFICATE", options.certificate, "Written by compile --certificate")->required();
  verify->add_option("HEADER", options.header, "Emitted with it")->required();
  verify->add_flag("--allow-uncertified", options.allow_uncertified,
                   "Also accept a sound header of a law that is not certified");

  describe_device(app, line);
  describe_exchange(app, line);

  CLI::App* run =
      add_command(app, line, "run", "Run the servo loop on a device, simulated unless --port names a board");
  add_networks(*run, line, false);
  add_choices(*run, line);
  add_advice(*run, line);
  run->get_option("--device")->required()->description("Device file");
  run->add_option("--for", options.duration, "How long [s], default until Ctrl-C")
      ->check(check_duration)
      ->option_text("SECONDS");
  run->add_option("--port", options.port, "The board: serial:PATH?baud=N, unix:PATH or udp:HOST:PORT")
      ->option_text("URL");
  run->add_option(
         "--hand", options.hand,
         "Who moves the simulated device, default relaxed: a hand that means to swing by 10 mm or 0.2 rad at 0.5 Hz")
      ->check(CLI::IsMember({"none", "relaxed", "firm", "stiff"}))
      ->option_text("none|relaxed|firm|stiff");
  run->add_option("--seed", options.seed, "Seed of the simulated device's random numbers, default 0")
      ->check(check_seed)
      ->option_text("N");
  run->add_flag("--fast", options.fast, "Simulated time: as fast as the machine allows, with --for");
  run->add_option("-o,--log", options.output, "Telemetry or, with --motion, the felt forces, default NAME_run.csv")
      ->option_text("FILE.csv");
  run->add_option("--motion", options.motion,
                  "Move the simulated device along a recorded motion, time,position or time,q1,q2 at any uniform "
                  "period, and compare the felt force with the network's")
      ->option_text("FILE.csv");
  run->add_flag("--json", options.json, "With --motion: the errors as JSON, SI units");

  CLI::App* shell = app.add_subcommand(command_of_completion, "Print a script that completes command lines in a shell");
  shell->add_option("SHELL", line.shell, "Shell to write the script for")
      ->required()
      ->check(CLI::IsMember(shells))
      ->option_text(CLI::detail::join(shells, "|"));
  app.add_subcommand(command_of_manual, "Print a manual page, for man -l -")
      ->add_option("COMMAND", line.page_about, "Command that the page is about, default dashpot itself")
      ->option_text("COMMAND");
}

void take_over_words(CommandLine& line) {
  Choices& choices = line.options.choices;
  line.options.json_diagnostics = line.diagnostics == "json";
  if (line.scheme == "backward-euler") choices.scheme = Scheme::backward_euler;
  if (line.scalar == "float") choices.scalar = ScalarType::float32;
  for (VectorRegisters registers :
       {VectorRegisters::none, VectorRegisters::avx2, VectorRegisters::avx512, VectorRegisters::neon})
    if (line.vector == name_of(registers)) choices.registers = registers;
  choices.guards_each_sample = line.options.emission.batch;
  line.options.target = find_target(line.target);
  if (line.device_target == "cpp") line.options.device_language = DeviceLanguage::cpp;
  if (line.device_target == "c99") line.options.device_language = DeviceLanguage::c99;
  if (line.state_input == "position") choices.state_input = StateInput::position;
  if (line.state_input == "velocity") choices.state_input = StateInput::velocity;
  if (line.state_input == "nodal") choices.state_input = StateInput::nodal;
  choices.tolerance = share(line.tolerance).value();
  if (const std::optional<double> damping = decimal(line.decomposition)) choices.decomposition = *damping;
  else choices.decomposition = line.decomposition;
}

// What dashpot says of itself.
std::string text_about_itself(const CLI::App& app, const CommandLine& line) {
  const std::vector<CommandWords> words = command_words(app);
  return line.shell.empty() ? manual_page(words, line.page_about) : completion(words, line.shell);
}

// With the formats of the files that it takes and makes; a number is that which such a file states.
std::string version_text() {
  std::string series, names;
  for (const auto& [name, format] : prony_formats) series += ", " + name;
  for (const Target& target : targets()) names += (names.empty() ? "" : ", ") + std::string(target.name);
  return fmt::format(
      "dashpot {}\nreads:   network 1, device 1, certificate 1, CSV; Prony series{}\n"
      "writes:  network 1, device 1, certificate 1, CSV, HTML, JSON; Prony series{}\ntargets: {}",
      DASHPOT_VERSION, series.substr(1), series.substr(1), names);
}

const std::map<std::string, Command> commands = {
    {"check", run_check},   {"explain", run_explain}, {"compile", run_compile}, {"simulate", run_simulate},
    {"report", run_report}, {"device", run_device},   {"run", run_run},         {"verify", run_verify},
    {"fit", run_fit},       {"import", run_import},   {"export", run_export}};

// `help COMMAND` asks what `COMMAND --help` asks.
std::vector<std::string> with_help_as_option(std::vector<std::string> arguments) {
  if (arguments.empty() || arguments[0] != "help") return arguments;
  arguments.erase(arguments.begin());
  if (arguments.size() > 1) arguments.resize(1);
  arguments.push_back("--help");
  return arguments;
}

// Without a value that follows behind '='.
std::string option_of(const std::string& argument) { return argument.substr(0, argument.find('=')); }

// Of what stands where a command should; empty where it is one, or an option that needs none.
std::string complaint_about_command(const CLI::App& app, const std::vector<std::string>& arguments) {
  if (arguments.empty()) return "";
  if (const std::string option = option_of(arguments[0]); option.starts_with('-'))
    return app.get_option_no_throw(option) != nullptr
               ? ""
               : "'" + option + "' stands where a command should; options come after the command\n";
  std::vector<std::string> names;
  for (const auto& [name, command] : commands) names.push_back(name);
  names.insert(names.end(), {command_of_completion, command_of_manual});
  if (std::find(names.begin(), names.end(), arguments[0]) != names.end()) return "";
  const std::optional<std::string> nearest = nearest_name(arguments[0], names);
  return "there is no command '" + arguments[0] + "'" +
         (nearest ? "; '" + *nearest + "' is the nearest" : "; commands are " + CLI::detail::join(names, ", ")) + "\n";
}

// Of the first option that the command does not have, or that has a value and takes none; empty if there is none. The
// parser would name no option that is like it, complain first of the value behind it, and let --batch=true pass.
std::string complaint_about_option(const CLI::App& app, const std::vector<std::string>& arguments) {
  const auto is_named = [&](const CLI::App* command) { return command->get_name() == arguments.front(); };
  const auto found = arguments.empty() ? std::vector<const CLI::App*>() : app.get_subcommands(is_named);
  if (found.empty()) return "";
  std::vector<std::string> names;
  for (const CLI::Option* option : found.front()->get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const auto is_letter = [&](const std::string& name) {  // perhaps with its value, as in -oFILE
    return name[1] != '-' && found.front()->get_option_no_throw(name.substr(0, 2)) != nullptr;
  };
  for (std::size_t i = 1; i < arguments.size() && arguments[i] != "--"; ++i) {
    const std::string name = option_of(arguments[i]);
    const CLI::Option* option = name.starts_with('-') ? found.front()->get_option_no_throw(name) : nullptr;
    const bool takes_next = option != nullptr && option->get_items_expected_min() > 0 && name == arguments[i];
    if (takes_next) ++i;
    if (option != nullptr && option->get_items_expected_max() == 0 && name != arguments[i])
      return "'" + name + "' takes no value\n";
    if (option != nullptr || !name.starts_with('-') || name == "-" || is_letter(name)) continue;
    const std::optional<std::string> nearest = nearest_name(name, names);
    return "'" + arguments[0] + "' has no option '" + name + "'" +
           (nearest ? "; '" + *nearest + "' is the nearest" : "") + "\n";
  }
  return "";
}

// "-" is standard output where that is the default or what is written is all there is to say, and refused elsewhere.
bool settle_dashes(const std::string& command, Options& options, Diagnostics& diagnostics) {
  const std::string dash = "-";
  if (options.output == dash) {
    const bool is_folder = command == "compile" && !options.print, is_telling = command == "fit" || command == "run";
    if (!is_folder && !is_telling) {
      options.output.reset();
    } else {
      diagnostics.report<DiagnosticCode::output_is_dash>({}, command == "run" ? "--log" : "--output",
                                                         is_folder ? "a folder" : "a file");
      diagnostics.note<DiagnosticCode::dash_remedy>({}, is_folder ? "--print writes a stage to standard output; " : "");
    }
  }
  for (const auto& [option, output] : {std::pair("--depfile", options.depfile),
                                       {"--report", options.fit.report},
                                       {"--certificate", options.certificate},
                                       {"--proof", options.proof}})
    if (output == dash) {
      diagnostics.report<DiagnosticCode::output_is_dash>({}, option, "a file");
      diagnostics.note<DiagnosticCode::dash_remedy>({}, "");
    }
  return !diagnostics.has_errors();
}

ExitStatus run(const CLI::App& app, CommandLine line) {
  SourceFiles files;
  Diagnostics diagnostics;
  if (line.options.without_advice) diagnostics.take_no_advice();
  ExitStatus status = ExitStatus::command_line_wrong;
  const std::string command = app.get_subcommands().front()->get_name();
  if (command == command_of_completion || command == command_of_manual) {
    const std::string text = text_about_itself(app, line);
    if (!text.empty()) status = write_standard_output(text, diagnostics);
    else std::cerr << complaint_about_command(app, {line.page_about});
    tell(line.options, diagnostics);
    return status;
  }
  std::vector<std::string> outputs;
  for (const std::optional<std::string>& output : {line.options.output, line.options.depfile, line.options.fit.report})
    if (output) outputs.push_back(*output);
  if (!settle_dashes(command, line.options, diagnostics) || contradicts_itself(line.options.choices, diagnostics) ||
      !spares_inputs(line.options, outputs, diagnostics))
    status = ExitStatus::command_line_wrong;
  else status = commands.at(command)(line.options, files, diagnostics);
  tell(line.options, diagnostics);
  return status;
}

// Before anything is parsed, and also where that fails.
bool asks_for_json(const std::vector<std::string>& arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i)
    if (arguments[i] == "--diagnostics=json" ||
        (arguments[i] == "--diagnostics" && i + 1 < arguments.size() && arguments[i + 1] == "json"))
      return true;
  return false;
}

// Help and version are asked for; what else ends parsing is a fault of the command line.
ExitStatus answer(const CLI::App& app, const CLI::ParseError& error, bool in_json) {
  std::ostringstream text, fault;
  if (app.exit(error, text, fault) != 0) {
    std::cerr << (in_json ? command_line_fault_as_json(error.what()) : fault.str());
    return ExitStatus::command_line_wrong;
  }
  Diagnostics diagnostics;
  const ExitStatus status = write_standard_output(text.str(), diagnostics);
  tell({}, diagnostics);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a failed write, which is told
  CLI::App app("Compiles networks of springs, dampers and slips into update laws for haptic devices", "dashpot");
  app.option_defaults()->disable_flag_override();  // --batch=7 is a mistake
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  CommandLine line;
  line.options.fit.arguments.assign(argv + 1, argv + argc);
  describe(app, line);
  std::vector<std::string> arguments = with_help_as_option(line.options.fit.arguments);
  std::string complaint = complaint_about_command(app, arguments);
  if (complaint.empty()) complaint = complaint_about_option(app, arguments);
  if (!complaint.empty()) {
    if (asks_for_json(arguments)) std::cerr << command_line_fault_as_json(complaint.substr(0, complaint.size() - 1));
    else std::cerr << complaint << "Run with --help for more information.\n";
    return static_cast<int>(ExitStatus::command_line_wrong);
  }
  try {
    std::reverse(arguments.begin(), arguments.end());  // as the parser takes them
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return static_cast<int>(answer(app, error, asks_for_json(line.options.fit.arguments)));
  }
  try {
    take_over_words(line);
    return static_cast<int>(run(app, line));
  } catch (const std::exception& error) {
    std::cerr << "dashpot: a defect in the compiler: " << error.what() << '\n';
    return static_cast<int>(ExitStatus::defect);
  }
}
