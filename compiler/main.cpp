// The command line of dashpot: architecture, section 4.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <sstream>

#include "commands/commands.hpp"
#include "network/rate_limits.hpp"

namespace {

using namespace dashpot::compiler;

using Command = ExitStatus (*)(const Options&, SourceFiles&, Diagnostics&);

const std::vector<std::string> decompositions = {"most-dissipative", "zero-frequency",   "quietest-passive",
                                                 "velocity-free",    "largest-observer", "gated",
                                                 "compensated",      "virtual"};

struct CommandLine {
  Options options;
  std::string scheme = "exact";
  std::string scalar = "double";
  std::string state_input = "auto";
  std::string vector = "sse2";
  std::string decomposition = "most-dissipative";
  std::string diagnostics = "text";
  std::string target = "cpp";
};

// The whole text as a number in decimal notation.
std::optional<double> decimal(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

std::string check_rate(const std::string& text) {
  const std::optional<double> rate = decimal(text);
  const bool ok = rate && *rate >= lowest_rate && *rate <= highest_rate;
  return ok ? ""
            : fmt::format("'{}' is no rate; a number of hertz from {:g} to {:g} is expected", text, lowest_rate,
                          highest_rate);
}

std::string check_duration(const std::string& text) {
  const std::optional<double> duration = decimal(text);
  return duration && *duration > 0 ? "" : "'" + text + "' is no duration; a number of seconds above 0 is expected";
}

std::string check_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  const bool ok = error == std::errc() && end == text.data() + text.size();
  return ok ? ""
            : fmt::format("'{}' is no seed; a whole number from 0 to {} is expected", text,
                          std::numeric_limits<std::uint64_t>::max());
}

std::string check_decomposition(const std::string& text) {
  if (std::find(decompositions.begin(), decompositions.end(), text) != decompositions.end()) return "";
  const std::optional<double> damping = decimal(text);
  const bool ok = damping && *damping >= 0;
  return ok ? ""
            : "'" + text + "' is no decomposition; one of " + CLI::detail::join(decompositions) +
                  " or a damping of zero or more is expected";
}

void add_choices(CLI::App& command, CommandLine& line) {
  Choices& choices = line.options.choices;
  command.add_option("--device", line.options.device, "Device file; without one an ideal device at --rate");
  command.add_option("--rate", choices.rate, "Rate of the servo loop [Hz], default 1000 or the device's")
      ->check(check_rate);
  command.add_option("--scheme", line.scheme, "How states are advanced, default exact")
      ->check(CLI::IsMember({"exact", "backward-euler"}))
      ->option_text("exact|backward-euler");
  command.add_option("--state-input", line.state_input, "What drives the states")
      ->check(CLI::IsMember({"auto", "position", "velocity", "nodal"}))
      ->option_text("auto|position|velocity|nodal");
  command.add_option("--decomposition", line.decomposition, "What the brake takes over")
      ->check(check_decomposition)
      ->option_text("NAME|DAMPING (" + CLI::detail::join(decompositions) + ", or a number in SI)");
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

void add_networks(CLI::App& command, CommandLine& line, bool several) {
  CLI::Option* networks = command.add_option("NETWORK", line.options.networks, "Network file")->required();
  networks->expected(several ? -1 : 1);
}

void describe(CLI::App& app, CommandLine& line) {
  Options& options = line.options;
  CLI::App* check = add_command(app, line, "check", "Report errors and warnings only");
  add_networks(*check, line, true);
  add_choices(*check, line);

  CLI::App* explain =
      add_command(app, line, "explain", "Show canonical form, candidate decompositions, and the choice");
  add_networks(*explain, line, false);
  add_choices(*explain, line);
  explain->add_flag("--json", options.json, "As JSON, SI units");

  CLI::App* compile = add_command(app, line, "compile", "Write the update law as C++ or C99");
  add_networks(*compile, line, true);
  add_choices(*compile, line);
  compile->add_option("-o,--output", options.output, "Folder to write to, default the current one")->option_text("DIR");
  compile->add_option("--target", line.target, "Language to write")
      ->check(CLI::IsMember({"cpp", "c99"}))
      ->option_text("cpp|c99");
  compile->add_flag("--constant-time", options.emission.constant_time,
                    "No jump, division or call in a step depends on its values");
  compile->add_flag("--batch", options.emission.batch,
                    "Also write NAME_batch.hpp, a class for many points of the network");
  compile->add_flag("--with-test", options.emission.with_test, "Also write NAME_test.cpp against the closed forms");
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
  compile->add_option("--timings", options.timings, "Say on standard error what each stage took")
      ->check(CLI::IsMember({"text", "json"}))
      ->option_text("text|json");
  compile->add_option("--print", options.print, "Print a stage and write nothing")
      ->check(CLI::IsMember({"network", "linear", "decomposition", "law", "certificate"}))
      ->option_text("network|linear|decomposition|law|certificate");

  CLI::App* simulate = add_command(app, line, "simulate", "Run the law over a recorded motion");
  add_networks(*simulate, line, false);
  add_choices(*simulate, line);
  simulate->add_option("--input", options.input, "Motion: time,position[,velocity] at a uniform period")
      ->required()
      ->option_text("FILE.csv");
  simulate->add_flag("--batch", options.emission.batch,
                     "As what compile --batch writes, which keeps out of the subnormals at each sample");
  simulate->add_option("-o,--output", options.output, "File to write to, default standard output")
      ->option_text("FILE.csv");

  CLI::App* report =
      add_command(app, line, "report", "Draw the network, its responses and the choice as one HTML page");
  add_networks(*report, line, false);
  add_choices(*report, line);
  report->add_option("-o,--output", options.output, "File to write to")->required()->option_text("FILE.html");

  CLI::App* verify =
      add_command(app, line, "verify", "Check a header against its certificate, and that against its network");
  verify->add_option("CERTIFICATE", options.certificate, "Written by compile --certificate")->required();
  verify->add_option("HEADER", options.header, "Emitted with it")->required();

  CLI::App* device = add_command(app, line, "device", "Fill in a device file's brake from the geometry of its blade");
  BladeWords& blade = options.blade;
  device->add_option("DEVICE", options.device, "Device file")->required();
  device->add_option("--blade", blade.thickness, "Thickness of the blade, as \"1.59 mm\"")->required();
  device->add_option("--pole-length", blade.pole_length, "Pole across the motion")->required();
  device->add_option("--pole-width", blade.pole_width, "Pole along the motion")->required();
  device->add_option("--field", blade.field, "Magnetic field in the gap, as \"1 T\"")->required();
  device->add_option("--resistivity", blade.resistivity, "Of the blade, default that of aluminium, \"28.2 nohm m\"");
  device
      ->add_option("--correction", blade.correction,
                   "Alpha of the eddy currents' return path, default by the pole's shape")
      ->check(CLI::Range(0.0, 1.0));
  device->add_option("--radius", blade.radius, "Of the blade's middle, default the device's arm_radius");
  device->add_option("--current", blade.current,
                     "Coil current that makes the field: also fills in damping_per_current_squared");
  device->add_option("-o,--output", options.output, "File to write to, default standard output")
      ->option_text("FILE.json");

  CLI::App* run =
      add_command(app, line, "run", "Run the servo loop on a device, simulated unless --port names a board");
  add_networks(*run, line, false);
  add_choices(*run, line);
  run->get_option("--device")->required()->description("Device file");
  run->add_option("--for", options.duration, "How long [s], default until Ctrl-C")
      ->check(check_duration)
      ->option_text("SECONDS");
  run->add_option("--port", options.port, "The board: serial:PATH?baud=N, unix:PATH, udp:HOST:PORT or pty:")
      ->option_text("URL");
  run->add_option("--hand", options.hand, "Who moves the simulated device, default relaxed")
      ->check(CLI::IsMember({"none", "relaxed", "firm", "stiff"}))
      ->option_text("none|relaxed|firm|stiff");
  run->add_option("--seed", options.seed, "Of the simulated device's chance, default 0")
      ->check(check_seed)
      ->option_text("N");
  run->add_flag("--fast", options.fast, "Simulated time: as fast as the machine allows");
  run->add_option("--log", options.output, "Telemetry, default NAME_run.csv")->option_text("FILE.csv");
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
  if (line.target == "c99") line.options.emission.target = Target::c99;
  if (line.state_input == "position") choices.state_input = StateInput::position;
  if (line.state_input == "velocity") choices.state_input = StateInput::velocity;
  if (line.state_input == "nodal") choices.state_input = StateInput::nodal;
  if (std::find(decompositions.begin(), decompositions.end(), line.decomposition) != decompositions.end())
    choices.decomposition = line.decomposition;
  else choices.decomposition = decimal(line.decomposition).value();
}

ExitStatus run(const CLI::App& app, const CommandLine& line) {
  static const std::map<std::string, Command> commands = {
      {"check", run_check},   {"explain", run_explain}, {"compile", run_compile}, {"simulate", run_simulate},
      {"report", run_report}, {"device", run_device},   {"run", run_run},         {"verify", run_verify}};
  SourceFiles files;
  Diagnostics diagnostics;
  ExitStatus status = ExitStatus::command_line_wrong;
  const std::string command = app.get_subcommands().front()->get_name();
  std::vector<std::string> outputs;
  for (const std::optional<std::string>& output : {line.options.output, line.options.depfile})
    if (output && command != "device") outputs.push_back(*output);  // `device` may fill in its own file
  if (contradicts_itself(line.options.choices, diagnostics) || !spares_inputs(line.options, outputs, diagnostics))
    status = ExitStatus::command_line_wrong;
  else status = commands.at(command)(line.options, files, diagnostics);
  tell(line.options, diagnostics);
  return status;
}

// Help and version are asked for; what else ends parsing is a fault of the command line.
ExitStatus answer(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream text;
  if (app.exit(error, text, std::cerr) != 0) return ExitStatus::command_line_wrong;
  Diagnostics diagnostics;
  const ExitStatus status = write_standard_output(text.str(), diagnostics);
  tell({}, diagnostics);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compiles networks of springs, dampers and slips into update laws for haptic devices", "dashpot");
  app.set_version_flag("--version", "dashpot " DASHPOT_VERSION);
  app.require_subcommand(1);
  CommandLine line;
  describe(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return static_cast<int>(answer(app, error));
  }
  try {
    take_over_words(line);
    return static_cast<int>(run(app, line));
  } catch (const std::exception& error) {
    std::cerr << "dashpot: a defect in the compiler: " << error.what() << '\n';
    return static_cast<int>(ExitStatus::defect);
  }
}
