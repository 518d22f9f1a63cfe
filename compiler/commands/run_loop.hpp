// What `dashpot run` does with a loop of one axis and of two.
#pragma once

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <dashpot/board/board_device.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "commands/commands.hpp"

namespace dashpot::compiler {

// That of a device, or of a joint.
inline any_estimator<double> estimator_of(const device_description& device) {
  return {device.velocity, device.loop.sample_period, device.encoder.step};
}

// The log is opened when the device is there, so that a former one survives a failure before; its folder is made where
// it is not there.
template <class Port, class Model, class Estimator, class LoopOptions, class Clock>
auto run_on(Port& device, Model& model, Estimator& estimator, LoopOptions options, Clock clock,
            const std::string& log_name, Diagnostics& diagnostics) {
  servo_loop<Model, Port, Estimator, Clock>* const kind = nullptr;
  using Summary = decltype(kind->run());
  // Who reads along may leave: the device is driven to the end, and left safe. Beyond the loop too, for the log is
  // closed and the summary told after it.
  std::signal(SIGPIPE, SIG_IGN);
  const auto close = [](std::FILE* file) { std::fclose(file); };
  std::error_code unreported;  // a log whose folder cannot be made cannot be opened, which is
  std::filesystem::create_directories(std::filesystem::path(log_name).parent_path(), unreported);
  const std::unique_ptr<std::FILE, decltype(close)> log(std::fopen(log_name.c_str(), "w"), close);
  if (!log) {
    diagnostics.report<DiagnosticCode::cannot_write_file>({}, log_name, std::string(std::strerror(errno)));
    return std::optional<Summary>();
  }
  options.outputs.csv = log.get();
  servo_loop<Model, Port, Estimator, Clock> loop(model, device, estimator, options, clock);
  const stop_on_signals ctrl_c(loop.control());
  return std::optional<Summary>(loop.run());
}

// The same on the board behind --port, a board_device or an arm_board_device.
template <class Board, class Description, class Model, class Estimator, class LoopOptions>
auto run_on_board(const std::string& port, const Description& described, Model& model, Estimator& estimator,
                  const LoopOptions& options, const std::string& log_name, Diagnostics& diagnostics) {
  using Ran = decltype(run_on(*static_cast<Board*>(nullptr), model, estimator, options, monotonic_clock{}, log_name,
                              diagnostics));
  std::string error;
  auto stream = board::open_transport(port, error);
  if (stream) {
    Board device(std::move(*stream), described);
    if (device.start(error)) return run_on(device, model, estimator, options, monotonic_clock{}, log_name, diagnostics);
  }
  diagnostics.report<DiagnosticCode::cannot_start_device>({}, port, error);
  return Ran();
}

// Prints the summary, with `range` of what moved; `log` is where the run was written to.
inline ExitStatus conclude(const servo_summary& summary, const std::string& range, const std::string& log,
                           Diagnostics& diagnostics) {
  const int unwritten = summary.telemetry_error;
  if (unwritten != 0)
    diagnostics.report<DiagnosticCode::cannot_write_file>({}, log, std::string(std::strerror(unwritten)));
  const bool has_log = is_admitted(summary.verdict) && unwritten == 0;
  const bool sound = has_log && summary.left_safe && summary.faults.total() == 0;
  const ExitStatus told =
      write_standard_output(to_text(summary) + (has_log ? range + "log: " + log + "\n" : ""), diagnostics);
  return sound ? told : ExitStatus::input_refused;
}

}  // namespace dashpot::compiler
