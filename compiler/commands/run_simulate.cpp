#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "commands/commands.hpp"
#include "commands/motion_cell.hpp"
#include "commands/motion_csv.hpp"
#include "compile.hpp"
#include "law/evaluate.hpp"
#include "emit/write_files.hpp"

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
  return false;
}

void warn_once_outside(const std::optional<Range>& range, double value, double time, const char* what, const char* unit,
                       bool& warned, const Network& network, Diagnostics& diagnostics) {
  if (warned || !range || range->contains(value)) return;
  warned = true;
  diagnostics.report<DiagnosticCode::outside_valid_range>(network.valid.span, what, value, unit, time, range->low,
                                                          range->high);
}

// Columns of the motion that are called like tunables.
class ValueColumns {
 public:
  // Refuses: a cell that is no finite number, a column given twice, a tunable that is called like one of the motion's
  // own.
  ValueColumns(const Compilation& c, const Motion& motion, Diagnostics& diagnostics) : network_(c.network) {
    if (!c.law.tunable) return;
    tunables_ = c.law.tunable->tunables;
    warned_.resize(tunables_.size());
    for (const Tunable& tunable : tunables_) {
      refuse_name_of_motion(tunable.name, diagnostics);
      columns_.push_back(column_of(tunable.name, motion, diagnostics));
    }
    is_empty_ =
        std::all_of(columns_.begin(), columns_.end(), [](const OtherColumn* column) { return column == nullptr; });
  }

  // Sets the values of a row, and warns once of each tunable that is out of its range.
  template <class Scalar>
  void set(Evaluation<Scalar>& law, std::size_t row, double time, Diagnostics& diagnostics) {
    if (is_empty_) return;
    std::vector<Scalar> values;
    for (std::size_t i = 0; i < tunables_.size(); ++i) {
      const tunable_range<double>& range = tunables_[i].range;
      const double value = columns_[i] == nullptr ? range.value : columns_[i]->values[row];
      warn_once_outside_range(i, value, time, diagnostics);
      values.push_back(static_cast<Scalar>(value));
    }
    law.set(values);
  }

 private:
  void warn_once_outside_range(std::size_t i, double value, double time, Diagnostics& diagnostics) {
    const Tunable& tunable = tunables_[i];
    if (warned_[i] || (value >= tunable.range.min && value <= tunable.range.max)) return;
    warned_[i] = true;
    diagnostics.report<DiagnosticCode::outside_tunable_range>(place_of(tunable.name), tunable.name, value, tunable.unit,
                                                              time, tunable.range.min, tunable.range.max);
  }

  Span place_of(const std::string& tunable) const {
    return std::find_if(network_.parameters.begin(), network_.parameters.end(),
                        [&](const Parameter& p) { return p.name == tunable; })
        ->span;
  }

  // Its column would be the motion's, so that nothing could ever set it.
  void refuse_name_of_motion(const std::string& tunable, Diagnostics& diagnostics) const {
    if (std::find(std::begin(own_columns), std::end(own_columns), tunable) != std::end(own_columns))
      diagnostics.report<DiagnosticCode::tunable_named_as_column>(place_of(tunable), tunable);
  }

  static const OtherColumn* column_of(const std::string& name, const Motion& motion, Diagnostics& diagnostics) {
    const auto is_named = [&](const OtherColumn& column) { return column.name == name; };
    const auto found = std::find_if(motion.others.begin(), motion.others.end(), is_named);
    if (found == motion.others.end()) return nullptr;
    const auto again = std::find_if(found + 1, motion.others.end(), is_named);
    if (again != motion.others.end()) diagnostics.report<DiagnosticCode::csv_column_twice>(again->span, name);
    if (found->not_a_number) report_cell(*found->not_a_number, name, diagnostics);
    return &*found;
  }

  const Network& network_;
  std::vector<Tunable> tunables_;
  std::vector<const OtherColumn*> columns_;
  std::vector<bool> warned_;
  bool is_empty_ = true;
};

template <class Scalar>
std::string simulate(const Compilation& c, const Motion& motion, Diagnostics& diagnostics) {
  Evaluation<Scalar> law(c.law);
  law.reset(0);
  std::string text = "time,position,velocity,force,damping,motor_force\n";
  double last_position = 0;
  bool warned_displacement = false, warned_rate = false;
  const bool turns = c.network.port_motion == motion::rotation;
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
    warn_once_outside(c.network.valid.displacement, position, motion.time[i], "displacement", turns ? "rad" : "m",
                      warned_displacement, c.network, diagnostics);
    // Rest is in every recording, and says nothing of how fast the tissue may be pressed.
    if (velocity != 0)
      warn_once_outside(c.network.valid.rate, std::abs(double(velocity)), motion.time[i], "rate",
                        turns ? "rad/s" : "m/s", warned_rate, c.network, diagnostics);
  }
  return text;
}

}  // namespace

ExitStatus run_simulate(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const DeviceChoice device = open_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  const SourceFile* network = files.open(options.networks.front(), diagnostics);
  const SourceFile* input = files.open(options.input, diagnostics);
  const std::optional<Motion> motion = input ? parse_motion(*input, diagnostics) : std::nullopt;
  if (network == nullptr || !motion) return ExitStatus::input_refused;
  Choices choices = options.choices;
  if (!settle_rate(*motion, device.device, choices, *input, diagnostics)) return ExitStatus::command_line_wrong;
  const std::optional<Compilation> compilation = compile(*network, choices, device.device, diagnostics);
  if (!compilation || diagnostics.has_errors()) return ExitStatus::input_refused;
  const std::string text = choices.scalar == ScalarType::float64 ? simulate<double>(*compilation, *motion, diagnostics)
                                                                 : simulate<float>(*compilation, *motion, diagnostics);
  if (diagnostics.has_errors()) return ExitStatus::input_refused;
  if (!options.output) return write_standard_output(text, diagnostics);
  return write_files("", {{*options.output, text}}, diagnostics) ? ExitStatus::done : ExitStatus::input_refused;
}

}  // namespace dashpot::compiler
