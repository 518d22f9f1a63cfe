// How a servo loop is to run.
#pragma once

#include <cstddef>

#include <dashpot/servo/admission.hpp>
#include <dashpot/servo/arm_path.hpp>
#include <dashpot/servo/command_path.hpp>
#include <dashpot/servo/realtime_session.hpp>
#include <dashpot/servo/telemetry_writer.hpp>

namespace dashpot {

// For one axis, or for two: what differs is what may be asked of the command's path, and what is reported.
template <class Command, class Record>
struct loop_options {
  device_identity identity;        // of the device's description
  bool require_certified = false;  // refuse a model that is not certified on this device
  bool start_running = true;       // false: idle until control().start()
  double duration = 0;             // [s]; 0: until control().stop()
  double farewell = 0.5;           // at the end, the longest wait for the device to confirm the safe command [s]
  Command command;
  realtime_wishes realtime;  // ignored in simulated time
  outputs_of<Record> outputs;
  std::size_t telemetry_capacity = 1u << 14;  // records that may wait for the writer
};

using servo_options = loop_options<command_options, telemetry_record>;
using arm_servo_options = loop_options<arm_command_options, arm_telemetry_record>;

}  // namespace dashpot
