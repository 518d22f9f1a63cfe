#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <dashpot/simulated/simulated_arm.hpp>

#include "commands/arm_library.hpp"
#include "commands/axes_commands.hpp"
#include "commands/changed_network.hpp"
#include "commands/live_line.hpp"
#include "commands/played_arm.hpp"
#include "commands/run_axes.hpp"
#include "commands/run_loop.hpp"
#include "emit/write_files.hpp"
#include "network/arm_description.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

// The tip goes round the middle of the workspace, at different rates along x and y, and so all over a rectangle of 40 %
// of the room that there is, but of no more than 20 mm.
constexpr double tip_frequency[2] = {0.5, 0.7};  // [Hz]
constexpr double share_of_workspace = 0.4;
constexpr double most_tip_amplitude = 0.01;  // [m]

simulated::tip_path path_in(const axes::Box& workspace) {
  double centre[2], amplitude[2], rate[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const double low = workspace[i].low, high = workspace[i].high;
    centre[i] = (low + high) / 2;
    amplitude[i] =
        low < high ? std::min(most_tip_amplitude, share_of_workspace * (high - low) / 2) : most_tip_amplitude;
    rate[i] = 2 * std::numbers::pi * tip_frequency[i];
  }
  return [=](double time) -> simulated::tip_motion {
    simulated::tip_motion at;
    for (std::size_t i = 0; i < 2; ++i) {
      at.position[i] = centre[i] + amplitude[i] * std::sin(rate[i] * time);
      at.velocity[i] = amplitude[i] * rate[i] * std::cos(rate[i] * time);
    }
    return at;
  };
}

std::string log_name(const Options& options, const AxesCompilation& compilation) {
  return options.output.value_or(compilation.network.name + "_run.csv");
}

ExitStatus play_motion(const Options& options, const AxesCompilation& compilation, SourceFiles& files,
                       Diagnostics& diagnostics) {
  const SourceFile* input = files.open(*options.motion, diagnostics);
  const std::optional<JointMotion> motion = input ? parse_joint_motion(*input, diagnostics) : std::nullopt;
  if (!motion || !suits(motion->clock, compilation.device.joint_motion(), diagnostics))
    return ExitStatus::input_refused;
  const std::string log = log_name(options, compilation);
  if (!spares_inputs(options, {log}, diagnostics)) return ExitStatus::command_line_wrong;
  const std::optional<PlayedMotion> played = play(compilation, *motion, options.seed.value_or(0), diagnostics);
  if (!played || diagnostics.has_errors()) return ExitStatus::input_refused;
  if (!write_files("", {{log, csv_of(*played, compilation)}}, diagnostics)) return ExitStatus::input_refused;
  return write_standard_output(
      options.json ? to_json(*played, compilation, log) : to_text(*played, compilation) + "log: " + log + "\n",
      diagnostics);
}

simulated::arm_scenario scene_of(const Options& options, const simulated::hand& user,
                                 const AxesCompilation& compilation) {
  simulated::arm_scenario scene;
  scene.user = simulated::planar(user.mass, user.damping, user.input[0] * user.output[0]);  // alike in all directions
  scene.seed = options.seed.value_or(0);
  scene.intended = path_in(compilation.device.workspace);
  const simulated::tip_motion start = scene.intended(0);
  const auto joints = axes::joints_at(compilation.device.arm, {start.position[0], start.position[1]});
  for (unsigned j = 0; joints && j < arm_axes; ++j) scene.initial_position[j] = (*joints)[j];
  return scene;
}

std::optional<arm_servo_summary> run_simulated(const arm_description& arm, const simulated::arm_scenario& scene,
                                               bool fast, LoadedArmModel& model,
                                               any_estimator<double> (&estimators)[arm_axes],
                                               const arm_servo_options& loop, const std::string& log,
                                               Diagnostics& diagnostics) {
  simulated_arm device(arm, scene);
  return fast ? run_on(device, model, estimators, loop, simulated_clock{}, log, diagnostics)
              : run_on(device, model, estimators, loop, monotonic_clock{}, log, diagnostics);
}

telemetry_record largest_of(const arm_telemetry_record& record) {
  telemetry_record line;
  line.time = record.time;
  line.lateness = record.lateness;
  line.tripped = record.tripped;
  line.energy = record.energy;
  for (const double torque : record.torque) line.motor_force = std::max(line.motor_force, std::abs(torque));
  for (const double damping : record.damping) line.damping = std::max(line.damping, damping);
  return line;
}

std::string list_of(const double* values, unsigned count) {
  std::string all;
  for (unsigned i = 0; i < count; ++i) all += fmt::format("{}{:.4g}", i == 0 ? "" : ", ", values[i]);
  return all;
}

std::string range_of(const arm_servo_summary& summary, unsigned brakes, const PortUnits& units) {
  return fmt::format(
      "range     the tip from {:.4g} to {:.4g} mm along x and from {:.4g} to {:.4g} mm along y, the motors up to {} "
      "{}, "
      "the brakes up to {} {}\n",
      1e3 * summary.lowest_tip[0], 1e3 * summary.highest_tip[0], 1e3 * summary.lowest_tip[1],
      1e3 * summary.highest_tip[1], list_of(summary.largest_torques, arm_axes), units.force,
      list_of(summary.largest_dampings, brakes), units.damping);
}

}  // namespace

ExitStatus run_axes(const Options& options, const simulated::hand& user, const SourceFile& network,
                    const DeviceChoice& device, SourceFiles& files, Diagnostics& diagnostics) {
  const auto compilation = compile_axes(network, options, device, diagnostics);
  if (!compilation) return ExitStatus::input_refused;
  if (!compilation->certificate.certified) warn_of_uncertified(*compilation, diagnostics);
  if (options.motion) return play_motion(options, *compilation, files, diagnostics);
  const arm_description arm = arm_description_of(compilation->device);
  const simulated::arm_scenario scene = scene_of(options, user, *compilation);
  const char* const refusal = options.port ? nullptr : simulated_arm::refusal(arm, scene);
  if (refusal != nullptr) {
    diagnostics.report<DiagnosticCode::cannot_start_device>({}, compilation->device.name, std::string(refusal));
    return ExitStatus::input_refused;
  }
  std::optional<LoadedArmModel> model = load_arm_model(*compilation, options.emission, diagnostics);
  if (!model) return ExitStatus::input_refused;
  if (!options.json_diagnostics) tell(options, diagnostics);
  LiveLine live(arm.motion());
  arm_servo_options loop;
  loop.identity = {compilation->device.name.c_str(), compilation->device.digest.c_str()};
  loop.duration = options.duration.value_or(0);
  loop.outputs.observe = [&live](const arm_telemetry_record& record) { live.show(largest_of(record)); };
  any_estimator<double> estimators[arm_axes] = {estimator_of(arm.joints[0]), estimator_of(arm.joints[1])};
  const std::string log = log_name(options, *compilation);
  const std::optional<arm_servo_summary> summary =
      options.port ? run_on_board<arm_board_device>(*options.port, arm, *model, estimators, loop, log, diagnostics)
                   : run_simulated(arm, scene, options.fast, *model, estimators, loop, log, diagnostics);
  live.finish();
  return summary ? conclude(*summary, range_of(*summary, arm.brake_count, port_units(arm.motion())), log, diagnostics)
                 : ExitStatus::input_refused;
}

}  // namespace dashpot::compiler
