#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "commands/changed_network.hpp"
#include "commands/commands.hpp"
#include "commands/motion_csv.hpp"
#include "commands/value_columns.hpp"
#include "compile.hpp"
#include "law/evaluate.hpp"

namespace dashpot::compiler {
namespace {

constexpr double same_rate = 1e-6;  // relative: times in a file are decimal numbers of limited length

// What rates may differ by, relative: the times' rounding leaves more of it open where they have few digits.
double same_rate_of(const Motion& motion) { return std::max(same_rate, motion.period_error / *motion.period); }

// The rate that the file means: a whole number of hertz, or a period with few digits, rather than the rounding of
// times.
double rate_meant(const Motion& motion) {
  const double period = *motion.period, rate = 1 / period;
  if (const double whole = std::round(rate); whole > 0 && std::abs(rate - whole) <= same_rate_of(motion) * rate)
    return whole;
  return 1 / std::strtod(fmt::format("{:.7g}", period).c_str(), nullptr);
}

// False where --rate or the device contradicts the motion. Leaves in `choices` the rate to compile for.
bool settle_rate(const Motion& motion, const std::optional<Device>& device, Choices& choices, const SourceFile& file,
                 Diagnostics& diagnostics) {
  if (!choices.rate && device) choices.rate = 1 / device->description.loop.sample_period;
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
    values.set(law, i, motion.time[i], diagnostics);
    const double position = motion.position[i];
    const double slope = i == 0 ? 0 : (position - last_position) * c.rate;
    const Scalar velocity = static_cast<Scalar>(motion.velocity.empty() ? slope : motion.velocity[i]);
    last_position = position;
    const command<Scalar> now = law.step(static_cast<Scalar>(position), velocity);
    text += fmt::format("{},{},{},{},{},{}\n", motion.time[i], static_cast<Scalar>(position), velocity,
                        now.damping * velocity + now.force, now.damping, now.force);
  }
  warn_outside_valid(motion, c.network, diagnostics);
  return text;
}

}  // namespace

ExitStatus run_simulate(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const DeviceChoice device = open_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  const SourceFile* network = open_network(options.networks.front(), options, files, diagnostics);
  const SourceFile* input = files.open(options.input, diagnostics);
  const std::optional<Motion> motion = input ? parse_motion(*input, diagnostics) : std::nullopt;
  if (network == nullptr || !motion) return ExitStatus::input_refused;
  Choices choices = options.choices;
  choices.varies_assumed = false;  // nothing is told of it
  if (!settle_rate(*motion, device.device, choices, *input, diagnostics)) return ExitStatus::command_line_wrong;
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
