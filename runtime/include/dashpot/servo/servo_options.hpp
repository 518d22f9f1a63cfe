// How a servo loop is to run.
#pragma once

#include <cstddef>

#include <dashpot/servo/admission.hpp>
#include <dashpot/servo/command_path.hpp>
#include <dashpot/servo/realtime_session.hpp>
#include <dashpot/servo/telemetry_writer.hpp>

namespace dashpot {

struct servo_options {
  device_identity identity;        // of the device's description
  bool require_certified = false;  // refuse a model that is not certified on this device
  bool start_running = true;       // false: idle until control().start()
  double duration = 0;             // [s]; 0: until control().stop()
  double farewell = 0.5;           // at the end, the longest wait for the device to confirm the safe command [s]
  command_options command;
  realtime_wishes realtime;  // ignored in simulated time
  telemetry_outputs outputs;
  std::size_t telemetry_capacity = 1u << 14;  // records that may wait for the writer
};

}  // namespace dashpot
