#include <fmt/format.h>

#include <algorithm>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/simulated/simulated_device.hpp>

#include "commands/axes_commands.hpp"
#include "commands/changed_network.hpp"
#include "commands/commands.hpp"
#include "commands/hand_motion.hpp"
#include "commands/live_line.hpp"
#include "commands/model_library.hpp"
#include "commands/played_motion.hpp"
#include "commands/run_axes.hpp"
#include "commands/run_loop.hpp"
#include "compile.hpp"
#include "emit/write_files.hpp"
#include "insist.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

const std::map<std::string, simulated::hand (*)()> hands = {{"none", simulated::no_hand},
                                                            {"relaxed", simulated::relaxed_hand},
                                                            {"firm", simulated::firm_hand},
                                                            {"stiff", simulated::stiff_grasp}};

simulated::scenario scene_of(const Options& options, const Compilation& compilation) {
  const device_description& device = compilation.device->description;
  simulated::scenario scene;
  scene.network = compilation.network.port_motion;
  scene.user = hands.at(options.hand.value_or("relaxed"))();
  const HandMotion motion = hand_motion(device, compilation.network.port_motion == motion::rotation);
  scene.initial_position = motion.start;
  scene.intended = motion.intended;
  scene.seed = options.seed.value_or(0);
  return scene;
}

std::string log_name(const Options& options, const Compilation& compilation) {
  return options.output.value_or(compilation.network.name + "_run.csv");
}

servo_options loop_options(const Options& options, const Compilation& compilation, LiveLine& live) {
  servo_options loop;
  loop.identity = {compilation.device->name.c_str(), compilation.device->digest.c_str()};
  loop.duration = options.duration.value_or(0);
  loop.outputs.observe = [&live](const telemetry_record& record) { live.show(record); };
  return loop;
}

std::optional<servo_summary> run_simulated(const Options& options, const Compilation& compilation, LoadedModel& model,
                                           any_estimator<double>& estimator, const servo_options& loop,
                                           const std::string& log, Diagnostics& diagnostics) {
  const simulated::scenario scene = scene_of(options, compilation);
  const device_description& description = compilation.device->description;
  if (const char* refusal = simulated_device::refusal(description, scene)) {
    diagnostics.report<DiagnosticCode::cannot_start_device>({}, compilation.device->name, std::string(refusal));
    return std::nullopt;
  }
  simulated_device device(description, scene);
  return options.fast ? run_on(device, model, estimator, loop, simulated_clock{}, log, diagnostics)
                      : run_on(device, model, estimator, loop, monotonic_clock{}, log, diagnostics);
}

std::string commands_text(const servo_summary& summary, const PortUnits& units) {
  return fmt::format(
      "range     the tool from {:.4g} to {:.4g} {}, the motor up to {:.4g} {}, the brake up to {:.4g} {}\n",
      summary.lowest_position, summary.highest_position, units.position, summary.largest_force, units.force,
      summary.largest_damping, units.damping);
}

// On a board hand, noise and time are real: --hand, --seed and --fast are for the simulated device only.
bool asks_a_board_to_be_simulated(const Options& options, Diagnostics& diagnostics) {
  if (!options.port) return false;
  if (options.fast) diagnostics.report<DiagnosticCode::simulated_device_only>({}, "--fast");
  if (options.hand) diagnostics.report<DiagnosticCode::simulated_device_only>({}, "--hand");
  if (options.seed) diagnostics.report<DiagnosticCode::simulated_device_only>({}, "--seed");
  return diagnostics.has_errors();
}

// A program that makes a pseudo-terminal can tell a peer its other end; here nobody would know it.
bool asks_for_what_nothing_can_open(const Options& options, Diagnostics& diagnostics) {
  if (options.port != "pty:") return false;
  diagnostics.report<DiagnosticCode::port_without_other_end>({}, *options.port);
  return true;
}

// A recorded motion takes as long as it takes, and needs no hand and no board. Without one something else ends a run
// that no clock holds back.
bool asks_for_more_than_a_motion(const Options& options, Diagnostics& diagnostics) {
  if (!options.motion) {
    if (options.fast && !options.duration) diagnostics.report<DiagnosticCode::fast_without_end>({});
    if (options.json) diagnostics.report<DiagnosticCode::motion_only>({}, "--json");
    return diagnostics.has_errors();
  }
  if (options.port) diagnostics.report<DiagnosticCode::not_with_motion>({}, "--port");
  if (options.hand) diagnostics.report<DiagnosticCode::not_with_motion>({}, "--hand");
  if (options.duration) diagnostics.report<DiagnosticCode::not_with_motion>({}, "--for");
  return diagnostics.has_errors();
}

void warn_of_limits(const Compilation& c, const Motion& motion, const SourceFile& file, Diagnostics& diagnostics) {
  const device_description& device = c.device->description;
  const double ratio = transmission<double>(device, c.network.port_motion).ratio();
  const PortUnits units = port_units(c.network.port_motion);
  const auto [least, most] = std::minmax_element(motion.position.begin(), motion.position.end());
  const double low = device.encoder.range_low * ratio, high = device.encoder.range_high * ratio;
  if (low < high && (*least < low || *most > high))
    diagnostics.report<DiagnosticCode::motion_beyond_encoder>({&file, 0, 0}, *least, *most, low, high, units.position);
  warn_of_speed({motion, motion.position}, device.encoder.max_speed * ratio, "the motion", units.velocity,
                {&file, 0, 0}, diagnostics);
}

ExitStatus play_motion(const Options& options, const Compilation& compilation, SourceFiles& files,
                       Diagnostics& diagnostics) {
  const SourceFile* input = files.open(*options.motion, diagnostics);
  const std::optional<Motion> motion = input ? parse_motion(*input, diagnostics) : std::nullopt;
  if (!motion || !suits(*motion, compilation.network.port_motion, diagnostics)) return ExitStatus::input_refused;
  const std::string log = log_name(options, compilation);
  if (!spares_inputs(options, {log}, diagnostics)) return ExitStatus::command_line_wrong;
  warn_of_limits(compilation, *motion, *input, diagnostics);
  const std::optional<PlayedMotion> played =
      play(compilation, options.choices, *motion, options.seed.value_or(0), diagnostics);
  if (!played || diagnostics.has_errors()) return ExitStatus::input_refused;
  if (!write_files("", {{log, csv_of(*played)}}, diagnostics)) return ExitStatus::input_refused;
  return write_standard_output(
      options.json ? to_json(*played, compilation, log) : to_text(*played, compilation) + "log: " + log + "\n",
      diagnostics);
}

}  // namespace

ExitStatus run_run(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  if (asks_a_board_to_be_simulated(options, diagnostics) || asks_for_more_than_a_motion(options, diagnostics) ||
      asks_for_what_nothing_can_open(options, diagnostics))
    return ExitStatus::command_line_wrong;
  const DeviceChoice device = open_any_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  const SourceFile* file = open_network(options.networks.front(), options, files, diagnostics);
  if (file && has_two_axes(*file))
    return run_axes(options, hands.at(options.hand.value_or("relaxed"))(), *file, device, files, diagnostics);
  if (file && !as_many_axes(*file, device, diagnostics)) return ExitStatus::input_refused;
  const std::optional<Compilation> compilation =
      file ? compile(*file, options.choices, device.device, diagnostics) : std::nullopt;
  if (!compilation || diagnostics.has_errors()) return ExitStatus::input_refused;
  warn_of_driving_uncertified(*compilation, options.choices, diagnostics);
  warn_of_felt_error(*compilation, options.choices, diagnostics);
  if (options.motion) return play_motion(options, *compilation, files, diagnostics);
  std::optional<LoadedModel> model = load_model(*compilation, options.emission, diagnostics);
  if (!model) return ExitStatus::input_refused;
  if (!options.json_diagnostics)
    tell(options, diagnostics);  // before anything moves; a program reads one array, at the end
  LiveLine live(compilation->network.port_motion);
  const servo_options loop = loop_options(options, *compilation, live);
  const device_description& described = compilation->device->description;
  any_estimator<double> estimator = estimator_of(described);
  const std::string log = log_name(options, *compilation);
  const std::optional<servo_summary> summary =
      options.port ? run_on_board<board_device>(*options.port, described, *model, estimator, loop, log, diagnostics)
                   : run_simulated(options, *compilation, *model, estimator, loop, log, diagnostics);
  live.finish();
  return summary ? conclude(*summary, commands_text(*summary, port_units(compilation->network.port_motion)), log,
                            diagnostics)
                 : ExitStatus::input_refused;
}

}  // namespace dashpot::compiler
