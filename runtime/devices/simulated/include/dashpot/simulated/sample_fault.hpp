// Faults of the sampling that a simulated device makes on request. The mechanics underneath go on undisturbed, and the
// samples before a fault are the same, bit for bit, as without it.
#pragma once

#include <cstdint>

namespace dashpot::simulated {

enum class sample_fault_kind : unsigned char {
  lost,          // read() returns no_data
  repeated,      // read() returns stale and the newest sample that was delivered before
  corrupted,     // read() returns corrupted
  disconnected,  // read() returns disconnected
  device_error,  // read() returns fault
  late,          // the sample, and with it all later ones, comes `size` [s] later than it should
  not_a_number,  // the position is NaN
  jump,          // position and counts are off by `size` at the joint [rad] or [m], rounded to whole encoder steps
};

struct sample_fault {
  sample_fault_kind kind = sample_fault_kind::lost;
  std::uint64_t first = 0;  // index of the first sample that it strikes: reads before it
  std::uint64_t count = 1;  // samples in a row; `late` strikes each of them
  double size = 0;
};

}  // namespace dashpot::simulated
