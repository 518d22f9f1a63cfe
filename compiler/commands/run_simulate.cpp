#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "commands/axes_commands.hpp"
#include "commands/changed_network.hpp"
#include "commands/commands.hpp"
#include "commands/motion_csv.hpp"
#include "commands/value_columns.hpp"
#include "compile.hpp"
#include "law/evaluate.hpp"

namespace dashpot::compiler {
namespace {

// What the motion's rate is held against.
struct DeviceRate {
  std::string name;
  double rate;  // [Hz]
};

std::optional<DeviceRate> rate_of(const DeviceChoice& device) {
  if (device.device) return DeviceRate{device.device->name, 1 / device.device->description.loop.sample_period};
  if (device.axes_device) return DeviceRate{device.axes_device->name, 1 / device.axes_device->loop().sample_period};
  return std::nullopt;
}

// False where --rate or the device contradicts the motion. Leaves in `choices` the rate to compile for.
bool settle_rate(const Motion& motion, const std::optional<DeviceRate>& device, Choices& choices,
                 const SourceFile& file, Diagnostics& diagnostics) {
  if (!choices.rate && device) choices.rate = device->rate;
  if (!motion.period) return true;
  if (!choices.rate) choices.rate = rate_meant(motion);
  if (std::abs(*choices.rate * *motion.period - 1) <= same_rate_of(motion)) return true;
  diagnostics.report<DiagnosticCode::csv_rate_contradicts>({&file, 0, 0}, 1 / *motion.period, *choices.rate);
  if (device) diagnostics.note<DiagnosticCode::played_at_any_rate>({}, device->name);
  return false;
}

template <class Scalar>
std::string simulate(const Compilation& c, const Motion& motion, Diagnostics& diagnostics) {
  Evaluation<Scalar> law(c.law);
  law.reset(0);
  std::string text = "time,position,velocity,force,damping,motor_force\n";
  double last_position = 0;
  ValueColumns values(c, motion, diagnostics);
  for (std::size_t i = 0; i < motion.time.size(); ++i) {
    values.warn_outside_range(i, motion.time[i], diagnostics);
    values.set(law, i);
    const double position = motion.position[i];
    const double slope = i == 0 ? 0 : (position - last_position) * c.rate;
    const Scalar velocity = static_cast<Scalar>(motion.velocity.empty() ? slope : motion.velocity[i]);
    last_position = position;
    const command<Scalar> now = law.step(static_cast<Scalar>(position), velocity);
    if (!all_finite(now.damping * velocity, now.force)) {
      diagnostics.report<DiagnosticCode::answer_not_finite>({}, motion.time[i], position, velocity);
      break;
    }
    text += fmt::format("{},{},{},{},{},{}\n", motion.time[i], static_cast<Scalar>(position), velocity,
                        now.damping * velocity + now.force, now.damping, now.force);
  }
  warn_outside_valid(motion, c.network, diagnostics);
  return text;
}

}  // namespace

namespace {

// Without columns of velocities the slopes since the sample before, 0 in the first row.
template <class Scalar>
std::string simulate(const AxesCompilation& c, const JointMotion& motion, Diagnostics& diagnostics) {
  Evaluation<Scalar> law(c.law);
  law.reset(std::vector<Scalar>{0, 0});
  std::string text = "time,q1,q2,v1,v2";
  for (std::size_t k = 0; k < c.device.brakes.size(); ++k) text += fmt::format(",damping_{}", k + 1);
  text += ",torque_1,torque_2\n";
  for (std::size_t i = 0; i < motion.clock.time.size(); ++i) {
    std::vector<Scalar> position, velocity;
    for (std::size_t joint = 0; joint < 2; ++joint) {
      const std::vector<double>& q = motion.position[joint];
      const double slope = i == 0 ? 0 : (q[i] - q[i - 1]) * c.rate;
      position.push_back(static_cast<Scalar>(q[i]));
      velocity.push_back(static_cast<Scalar>(motion.velocity[joint].empty() ? slope : motion.velocity[joint][i]));
    }
    const JointCommand<Scalar> now = law.step(position, velocity);
    const bool has_damping =
        std::all_of(now.damping.begin(), now.damping.end(), [](Scalar b) { return all_finite(b); });
    for (std::size_t joint = 0; joint < 2; ++joint) {
      if (has_damping && all_finite(position[joint], velocity[joint], now.torque[joint])) continue;
      diagnostics.report<DiagnosticCode::answer_not_finite>({}, motion.clock.time[i], motion.position[joint][i],
                                                            velocity[joint]);
      return text;
    }
    text += fmt::format("{},{},{}\n", motion.clock.time[i], fmt::join(position, ","), fmt::join(velocity, ","));
    text.back() = ',';
    text += fmt::format("{},{}\n", fmt::join(now.damping, ","), fmt::join(now.torque, ","));
  }
  return text;
}

ExitStatus simulate_axes(const SourceFile& network, const Options& asked, SourceFiles& files,
                         const DeviceChoice& device, Diagnostics& diagnostics) {
  const SourceFile* input = files.open(asked.input, diagnostics);
  const std::optional<JointMotion> motion = input ? parse_joint_motion(*input, diagnostics) : std::nullopt;
  if (!motion) return ExitStatus::input_refused;
  Options options = asked;
  if (!settle_rate(motion->clock, rate_of(device), options.choices, *input, diagnostics))
    return ExitStatus::command_line_wrong;
  const std::optional<AxesCompilation> c = compile_axes(network, options, device, diagnostics);
  if (!c || diagnostics.has_errors()) return ExitStatus::input_refused;
  if (!suits(motion->clock, c->device.joint_motion(), diagnostics)) return ExitStatus::input_refused;
  const std::string text = options.choices.scalar == ScalarType::float64 ? simulate<double>(*c, *motion, diagnostics)
                                                                         : simulate<float>(*c, *motion, diagnostics);
  if (diagnostics.has_errors()) return ExitStatus::input_refused;
  if (device.axes_device) diagnostics.report<DiagnosticCode::law_alone>({}, device.axes_device->name);
  return write_output(options, text, diagnostics);
}

}  // namespace

ExitStatus run_simulate(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const DeviceChoice device = open_any_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  const SourceFile* network = open_network(options.networks.front(), options, files, diagnostics);
  if (network != nullptr && has_two_axes(*network)) return simulate_axes(*network, options, files, device, diagnostics);
  if (network != nullptr && !as_many_axes(*network, device, diagnostics)) return ExitStatus::input_refused;
  const SourceFile* input = files.open(options.input, diagnostics);
  const std::optional<Motion> motion = input ? parse_motion(*input, diagnostics) : std::nullopt;
  if (network == nullptr || !motion) return ExitStatus::input_refused;
  Choices choices = options.choices;
  if (!settle_rate(*motion, rate_of(device), choices, *input, diagnostics)) return ExitStatus::command_line_wrong;
  const std::optional<Compilation> compilation = compile(*network, choices, device.device, diagnostics);
  if (!compilation || diagnostics.has_errors() || !suits(*motion, compilation->network.port_motion, diagnostics))
    return ExitStatus::input_refused;
  const std::string text = choices.scalar == ScalarType::float64 ? simulate<double>(*compilation, *motion, diagnostics)
                                                                 : simulate<float>(*compilation, *motion, diagnostics);
  if (diagnostics.has_errors()) return ExitStatus::input_refused;
  if (device.device) diagnostics.report<DiagnosticCode::law_alone>({}, device.device->name);
  return write_output(options, text, diagnostics);
}

}  // namespace dashpot::compiler
